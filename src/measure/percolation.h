#ifndef GB_MEASURE_PERCOLATION_H
#define GB_MEASURE_PERCOLATION_H

#include <stdint.h>

#include "pack/structure/chain_growth.h"

/* Distance below which particles of chain growth touch, d: their own is r_eq, and without
 * adhesion (r_eq = 1) rounding decides. */
double gb_percolation_reach(double r_eq);

/* Least number of particles whose cluster joins its images in all neighbouring cells, while
 * chain growth places one after another: N_1 of P1 section III.  Growth does not look
 * ahead, so that the first N particles of a longer one are the structure of N.
 *
 * grow        of one size; its count is where the search begins
 * particles   N_1
 * Errors: GB_ERR_INPUT (unequal sizes; the cell is full before the cluster percolates),
 * GB_ERR_MEMORY, GB_ERR_CANCELLED. */
bool gb_percolation_find(const struct gb_chain_growth *grow, int64_t *particles,
                         struct gb_error *err);

#endif
