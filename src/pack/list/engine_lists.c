/* Rebuild of the lists of the engine, and of all that has one entry per pair.
 *
 * Contact records hold the history of friction, so they must survive a rebuild.  The
 * caller notes the contacts, builds the lists and then moves the records:
 *   carry_note   the pair and the slot of every contact, in the order of the old list
 *   build        new lists, and room for their pairs in every array
 *   carry_move   each record from its old slot to its new one, within its array
 * Both lists have the same order.  Records that move down go first in ascending order, then
 * those that move up in descending order: none overwrites another, and no copy is needed. */

#include "pack/list/engine_lists.h"

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "base/alloc.h"
#include "base/team.h"
#include "greenbody/status.h"
#include "pack/cell/contacts.h"
#include "pack/cell/engine.h"
#include "pack/kernel/share.h"
#include "pack/list/blocks.h"
#include "pack/list/neighbour_list.h"
#include "scene/loading_kind.h"

/* ---- Build ---- */

/* Room for the records of a longer list, array by array; those that exist stay.  On failure
 * all are freed. */
static bool grow_contacts(struct gb_contacts *contacts, int64_t capacity,
                          struct gb_error *err)
{
    const size_t size = gb_real_size(contacts->real);
    const size_t room = (size_t)(capacity + 15) / 16 * 16; /* whole vectors */
    for (int p = 0; p < contacts->planes; p++) {
        void *plane = gb_alloc_array(room, size, err);
        if (!plane) {
            gb_contacts_finish(contacts);
            return false;
        }
        memcpy(plane, contacts->plane[p], (size_t)contacts->capacity * size);
        gb_alloc_free(contacts->plane[p]);
        contacts->plane[p] = plane;
    }
    contacts->capacity = capacity;
    return true;
}

/* Room for the pairs of the lists as they are. */
static bool reserve(struct gb_engine *engine, struct gb_error *err)
{
    const struct gb_model *model = engine->model;
    const int64_t near = engine->list.near.capacity, far = engine->list.far.capacity;
    const enum gb_real real = engine->state.real;
    const bool viscous = gb_loading_kind_at(model->kind)->viscous_contacts;
    if (near > engine->contacts.capacity) {
        const struct gb_contacts_shape shape = {model->record_dimension, viscous, real};
        if ((real == GB_REAL_F64 &&
             !gb_engine_pair_resize_near(&engine->pair, near, err)) ||
            !(engine->contacts.capacity > 0
                  ? grow_contacts(&engine->contacts, near, err)
                  : gb_contacts_init(&engine->contacts, shape, near, err))) {
            return false;
        }
    }
    if (far > engine->pair.far_capacity &&
        !gb_engine_pair_resize_far(
            &engine->pair, far, real,
            viscous ? GB_PAIR_RESULTS_FAR_WORK : GB_PAIR_RESULTS_FAR_FORCE, err)) {
        return false;
    }
    return real == GB_REAL_F64 ||
           gb_f32_state_assign_rows(&engine->f32.rows, &engine->list, err);
}

bool gb_engine_lists_build(struct gb_engine *engine, const struct gb_cell *cell,
                           struct gb_error *err)
{
    const struct gb_numerics *numerics = &engine->model->numerics;
    const struct gb_neighbour_list_range range = {numerics->cutoff, numerics->skin};
    gb_engine_state_drop_lists(&engine->state);
    if (!gb_neighbour_list_build(&engine->list, cell, engine->particles.position, range,
                                 engine->team, err) ||
        !reserve(engine, err)) {
        gb_neighbour_list_clear(&engine->list);
        return false;
    }
    gb_blocks_weigh(engine);
    gb_engine_state_build_lists(&engine->state);
    return true;
}

/* ---- Carry: note ---- */

void gb_engine_lists_carry_finish(struct gb_contact_carry *carry)
{
    gb_alloc_free(carry->pair);
    gb_alloc_free(carry->slot);
    gb_alloc_free(carry->begin);
    *carry = (struct gb_contact_carry){0};
}

static bool reserve_carry(struct gb_contact_carry *carry, int64_t need,
                          struct gb_error *err)
{
    if (need <= carry->capacity) {
        return true;
    }
    const size_t room = (size_t)(need + need / 16 + 16);
    gb_alloc_free(carry->pair);
    gb_alloc_free(carry->slot);
    carry->capacity = 0;
    carry->pair = gb_alloc_array(room, sizeof *carry->pair, err);
    carry->slot = gb_alloc_array(room, sizeof *carry->slot, err);
    if (!carry->pair || !carry->slot) {
        return false;
    }
    carry->capacity = (int64_t)room;
    return true;
}

static bool reserve_parts(struct gb_contact_carry *carry, int parts, struct gb_error *err)
{
    if (parts != carry->parts || !carry->begin) {
        gb_alloc_free(carry->begin);
        carry->begin = gb_alloc_array((size_t)parts + 1, sizeof *carry->begin, err);
        carry->parts = parts;
    }
    return carry->begin != NULL;
}

struct noting {
    struct gb_contact_carry *carry;
    const struct gb_engine *engine;
};

/* Slots of part t: from slots[0] up to slots[1], which is not one of them. */
static void slots_of(const struct noting *noting, int64_t t, int64_t slots[2])
{
    const int64_t count = noting->engine->particles.count;
    const int64_t *start = noting->engine->list.near.start;
    slots[0] = start[gb_share(count, (int)t, noting->carry->parts)];
    slots[1] = start[gb_share(count, (int)t + 1, noting->carry->parts)];
}

static void count_item(void *data, int64_t t)
{
    const struct noting *noting = data;
    int64_t slots[2], touching = 0;
    slots_of(noting, t, slots);
    for (int64_t k = slots[0]; k < slots[1]; k++) {
        touching += gb_contacts_touch(&noting->engine->contacts, k);
    }
    noting->carry->begin[t + 1] = touching;
}

static void note_item(void *data, int64_t t)
{
    const struct noting *noting = data;
    const struct gb_pair_list *near = &noting->engine->list.near;
    struct gb_contact_carry *carry = noting->carry;
    int64_t slots[2], index = carry->begin[t];
    slots_of(noting, t, slots);
    for (int64_t k = slots[0]; k < slots[1]; k++) {
        if (gb_contacts_touch(&noting->engine->contacts, k)) {
            carry->pair[index][0] = near->first[k];
            carry->pair[index][1] = near->other[k];
            carry->slot[index++] = (int32_t)k;
        }
    }
}

bool gb_engine_lists_carry_note(struct gb_contact_carry *carry,
                                const struct gb_engine *engine, struct gb_error *err)
{
    const int parts = gb_team_size(engine->team);
    struct noting noting = {carry, engine};
    carry->count = 0;
    if (engine->state.lists == GB_ENGINE_NO_LISTS) {
        return true;
    }
    if (!reserve_parts(carry, parts, err)) {
        return false;
    }
    gb_team_run(engine->team, parts, count_item, &noting);
    carry->begin[0] = 0;
    for (int t = 0; t < parts; t++) {
        carry->begin[t + 1] += carry->begin[t];
    }
    if (!reserve_carry(carry, carry->begin[parts], err)) {
        return false;
    }
    gb_team_run(engine->team, parts, note_item, &noting);
    carry->count = carry->begin[parts];
    return true;
}

/* ---- Carry: move ---- */

struct moving {
    struct gb_contact_carry *carry;
    struct gb_engine *engine;
};

/* The first contact of particle i or of a later one. */
static int64_t find_particle(const struct gb_contact_carry *carry, int64_t i)
{
    int64_t low = 0, high = carry->count;
    while (low < high) {
        const int64_t middle = low + (high - low) / 2;
        if (carry->pair[middle][0] < i) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

/* New slots of the contacts of the particles begin .. end - 1: a merge, since list and
 * contacts have the same order. */
static void find_slots(void *data, int64_t begin, int64_t end)
{
    const struct moving *moving = data;
    const struct gb_pair_list *near = &moving->engine->list.near;
    struct gb_contact_carry *carry = moving->carry;
    const int64_t last = find_particle(carry, end);
    for (int64_t c = find_particle(carry, begin); c < last; c++) {
        const int32_t i = carry->pair[c][0], j = carry->pair[c][1];
        int64_t k = near->start[i];
        while (k < near->start[i + 1] && near->other[k] < j) {
            k++;
        }
        const bool stays = k < near->start[i + 1] && near->other[k] == j;
        carry->pair[c][1] =
            stays ? (int32_t)k
                  : -1; /* the new slot; other threads search pair[..][0] only */
    }
}

/* Loops over the slots are compiled for each size of a number. */
#define INLINE static inline __attribute__((always_inline))

/* One array of the records, of numbers of `size` bytes. */
INLINE void move_plane(char *plane, size_t size, const struct gb_contact_carry *carry)
{
    for (int64_t c = 0; c < carry->count; c++) {
        const int32_t from = carry->slot[c], to = carry->pair[c][1];
        if (to >= 0 && to < from) {
            memcpy(plane + (size_t)to * size, plane + (size_t)from * size, size);
        }
    }
    for (int64_t c = carry->count - 1; c >= 0; c--) {
        const int32_t from = carry->slot[c], to = carry->pair[c][1];
        if (to > from) {
            memcpy(plane + (size_t)to * size, plane + (size_t)from * size, size);
        }
    }
}

/* Sets every slot below `slots` to `none`, except those that received a record. */
INLINE void clear_others(char *plane, size_t size, const struct gb_contact_carry *carry,
                         int64_t slots, const void *none)
{
    int64_t k = 0;
    for (int64_t c = 0; c <= carry->count; c++) {
        const int64_t to = c < carry->count ? carry->pair[c][1] : slots;
        for (; k < to; k++) {
            memcpy(plane + (size_t)k * size, none, size);
        }
        k += to >= 0; /* skips the slot of this record */
    }
}

static void move_item(void *data, int64_t p)
{
    const struct moving *moving = data;
    struct gb_contacts *contacts = &moving->engine->contacts;
    const struct gb_neighbour_list *list = &moving->engine->list;
    const int64_t slots = gb_neighbour_list_slots(list, &list->near);
    const double none = p == contacts->deepest ? -1.0 : 0.0;
    if (contacts->real == GB_REAL_F32) {
        const float none_f32 = (float)none;
        move_plane(contacts->plane[p], sizeof none_f32, moving->carry);
        clear_others(contacts->plane[p], sizeof none_f32, moving->carry, slots,
                     &none_f32);
    } else {
        move_plane(contacts->plane[p], sizeof none, moving->carry);
        clear_others(contacts->plane[p], sizeof none, moving->carry, slots, &none);
    }
}

void gb_engine_lists_carry_move(struct gb_contact_carry *carry, struct gb_engine *engine)
{
    struct moving moving = {carry, engine};
    gb_team_run_ranges(engine->team, engine->particles.count, GB_BLOCKS_GRAIN, find_slots,
                       &moving);
    gb_team_run(engine->team, engine->contacts.planes, move_item, &moving);
}
