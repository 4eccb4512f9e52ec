#ifndef GB_PACK_LEDGER_H
#define GB_PACK_LEDGER_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/status.h"
#include "pack/batch.h"

struct gb_world;

/* Touching pairs in list order with their histories: whole for rebuilds, without the arms
 * for copies. */
struct gb_ledger {
    int64_t count, capacity;
    int planes; /* values a line holds: all planes of the contacts, or those kept */
    int32_t (*pair)[2];
    bool single;
    void *value;   /* capacity x planes, double or (single) float */
    int64_t state; /* of the world, that it tells of: world->state; 0: none */
    int64_t *from; /* scratch: where the lines of each thread begin */
    int threads;
};

void gb_ledger_finish(struct gb_ledger *ledger);

/* Room for so many lines of so many values; what was there is lost when it grows. */
bool gb_ledger_reserve(struct gb_ledger *ledger, int64_t need, int planes, bool single,
                       struct gb_error *err);

/* Writes down every touching pair of the world, in the order of its list. */
bool gb_ledger_write(struct gb_ledger *ledger, const struct gb_world *world, bool whole,
                     struct gb_error *err);

/* The same lines in another ledger. */
bool gb_ledger_copy(struct gb_ledger *to, const struct gb_ledger *from,
                    struct gb_error *err);

/* One number of a line, and a line into the history of pair k. */
double gb_ledger_value(const struct gb_ledger *ledger, int64_t line, int plane);
void gb_ledger_give(const struct gb_ledger *ledger, int64_t line,
                    struct gb_contacts *contacts, int64_t k);

/* Gives every pair of the world's new list its old history, or none. */
void gb_ledger_read(const struct gb_ledger *ledger, struct gb_world *world);

#endif
