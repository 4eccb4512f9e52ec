#ifndef GB_PACK_DIE_BED_RECORD_H
#define GB_PACK_DIE_BED_RECORD_H

#include "base/record.h"
#include "pack/die/bed.h"

/* Positions, velocities, histories and die, for a restore. */
struct gb_bed_copy;

bool gb_bed_record_take(const struct gb_bed *bed, struct gb_bed_copy **copy,
                        struct gb_error *err); /* reuses *copy when not NULL */

bool gb_bed_record_restore(struct gb_bed *bed, const struct gb_bed_copy *copy,
                           struct gb_error *err);

void gb_bed_record_destroy(struct gb_bed_copy *copy); /* NULL is fine */

/* 64-bit hash over positions, velocities, histories and punch: equal states, equal
 * hashes. */
uint64_t gb_bed_record_hash(const struct gb_bed *bed);

/* A bed into a record, or back into one of the same sizes and law, right after an
 * evaluation: it then continues to the same bits.  The lists are not part of it, since no
 * force depends on them: they are rebuilt.  Errors: GB_ERR_INPUT naming what is missing
 * or out of range, GB_ERR_MEMORY. */
bool gb_bed_record(struct gb_bed *bed, struct gb_record *record, struct gb_error *err);

#endif
