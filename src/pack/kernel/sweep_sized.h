#ifndef GB_PACK_KERNEL_SWEEP_SIZED_H
#define GB_PACK_KERNEL_SWEEP_SIZED_H

#include <stdbool.h>

struct gb_world;

/* Doubles per near pair: its row, and what it adds to the tally. */
enum { GB_SIZED_ROW = 12 };

/* gb_sweep_run for particles of unequal sizes: pair by pair through the scalar laws
 * (law/law_unequal.h), sums in the order of the lists.  Bits do not depend on the number
 * of threads.
 *
 * Turns are arcs, d_i times the rotation (the radius would do as well; so the numbers are
 * those of equal spheres where all are d), and torques what does work over them, the
 * moment over d_i: small particles are as easily turned as large ones, and a relaxer
 * needs to know nothing of sizes.  The surfaces of two particles meet where their
 * centres' distance is divided as their diameters are, so the force of a pair is balanced
 * and its moments are, about any point. */
bool gb_sweep_sized_run(struct gb_world *world, double *travel);

#endif
