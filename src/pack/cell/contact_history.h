#ifndef GB_PACK_CELL_CONTACT_HISTORY_H
#define GB_PACK_CELL_CONTACT_HISTORY_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/status.h"
#include "pack/kernel/batch.h"

struct gb_world;

/* Touching pairs in list order with their histories: whole for rebuilds, without the arms
 * for copies. */
struct gb_contact_history {
    int64_t count, capacity;
    int planes; /* values a line holds: all planes of the contacts, or those kept */
    int32_t (*pair)[2];
    bool single;
    void *value;   /* capacity x planes, double or (single) float */
    int64_t state; /* of the world, that it tells of: world->state; 0: none */
    int64_t *from; /* scratch: where the lines of each thread begin */
    int threads;
};

void gb_contact_history_finish(struct gb_contact_history *ledger);

/* Room for so many lines of so many values; what was there is lost when it grows. */
bool gb_contact_history_reserve(struct gb_contact_history *ledger, int64_t need,
                                int planes, bool single, struct gb_error *err);

/* Writes down every touching pair of the world, in the order of its list. */
bool gb_contact_history_write(struct gb_contact_history *ledger,
                              const struct gb_world *world, bool whole,
                              struct gb_error *err);

/* The same lines in another ledger. */
bool gb_contact_history_copy(struct gb_contact_history *to,
                             const struct gb_contact_history *from, struct gb_error *err);

/* One number of a line, and a line into the history of pair k. */
double gb_contact_history_value(const struct gb_contact_history *ledger, int64_t line,
                                int plane);
void gb_contact_history_give(const struct gb_contact_history *ledger, int64_t line,
                             struct gb_contacts *contacts, int64_t k);

/* Gives every pair of the world's new list its old history, or none. */
void gb_contact_history_read(const struct gb_contact_history *ledger,
                             struct gb_world *world);

#endif
