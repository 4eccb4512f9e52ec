#ifndef GB_PACK_KERNEL_SWEEP_SIZED_H
#define GB_PACK_KERNEL_SWEEP_SIZED_H

#include <stdbool.h>
#include <stdint.h>

struct gb_engine;

/* The forces of gb_sweep_run for particles of unequal sizes: pair by pair through the
 * scalar laws (law/law_unequal.h), sums in the order of the lists, so bits do not depend
 * on the number of threads.
 *
 * Rotation increments are arcs, d_i times the angle (equal to the values of
 * equal spheres where all d are 1), and torques are moments over d_i, the conjugate
 * quantity: small particles rotate as easily as large ones, and a relaxer needs no
 * sizes.  The contact point divides the centre distance in the ratio of the diameters, so
 * the forces of a pair and its moments about any point balance. */
void gb_sweep_sized_run(struct gb_engine *engine);

/* Pair k of the near or the far list after another motion than that of its particles;
 * nothing is stored.
 *
 * motion   branch vector (d), rotation increments of i and of j
 * result   force on i, torques on i and on j, as above */
void gb_sweep_sized_pair(const struct gb_engine *engine, bool near, int64_t k,
                         const double motion[9], double result[9]);

#endif
