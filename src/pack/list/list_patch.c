/* Insertion of missing pairs into lists that are otherwise valid.
 *
 * Of a million particles there is always one that meets a partner it was far from, and a
 * rebuild costs as much as several sweeps.  A single-precision list therefore ends every block
 * of particles with free slots.  Pairs are inserted in order: the pairs of the block that
 * follow move up by one slot, with their contact records, and no other block changes.
 *
 * A patch is planned first (which pairs go where, and do they fit?) and then applied, so that
 * a failed plan leaves the lists as they are. */

#include "pack/list/list_patch.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "pack/cell/contacts.h"
#include "pack/cell/engine.h"
#include "pack/list/blocks.h"
#include "pack/list/list_check.h"
#include "pack/list/neighbour_list.h"

/* ---- Slots of one list ---- */

/* Changes of one list, ascending. */
struct slots {
    int64_t *at; /* slot of each before anything is moved */
    const struct gb_inserted_pair **pair;
    int count;
};

static bool slots_init(struct slots *slots, int64_t capacity, struct gb_error *err)
{
    const size_t n = (size_t)capacity;
    slots->count = 0;
    slots->at = gb_alloc_array(n, sizeof *slots->at, err);
    slots->pair = gb_alloc_array(n, sizeof *slots->pair, err);
    return slots->at && slots->pair;
}

static void slots_finish(struct slots *slots)
{
    gb_alloc_free(slots->at);
    gb_alloc_free(slots->pair);
    *slots = (struct slots){0};
}

static int64_t block_of(const struct gb_neighbour_list *list, int64_t i)
{
    return i / gb_blocks_size(list->count);
}

/* One past the last pair of particle i. */
static int64_t end_of(const struct gb_neighbour_list *list,
                      const struct gb_pair_list *pairs, int64_t i)
{
    const int64_t stop = pairs->stop[block_of(list, i)];
    return pairs->start[i + 1] < stop ? pairs->start[i + 1] : stop;
}

/* First slot of pair->first whose second particle is not before pair->other. */
static int64_t slots_find(const struct gb_neighbour_list *list,
                          const struct gb_pair_list *pairs,
                          const struct gb_inserted_pair *pair)
{
    const int64_t end = end_of(list, pairs, pair->first);
    int64_t k = pairs->start[pair->first];
    while (k < end && pairs->other[k] < pair->other) {
        k++;
    }
    return k;
}

static bool slots_holds(const struct gb_neighbour_list *list,
                        const struct gb_pair_list *pairs,
                        const struct gb_inserted_pair *pair)
{
    const int64_t k = slots_find(list, pairs, pair);
    return k < end_of(list, pairs, pair->first) && pairs->other[k] == pair->other;
}

/* Adds a change at the slot of the pair. */
static void slots_add(struct slots *slots, const struct gb_neighbour_list *list,
                      const struct gb_pair_list *pairs,
                      const struct gb_inserted_pair *pair)
{
    slots->at[slots->count] = slots_find(list, pairs, pair);
    slots->pair[slots->count++] = pair;
}

/* Splits off the changes of the block of the first one; the others are left in *slots. */
static struct slots take_block(const struct gb_neighbour_list *list, struct slots *slots,
                               int64_t *b)
{
    struct slots own = *slots;
    *b = block_of(list, own.pair[0]->first);
    own.count = 0;
    while (own.count < slots->count && block_of(list, own.pair[own.count]->first) == *b) {
        own.count++;
    }
    slots->at += own.count;
    slots->pair += own.count;
    slots->count -= own.count;
    return own;
}

/* True if every block has free slots for its insertions. */
static bool slots_fit(const struct gb_neighbour_list *list,
                      const struct gb_pair_list *pairs, struct slots slots)
{
    while (slots.count > 0) {
        int64_t b;
        const struct slots own = take_block(list, &slots, &b);
        const int64_t end = gb_blocks_end(list->count, b);
        if (pairs->stop[b] + own.count > pairs->start[end]) {
            return false;
        }
    }
    return true;
}

/* True if a changed pair crosses from one block into another. */
static bool slots_cross(const struct slots *slots, int64_t count)
{
    const int64_t size = gb_blocks_size(count);
    for (int p = 0; p < slots->count; p++) {
        if (slots->pair[p]->first / size != slots->pair[p]->other / size) {
            return true;
        }
    }
    return false;
}

/* Opens a gap before every slot, in an array of items of `size` bytes that ends at `end`. */
static void open_gaps(void *array, size_t size, int64_t end, const struct slots *slots)
{
    char *byte = array;
    for (int p = slots->count - 1; p >= 0; p--) {
        const int64_t at = slots->at[p];
        memmove(byte + (size_t)(at + p + 1) * size, byte + (size_t)at * size,
                (size_t)(end - at) * size);
        end = at;
    }
}

/* Removes the item of every slot. */
static void close_gaps(void *array, size_t size, int64_t end, const struct slots *slots)
{
    char *byte = array;
    for (int p = 0; p < slots->count; p++) {
        const int64_t from = slots->at[p] + 1;
        const int64_t to = p + 1 < slots->count ? slots->at[p + 1] : end;
        memmove(byte + (size_t)(from - p - 1) * size, byte + (size_t)from * size,
                (size_t)(to - from) * size);
    }
}

typedef void move_items(void *array, size_t size, int64_t end, const struct slots *slots);

static void move_pairs(struct gb_pair_list *pairs, move_items *move, int64_t end,
                       const struct slots *slots)
{
    move(pairs->first, sizeof *pairs->first, end, slots);
    move(pairs->other, sizeof *pairs->other, end, slots);
    move(pairs->image, sizeof *pairs->image, end, slots);
    move(pairs->row, sizeof *pairs->row, end, slots);
}

/* Moves the starts of the particles of block b that follow the slots, and its stop. */
static void shift_starts(struct gb_pair_list *pairs, int64_t particles, int64_t b,
                         const struct slots *slots, int64_t sign)
{
    const int64_t end = gb_blocks_end(particles, b);
    int p = 0;
    for (int64_t i = slots->pair[0]->first + 1; i < end; i++) {
        while (p < slots->count && slots->pair[p]->first < i) {
            p++;
        }
        pairs->start[i] += sign * p;
    }
    pairs->stop[b] += sign * slots->count;
    pairs->pair_count += sign * slots->count;
}

/* Records for inserted near pairs: not in contact. */
static void insert_contacts(struct gb_contacts *contacts, int64_t end,
                            const struct slots *slots)
{
    for (int p = 0; p < contacts->planes; p++) {
        open_gaps(contacts->plane[p], gb_real_size(contacts->real), end, slots);
    }
    for (int p = 0; p < slots->count; p++) {
        gb_contacts_clear(contacts, slots->at[p] + p);
    }
}

/* contacts: records of the list, which get the same slots, without a history; NULL: none */
static void slots_insert(struct gb_neighbour_list *list, struct gb_pair_list *pairs,
                         struct gb_contacts *contacts, struct slots slots)
{
    while (slots.count > 0) {
        int64_t b;
        const struct slots own = take_block(list, &slots, &b);
        if (contacts) {
            insert_contacts(contacts, pairs->stop[b], &own);
        }
        move_pairs(pairs, open_gaps, pairs->stop[b], &own);
        for (int p = 0; p < own.count; p++) {
            const int64_t k = own.at[p] + p;
            pairs->first[k] = own.pair[p]->first;
            pairs->other[k] = own.pair[p]->other;
            pairs->image[k] = (uint8_t)own.pair[p]->image;
            pairs->row[k] =
                own.pair[p]
                    ->other; /* of a pair of two blocks: gb_f32_state_assign_rows sets it */
        }
        shift_starts(pairs, list->count, b, &own, 1);
    }
}

static void slots_remove(struct gb_neighbour_list *list, struct gb_pair_list *pairs,
                         struct slots slots)
{
    while (slots.count > 0) {
        int64_t b;
        const struct slots own = take_block(list, &slots, &b);
        move_pairs(pairs, close_gaps, pairs->stop[b], &own);
        shift_starts(pairs, list->count, b, &own, -1);
        for (int p = 0; p < own.count; p++) {
            gb_neighbour_list_free_slot(pairs, pairs->stop[b] + p,
                                        gb_blocks_end(list->count, b) - 1);
        }
    }
}

/* ---- Plan of a patch ---- */

/* Changes to the lists. */
struct plan {
    struct gb_inserted_pair *missing; /* sorted */
    int count;
    struct slots near, far; /* insertions */
    struct slots far_gone;  /* removals: pairs that become near */
};

static void plan_finish(struct plan *plan)
{
    slots_finish(&plan->near);
    slots_finish(&plan->far);
    slots_finish(&plan->far_gone);
    gb_alloc_free(plan->missing);
    *plan = (struct plan){0};
}

/* Room for `room` pairs. */
static bool plan_init(struct plan *plan, int64_t room, struct gb_error *err)
{
    *plan = (struct plan){0};
    plan->missing = gb_alloc_array((size_t)room, sizeof *plan->missing, err);
    if (!plan->missing || !slots_init(&plan->near, room, err) ||
        !slots_init(&plan->far, room, err) || !slots_init(&plan->far_gone, room, err)) {
        plan_finish(plan);
        return false;
    }
    return true;
}

/* Order of the lists. */
static int compare(const void *a, const void *b)
{
    const struct gb_inserted_pair *x = a, *y = b;
    return x->first != y->first ? (x->first > y->first) - (x->first < y->first)
                                : (x->other > y->other) - (x->other < y->other);
}

/* Index of the nearest image of the pair; -1 if it is farther than one edge. */
static int32_t nearest_image(const struct gb_engine *engine, int64_t i, int64_t j)
{
    int32_t image = 0, weight = 1;
    double xi[3], xj[3];
    gb_engine_position(engine, i, xi);
    gb_engine_position(engine, j, xj);
    for (int k = 0; k < 3; k++) {
        const double edge = engine->particles.cell.edge[k];
        const double r = xi[k] - xj[k];
        const int32_t whole = -(int32_t)gb_cell_whole(r / edge);
        if (whole < -1 || whole > 1) {
            return -1;
        }
        image += weight * (whole + 1);
        weight *= 3;
    }
    return image;
}

/* True if all missing pairs are known and few enough; *most: an upper bound of them. */
static bool can_insert(const struct gb_engine *engine, int64_t *most)
{
    int64_t escaped = 0;
    *most = 0;
    for (int64_t b = 0; b < gb_blocks_count(engine->particles.count); b++) {
        const struct gb_missing_pairs *part = &engine->check[b].missing;
        escaped += part->escaped;
        *most += part->count;
        if (part->incomplete) {
            return false;
        }
    }
    return *most > 0 &&
           engine->list.inserted_count + *most <= engine->list.inserted_max &&
           !gb_list_check_too_many(escaped, engine->particles.count);
}

/* All missing pairs, sorted, each once. */
static void collect_missing(const struct gb_engine *engine, struct plan *plan)
{
    int n = 0;
    for (int64_t b = 0; b < gb_blocks_count(engine->particles.count); b++) {
        const struct gb_missing_pairs *part = &engine->check[b].missing;
        for (int k = 0; k < part->count; k++) {
            const struct gb_missing_pair *pair = &part->pair[k];
            plan->missing[n++] = (struct gb_inserted_pair){
                pair->first, pair->other, nearest_image(engine, pair->first, pair->other),
                pair->near};
        }
    }
    qsort(plan->missing, (size_t)n, sizeof *plan->missing, compare);
    for (int k = 0; k < n; k++) {
        if (k == 0 || compare(&plan->missing[plan->count - 1], &plan->missing[k]) != 0) {
            plan->missing[plan->count++] = plan->missing[k];
        }
    }
}

/* Assigns the missing pairs to the lists; false where one is invalid or does not fit. */
static bool assign_slots(const struct gb_neighbour_list *list, struct plan *plan)
{
    for (int k = 0; k < plan->count; k++) {
        const struct gb_inserted_pair *pair = &plan->missing[k];
        const bool in_far = slots_holds(list, &list->far, pair);
        if (slots_holds(list, &list->near, pair) || pair->image < 0 ||
            (in_far && !pair->near)) {
            return false; /* listed with another image, or farther than one edge */
        }
        if (pair->near) {
            slots_add(&plan->near, list, &list->near, pair);
        } else {
            slots_add(&plan->far, list, &list->far, pair);
        }
        if (in_far) {
            slots_add(&plan->far_gone, list, &list->far, pair);
        }
    }
    return slots_fit(list, &list->near, plan->near) &&
           slots_fit(list, &list->far, plan->far);
}

/* ---- Patch ---- */

/* Adds the pairs to `inserted`, which stays sorted; a pair that was far becomes near. */
static void record_inserted(struct gb_neighbour_list *list, const struct plan *plan)
{
    const size_t before = (size_t)list->inserted_count, size = sizeof *list->inserted;
    for (int k = 0; k < plan->count; k++) {
        struct gb_inserted_pair *known =
            bsearch(&plan->missing[k], list->inserted, before, size, compare);
        if (known) {
            *known = plan->missing[k];
        } else {
            list->inserted[list->inserted_count++] = plan->missing[k];
        }
    }
    qsort(list->inserted, (size_t)list->inserted_count, size, compare);
}

/* Changes both lists, the contact records and the rows of cross pairs. */
static bool apply(struct gb_engine *engine, struct plan *plan, struct gb_error *err)
{
    struct gb_neighbour_list *list = &engine->list;
    const int64_t count = engine->particles.count;
    record_inserted(list, plan);
    slots_insert(list, &list->near, &engine->contacts, plan->near);
    slots_remove(list, &list->far, plan->far_gone);
    for (int p = 0; p < plan->far.count; p++) { /* removals have moved the slots */
        plan->far.at[p] = slots_find(list, &list->far, plan->far.pair[p]);
    }
    slots_insert(list, &list->far, NULL, plan->far);
    const bool crosses = slots_cross(&plan->near, count) ||
                         slots_cross(&plan->far, count) ||
                         slots_cross(&plan->far_gone, count);
    return !crosses || gb_f32_state_assign_rows(&engine->f32.rows, list, err);
}

enum gb_list_patch_outcome gb_list_patch_insert(struct gb_engine *engine,
                                                struct gb_error *err)
{
    int64_t most;
    if (!gb_engine_is_f32(engine) ||
        gb_list_check_judge(engine, gb_list_check_largest(engine)) !=
            GB_LIST_CHECK_UNCERTAIN ||
        !can_insert(engine, &most)) {
        return GB_LIST_PATCH_REBUILD;
    }
    struct plan plan;
    if (!plan_init(&plan, most, err)) {
        return GB_LIST_PATCH_FAILED;
    }
    collect_missing(engine, &plan);
    const bool fits = assign_slots(&engine->list, &plan);
    const bool good = !fits || apply(engine, &plan, err);
    plan_finish(&plan);
    if (!good) {
        return GB_LIST_PATCH_FAILED;
    }
    return fits ? GB_LIST_PATCH_DONE : GB_LIST_PATCH_REBUILD;
}

/* Pairs of a checkpoint: in order and in range. */
static bool valid(const struct gb_engine *engine, const struct gb_inserted_pair *kept,
                  int64_t count)
{
    for (int64_t k = 0; k < count; k++) {
        const struct gb_inserted_pair *pair = &kept[k];
        if (pair->first < 0 || pair->other <= pair->first ||
            pair->other >= engine->particles.count || pair->image < 0 ||
            pair->image > 26 || (pair->near != 0 && pair->near != 1) ||
            (k > 0 && compare(&kept[k - 1], pair) >= 0)) {
            return false;
        }
    }
    return count <= engine->list.inserted_max;
}

bool gb_list_patch_load(struct gb_engine *engine, const struct gb_inserted_pair *kept,
                        int64_t count, struct gb_error *err)
{
    if (count == 0) {
        return true;
    }
    struct plan plan = {0};
    bool good = gb_engine_is_f32(engine) && valid(engine, kept, count);
    if (good) {
        if (!plan_init(&plan, count, err)) {
            return false;
        }
        memcpy(plan.missing, kept, (size_t)count * sizeof *kept);
        plan.count = (int)count;
        good = assign_slots(&engine->list, &plan);
    }
    const bool done = good && apply(engine, &plan, err);
    plan_finish(&plan);
    return good ? done
                : gb_error_set(err, GB_ERR_INPUT, "%s: is out of range", "world/amended");
}
