#ifndef GB_PACK_DIE_BED_DRIFT_H
#define GB_PACK_DIE_BED_DRIFT_H

#include "pack/die/bed.h"
#include "pack/kernel/bed_motion.h"

/* Motion of all particles, by blocks on the threads of the bed. */

/* x += step v.  Returns a bound of the squared deviation, for gb_bed_evaluate. */
double gb_bed_drift(struct gb_bed *bed, double step);

/* After gb_bed_evaluate_blocks: forces are summed, then gb_bed_motion_kick of the rows of the
 * bed.  Returns a bound of the speeds. */
double gb_bed_drift_kick(struct gb_bed *bed, const struct gb_bed_motion_kick *by);

#endif
