#ifndef GB_STUDY_YIELD_H
#define GB_STUDY_YIELD_H

#include <glib.h>
#include <stdbool.h>

#include "greenbody/params.h"
#include "greenbody/status.h"
#include "many/pool.h"
#include "measure/fit.h"
#include "measure/yield_point.h"
#include "scene/field/keep_points.h"
#include "study/cells.h"

enum { GB_YIELD_DIRECTIONS_MAX = 72, GB_YIELD_REPLICAS_MAX = 1000 };

/* What a yield surface says in one number each.  Angles in degrees. */
enum gb_yield_surface_quantity {
    GB_YIELD_CENTRE_P, /* of the fitted ellipse, Pa */
    GB_YIELD_CENTRE_Q,
    GB_YIELD_HALF_P,
    GB_YIELD_HALF_Q,
    GB_YIELD_TENSION, /* where the ellipse meets the p axis, Pa: centre less half axis ... */
    GB_YIELD_PRESSURE,  /* ... and centre plus half axis */
    GB_YIELD_SHIFT,     /* centre over half axis along p; above 0: towards compression */
    GB_YIELD_MISFIT,    /* rms distance of the points from the ellipse, relative */
    GB_YIELD_ANGLE_RMS, /* between flow and normal, over all directions */
    GB_YIELD_ANGLE_NOISE, /* rms of the errors of these angles: what flow along the normal
                           * would show as rms */
    GB_YIELD_FLOW_DEVIATION, /* mean angle from the normal to the flow, positive towards
                              * +p; without the directions along the p axis.  0 for flow
                              * along the normal */
    GB_YIELD_DILATANCY_COMPRESSION, /* -dv/|dw| of plastic flow along +q at constant p */
    GB_YIELD_DILATANCY_EXTENSION,   /* the same along -q */
    GB_YIELD_QUANTITIES
};

/* A row of the table of quantities. */
struct gb_yield_surface_row {
    const char *name, *unit;
    double factor; /* to the unit */
};

extern const struct gb_yield_surface_row gb_yield_surface_rows[GB_YIELD_QUANTITIES];

/* One direction of loading, over the cells. */
struct gb_yield_surface_direction {
    struct gb_yield_point mean;    /* replica 0 */
    int cells;                     /* that reached the offset */
    struct gb_fit_value angle;     /* of the flow from the outward normal, degrees */
    struct gb_fit_value dilatancy; /* -dv/|dw| */
};

/* The yield surface of a compact at one offset.  Errors and 95 % intervals by the jackknife
 * over the cells (Student's t); NaN with fewer than two. */
struct gb_yield_surface {
    struct gb_keep_point mark;
    double offset;
    struct gb_fit_value density, top_p, top_q; /* of the compact; Pa */
    int cells, directions;
    struct gb_yield_surface_direction direction[GB_YIELD_DIRECTIONS_MAX];
    struct gb_fit_value quantity[GB_YIELD_QUANTITIES];
};

/* The points of one compact and offset: cells x directions, p_pa NaN where there is none;
 * the stresses of the compacts. */
struct gb_yield_surface_data {
    const struct gb_yield_point *point;
    const double *top_p, *top_q; /* of each cell, Pa; NaN: the cell failed */
    int cells, directions;
};

/* A direction counts where half of the cells or more reached the offset.  Errors:
 * GB_ERR_MEMORY; a surface that cannot be fitted has quantities NaN. */
bool gb_yield_surface_measure(struct gb_yield_surface *surface,
                              const struct gb_yield_surface_data *data,
                              struct gb_error *err);

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
