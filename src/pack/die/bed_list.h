#ifndef GB_PACK_DIE_BED_LIST_H
#define GB_PACK_DIE_BED_LIST_H

#include "pack/die/bed.h"

/* Numbers the particles anew along a Hilbert curve, so that neighbours in space are
 * neighbours in memory.  Contacts keep their histories; forces are those of the next
 * evaluation.  Not for a bed with welds, which name particles by number.
 * Errors: GB_ERR_MEMORY. */
bool gb_bed_list_renumber(struct gb_bed *bed, struct gb_error *err);

bool gb_bed_list_init(struct gb_bed_list *list, int64_t particles, int64_t room,
                      struct gb_error *err);
void gb_bed_list_finish(struct gb_bed_list *list);

/* Rebuilds candidates and lists of a bed; touching contacts keep their histories. */
bool gb_bed_list_rebuild(struct gb_bed *bed, struct gb_error *err);

/* Rows of `force` and `torque` for all particles, walls and crossings; those of the
 * particles keep their values. */
bool gb_bed_list_make_rows(struct gb_bed *bed, struct gb_error *err);

/* Draws the list of pairs anew from the candidates. */
bool gb_bed_list_draw(struct gb_bed *bed, struct gb_error *err);

/* Fills in `start` of a list whose contacts are sorted. */
void gb_bed_list_start(struct gb_bed_list *list, int64_t particles);

/* The touching contacts of a list, with their histories. */
bool gb_bed_list_copy_touching(struct gb_bed_list *to, const struct gb_bed_list *from,
                               int64_t particles, struct gb_error *err);

#endif
