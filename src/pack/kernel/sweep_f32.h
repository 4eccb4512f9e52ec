#ifndef GB_PACK_KERNEL_SWEEP_F32_H
#define GB_PACK_KERNEL_SWEEP_F32_H

#include <stdint.h>

#include "pack/kernel/batch/batch.h"

struct gb_engine;
struct gb_force_sums;
struct gb_pair_list;
struct gb_tally;

/* The parts of sweep_run in single precision.  All particles are converted before a
 * block is swept.  The rows for a block are added after it and all blocks with rows for
 * it were swept. */

/* Forces of the pairs of block b. */
void gb_sweep_f32_block(struct gb_engine *engine, int64_t b, double cutoff2,
                        struct gb_tally *tally);

/* Adds the rows of cross pairs for particles begin .. end - 1, and sums over them. */
void gb_sweep_f32_collect(struct gb_engine *engine, int64_t begin, int64_t end,
                          struct gb_force_sums *sums);

/* Branch vectors and forces on the first particles of batch->n pairs of a list from slot
 * on, as of the last evaluation: in single precision they are computed again from the
 * contact records instead of kept. */
void gb_sweep_f32_recompute(const struct gb_engine *engine,
                            const struct gb_pair_list *list, int64_t slot,
                            struct gb_batch_f32 *batch);

#endif
