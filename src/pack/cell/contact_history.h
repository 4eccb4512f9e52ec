#ifndef GB_PACK_CELL_CONTACT_HISTORY_H
#define GB_PACK_CELL_CONTACT_HISTORY_H

#include <stdbool.h>
#include <stdint.h>

#include "base/record.h"
#include "greenbody/status.h"
#include "pack/cell/contacts.h"

struct gb_engine;

/* The contacts with their histories in the order of the near list, independent of its
 * slots: what copies and checkpoints hold.  Branch vectors are left out. */
struct gb_contact_history {
    int64_t count, capacity; /* contacts */
    int planes;              /* values of each */
    int32_t (*pair)[2];
    enum gb_real real;
    void *value;    /* capacity x planes, of `real` */
    int64_t *begin; /* scratch: first contact of each thread */
    int parts;
};

void gb_contact_history_finish(struct gb_contact_history *history);

/* Writes every contact of the engine, in the order of its list. */
bool gb_contact_history_write(struct gb_contact_history *history,
                              const struct gb_engine *engine, struct gb_error *err);

/* The values of contact number `index` into slot k. */
void gb_contact_history_apply(const struct gb_contact_history *history, int64_t index,
                              struct gb_contacts *contacts, int64_t k);

/* Gives every slot of a new list its history, or none. */
void gb_contact_history_read(const struct gb_contact_history *history,
                             struct gb_engine *engine);

/* Item of a checkpoint with the pairs of the history. */
#define GB_CONTACT_HISTORY_PAIR "world/pair"

/* Saves the kept values of every contact of the engine, in the order of its list, without
 * another copy of them. */
bool gb_contact_history_save(const struct gb_engine *engine, struct gb_record *record,
                             struct gb_error *err);

/* Saves the kept values of a history, or loads them; contacts are not changed.
 * Errors: GB_ERR_INPUT naming the item, GB_ERR_MEMORY. */
bool gb_contact_history_record(struct gb_contact_history *history,
                               const struct gb_engine *engine, struct gb_record *record,
                               struct gb_error *err);

#endif
