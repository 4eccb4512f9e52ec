#ifndef GB_PACK_DIE_BED_ORDER_H
#define GB_PACK_DIE_BED_ORDER_H

#include "pack/die/bed.h"

/* Numbers the particles anew along a Hilbert curve, so that neighbours in space are
 * neighbours in memory.  Contacts keep their histories; forces are those of the next
 * evaluation.  Not for a bed with welds, which name particles by number.
 * Errors: GB_ERR_MEMORY. */
bool gb_bed_order_renumber(struct gb_bed *bed, struct gb_error *err);

#endif
