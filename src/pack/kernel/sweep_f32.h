#ifndef GB_PACK_KERNEL_SWEEP_F32_H
#define GB_PACK_KERNEL_SWEEP_F32_H

#include <stdbool.h>
#include <stdint.h>

struct gb_batch_f32;
struct gb_tally;
struct gb_world;
struct gb_force_sums;

/* The parts of gb_sweep_run in single precision, for particles [begin, end), or block b:
 * where they are, the forces of their own pairs, and what the pairs of earlier blocks
 * add.  All blocks are prepared before any is swept, and a block collects when it and all
 * that leave rows for it are swept. */
void gb_sweep_f32_prepare(struct gb_world *world, int64_t begin, int64_t end);
void gb_sweep_f32_block(struct gb_world *world, int64_t b, double cutoff2,
                        struct gb_tally *tally);
void gb_sweep_f32_collect(struct gb_world *world, int64_t begin, int64_t end,
                          struct gb_force_sums *sums);

/* Arms of batch->n pairs of a list from slot on, and the forces on their first particles,
 * as of the last evaluation: nothing keeps them from there. */
void gb_sweep_f32_recall(const struct gb_world *world, bool near, int64_t slot,
                         struct gb_batch_f32 *batch);

/* Positions follow places; where nobody moved, nothing is done. */
void gb_sweep_f32_settle(struct gb_world *world);

/* Forces and torques as doubles, for all but gb_integrate_f32_step; and back. */
void gb_sweep_f32_widen(struct gb_world *world);
void gb_sweep_f32_narrow(struct gb_world *world);

#endif
