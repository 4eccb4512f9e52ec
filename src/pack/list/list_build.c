#include "pack/list/list_build.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/team/team.h"
#include "pack/kernel/share.h"
#include "pack/list/blocks.h"
#include "pack/list/list_levels.h"
#include "pack/list/list_scan.h"
#include "scene/tolerances.h"

/* Particles begin .. end - 1 with all their neighbours, found by one thread. */
struct part {
    int64_t begin, end;
    struct gb_list_scan_found *found; /* particle after particle, sorted within each */
    int64_t count, capacity;
    int64_t expected;  /* share of the pairs of the last build */
    int64_t near, far; /* number of pairs in each list; then their first slot there */
    struct gb_error err;
};

/* Room for the neighbours of one more particle, `most` of them. */
static bool make_room(struct part *part, int64_t most)
{
    if (part->count + most < part->capacity) {
        return true;
    }
    const int64_t more = part->capacity > 0 ? part->capacity / 4 : part->expected;
    const int64_t room = part->capacity + more + most + 16 * GB_LIST_SCAN_MAX;
    struct gb_list_scan_found *found = gb_alloc_grow(
        part->found, (size_t)part->count, (size_t)room, sizeof *found, &part->err);
    if (!found) {
        return false;
    }
    part->found = found;
    part->capacity = room;
    return true;
}

/* Leaves in start[i + 1] of both lists the number of pairs of particle i. */
static bool scan_part(struct gb_neighbour_list *list, const struct gb_list_scan *scan,
                      struct part *part)
{
    for (int64_t i = part->begin; i < part->end; i++) {
        if (!make_room(part, gb_list_scan_most(scan, i))) {
            return false;
        }
        const struct gb_list_scan_found *found = part->found + part->count;
        const int n = gb_list_scan_particle(scan, i, part->found + part->count);
        if (!scan->candidates && n >= GB_LIST_SCAN_MAX) {
            return gb_error_set(&part->err, GB_ERR_GUARD,
                                "particle %lld has %d or more neighbours within %.3g d: "
                                "the packing has collapsed",
                                (long long)i, n, sqrt(scan->bounds.far));
        }
        int near = 0;
        for (int k = 0; k < n; k++) {
            near += found[k].near;
        }
        list->near.start[i + 1] = near;
        list->far.start[i + 1] = n - near;
        part->near += near;
        part->far += n - near;
        part->count += n;
    }
    return true;
}

/* First slots of every part, and room for all pairs. */
static bool assign_part_slots(struct gb_neighbour_list *list, struct part *part,
                              int parts, struct gb_error *err)
{
    const int64_t size = gb_blocks_size(list->count);
    const int64_t per_block = gb_neighbour_list_free_slots(list);
    int64_t near = 0, far = 0;
    for (int t = 0; t < parts; t++) {
        if (part[t].err.code != GB_OK) {
            return gb_error_set(err, part[t].err.code, "%s", part[t].err.text);
        }
        const int64_t own_near = part[t].near, own_far = part[t].far;
        const int64_t free_slots = per_block * (part[t].begin / size);
        part[t].near = near + free_slots;
        part[t].far = far + free_slots;
        near += own_near;
        far += own_far;
    }
    list->near.start[0] = list->far.start[0] = 0;
    list->near.pair_count = near;
    list->far.pair_count = far;
    const int64_t free_slots = per_block * gb_blocks_count(list->count);
    return gb_neighbour_list_reserve(list, &list->near, near + free_slots, err) &&
           gb_neighbour_list_reserve(list, &list->far, far + free_slots, err);
}

static void put_pair(struct gb_pair_list *pairs, int64_t i, int64_t k,
                     const struct gb_list_scan_found *found)
{
    pairs->first[k] = (int32_t)i;
    pairs->other[k] = found->other;
    pairs->image[k] = found->image;
}

/* Free slots behind the pairs of block b, whose last particle is i; returns the first slot
 * of the next block. */
static int64_t end_block(struct gb_neighbour_list *list, struct gb_pair_list *pairs,
                         int64_t b, int64_t i, int64_t slot)
{
    const int64_t free_slots = gb_neighbour_list_free_slots(list);
    pairs->stop[b] = slot;
    for (int64_t k = 0; k < free_slots; k++) {
        gb_neighbour_list_free_slot(pairs, slot++, i);
    }
    return slot;
}

static void fill_part(struct gb_neighbour_list *list, const struct part *part)
{
    const bool patchable = list->layout == GB_NEIGHBOUR_LIST_PATCHABLE;
    const struct gb_list_scan_found *found = part->found;
    int64_t near = part->near, far = part->far;
    int64_t b = part->begin / gb_blocks_size(list->count);
    int64_t end = gb_blocks_end(list->count, b);
    for (int64_t i = part->begin; i < part->end; i++) {
        int64_t n = list->near.start[i + 1] + list->far.start[i + 1];
        for (; n > 0; n--, found++) {
            if (found->near) {
                put_pair(&list->near, i, near++, found);
            } else {
                put_pair(&list->far, i, far++, found);
            }
        }
        if (patchable && i + 1 == end) {
            near = end_block(list, &list->near, b, i, near);
            far = end_block(list, &list->far, b, i, far);
            end = gb_blocks_end(list->count, ++b);
        }
        list->near.start[i + 1] = near;
        list->far.start[i + 1] = far;
    }
}

struct filling {
    struct gb_neighbour_list *list;
    const struct gb_list_scan *scan;
    struct part *part;
};

static void scan_item(void *data, int64_t t)
{
    struct filling *filling = data;
    struct part *part = &filling->part[t];
    (void)scan_part(filling->list, filling->scan, part); /* the part keeps the error */
}

static void fill_item(void *data, int64_t t)
{
    struct filling *filling = data;
    fill_part(filling->list, &filling->part[t]);
}

static bool fill_lists(struct gb_neighbour_list *list, const struct gb_list_scan *scan,
                       struct gb_team *team, struct gb_error *err)
{
    const int parts = gb_team_size(team);
    struct part *part = gb_alloc_array((size_t)parts, sizeof *part, err);
    if (!part) {
        return false;
    }
    struct filling filling = {list, scan, part};
    const int64_t pairs = list->near.pair_count + list->far.pair_count;
    for (int t = 0; t < parts; t++) {
        part[t].expected = (pairs + pairs / 16) / parts;
        part[t].begin = gb_share(list->count, t, parts);
        part[t].end = gb_share(list->count, t + 1, parts);
    }
    gb_team_run(team, parts, scan_item, &filling);
    const bool good = assign_part_slots(list, part, parts, err);
    if (good) {
        gb_team_run(team, parts, fill_item, &filling);
    }
    for (int t = 0; t < parts; t++) {
        gb_alloc_free(part[t].found);
    }
    gb_alloc_free(part);
    return good;
}

/* The transposed list, by counting. */
static void transpose(struct gb_pair_list *pairs, int64_t count)
{
    int64_t *in = pairs->in_start;
    memset(in, 0, ((size_t)count + 1) * sizeof *in);
    for (int64_t k = 0; k < pairs->pair_count; k++) {
        in[pairs->other[k] + 1]++;
    }
    for (int64_t j = 0; j < count; j++) {
        in[j + 1] += in[j];
    }
    for (int64_t k = 0; k < pairs->pair_count; k++) {
        pairs->in_slot[in[pairs->other[k]]++] = (int32_t)k;
    }
    for (int64_t j = count; j > 0; j--) {
        in[j] = in[j - 1];
    }
    in[0] = 0;
}

/* The near list or the far one. */
static void transpose_item(void *data, int64_t far)
{
    struct gb_neighbour_list *list = data;
    transpose(far ? &list->far : &list->near, list->count);
}

/* Reference of the list check until the next build. */
static void record_build(struct gb_neighbour_list *list, const struct gb_cell *cell,
                         const double *position, const struct gb_neighbour_grid *grid)
{
    list->inserted_count = 0;
    list->grid = *grid;
    memcpy(list->built_position, position, 3 * (size_t)list->count * sizeof *position);
    list->built = *cell;
    gb_cell_init(&list->unit, 3, (const double[3]){1.0, 1.0, 1.0});
    list->strain = 0.0;
}

/* Candidates by levels of size for unequal particles, but for a tilted cell.  Errors: those of
 * gb_list_levels_find. */
static bool find_candidates(struct gb_neighbour_list *list, struct gb_list_scan *scan,
                            struct gb_team *team, struct gb_error *err)
{
    if (!list->diameter || scan->grid.tilted) {
        return true;
    }
    return (list->levels || gb_list_levels_create(&list->levels, list->count, err)) &&
           gb_list_levels_find(list->levels, scan, list->count, team, err);
}

bool gb_list_build(struct gb_neighbour_list *list, const struct gb_cell *cell,
                   const double *position, struct gb_list_build_range range,
                   struct gb_team *team, struct gb_error *err)
{
    const double skin = range.skin, gap = range.cutoff - 1.0 + skin;
    const double reach = list->largest - 1.0 + range.cutoff + skin;
    if (gb_cell_shortest(cell) < GB_EDGE_OVER_RANGE_MIN * reach) {
        return gb_error_set(
            err, GB_ERR_GUARD,
            "the cell has shrunk to %.3g d, less than twice the neighbour "
            "reach %.3g d: take more particles or another structure.base",
            gb_cell_shortest(cell), reach);
    }
    gb_neighbour_list_update_shifts(list, cell);
    struct gb_list_scan scan = {
        .bounds = {(1.0 + skin) * (1.0 + skin), reach * reach, skin, gap},
        .cell = cell,
        .position = position,
        .shift = (const double(*)[3])list->shift,
        .diameter = list->diameter};
    gb_neighbour_grid_init(&scan.grid, cell, reach, list->count);
    if (!find_candidates(list, &scan, team, err) ||
        !gb_list_scan_sort(&scan, list, err) || !fill_lists(list, &scan, team, err)) {
        return false;
    }
    if (list->layout == GB_NEIGHBOUR_LIST_TRANSPOSED) {
        gb_team_run(team, 2, transpose_item, list);
    }
    record_build(list, cell, position, &scan.grid);
    return true;
}
