#ifndef GB_STUDY_STRENGTH_STRENGTH_CELL_H
#define GB_STUDY_STRENGTH_STRENGTH_CELL_H

#include "many/pool.h"

/* One compact of one cell, as the work of a pool: pressed, all stresses taken away, and
 * broken in each test on a copy.
 *
 * path  of the cell without ending: PATH.ini is the question, PATH.csv receives a row per
 *       recorded point of each test: test, strain, stress in Pa, density of the compact,
 *       share of its bridges that are broken */
gb_pool_work gb_strength_cell_work;

#endif
