#ifndef GB_PACK_DIE_BED_WALLS_H
#define GB_PACK_DIE_BED_WALLS_H

#include "pack/die/bed.h"
#include "pack/kernel/bed_batch.h"

/* Adds the forces of the contacts with die, punch and funnel to the particles and to the
 * tally. */
void gb_bed_walls_sweep(struct gb_bed *bed, struct gb_bed_batch *b);

#endif
