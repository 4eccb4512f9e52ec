#include "pack/cell/list_patch.h"

#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "pack/cell/world_private.h"

/* Where pairs go into a list, or come out of it, ascending. */
struct places {
    int64_t *at; /* slots before anything is moved */
    const struct gb_amendment **pair;
    int count;
};

/* What is to be done to the lists. */
struct plan {
    struct gb_amendment *missing; /* sorted */
    int count;
    struct places near, far, not_far;
};

static int compare(const void *a, const void *b)
{
    const struct gb_amendment *x = a, *y = b;
    return x->first != y->first ? (x->first > y->first) - (x->first < y->first)
                                : (x->other > y->other) - (x->other < y->other);
}

static int64_t block_of(const struct gb_world *world, int64_t i)
{
    return i / gb_sweep_block_size(world->count);
}

/* Behind the last pair of particle i of a list that leaves slots free. */
static int64_t end_of(const struct gb_world *world, const struct gb_pair_list *list,
                      int64_t i)
{
    const int64_t stop = list->stop[block_of(world, i)];
    return list->start[i + 1] < stop ? list->start[i + 1] : stop;
}

/* First slot of the pair's first particle whose second one is not before the pair's. */
static int64_t slot_of(const struct gb_world *world, const struct gb_pair_list *list,
                       const struct gb_amendment *pair)
{
    const int64_t end = end_of(world, list, pair->first);
    int64_t k = list->start[pair->first];
    while (k < end && list->other[k] < pair->other) {
        k++;
    }
    return k;
}

static bool holds(const struct gb_world *world, const struct gb_pair_list *list,
                  const struct gb_amendment *pair)
{
    const int64_t k = slot_of(world, list, pair);
    return k < end_of(world, list, pair->first) && list->other[k] == pair->other;
}

/* Opens a gap at every place in an array of items of so many bytes, whose last one that
 * moves is before `end`. */
static void open_gaps(void *array, size_t size, int64_t end, const struct places *places)
{
    char *byte = array;
    for (int p = places->count - 1; p >= 0; p--) {
        const int64_t at = places->at[p];
        memmove(byte + (size_t)(at + p + 1) * size, byte + (size_t)at * size,
                (size_t)(end - at) * size);
        end = at;
    }
}

static void close_gaps(void *array, size_t size, int64_t end, const struct places *places)
{
    char *byte = array;
    for (int p = 0; p < places->count; p++) {
        const int64_t from = places->at[p] + 1;
        const int64_t to = p + 1 < places->count ? places->at[p + 1] : end;
        memmove(byte + (size_t)(from - p - 1) * size, byte + (size_t)from * size,
                (size_t)(to - from) * size);
    }
}

static void move_list(struct gb_pair_list *list,
                      void (*move)(void *, size_t, int64_t, const struct places *),
                      int64_t end, const struct places *places)
{
    move(list->first, sizeof *list->first, end, places);
    move(list->other, sizeof *list->other, end, places);
    move(list->image, sizeof *list->image, end, places);
}

/* Moves the starts of the particles of block b behind the places, and its stop; by: +1 or
 * -1. */
static void shift_starts(struct gb_pair_list *list, int64_t particles, int64_t b,
                         const struct places *places, int by)
{
    const int64_t end = gb_sweep_block_end(particles, b);
    int p = 0;
    for (int64_t i = places->pair[0]->first + 1; i < end; i++) {
        while (p < places->count && places->pair[p]->first < i) {
            p++;
        }
        list->start[i] += (int64_t)by * p;
    }
    list->stop[b] += (int64_t)by * places->count;
    list->pair_count += (int64_t)by * places->count;
}

/* Those of the block in which the first of them is; the others are left. */
static struct places take_block(const struct gb_world *world, struct places *places,
                                int64_t *b)
{
    struct places own = *places;
    *b = block_of(world, own.pair[0]->first);
    own.count = 0;
    while (own.count < places->count &&
           block_of(world, own.pair[own.count]->first) == *b) {
        own.count++;
    }
    places->at += own.count;
    places->pair += own.count;
    places->count -= own.count;
    return own;
}

/* Gaps in the histories of near pairs before `end`, filled with pairs that do not touch.
 */
static void make_histories(struct gb_contacts *contacts, int64_t end,
                           const struct places *places)
{
    for (int p = 0; p < contacts->planes; p++) {
        open_gaps(contacts->plane[p], sizeof(float), end, places);
    }
    for (int p = 0; p < places->count; p++) {
        gb_contacts_clear(contacts, places->at[p] + p);
    }
}

/* Into free slots of their blocks. */
static void put_in(struct gb_world *world, struct gb_pair_list *list,
                   struct places places)
{
    while (places.count > 0) {
        int64_t b;
        const struct places own = take_block(world, &places, &b);
        if (list == &world->pairs.near) {
            make_histories(&world->contacts, list->stop[b], &own);
        }
        move_list(list, open_gaps, list->stop[b], &own);
        for (int p = 0; p < own.count; p++) {
            const int64_t k = own.at[p] + p;
            list->first[k] = own.pair[p]->first;
            list->other[k] = own.pair[p]->other;
            list->image[k] = (uint8_t)own.pair[p]->image;
        }
        shift_starts(list, world->count, b, &own, 1);
    }
}

static void take_out(struct gb_world *world, struct gb_pair_list *list,
                     struct places places)
{
    while (places.count > 0) {
        int64_t b;
        const struct places own = take_block(world, &places, &b);
        move_list(list, close_gaps, list->stop[b], &own);
        shift_starts(list, world->count, b, &own, -1);
        for (int p = 0; p < own.count; p++) {
            gb_neighbour_list_vacate(list, list->stop[b] + p,
                                     gb_sweep_block_end(world->count, b) - 1);
        }
    }
}

/* Image of the pair that is the nearest one now. */
static int32_t nearest_image(const struct gb_world *world, int64_t i, int64_t j)
{
    int32_t image = 0, weight = 1;
    double xi[3], xj[3];
    gb_world_at(world, i, xi);
    gb_world_at(world, j, xj);
    for (int k = 0; k < 3; k++) {
        const double edge = world->cell.edge[k];
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

static void plan_finish(struct plan *plan)
{
    struct places *places[] = {&plan->near, &plan->far, &plan->not_far};
    for (int l = 0; l < 3; l++) {
        gb_alloc_free(places[l]->at);
        gb_alloc_free(places[l]->pair);
    }
    gb_alloc_free(plan->missing);
    *plan = (struct plan){0};
}

/* Room for so many pairs. */
static bool plan_init(struct plan *plan, int64_t room, struct gb_error *err)
{
    *plan = (struct plan){0};
    struct places *places[] = {&plan->near, &plan->far, &plan->not_far};
    const size_t n = (size_t)room;
    plan->missing = gb_alloc_array(n, sizeof *plan->missing, err);
    bool good = plan->missing != NULL;
    for (int l = 0; l < 3 && good; l++) {
        places[l]->at = gb_alloc_array(n, sizeof *places[l]->at, err);
        places[l]->pair = gb_alloc_array(n, sizeof *places[l]->pair, err);
        good = places[l]->at && places[l]->pair;
    }
    if (!good) {
        plan_finish(plan);
    }
    return good;
}

/* Is it known who is missing, and are they few enough?  How many may be. */
static bool count_missing(const struct gb_world *world, int64_t *most)
{
    int64_t strays = 0;
    *most = 0;
    for (int64_t b = 0; b < gb_sweep_blocks(world->count); b++) {
        const struct gb_list_check_missing *part = &world->block[b].missing;
        strays += part->strays;
        *most += part->count;
        if (part->many) {
            return false;
        }
    }
    return *most > 0 && world->pairs.amended_count + *most <= world->pairs.amended_most &&
           !gb_list_check_too_many(strays, world->count);
}

/* All that is missing, sorted, each pair once. */
static void gather(const struct gb_world *world, struct plan *plan)
{
    int n = 0;
    for (int64_t b = 0; b < gb_sweep_blocks(world->count); b++) {
        const struct gb_list_check_missing *part = &world->block[b].missing;
        for (int k = 0; k < part->count; k++) {
            const struct gb_list_check_pair *pair = &part->pair[k];
            plan->missing[n++] = (struct gb_amendment){
                pair->first, pair->other, nearest_image(world, pair->first, pair->other),
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

static void add_place(const struct gb_world *world, struct places *places,
                      const struct gb_pair_list *list, const struct gb_amendment *pair)
{
    places->at[places->count] = slot_of(world, list, pair);
    places->pair[places->count++] = pair;
}

/* Has every block free slots for its own of them? */
static bool fit_in(const struct gb_world *world, const struct gb_pair_list *list,
                   struct places places)
{
    while (places.count > 0) {
        int64_t b;
        const struct places own = take_block(world, &places, &b);
        const int64_t end = gb_sweep_block_end(world->count, b);
        if (list->stop[b] + own.count > list->start[end]) {
            return false;
        }
    }
    return true;
}

/* Sorts the changes by list; false where one makes no sense or room is out. */
static bool sort_out(const struct gb_world *world, struct plan *plan)
{
    const struct gb_neighbour_list *pairs = &world->pairs;
    for (int k = 0; k < plan->count; k++) {
        const struct gb_amendment *pair = &plan->missing[k];
        const bool far_off = holds(world, &pairs->far, pair);
        if (holds(world, &pairs->near, pair) || pair->image < 0 ||
            (far_off && !pair->near)) {
            return false; /* there, but with another image */
        }
        if (pair->near) {
            add_place(world, &plan->near, &pairs->near, pair);
        } else {
            add_place(world, &plan->far, &pairs->far, pair);
        }
        if (far_off) {
            add_place(world, &plan->not_far, &pairs->far, pair);
        }
    }
    return fit_in(world, &pairs->near, plan->near) &&
           fit_in(world, &pairs->far, plan->far);
}

/* Remembers them, sorted; one that was far becomes near. */
static void remember(struct gb_neighbour_list *pairs, const struct plan *plan)
{
    const size_t before = (size_t)pairs->amended_count, size = sizeof *pairs->amended;
    for (int k = 0; k < plan->count; k++) {
        struct gb_amendment *known =
            bsearch(&plan->missing[k], pairs->amended, before, size, compare);
        if (known) {
            *known = plan->missing[k];
        } else {
            pairs->amended[pairs->amended_count++] = plan->missing[k];
        }
    }
    qsort(pairs->amended, (size_t)pairs->amended_count, size, compare);
}

/* Does one of the pairs reach out of its block? */
static bool any_leaves(const struct places *places, int64_t count)
{
    const int64_t size = gb_sweep_block_size(count);
    for (int p = 0; p < places->count; p++) {
        if (places->pair[p]->first / size != places->pair[p]->other / size) {
            return true;
        }
    }
    return false;
}

/* Both lists, and all that goes with them, as planned. */
static bool carry_out(struct gb_world *world, struct plan *plan, struct gb_error *err)
{
    struct gb_neighbour_list *pairs = &world->pairs;
    remember(pairs, plan);
    put_in(world, &pairs->near, plan->near);
    take_out(world, &pairs->far, plan->not_far);
    for (int p = 0; p < plan->far.count; p++) {
        plan->far.at[p] = slot_of(world, &pairs->far, plan->far.pair[p]);
    }
    put_in(world, &pairs->far, plan->far);
    const bool near_leaves = any_leaves(&plan->near, world->count);
    const bool far_leaves =
        any_leaves(&plan->far, world->count) || any_leaves(&plan->not_far, world->count);
    return gb_f32_state_amend(&world->single, pairs, near_leaves, far_leaves, err);
}

bool gb_list_patch_lists(struct gb_world *world, double travel, bool *done,
                         struct gb_error *err)
{
    int64_t most;
    *done = world->in_single &&
            gb_list_check_judge(world, travel) == GB_LIST_CHECK_DOUBTED &&
            count_missing(world, &most);
    if (!*done) {
        return true;
    }
    struct plan plan;
    if (!plan_init(&plan, most, err)) {
        return false;
    }
    gather(world, &plan);
    *done = sort_out(world, &plan);
    const bool good = !*done || carry_out(world, &plan, err);
    plan_finish(&plan);
    return good;
}

static bool sound(const struct gb_world *world, const struct gb_amendment *kept,
                  int64_t count)
{
    for (int64_t k = 0; k < count; k++) {
        const struct gb_amendment *pair = &kept[k];
        if (pair->first < 0 || pair->other <= pair->first ||
            pair->other >= world->count || pair->image < 0 || pair->image > 26 ||
            (pair->near != 0 && pair->near != 1) ||
            (k > 0 && compare(&kept[k - 1], pair) >= 0)) {
            return false;
        }
    }
    return count <= world->pairs.amended_most;
}

bool gb_list_patch_again(struct gb_world *world, const struct gb_amendment *kept,
                         int64_t count, struct gb_error *err)
{
    if (count == 0) {
        return true;
    }
    struct plan plan = {0};
    bool good = world->in_single && sound(world, kept, count);
    if (good) {
        if (!plan_init(&plan, count, err)) {
            return false;
        }
        memcpy(plan.missing, kept, (size_t)count * sizeof *kept);
        plan.count = (int)count;
        good = sort_out(world, &plan);
    }
    const bool done = good && carry_out(world, &plan, err);
    plan_finish(&plan);
    return good ? done
                : gb_error_set(err, GB_ERR_INPUT, "world/amended: is out of range");
}
