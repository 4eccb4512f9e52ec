#include "pack/ledger.h"

#include "base/alloc.h"
#include "pack/world_private.h"

void gb_ledger_finish(struct gb_ledger *ledger)
{
    gb_alloc_free(ledger->pair);
    gb_alloc_free(ledger->value);
    *ledger = (struct gb_ledger){0};
}

bool gb_ledger_reserve(struct gb_ledger *ledger, int64_t need, int planes, bool single,
                       struct gb_error *err)
{
    if (need <= ledger->capacity && planes == ledger->planes &&
        single == ledger->single) {
        return true;
    }
    gb_ledger_finish(ledger);
    const size_t room = (size_t)(need + need / 16 + 16);
    ledger->pair = gb_alloc_array(room, sizeof *ledger->pair, err);
    ledger->value = gb_alloc_array(room * (size_t)planes,
                                   single ? sizeof(float) : sizeof(double), err);
    if (!ledger->pair || !ledger->value) {
        gb_ledger_finish(ledger);
        return false;
    }
    ledger->planes = planes;
    ledger->single = single;
    ledger->capacity = (int64_t)room;
    return true;
}

static int64_t count_touching(const struct gb_world *world)
{
    int64_t touching = 0;
    for (int64_t k = 0; world->listed && k < world->pairs.near.pair_count; k++) {
        touching += gb_contacts_touch(&world->contacts, k);
    }
    return touching;
}

/* The history of pair k onto a line. */
static void take_values(struct gb_ledger *ledger, int64_t line,
                        const struct gb_contacts *contacts, int64_t k)
{
    const int planes = ledger->planes;
    if (ledger->single) {
        float *to = (float *)ledger->value + line * planes;
        for (int p = 0; p < planes; p++) {
            to[p] = ((const float *)contacts->plane[p])[k];
        }
    } else {
        double *to = (double *)ledger->value + line * planes;
        for (int p = 0; p < planes; p++) {
            to[p] = ((const double *)contacts->plane[p])[k];
        }
    }
}

double gb_ledger_value(const struct gb_ledger *ledger, int64_t line, int plane)
{
    const int64_t at = line * ledger->planes + plane;
    return ledger->single ? (double)((const float *)ledger->value)[at]
                          : ((const double *)ledger->value)[at];
}

void gb_ledger_give(const struct gb_ledger *ledger, int64_t line,
                    struct gb_contacts *contacts, int64_t k)
{
    for (int p = 0; p < ledger->planes; p++) {
        gb_contacts_put(contacts, p, k, gb_ledger_value(ledger, line, p));
    }
}

bool gb_ledger_write(struct gb_ledger *ledger, const struct gb_world *world, bool whole,
                     struct gb_error *err)
{
    const struct gb_pair_list *near = &world->pairs.near;
    const struct gb_contacts *contacts = &world->contacts;
    const int planes = world->listed ? whole ? contacts->planes : contacts->kept : 1;
    if (!gb_ledger_reserve(ledger, count_touching(world), planes, world->in_single,
                           err)) {
        return false;
    }
    int64_t line = 0;
    for (int64_t i = 0; world->listed && i < world->count; i++) {
        for (int64_t k = near->start[i]; k < near->start[i + 1]; k++) {
            if (!gb_contacts_touch(contacts, k)) {
                continue;
            }
            ledger->pair[line][0] = (int32_t)i;
            ledger->pair[line][1] = near->other[k];
            take_values(ledger, line++, contacts, k);
        }
    }
    ledger->count = line;
    return true;
}

/* Puts line `line` of the ledger into near pair k of particle i. */
static void ledger_put(const struct gb_ledger *ledger, int64_t line,
                       struct gb_world *world, int64_t i, int64_t k)
{
    struct gb_contacts *contacts = &world->contacts;
    gb_ledger_give(ledger, line, contacts, k);
    if (ledger->planes < contacts->planes) {
        double arm[3];
        if (world->in_single) { /* as the sweep that made the history saw it */
            gb_single_arm(&world->cell, world->position + 3 * i,
                          world->position + 3 * (int64_t)world->pairs.near.other[k], arm);
        } else {
            gb_world_arm_of(world, &world->pairs.near, i, k, arm);
        }
        const bool solid = world->model->dimension == 3;
        gb_contacts_put(contacts, contacts->arm[0], k, arm[0]);
        gb_contacts_put(contacts, contacts->arm[1], k, arm[solid ? 1 : 2]);
        if (solid) {
            gb_contacts_put(contacts, contacts->arm[2], k, arm[2]);
        }
    }
}

/* Both are sorted alike. */
void gb_ledger_read(const struct gb_ledger *ledger, struct gb_world *world)
{
    const struct gb_pair_list *near = &world->pairs.near;
    int64_t line = 0;
    for (int64_t i = 0; i < world->count; i++) {
        for (int64_t k = near->start[i]; k < near->start[i + 1]; k++) {
            const int32_t j = near->other[k];
            while (line < ledger->count &&
                   (ledger->pair[line][0] < i ||
                    (ledger->pair[line][0] == i && ledger->pair[line][1] < j))) {
                line++; /* a pair that has left the reach: its history is over */
            }
            if (line < ledger->count && ledger->pair[line][0] == i &&
                ledger->pair[line][1] == j) {
                ledger_put(ledger, line++, world, i, k);
            } else {
                gb_contacts_clear(&world->contacts, k);
            }
        }
    }
}
