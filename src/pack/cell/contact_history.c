#include "pack/cell/contact_history.h"

#include <string.h>

#include "base/alloc.h"
#include "pack/cell/world_private.h"
#include "pack/kernel/share.h"

void gb_contact_history_finish(struct gb_contact_history *ledger)
{
    gb_alloc_free(ledger->pair);
    gb_alloc_free(ledger->value);
    gb_alloc_free(ledger->from);
    *ledger = (struct gb_contact_history){0};
}

bool gb_contact_history_reserve(struct gb_contact_history *ledger, int64_t need,
                                int planes, bool single, struct gb_error *err)
{
    if (need <= ledger->capacity && planes == ledger->planes &&
        single == ledger->single) {
        return true;
    }
    gb_alloc_free(ledger->pair);
    gb_alloc_free(ledger->value);
    const size_t room = (size_t)(need + need / 16 + 16);
    ledger->pair = gb_alloc_array(room, sizeof *ledger->pair, err);
    ledger->value = gb_alloc_array(room * (size_t)planes,
                                   single ? sizeof(float) : sizeof(double), err);
    if (!ledger->pair || !ledger->value) {
        gb_contact_history_finish(ledger);
        return false;
    }
    ledger->planes = planes;
    ledger->single = single;
    ledger->capacity = (int64_t)room;
    return true;
}

/* Touching pairs of the particles begin .. end - 1. */
static int64_t count_touching(const struct gb_world *world, int64_t begin, int64_t end)
{
    const int64_t *start = world->pairs.near.start;
    int64_t touching = 0;
    for (int64_t k = start[begin]; k < start[end]; k++) {
        touching += gb_contacts_touch(&world->contacts, k);
    }
    return touching;
}

/* The history of pair k onto a line. */
static void take_values(struct gb_contact_history *ledger, int64_t line,
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

double gb_contact_history_value(const struct gb_contact_history *ledger, int64_t line,
                                int plane)
{
    const int64_t at = line * ledger->planes + plane;
    return ledger->single ? (double)((const float *)ledger->value)[at]
                          : ((const double *)ledger->value)[at];
}

void gb_contact_history_give(const struct gb_contact_history *ledger, int64_t line,
                             struct gb_contacts *contacts, int64_t k)
{
    for (int p = 0; p < ledger->planes; p++) {
        gb_contacts_put(contacts, p, k, gb_contact_history_value(ledger, line, p));
    }
}

/* Those of the particles begin .. end - 1, from a line on. */
static void write_down(struct gb_contact_history *ledger, const struct gb_world *world,
                       int64_t begin, int64_t end, int64_t line)
{
    const struct gb_pair_list *near = &world->pairs.near;
    for (int64_t i = begin; i < end; i++) {
        for (int64_t k = near->start[i]; k < near->start[i + 1]; k++) {
            if (!gb_contacts_touch(&world->contacts, k)) {
                continue;
            }
            ledger->pair[line][0] = (int32_t)i;
            ledger->pair[line][1] = near->other[k];
            take_values(ledger, line++, &world->contacts, k);
        }
    }
}

/* One line more than there are threads. */
static bool reserve_shares(struct gb_contact_history *ledger, int threads,
                           struct gb_error *err)
{
    if (threads != ledger->threads || !ledger->from) {
        gb_alloc_free(ledger->from);
        ledger->from = gb_alloc_array((size_t)threads + 1, sizeof *ledger->from, err);
        ledger->threads = threads;
    }
    return ledger->from != NULL;
}

bool gb_contact_history_write(struct gb_contact_history *ledger,
                              const struct gb_world *world, bool whole,
                              struct gb_error *err)
{
    const struct gb_contacts *contacts = &world->contacts;
    const int planes = world->listed ? whole ? contacts->planes : contacts->kept : 1;
    const int threads = world->listed ? world->threads : 1;
    const int64_t count = world->listed ? world->count : 0;
    ledger->state = 0;
    if (!reserve_shares(ledger, threads, err)) {
        return false;
    }
    int64_t *line = ledger->from;
    line[0] = 0;
#pragma omp parallel for num_threads(threads) schedule(static, 1) if (threads > 1)
    for (int t = 0; t < threads; t++) {
        line[t + 1] = count_touching(world, gb_share(count, t, threads),
                                     gb_share(count, t + 1, threads));
    }
    for (int t = 0; t < threads; t++) {
        line[t + 1] += line[t];
    }
    if (!gb_contact_history_reserve(ledger, line[threads], planes, world->in_single,
                                    err)) {
        return false;
    }
#pragma omp parallel for num_threads(threads) schedule(static, 1) if (threads > 1)
    for (int t = 0; t < threads; t++) {
        write_down(ledger, world, gb_share(count, t, threads),
                   gb_share(count, t + 1, threads), line[t]);
    }
    ledger->count = line[threads];
    ledger->state = world->state;
    return true;
}

bool gb_contact_history_copy(struct gb_contact_history *to,
                             const struct gb_contact_history *from, struct gb_error *err)
{
    if (!gb_contact_history_reserve(to, from->count, from->planes, from->single, err)) {
        return false;
    }
    const size_t value = from->single ? sizeof(float) : sizeof(double);
    const size_t lines = (size_t)from->count;
    to->count = from->count;
    to->state = from->state;
    if (lines > 0) {
        memcpy(to->pair, from->pair, lines * sizeof *to->pair);
        memcpy(to->value, from->value, lines * (size_t)from->planes * value);
    }
    return true;
}

/* Puts line `line` of the ledger into near pair k of particle i. */
static void ledger_put(const struct gb_contact_history *ledger, int64_t line,
                       struct gb_world *world, int64_t i, int64_t k)
{
    struct gb_contacts *contacts = &world->contacts;
    gb_contact_history_give(ledger, line, contacts, k);
    if (ledger->planes < contacts->planes) {
        double arm[3];
        if (world->in_single) { /* as the sweep that made the history saw it */
            gb_f32_state_arm(&world->cell, world->position + 3 * i,
                             world->position + 3 * (int64_t)world->pairs.near.other[k],
                             arm);
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

/* The first line of particle i or one behind it. */
static int64_t find_line(const struct gb_contact_history *ledger, int64_t i)
{
    int64_t low = 0, high = ledger->count;
    while (low < high) {
        const int64_t middle = low + (high - low) / 2;
        if (ledger->pair[middle][0] < i) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

/* Both are sorted alike. */
static void read_back(const struct gb_contact_history *ledger, struct gb_world *world,
                      int64_t begin, int64_t end)
{
    const struct gb_pair_list *near = &world->pairs.near;
    int64_t line = find_line(ledger, begin);
    for (int64_t i = begin; i < end; i++) {
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

void gb_contact_history_read(const struct gb_contact_history *ledger,
                             struct gb_world *world)
{
    world->state++;
    const int threads = world->threads;
#pragma omp parallel for num_threads(threads) schedule(static, 1) if (threads > 1)
    for (int t = 0; t < threads; t++) {
        read_back(ledger, world, gb_share(world->count, t, threads),
                  gb_share(world->count, t + 1, threads));
    }
}
