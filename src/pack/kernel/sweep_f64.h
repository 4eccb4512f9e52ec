#ifndef GB_PACK_KERNEL_SWEEP_F64_H
#define GB_PACK_KERNEL_SWEEP_F64_H

#include <stdint.h>

#include "pack/kernel/tally.h"

struct gb_engine;
struct gb_particles;

/* The parts of gb_sweep_run in double precision, for particles of one size.  The rows
 * for a particle are added after all blocks have been swept. */

/* Forces of the pairs of block b on their first particles; rows for the second ones. */
void gb_sweep_f64_block(struct gb_engine *engine, int64_t b, double cutoff2,
                        struct gb_tally *tally);

/* Adds the rows for particles begin .. end - 1. */
void gb_sweep_f64_collect(struct gb_engine *engine, int64_t begin, int64_t end);

/* Sums over the forces on particles begin .. end - 1. */
void gb_sweep_f64_sum(const struct gb_particles *particles, int64_t begin, int64_t end,
                      struct gb_sweep_along along, struct gb_force_sums *sums);

#endif
