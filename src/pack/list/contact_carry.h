#ifndef GB_PACK_LIST_CONTACT_CARRY_H
#define GB_PACK_LIST_CONTACT_CARRY_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/status.h"
#include "pack/cell/contacts.h"

struct gb_engine;

/* How contact records survive a rebuild of the lists: in their arrays, where each moves from
 * its slot of the old list to that of the new one.  Both lists have the same order, so that
 * no record needs another place in between. */
struct gb_contact_carry {
    int64_t count, capacity; /* contacts */
    int32_t (*pair)[2];      /* particles; then the first and the new slot, or -1 */
    int32_t *slot;           /* of the old list */
    int64_t *begin;          /* scratch: first contact of each thread */
    int parts;
};

void gb_contact_carry_finish(struct gb_contact_carry *carry);

/* Before the rebuild: the contacts and their slots. */
bool gb_contact_carry_note(struct gb_contact_carry *carry, const struct gb_engine *engine,
                           struct gb_error *err);

/* Room for the records of a longer list, array by array; those there are stay.  On failure there
 * are none. */
bool gb_contact_carry_grow(struct gb_contacts *contacts, int64_t capacity,
                           struct gb_error *err);

/* After it: their records in the slots of the new list, all others without a contact. */
void gb_contact_carry_move(struct gb_contact_carry *carry, struct gb_engine *engine);

#endif
