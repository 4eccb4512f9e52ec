#ifndef GB_PACK_DIE_BED_SWEEP_H
#define GB_PACK_DIE_BED_SWEEP_H

#include "pack/die/bed.h"

/* Forces, torques and histories of all pairs and walls over a step, by blocks on the threads
 * of the bed; the tally of the bed. */
void gb_bed_sweep(struct gb_bed *bed, double step);

/* Then the forces on the second particles of pairs of two blocks: of those in block b, and of
 * all. */
void gb_bed_sweep_sum_block(struct gb_bed *bed, int64_t b);
void gb_bed_sweep_sum(struct gb_bed *bed);

#endif
