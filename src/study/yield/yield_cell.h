#ifndef GB_STUDY_YIELD_YIELD_CELL_H
#define GB_STUDY_YIELD_YIELD_CELL_H

#include "many/pool.h"
#include "study/yield/yield_options.h"

/* One compact of one cell, as the work of a pool: pressed, unloaded to a point inside, and
 * probed along all directions.
 *
 * path  of the cell without ending: PATH.ini is the question (study/yield/yield_options.h),
 *       PATH.csv receives a row per direction and offset, PATH.paths.csv the states of all
 *       probes */
gb_pool_work gb_yield_cell_work;

/* The same without files.  point: of each direction at the chosen offset, p_pa NaN where it
 * was not reached; top_pa: p and q of the compact.  Errors: those of the compact. */
bool gb_yield_cell_measure(struct gb_yield_point point[GB_YIELD_DIRECTIONS_MAX],
                           double top_pa[2], const struct gb_params *params,
                           const struct gb_keep_point *mark,
                           const struct gb_yield_options *options,
                           const struct gb_pool_callbacks *callbacks,
                           struct gb_error *err);

#endif
