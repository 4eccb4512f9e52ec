#ifndef GB_STUDY_YIELD_YIELD_CELL_H
#define GB_STUDY_YIELD_YIELD_CELL_H

#include "many/pool.h"

/* One compact of one cell, as the work of a pool: pressed, unloaded to a point inside, and
 * probed along all directions.
 *
 * path  of the cell without ending: PATH.ini is the question (study/yield/yield_options.h),
 *       PATH.csv receives a row per direction and offset, PATH.paths.csv the states of all
 *       probes */
gb_pool_work gb_yield_cell_work;

#endif
