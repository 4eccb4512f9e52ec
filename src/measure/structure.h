#ifndef GB_MEASURE_STRUCTURE_H
#define GB_MEASURE_STRUCTURE_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/status.h"
#include "pack/cell/cell.h"
#include "pack/structure/chain_growth.h"

/* Measures of plain positions (count x 3, reduced units). */

/* Radial distribution function, P1 eq. (14) (2D: its planar form).
 *
 * r_max      at most half the least height of the cell (gb_cell_shortest)
 * g          bins values; bin k covers [k, k+1) r_max / bins
 * Errors: GB_ERR_INPUT for r_max out of range, GB_ERR_MEMORY.  Cost linear in count for a
 * fixed r_max (cell grid). */
bool gb_structure_rdf(const struct gb_cell *cell, int64_t count, const double *position,
                      double r_max, int bins, double *g, struct gb_error *err);

/* Mean of such a g over the last diameter before r_max, each bin by its volume.  ripple
 * (NULL is fine): rms deviation from 1 of the means over the quarters of that diameter; 0
 * where the cell is wide enough for its density. */
double gb_structure_rdf_end(int dimension, double r_max, int bins, const double *g,
                            double *ripple);

struct gb_connectivity {
    int64_t clusters;      /* of particles closer than the reach */
    int64_t largest;       /* particles in the largest */
    bool percolates[3];    /* the largest spans axis k and meets its own image */
    double coordination;   /* mean number of neighbours closer than the reach */
    int64_t histogram[16]; /* particles with 0, 1, ..., 15 or more neighbours */
};

/* Clusters of particles closer than reach (d; where radius is not NULL: in sums of two
 * radii), and whether the largest joins its own periodic
 * images (union-find that carries image shifts). */
bool gb_structure_connectivity(const struct gb_cell *cell, int64_t count,
                               const double *position, const double *radius, double reach,
                               struct gb_connectivity *out, struct gb_error *err);

/* Distance below which particles of chain growth touch, d: their own is r_eq, and without
 * adhesion (r_eq = 1) rounding decides. */
double gb_structure_reach(double r_eq);

/* Least number of particles whose cluster joins its images in all neighbouring cells, while
 * chain growth places one after another: N_1 of P1 section III.  Growth does not look
 * ahead, so that the first N particles of a longer one are the structure of N.
 *
 * grow        of one size; its count is where the search begins
 * particles   N_1
 * Errors: GB_ERR_INPUT (unequal sizes; the cell is full before the cluster percolates),
 * GB_ERR_MEMORY, GB_ERR_CANCELLED. */
bool gb_structure_percolation(const struct gb_chain_growth *grow, int64_t *particles,
                              struct gb_error *err);

#endif
