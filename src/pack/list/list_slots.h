#ifndef GB_PACK_LIST_LIST_SLOTS_H
#define GB_PACK_LIST_LIST_SLOTS_H

#include <stdbool.h>
#include <stdint.h>

#include "pack/cell/contacts.h"
#include "pack/list/neighbour_list.h"

/* Insertion of pairs into the free slots of a patchable list, and removal. */

/* Changes of one list, ascending. */
struct gb_list_slots {
    int64_t *at; /* slot of each before anything is moved */
    const struct gb_inserted_pair **pair;
    int count;
};

bool gb_list_slots_init(struct gb_list_slots *slots, int64_t capacity,
                        struct gb_error *err);
void gb_list_slots_finish(struct gb_list_slots *slots);

/* Adds a change at the slot of the pair. */
void gb_list_slots_add(struct gb_list_slots *slots, const struct gb_neighbour_list *list,
                       const struct gb_pair_list *pairs,
                       const struct gb_inserted_pair *pair);

/* First slot of pair->first whose second particle is not before pair->other. */
int64_t gb_list_slots_find(const struct gb_neighbour_list *list,
                           const struct gb_pair_list *pairs,
                           const struct gb_inserted_pair *pair);

bool gb_list_slots_holds(const struct gb_neighbour_list *list,
                         const struct gb_pair_list *pairs,
                         const struct gb_inserted_pair *pair);

/* True if every block has free slots for its insertions. */
bool gb_list_slots_fit(const struct gb_neighbour_list *list,
                       const struct gb_pair_list *pairs, struct gb_list_slots slots);

/* True if a changed pair crosses from one block into another. */
bool gb_list_slots_cross(const struct gb_list_slots *slots, int64_t count);

/* contacts: records of the list, which get the same slots, without a history; NULL: none */
void gb_list_slots_insert(struct gb_neighbour_list *list, struct gb_pair_list *pairs,
                          struct gb_contacts *contacts, struct gb_list_slots slots);
void gb_list_slots_remove(struct gb_neighbour_list *list, struct gb_pair_list *pairs,
                          struct gb_list_slots slots);

#endif
