#ifndef GB_PACK_DIE_BED_COPY_H
#define GB_PACK_DIE_BED_COPY_H

#include "pack/die/bed.h"

/* Positions, velocities, histories and die, for a restore. */
struct gb_bed_copy;
bool gb_bed_copy_take(const struct gb_bed *bed, struct gb_bed_copy **copy,
                      struct gb_error *err); /* reuses *copy when not NULL */
bool gb_bed_copy_restore(struct gb_bed *bed, const struct gb_bed_copy *copy,
                         struct gb_error *err);
void gb_bed_copy_destroy(struct gb_bed_copy *copy); /* NULL is fine */

/* 64-bit hash over positions, velocities, histories and punch: equal states, equal
 * hashes. */
uint64_t gb_bed_copy_hash(const struct gb_bed *bed);

#endif
