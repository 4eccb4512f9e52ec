#ifndef GB_PACK_LIST_ENGINE_LISTS_H
#define GB_PACK_LIST_ENGINE_LISTS_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/status.h"

struct gb_cell;
struct gb_engine;

/* Builds the neighbour lists from the positions, which lie inside `cell`, and makes room
 * for all that belongs to their pairs; contact records are undefined afterwards.  Errors:
 * those of gb_neighbour_list_build; there are no lists then. */
bool gb_engine_lists_build(struct gb_engine *engine, const struct gb_cell *cell,
                           struct gb_error *err);

/* Contacts on their way from the old lists to the new ones. */
struct gb_contact_carry {
    int64_t count, capacity; /* contacts */
    int32_t (*pair)[2];      /* particles; then the first and the new slot, or -1 */
    int32_t *slot;           /* of the old list */
    int64_t *begin;          /* scratch: first contact of each thread */
    int parts;
};

void gb_engine_lists_carry_finish(struct gb_contact_carry *carry);

/* Before the build: notes the contacts and their slots.  Errors: GB_ERR_MEMORY. */
bool gb_engine_lists_carry_note(struct gb_contact_carry *carry,
                                const struct gb_engine *engine, struct gb_error *err);

/* After the build: moves their records to the slots of the new list.  All other slots have no
 * contact. */
void gb_engine_lists_carry_move(struct gb_contact_carry *carry, struct gb_engine *engine);

#endif
