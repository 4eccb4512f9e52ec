#ifndef GB_PACK_DIE_BED_WALLS_H
#define GB_PACK_DIE_BED_WALLS_H

#include "pack/die/bed.h"
#include "pack/kernel/bed_batch.h"

/* Gives the rows of the walls their velocities. */
void gb_bed_walls_move(struct gb_bed *bed);

/* Adds the forces of the contacts of a block with die, punch and funnel to its particles and
 * to its tally. */
void gb_bed_walls_sweep(struct gb_bed *bed, int64_t block, struct gb_bed_batch *b);

#endif
