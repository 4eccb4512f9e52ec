#include "pack/cell/contact_history.h"

#include <string.h>

#include "base/alloc.h"
#include "base/team.h"
#include "pack/cell/engine.h"
#include "pack/kernel/share.h"
#include "pack/list/blocks.h"

void gb_contact_history_finish(struct gb_contact_history *history)
{
    gb_alloc_free(history->pair);
    gb_alloc_free(history->value);
    gb_alloc_free(history->begin);
    *history = (struct gb_contact_history){0};
}

/* Room for `need` contacts with `planes` values each; growing loses the contents. */
static bool reserve(struct gb_contact_history *history, int64_t need, int planes,
                    enum gb_real real, struct gb_error *err)
{
    if (need <= history->capacity && planes == history->planes && real == history->real) {
        return true;
    }
    gb_alloc_free(history->pair);
    gb_alloc_free(history->value);
    const size_t room = (size_t)(need + need / 16 + 16);
    history->pair = gb_alloc_array(room, sizeof *history->pair, err);
    history->value = gb_alloc_array(room * (size_t)planes, gb_real_size(real), err);
    if (!history->pair || !history->value) {
        gb_contact_history_finish(history);
        return false;
    }
    history->planes = planes;
    history->real = real;
    history->capacity = (int64_t)room;
    return true;
}

/* Contacts of the particles begin .. end - 1. */
static int64_t count_contacts(const struct gb_engine *engine, int64_t begin, int64_t end)
{
    const int64_t *start = engine->list.near.start;
    int64_t touching = 0;
    for (int64_t k = start[begin]; k < start[end]; k++) {
        touching += gb_contacts_touch(&engine->contacts, k);
    }
    return touching;
}

/* Values of slot k. */
static void store_values(struct gb_contact_history *history, int64_t index,
                         const struct gb_contacts *contacts, int64_t k)
{
    const int planes = history->planes;
    if (history->real == GB_REAL_F32) {
        float *to = (float *)history->value + index * planes;
        for (int p = 0; p < planes; p++) {
            to[p] = ((const float *)contacts->plane[p])[k];
        }
    } else {
        double *to = (double *)history->value + index * planes;
        for (int p = 0; p < planes; p++) {
            to[p] = ((const double *)contacts->plane[p])[k];
        }
    }
}

static double value_at(const struct gb_contact_history *history, int64_t index, int plane)
{
    const int64_t at = index * history->planes + plane;
    return history->real == GB_REAL_F32 ? (double)((const float *)history->value)[at]
                                        : ((const double *)history->value)[at];
}

void gb_contact_history_apply(const struct gb_contact_history *history, int64_t index,
                              struct gb_contacts *contacts, int64_t k)
{
    /* a viscous scene keeps more planes than a quasi-static copy of it has */
    const int planes =
        history->planes < contacts->planes ? history->planes : contacts->planes;
    for (int p = 0; p < planes; p++) {
        gb_contacts_put(contacts, p, k, value_at(history, index, p));
    }
}

/* Contacts of the particles begin .. end - 1, to `index` on. */
static void write_part(struct gb_contact_history *history, const struct gb_engine *engine,
                       int64_t begin, int64_t end, int64_t index)
{
    const struct gb_pair_list *near = &engine->list.near;
    for (int64_t i = begin; i < end; i++) {
        for (int64_t k = near->start[i]; k < near->start[i + 1]; k++) {
            if (!gb_contacts_touch(&engine->contacts, k)) {
                continue;
            }
            history->pair[index][0] = (int32_t)i;
            history->pair[index][1] = near->other[k];
            store_values(history, index++, &engine->contacts, k);
        }
    }
}

static bool reserve_parts(struct gb_contact_history *history, int parts,
                          struct gb_error *err)
{
    if (parts != history->parts || !history->begin) {
        gb_alloc_free(history->begin);
        history->begin = gb_alloc_array((size_t)parts + 1, sizeof *history->begin, err);
        history->parts = parts;
    }
    return history->begin != NULL;
}

/* The contacts of `count` particles in the parts of a history. */
struct transfer {
    struct gb_contact_history *history;
    const struct gb_engine *engine;
    int64_t count;
};

static void count_item(void *data, int64_t t)
{
    struct transfer *transfer = data;
    const int64_t count = transfer->count;
    const int parts = transfer->history->parts;
    transfer->history->begin[t + 1] =
        count_contacts(transfer->engine, gb_share(count, (int)t, parts),
                       gb_share(count, (int)t + 1, parts));
}

static void write_item(void *data, int64_t t)
{
    struct transfer *transfer = data;
    const int64_t count = transfer->count;
    const int parts = transfer->history->parts;
    write_part(transfer->history, transfer->engine, gb_share(count, (int)t, parts),
               gb_share(count, (int)t + 1, parts), transfer->history->begin[t]);
}

/* The first contact of each part in `begin`, and behind them their number: 0 without
 * lists. */
static bool count_parts(struct transfer *transfer, struct gb_error *err)
{
    const struct gb_engine *engine = transfer->engine;
    struct gb_contact_history *history = transfer->history;
    const bool lists = engine->state.lists != GB_ENGINE_NO_LISTS;
    const int parts = lists ? gb_team_size(engine->team) : 1;
    transfer->count = lists ? engine->particles.count : 0;
    if (!reserve_parts(history, parts, err)) {
        return false;
    }
    int64_t *begin = history->begin;
    begin[0] = 0;
    gb_team_run(engine->team, parts, count_item, transfer);
    for (int t = 0; t < parts; t++) {
        begin[t + 1] += begin[t];
    }
    return true;
}

bool gb_contact_history_write(struct gb_contact_history *history,
                              const struct gb_engine *engine, struct gb_error *err)
{
    const bool lists = engine->state.lists != GB_ENGINE_NO_LISTS;
    const int planes = lists ? engine->contacts.kept : 1;
    struct transfer transfer = {history, engine, 0};
    if (!count_parts(&transfer, err) || !reserve(history, history->begin[history->parts],
                                                 planes, engine->state.real, err)) {
        return false;
    }
    gb_team_run(engine->team, history->parts, write_item, &transfer);
    history->count = history->begin[history->parts];
    return true;
}

static const char pair_name[] = GB_CONTACT_HISTORY_PAIR, value_name[] = "world/history";

/* Items of a record as the memory of a history; false without memory. */
static bool add_items(struct gb_contact_history *history, struct gb_record *record,
                      struct gb_error *err)
{
    const int64_t rows = history->begin[history->parts];
    struct gb_record_item *pair =
        gb_record_add(record, pair_name, GB_RECORD_INT32, rows, 2, "1", err);
    if (!pair) {
        return false;
    }
    struct gb_record_item *value =
        history->real == GB_REAL_F32
            ? gb_record_add_f32(record, value_name, rows, history->planes, "d", err)
            : gb_record_add(record, value_name, GB_RECORD_DOUBLE, rows, history->planes,
                            "d", err);
    history->pair = pair->data;
    history->value = value ? value->data : NULL;
    return value != NULL;
}

bool gb_contact_history_save(const struct gb_engine *engine, struct gb_record *record,
                             struct gb_error *err)
{
    struct gb_contact_history history = {.planes = engine->contacts.kept,
                                         .real = engine->state.real};
    struct transfer transfer = {&history, engine, 0};
    const bool done = count_parts(&transfer, err) && add_items(&history, record, err);
    if (done) {
        gb_team_run(engine->team, history.parts, write_item, &transfer);
    }
    gb_alloc_free(history.begin); /* the rest is the record's */
    return done;
}

/* Branch vector of slot k of particle i as the sweep that made the history saw it. */
static void branch_of(const struct gb_engine *engine, int64_t i, int64_t k, double r[3])
{
    const struct gb_particles *particles = &engine->particles;
    const struct gb_pair_list *near = &engine->list.near;
    if (gb_engine_is_f32(engine)) {
        gb_fixed_position_branch(&particles->cell, particles->position + 3 * i,
                                 particles->position + 3 * (int64_t)near->other[k], r);
    } else {
        gb_engine_branch_vector(engine, near, i, k, r);
    }
}

/* Contact number `index` into slot k of particle i. */
static void restore_contact(const struct gb_contact_history *history, int64_t index,
                            struct gb_engine *engine, int64_t i, int64_t k)
{
    struct gb_contacts *contacts = &engine->contacts;
    gb_contact_history_apply(history, index, contacts, k);
    if (history->planes < contacts->planes) {
        const bool solid = engine->model->record_dimension == 3;
        double branch[3];
        branch_of(engine, i, k, branch);
        gb_contacts_put(contacts, contacts->branch[0], k, branch[0]);
        gb_contacts_put(contacts, contacts->branch[1], k, branch[solid ? 1 : 2]);
        if (solid) {
            gb_contacts_put(contacts, contacts->branch[2], k, branch[2]);
        }
    }
}

/* The first contact of particle i or of one behind it. */
static int64_t find_particle(const struct gb_contact_history *history, int64_t i)
{
    int64_t low = 0, high = history->count;
    while (low < high) {
        const int64_t middle = low + (high - low) / 2;
        if (history->pair[middle][0] < i) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

/* A merge: list and history have the same order. */
static void read_part(const struct gb_contact_history *history, struct gb_engine *engine,
                      int64_t begin, int64_t end)
{
    const struct gb_pair_list *near = &engine->list.near;
    int64_t index = find_particle(history, begin);
    for (int64_t i = begin; i < end; i++) {
        for (int64_t k = near->start[i]; k < near->start[i + 1]; k++) {
            const int32_t j = near->other[k];
            while (index < history->count &&
                   (history->pair[index][0] < i ||
                    (history->pair[index][0] == i && history->pair[index][1] < j))) {
                index++; /* this pair has left the list: its history ends */
            }
            if (index < history->count && history->pair[index][0] == i &&
                history->pair[index][1] == j) {
                restore_contact(history, index++, engine, i, k);
            } else {
                gb_contacts_clear(&engine->contacts, k);
            }
        }
    }
}

struct reading {
    const struct gb_contact_history *history;
    struct gb_engine *engine;
};

static void read_range(void *data, int64_t begin, int64_t end)
{
    const struct reading *reading = data;
    read_part(reading->history, reading->engine, begin, end);
}

void gb_contact_history_read(const struct gb_contact_history *history,
                             struct gb_engine *engine)
{
    struct reading reading = {history, engine};
    gb_team_run_ranges(engine->team, engine->particles.count, GB_BLOCKS_GRAIN, read_range,
                       &reading);
}

bool gb_contact_history_record(struct gb_contact_history *history,
                               const struct gb_engine *engine, struct gb_record *record,
                               struct gb_error *err)
{
    const int planes = engine->contacts.kept;
    const enum gb_real real = engine->state.real;
    int64_t rows = history->count;
    if (record->loading &&
        (!gb_record_rows(record, pair_name, GB_RECORD_INT32, 2, &rows, err) ||
         !reserve(history, rows, planes, real, err))) {
        return false;
    }
    history->count = rows;
    return gb_record_array(record, pair_name, GB_RECORD_INT32, rows, 2, "1",
                           history->pair, err) &&
           (real == GB_REAL_F32
                ? gb_record_f32(record, value_name, rows, planes, "d", history->value,
                                err)
                : gb_record_array(record, value_name, GB_RECORD_DOUBLE, rows, planes, "d",
                                  history->value, err));
}
