#ifndef GB_PACK_KERNEL_SWEEP_F64_H
#define GB_PACK_KERNEL_SWEEP_F64_H

#include <stdint.h>

#include "pack/kernel/tally.h"

struct gb_batch;
struct gb_engine;
struct gb_pair_list;
struct gb_particles;

/* The parts of sweep_run in double precision.  The rows for a particle are added after
 * all blocks have been swept.
 *
 * Of unequal sizes rotation increments are arcs, d_i times the angle (equal to the values of
 * equal spheres where all d are 1), and torques are moments over d_i, the conjugate
 * quantity: small particles rotate as easily as large ones, and a relaxer needs no sizes.
 * The contact point divides the centre distance in the ratio of the diameters, so the
 * forces of a pair and its moments about any point balance. */

/* Forces of the pairs of block b on their first particles; rows for the second ones. */
void gb_sweep_f64_block(struct gb_engine *engine, int64_t b, double cutoff2,
                        struct gb_tally *tally);

/* Diameters of pairs [slot, slot + n) of a list, where they are unequal. */
void gb_sweep_f64_gather_diameters(const struct gb_engine *engine,
                                   const struct gb_pair_list *list,
                                   struct gb_batch *restrict batch, int64_t slot);

/* Adds the rows for particles begin .. end - 1. */
void gb_sweep_f64_collect(struct gb_engine *engine, int64_t begin, int64_t end);

/* Sums over the forces on particles begin .. end - 1. */
void gb_sweep_f64_sum(const struct gb_particles *particles, int64_t begin, int64_t end,
                      struct gb_sweep_along along, struct gb_force_sums *sums);

#endif
