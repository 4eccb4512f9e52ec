#include "pack/amend.h"

#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "pack/world_private.h"

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

/* First slot of the pair's first particle whose second one is not before the pair's. */
static int64_t slot_of(const struct gb_pair_list *list, const struct gb_amendment *pair)
{
    int64_t k = list->start[pair->first];
    while (k < list->start[pair->first + 1] && list->other[k] < pair->other) {
        k++;
    }
    return k;
}

static bool holds(const struct gb_pair_list *list, const struct gb_amendment *pair)
{
    const int64_t k = slot_of(list, pair);
    return k < list->start[pair->first + 1] && list->other[k] == pair->other;
}

/* Opens a gap at every place in an array of items of so many bytes. */
static void open_gaps(void *array, size_t size, int64_t length,
                      const struct places *places)
{
    char *byte = array;
    int64_t end = length;
    for (int p = places->count - 1; p >= 0; p--) {
        const int64_t at = places->at[p];
        memmove(byte + (size_t)(at + p + 1) * size, byte + (size_t)at * size,
                (size_t)(end - at) * size);
        end = at;
    }
}

static void close_gaps(void *array, size_t size, int64_t length,
                       const struct places *places)
{
    char *byte = array;
    for (int p = 0; p < places->count; p++) {
        const int64_t from = places->at[p] + 1;
        const int64_t to = p + 1 < places->count ? places->at[p + 1] : length;
        memmove(byte + (size_t)(from - p - 1) * size, byte + (size_t)from * size,
                (size_t)(to - from) * size);
    }
}

/* Moves the starts of all particles behind the places; by: +1 or -1. */
static void shift_starts(struct gb_pair_list *list, int64_t particles,
                         const struct places *places, int by)
{
    int p = 0;
    for (int64_t i = 0; i <= particles; i++) {
        while (p < places->count && places->pair[p]->first < i) {
            p++;
        }
        list->start[i] += (int64_t)by * p;
    }
    list->pair_count += (int64_t)by * places->count;
}

static void move_list(struct gb_pair_list *list,
                      void (*move)(void *, size_t, int64_t, const struct places *),
                      const struct places *places)
{
    move(list->first, sizeof *list->first, list->pair_count, places);
    move(list->other, sizeof *list->other, list->pair_count, places);
    move(list->image, sizeof *list->image, list->pair_count, places);
}

static void put_in(struct gb_pair_list *list, int64_t particles,
                   const struct places *places)
{
    move_list(list, open_gaps, places);
    for (int p = 0; p < places->count; p++) {
        const int64_t k = places->at[p] + p;
        list->first[k] = places->pair[p]->first;
        list->other[k] = places->pair[p]->other;
        list->image[k] = (uint8_t)places->pair[p]->image;
    }
    shift_starts(list, particles, places, 1);
}

static void take_out(struct gb_pair_list *list, int64_t particles,
                     const struct places *places)
{
    move_list(list, close_gaps, places);
    shift_starts(list, particles, places, -1);
}

/* Gaps in the histories of the near pairs, filled with pairs that do not touch. */
static void make_histories(struct gb_world *world, const struct places *places)
{
    struct gb_contacts *contacts = &world->contacts;
    const int64_t length = world->pairs.near.pair_count;
#pragma omp parallel for num_threads(world->threads)                                     \
    schedule(static) if (world->threads > 1)
    for (int p = 0; p < contacts->planes; p++) {
        open_gaps(contacts->plane[p], sizeof(float), length, places);
    }
    for (int p = 0; p < places->count; p++) {
        gb_contacts_clear(contacts, places->at[p] + p);
    }
}

/* Image of the pair that is the nearest one now. */
static int32_t nearest_image(const struct gb_world *world, int64_t i, int64_t j)
{
    int32_t image = 0, weight = 1;
    for (int k = 0; k < 3; k++) {
        const double edge = world->cell.edge[k];
        const double r = world->position[3 * i + k] - world->position[3 * j + k];
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
        const struct gb_strays_missing *part = &world->block[b].missing;
        strays += part->strays;
        *most += part->count;
        if (part->many) {
            return false;
        }
    }
    return *most > 0 && world->pairs.amended_count + *most <= world->pairs.amended_most &&
           !gb_strays_too_many(strays, world->count);
}

/* All that is missing, sorted, each pair once. */
static void gather(const struct gb_world *world, struct plan *plan)
{
    int n = 0;
    for (int64_t b = 0; b < gb_sweep_blocks(world->count); b++) {
        const struct gb_strays_missing *part = &world->block[b].missing;
        for (int k = 0; k < part->count; k++) {
            const struct gb_strays_pair *pair = &part->pair[k];
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

static void add_place(struct places *places, const struct gb_pair_list *list,
                      const struct gb_amendment *pair)
{
    places->at[places->count] = slot_of(list, pair);
    places->pair[places->count++] = pair;
}

/* Sorts the changes by list; false where one makes no sense or room is out. */
static bool sort_out(const struct gb_world *world, struct plan *plan)
{
    const struct gb_pairs *pairs = &world->pairs;
    for (int k = 0; k < plan->count; k++) {
        const struct gb_amendment *pair = &plan->missing[k];
        const bool far_off = holds(&pairs->far, pair);
        if (holds(&pairs->near, pair) || pair->image < 0 || (far_off && !pair->near)) {
            return false; /* there, but with another image */
        }
        if (pair->near) {
            add_place(&plan->near, &pairs->near, pair);
        } else {
            add_place(&plan->far, &pairs->far, pair);
        }
        if (far_off) {
            add_place(&plan->not_far, &pairs->far, pair);
        }
    }
    return pairs->near.pair_count + plan->near.count < pairs->near.capacity &&
           pairs->far.pair_count + plan->far.count < pairs->far.capacity;
}

/* Remembers them, sorted; one that was far becomes near. */
static void remember(struct gb_pairs *pairs, const struct plan *plan)
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
    struct gb_pairs *pairs = &world->pairs;
    remember(pairs, plan);
    make_histories(world, &plan->near);
    put_in(&pairs->near, world->count, &plan->near);
    take_out(&pairs->far, world->count, &plan->not_far);
    for (int p = 0; p < plan->far.count; p++) {
        plan->far.at[p] = slot_of(&pairs->far, plan->far.pair[p]);
    }
    put_in(&pairs->far, world->count, &plan->far);
    const bool near_leaves = any_leaves(&plan->near, world->count);
    const bool far_leaves =
        any_leaves(&plan->far, world->count) || any_leaves(&plan->not_far, world->count);
    return gb_single_amend(&world->single, pairs, near_leaves, far_leaves, err);
}

bool gb_amend_lists(struct gb_world *world, double travel, bool *done,
                    struct gb_error *err)
{
    int64_t most;
    *done = world->in_single && gb_strays_judge(world, travel) == GB_STRAYS_DOUBTED &&
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

bool gb_amend_again(struct gb_world *world, const struct gb_amendment *kept,
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
