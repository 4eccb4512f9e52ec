#include "pack/list/list_patch.h"

#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "pack/cell/engine.h"
#include "pack/list/blocks.h"
#include "pack/list/list_check.h"
#include "pack/list/list_slots.h"

/* Changes to the lists. */
struct plan {
    struct gb_inserted_pair *missing; /* sorted */
    int count;
    struct gb_list_slots near, far; /* insertions */
    struct gb_list_slots far_gone;  /* removals: pairs that become near */
};

static void plan_finish(struct plan *plan)
{
    gb_list_slots_finish(&plan->near);
    gb_list_slots_finish(&plan->far);
    gb_list_slots_finish(&plan->far_gone);
    gb_alloc_free(plan->missing);
    *plan = (struct plan){0};
}

/* Room for `room` pairs. */
static bool plan_init(struct plan *plan, int64_t room, struct gb_error *err)
{
    *plan = (struct plan){0};
    plan->missing = gb_alloc_array((size_t)room, sizeof *plan->missing, err);
    if (!plan->missing || !gb_list_slots_init(&plan->near, room, err) ||
        !gb_list_slots_init(&plan->far, room, err) ||
        !gb_list_slots_init(&plan->far_gone, room, err)) {
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
        const bool in_far = gb_list_slots_holds(list, &list->far, pair);
        if (gb_list_slots_holds(list, &list->near, pair) || pair->image < 0 ||
            (in_far && !pair->near)) {
            return false; /* it is there, but with another image */
        }
        if (pair->near) {
            gb_list_slots_add(&plan->near, list, &list->near, pair);
        } else {
            gb_list_slots_add(&plan->far, list, &list->far, pair);
        }
        if (in_far) {
            gb_list_slots_add(&plan->far_gone, list, &list->far, pair);
        }
    }
    return gb_list_slots_fit(list, &list->near, plan->near) &&
           gb_list_slots_fit(list, &list->far, plan->far);
}

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
    gb_list_slots_insert(list, &list->near, &engine->contacts, plan->near);
    gb_list_slots_remove(list, &list->far, plan->far_gone);
    for (int p = 0; p < plan->far.count; p++) { /* removals have moved the slots */
        plan->far.at[p] = gb_list_slots_find(list, &list->far, plan->far.pair[p]);
    }
    gb_list_slots_insert(list, &list->far, NULL, plan->far);
    const bool crosses = gb_list_slots_cross(&plan->near, count) ||
                         gb_list_slots_cross(&plan->far, count) ||
                         gb_list_slots_cross(&plan->far_gone, count);
    return !crosses || gb_wrench_rows_update(&engine->f32.rows, list, err);
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
    return !good  ? GB_LIST_PATCH_FAILED
           : fits ? GB_LIST_PATCH_DONE
                  : GB_LIST_PATCH_REBUILD;
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
