#ifndef GB_STUDY_YIELD_YIELD_H
#define GB_STUDY_YIELD_YIELD_H

#include <glib.h>
#include <stdbool.h>

#include "greenbody/params.h"
#include "many/pool.h"
#include "measure/yield_point.h"
#include "scene/field/keep_points.h"
#include "study/compact/cells.h"
#include "study/yield/yield_surface.h"

/* Yield surfaces of the compacts of a preset (docs/mechanics.md). */

/* Offsets at which points are reported, in units of the chosen one. */
enum { GB_YIELD_OFFSETS = 3, GB_YIELD_OFFSET_CHOSEN = 1 };

struct gb_yield_options {
    struct gb_keep_points marks; /* the compacts: densities or pressing pressures */
    int replicas;                /* cells, from structure.seed on */
    int directions;              /* evenly spaced from +p on; a multiple of 4 */
    double inside;      /* pressure at which probes begin, over that of the compact */
    double offset;      /* of plastic strain */
    double step;        /* strain step of a probe */
    double strain_most; /* at which a probe is given up */
    double tolerance;   /* numerics.tolerance of unloading and probes */
};

void gb_yield_options_init(struct gb_yield_options *options);

/* Presses and probes one cell, without files.
 *
 * point   of each direction at the chosen offset; p_pa NaN where it was not reached
 * top_pa  p and q of the compact
 * Errors: those of the compact. */
bool gb_yield_measure(struct gb_yield_point point[GB_YIELD_DIRECTIONS_MAX],
                      double top_pa[2], const struct gb_params *params,
                      const struct gb_keep_point *mark,
                      const struct gb_yield_options *options,
                      const struct gb_pool_callbacks *callbacks, struct gb_error *err);

/* Yield surfaces of the compacts of a preset (section "Yield" of docs/mechanics.md). */
struct gb_yield_study {
    struct gb_yield_options options;
    GPtrArray *surface; /* of struct gb_yield_surface: marks x GB_YIELD_OFFSETS */
    GArray *point;      /* of struct gb_yield_point: those of every cell at the chosen
                         * offset; directions that did not reach it are left out */
    size_t failed;      /* cells without an answer; `why` says it of the first */
    struct gb_error why;
};

/* Presses and probes all cells, `jobs` at a time (0: one per processor), with their answers
 * under DIR/cells.  gb_yield_finish is due.  Errors: GB_ERR_INPUT, GB_ERR_CANCELLED,
 * GB_ERR_MACHINE; GB_ERR_GUARD when no cell of a compact has an answer. */
bool gb_yield_run(struct gb_yield_study *study, const struct gb_params *preset,
                  const struct gb_yield_options *options, const char *directory, int jobs,
                  const struct gb_cells_callbacks *callbacks, struct gb_error *err);
void gb_yield_finish(struct gb_yield_study *study); /* zeroed is fine */

/* The surface of a mark at an offset (index of offsets). */
const struct gb_yield_surface *gb_yield_study_surface(const struct gb_yield_study *study,
                                                      int mark, int offset);

/* yield.csv: a row per compact, offset and direction, means over the cells with standard
 * errors. */
GString *gb_yield_points(const struct gb_yield_study *study, const char *comment);

/* yield_fit.csv: a row per compact, offset and quantity, with its 95 % interval. */
GString *gb_yield_fit(const struct gb_yield_study *study, const char *comment);

/* Writes all of them into a folder; preset.ini is the caller's. */
bool gb_yield_write(const struct gb_yield_study *study, const char *directory,
                    const char *title, const char *command, struct gb_error *err);

#endif
