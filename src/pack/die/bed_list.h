#ifndef GB_PACK_DIE_BED_LIST_H
#define GB_PACK_DIE_BED_LIST_H

#include "pack/die/bed.h"

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

/* Gives the contacts of `to` the histories that `from` holds for the same pairs. */
void gb_bed_list_transfer(struct gb_bed_list *to, const struct gb_bed_list *from,
                          int64_t particles);

/* Gives a contact the history of another one. */
void gb_bed_list_copy_slot(struct gb_bed_contacts *to, int64_t slot,
                           const struct gb_bed_contacts *from, int64_t old);

/* Fills in `start` of a list whose contacts are sorted. */
void gb_bed_list_start(struct gb_bed_list *list, int64_t particles);

/* The touching contacts of a list, with their histories. */
bool gb_bed_list_copy_touching(struct gb_bed_list *to, const struct gb_bed_list *from,
                               int64_t particles, struct gb_error *err);

#endif
