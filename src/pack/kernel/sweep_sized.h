#ifndef GB_PACK_KERNEL_SWEEP_SIZED_H
#define GB_PACK_KERNEL_SWEEP_SIZED_H

struct gb_engine;

/* The forces of gb_sweep_run for particles of unequal sizes: pair by pair through the
 * scalar laws (law/law_unequal.h), sums in the order of the lists, so bits do not depend
 * on the number of threads.
 *
 * Rotation increments are arcs, d_i times the angle (so that the numbers are those of
 * equal spheres where all d are 1), and torques are moments over d_i, which does the same
 * work: small particles rotate as easily as large ones, and a relaxer needs no
 * sizes.  The surfaces of two particles meet where their centre distance is
 * divided as their diameters are, so the forces of a pair balance, and its moments about
 * any point do too. */
void gb_sweep_sized_run(struct gb_engine *engine);

#endif
