#ifndef GB_PACK_DIE_BED_SWEEP_H
#define GB_PACK_DIE_BED_SWEEP_H

#include "pack/die/bed.h"
#include "pack/kernel/bed_batch.h"

/* x += step v.  Returns a bound of the squared deviation, for gb_bed_evaluate. */
double gb_bed_sweep_drift(struct gb_bed *bed, double step);

/* After gb_bed_evaluate_blocks: forces are summed, then gb_bed_batch_kick of the rows of the
 * bed.  Returns a bound of the speeds. */
double gb_bed_sweep_kick(struct gb_bed *bed, const struct gb_bed_batch_kick *by);

/* Forces, torques and histories of all pairs and walls over a step, by blocks on the threads
 * of the bed; the tally of the bed. */
void gb_bed_sweep(struct gb_bed *bed, double step);

/* Then the forces on the second particles of pairs of two blocks: of those in block b, and of
 * all. */
void gb_bed_sweep_sum(struct gb_bed *bed);

#endif
