#ifndef GB_STUDY_YIELD_YIELD_STUDY_H
#define GB_STUDY_YIELD_YIELD_STUDY_H

#include <glib.h>
#include <stdbool.h>

#include "greenbody/params.h"
#include "study/compact/cells.h"
#include "study/yield/yield_options.h"
#include "study/yield/yield_surface.h"

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
 * under DIR/cells.  gb_yield_study_finish is due.  Errors: GB_ERR_INPUT, GB_ERR_CANCELLED,
 * GB_ERR_MACHINE; GB_ERR_GUARD when no cell of a compact has an answer. */
bool gb_yield_study_run(struct gb_yield_study *study, const struct gb_params *preset,
                        const struct gb_yield_options *options, const char *directory,
                        int jobs, const struct gb_cells_callbacks *callbacks,
                        struct gb_error *err);
void gb_yield_study_finish(struct gb_yield_study *study); /* zeroed is fine */

/* The surface of a mark at an offset (index of gb_yield_options_offset). */
const struct gb_yield_surface *gb_yield_study_surface(const struct gb_yield_study *study,
                                                      int mark, int offset);

#endif
