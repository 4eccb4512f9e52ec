/* Neighbour lists of a bed.
 *
 * Candidates are all pairs with a gap below the skin, from a hierarchical grid (hgrid).  The
 * list of pairs holds the candidates that steady motion will soon bring together.  It is
 * shorter, and is selected more often than the candidates are searched.  Another list holds the
 * contacts with the walls.  Touching contacts keep their histories whenever a list is rebuilt.
 *
 * Particles that moved far are renumbered along a Hilbert curve now and then, so that
 * neighbours in space are neighbours in memory. */

#include "pack/die/bed_list.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "pack/die/bed.h"
#include "pack/structure/hilbert.h"

/* ---- Slots and their histories ---- */

bool gb_bed_list_init(struct gb_bed_list *list, int64_t particles, int64_t room,
                      struct gb_error *err)
{
    *list = (struct gb_bed_list){.room = room};
    list->start = gb_alloc_array((size_t)particles + 1, sizeof *list->start, err);
    list->first = gb_alloc_array((size_t)room + 1, sizeof *list->first, err);
    list->other = gb_alloc_array((size_t)room + 1, sizeof *list->other, err);
    list->target = gb_alloc_array((size_t)room + 1, sizeof *list->target, err);
    if (!list->start || !list->first || !list->other || !list->target ||
        !gb_bed_batch_init(&list->contacts, room, err)) {
        gb_bed_list_finish(list);
        return false;
    }
    return true;
}

void gb_bed_list_finish(struct gb_bed_list *list)
{
    gb_alloc_free(list->start);
    gb_alloc_free(list->first);
    gb_alloc_free(list->other);
    gb_alloc_free(list->target);
    gb_bed_batch_finish(&list->contacts);
    *list = (struct gb_bed_list){0};
}

/* Room for count slots; what the list held is lost. */
static bool make_room(struct gb_bed_list *list, int64_t particles, int64_t count,
                      struct gb_error *err)
{
    if (count <= list->room) {
        return true;
    }
    gb_bed_list_finish(list);
    return gb_bed_list_init(list, particles, count + count / 4, err);
}

static void set_slot(struct gb_bed_list *list, int64_t slot, int64_t i, int64_t other,
                     const struct gb_bed *bed)
{
    const bool wall = list == &bed->walls;
    const double radius[2] = {bed->position[i][3],
                              wall ? HUGE_VAL : bed->position[other][3]};
    const double mass[2] = {bed->mass[i], wall ? HUGE_VAL : bed->mass[other]};
    gb_bed_batch_set(&list->contacts, slot, &bed->law, radius, mass);
}

static double *history(const struct gb_bed_contacts *contacts, int k)
{
    double *const plane[GB_BED_HISTORY] = {contacts->deepest, contacts->permanent,
                                           contacts->shear[0], contacts->shear[1],
                                           contacts->shear[2]};
    return plane[k];
}

/* Gives a contact the history of another one. */
static void copy_slot(struct gb_bed_contacts *to, int64_t slot,
                      const struct gb_bed_contacts *from, int64_t old)
{
    for (int k = 0; k < GB_BED_HISTORY; k++) {
        history(to, k)[slot] = history(from, k)[old];
    }
    to->normal[slot] = from->normal[old];
}

/* Gives the contacts of `to` the histories that `from` holds for the same pairs. */
static void transfer(struct gb_bed_list *to, const struct gb_bed_list *from,
                     int64_t particles)
{
    for (int64_t i = 0; i < particles; i++) {
        int64_t old = from->start[i];
        for (int64_t slot = to->start[i]; slot < to->start[i + 1]; slot++) {
            while (old < from->start[i + 1] && from->other[old] < to->other[slot]) {
                old++;
            }
            if (old < from->start[i + 1] && from->other[old] == to->other[slot]) {
                copy_slot(&to->contacts, slot, &from->contacts, old);
            }
        }
    }
}

bool gb_bed_list_copy_touching(struct gb_bed_list *to, const struct gb_bed_list *from,
                               int64_t particles, struct gb_error *err)
{
    int64_t touching = 0;
    for (int64_t slot = 0; slot < from->count; slot++) {
        touching += from->contacts.normal[slot] >= 0.0;
    }
    if (!to->start && !gb_bed_list_init(to, particles, touching, err)) {
        return false;
    }
    if (!make_room(to, particles, touching, err)) {
        return false;
    }
    to->count = 0;
    for (int64_t i = 0; i < particles; i++) {
        to->start[i] = to->count;
        for (int64_t slot = from->start[i]; slot < from->start[i + 1]; slot++) {
            if (from->contacts.normal[slot] >= 0.0) {
                to->first[to->count] = from->first[slot];
                to->other[to->count] = from->other[slot];
                copy_slot(&to->contacts, to->count++, &from->contacts, slot);
            }
        }
    }
    to->start[particles] = to->count;
    return true;
}

void gb_bed_list_start(struct gb_bed_list *list, int64_t particles)
{
    int64_t slot = 0;
    for (int64_t i = 0; i <= particles; i++) {
        while (slot < list->count && list->first[slot] < i) {
            slot++;
        }
        list->start[i] = slot;
    }
}

/* ---- Candidates and walls ---- */

static void swap(struct gb_bed_list *a, struct gb_bed_list *b)
{
    const struct gb_bed_list kept = *a;
    *a = *b;
    *b = kept;
}

static bool list_walls(struct gb_bed *bed, struct gb_error *err)
{
    double unit[3];
    struct gb_bed_list *list = &bed->walls;
    swap(list, &bed->previous_walls);
    if (!make_room(list, bed->count, GB_DIE_WALLS * bed->count, err)) {
        return false;
    }
    list->count = 0;
    for (int64_t i = 0; i < bed->count; i++) {
        list->start[i] = list->count;
        for (int wall = 0; wall < GB_DIE_WALLS; wall++) {
            const double overlap =
                gb_die_overlap(&bed->die, (enum gb_die_wall)wall, bed->position[i],
                               bed->position[i][3], unit);
            if (overlap > -bed->skin) {
                const int64_t slot = list->count++;
                list->first[slot] = (int32_t)i;
                list->other[slot] = wall;
                list->target[slot] =
                    (int32_t)gb_bed_wall_rows(bed, i / bed->blocks.size) + wall;
                set_slot(list, slot, i, wall, bed);
            }
        }
    }
    list->start[bed->count] = list->count;
    transfer(list, &bed->previous_walls, bed->count);
    return true;
}

/* The box around all centres that are numbers; spheres that are not are found by the
 * search. */
static struct gb_hgrid_box box_of(const struct gb_bed *bed)
{
    struct gb_hgrid_box box = {.low = {HUGE_VAL, HUGE_VAL, HUGE_VAL},
                               .high = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
    for (int64_t i = 0; i < bed->count; i++) {
        for (int k = 0; k < 3; k++) {
            box.low[k] = fmin(box.low[k], bed->position[i][k]);
            box.high[k] = fmax(box.high[k], bed->position[i][k]);
        }
    }
    return box;
}

/* ---- Pairs, drawn from the candidates ---- */

/* Lists that are drawn from the candidates. */
struct drawing {
    struct gb_bed *bed;
    bool anew;
};

/* True for a gap that steady motion makes smaller than near_skin in listed_time, or one that
 * is not a number. */
static bool near(const struct gb_bed *bed, int64_t i, int64_t j)
{
    const double *a = bed->position[i], *b = bed->position[j];
    const double *v = bed->velocity[i], *w = bed->velocity[j];
    double distance2 = 0.0, speed2 = 0.0;
    for (int k = 0; k < 3; k++) {
        distance2 += (a[k] - b[k]) * (a[k] - b[k]);
        speed2 += (v[k] - w[k]) * (v[k] - w[k]);
    }
    const double reach = a[3] + b[3] + bed->near_skin + bed->listed_time * sqrt(speed2);
    return !(distance2 >= reach * reach);
}

static void copy_constants(struct gb_bed_contacts *to, int64_t slot,
                           const struct gb_bed_contacts *from, int64_t old)
{
    to->hertz[slot] = from->hertz[old];
    to->damping[slot] = from->damping[old];
    to->inverse_mass[slot] = from->inverse_mass[old];
    to->transition[slot] = from->transition[old];
}

/* The near candidates of a block: to bed->near, from the number of its first candidate on;
 * those of each particle are counted in the list. */
static void find_near(void *data, int64_t b)
{
    const struct drawing *drawing = data;
    struct gb_bed *bed = drawing->bed;
    struct gb_bed_block *block = &bed->blocks.block[b];
    const int64_t begin = gb_bed_blocks_begin(bed->count, b);
    const int64_t end = gb_bed_blocks_end(bed->count, b);
    const int64_t *candidates = bed->hgrid.start;
    int32_t *found = bed->near + candidates[begin];
    int64_t count = 0;
    block->crossings = 0;
    for (int64_t i = begin; i < end; i++) {
        const int64_t before = count;
        for (int64_t k = candidates[i]; k < candidates[i + 1]; k++) {
            const int32_t j = bed->hgrid.other[k];
            if (near(bed, i, j)) {
                found[count++] = j;
                block->crossings += j >= end;
            }
        }
        bed->pairs.start[i + 1] = count - before;
    }
}

/* Slots become those of the particles; returns their number. */
static int64_t sum_starts(struct gb_bed_list *list, int64_t particles)
{
    list->start[0] = 0;
    for (int64_t i = 0; i < particles; i++) {
        list->start[i + 1] += list->start[i];
    }
    return list->start[particles];
}

/* A pair that the last list has, in slot `old`, keeps its history; its constants as well
 * unless these are to be set anew. */
static void write_pair(const struct drawing *drawing, int64_t slot, int64_t old)
{
    struct gb_bed *bed = drawing->bed;
    struct gb_bed_list *list = &bed->pairs;
    const struct gb_bed_contacts *last = &bed->previous_pairs.contacts;
    if (old < 0 || drawing->anew) {
        set_slot(list, slot, list->first[slot], list->other[slot], bed);
    } else {
        copy_constants(&list->contacts, slot, last, old);
    }
    if (old >= 0) {
        copy_slot(&list->contacts, slot, last, old);
    }
}

/* The slots of a block. */
static void draw_block(void *data, int64_t b)
{
    const struct drawing *drawing = data;
    struct gb_bed *bed = drawing->bed;
    struct gb_bed_list *list = &bed->pairs;
    const struct gb_bed_list *last = &bed->previous_pairs;
    const int64_t begin = gb_bed_blocks_begin(bed->count, b);
    const int64_t end = gb_bed_blocks_end(bed->count, b);
    const int64_t crossing_rows = gb_bed_crossing_rows(bed);
    const int32_t *found = bed->near + bed->hgrid.start[begin];
    int64_t crossing = bed->blocks.crossing[b];
    for (int64_t i = begin; i < end; i++) {
        int64_t old = last->start[i];
        for (int64_t slot = list->start[i]; slot < list->start[i + 1]; slot++) {
            const int32_t j = *found++;
            while (old < last->start[i + 1] && last->other[old] < j) {
                old++;
            }
            const bool known = old < last->start[i + 1] && last->other[old] == j;
            list->first[slot] = (int32_t)i;
            list->other[slot] = list->target[slot] = j;
            if (j >= end) {
                bed->blocks.target[crossing] = j;
                list->target[slot] = (int32_t)(crossing_rows + crossing++);
            }
            write_pair(drawing, slot, known ? old : -1);
        }
    }
}

static bool make_near_room(struct gb_bed *bed, struct gb_error *err)
{
    if (bed->near && bed->hgrid.pair_count <= bed->near_room) {
        return true;
    }
    gb_alloc_free(bed->near);
    bed->near_room = bed->hgrid.pair_count + bed->hgrid.pair_count / 4;
    bed->near = gb_alloc_array((size_t)bed->near_room + 1, sizeof *bed->near, err);
    return bed->near != NULL;
}

bool gb_bed_list_make_rows(struct gb_bed *bed, struct gb_error *err)
{
    const int64_t rows =
        gb_bed_crossing_rows(bed) + bed->blocks.crossing[bed->blocks.count];
    if (bed->force && rows <= bed->force_room) {
        return true;
    }
    const size_t kept = bed->force ? (size_t)bed->count * sizeof *bed->force : 0;
    gb_bed_row *const old[2] = {bed->force, bed->moment};
    gb_bed_row **const all[2] = {&bed->force, &bed->moment};
    gb_bed_row *grown[2];
    bed->force_room = rows + rows / 4;
    for (int k = 0; k < 2; k++) {
        grown[k] = gb_alloc_array((size_t)bed->force_room, sizeof *grown[k], err);
    }
    if (!grown[0] || !grown[1]) {
        gb_alloc_free(grown[0]);
        gb_alloc_free(grown[1]);
        bed->force_room = 0;
        return false;
    }
    for (int k = 0; k < 2; k++) {
        if (kept > 0) {
            memcpy(grown[k], old[k], kept);
        }
        gb_alloc_free(old[k]);
        *all[k] = grown[k];
    }
    return true;
}

/* What a wall costs in pairs: its geometry is dearer. */
enum { WALL_COST = 2 };

static void weigh_blocks(struct gb_bed *bed)
{
    for (int64_t b = 0; b < bed->blocks.count; b++) {
        const int64_t end = gb_bed_blocks_end(bed->count, b);
        bed->blocks.cost[b + 1] =
            end + bed->pairs.start[end] + WALL_COST * bed->walls.start[end];
    }
}

static bool draw_pairs(struct gb_bed *bed, bool anew, struct gb_error *err)
{
    struct gb_bed_list *list = &bed->pairs;
    struct drawing drawing = {bed, anew};
    swap(list, &bed->previous_pairs);
    if (!make_room(list, bed->count, bed->hgrid.pair_count, err) ||
        !make_near_room(bed, err)) {
        return false;
    }
    gb_bed_run_blocks(bed, find_near, &drawing);
    list->count = sum_starts(list, bed->count);
    if (!gb_bed_blocks_number(&bed->blocks, err) || !gb_bed_list_make_rows(bed, err)) {
        return false;
    }
    gb_bed_run_blocks(bed, draw_block, &drawing);
    gb_bed_blocks_enter(&bed->blocks);
    weigh_blocks(bed);
    return true;
}

bool gb_bed_list_draw(struct gb_bed *bed, struct gb_error *err)
{
    return draw_pairs(bed, false, err);
}

bool gb_bed_list_rebuild(struct gb_bed *bed, struct gb_error *err)
{
    /* contacts of a record have no constants, and the law may be another one */
    const bool anew = true;
    const struct gb_hgrid_box box = box_of(bed);
    return gb_hgrid_build(&bed->hgrid, &box, bed->count,
                          (const gb_bed_row *)bed->position, NULL, bed->skin, err) &&
           list_walls(bed, err) && draw_pairs(bed, anew, err);
}

/* ---- Numbers along a Hilbert curve ---- */

enum { BITS_MAX = 16 };

/* Cells of the curve: cubes about as wide as a particle, from a corner of the bed on. */
struct lattice {
    double low[3], width;
    int bits;
};

static struct lattice lattice_of(const struct gb_bed *bed)
{
    struct lattice lattice = {.low = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, .bits = 1};
    double high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, radii = 0.0, longest = 0.0;
    for (int64_t i = 0; i < bed->count; i++) {
        for (int k = 0; k < 3; k++) {
            lattice.low[k] = fmin(lattice.low[k], bed->position[i][k]);
            high[k] = fmax(high[k], bed->position[i][k]);
        }
        radii += bed->position[i][3];
    }
    for (int k = 0; k < 3; k++) {
        longest = fmax(longest, high[k] - lattice.low[k]);
    }
    lattice.width = 2.0 * radii / (double)bed->count;
    while (lattice.bits < BITS_MAX && ldexp(lattice.width, lattice.bits) < longest) {
        lattice.bits++;
    }
    return lattice;
}

static uint64_t key_of(const struct lattice *lattice, const double x[3])
{
    const double most = ldexp(1.0, lattice->bits) - 1.0;
    uint32_t cell[3];
    for (int k = 0; k < 3; k++) {
        const double at = (x[k] - lattice->low[k]) / lattice->width;
        cell[k] = (uint32_t)(at > 0.0 ? fmin(at, most) : 0.0); /* 0: not a number */
    }
    return gb_hilbert_index(cell, 3, lattice->bits);
}

static void permute(gb_bed_row *rows, gb_bed_row *scratch,
                    const struct gb_hilbert_entry *order, int64_t count)
{
    memcpy(scratch, rows, (size_t)count * sizeof *rows);
    for (int64_t i = 0; i < count; i++) {
        memcpy(rows[i], scratch[order[i].particle], sizeof *rows);
    }
}

/* A contact under its new numbers. */
struct renamed {
    int32_t first, other;
    bool swapped;
    int64_t slot;
};

static int compare(const void *a, const void *b)
{
    const struct renamed *x = a, *y = b;
    return x->first != y->first ? (x->first > y->first) - (x->first < y->first)
                                : (x->other > y->other) - (x->other < y->other);
}

static struct renamed rename_slot(const struct gb_bed_list *list, int64_t slot,
                                  enum gb_bed_partner partner, const int32_t *rank)
{
    const int32_t i = rank[list->first[slot]], j = list->other[slot];
    if (partner == GB_BED_PARTNER_WALL) {
        return (struct renamed){i, j, false, slot};
    }
    const bool swapped = rank[j] < i;
    return (struct renamed){swapped ? rank[j] : i, swapped ? i : rank[j], swapped, slot};
}

/* The touching contacts of a list, by their new numbers; `kept` is scratch. */
static bool rename_list(struct gb_bed_list *list, struct gb_bed_list *kept,
                        enum gb_bed_partner partner, const int32_t *rank,
                        int64_t particles, struct gb_error *err)
{
    if (!gb_bed_list_copy_touching(kept, list, particles, err)) {
        return false;
    }
    struct renamed *renamed = gb_alloc_array((size_t)kept->count, sizeof *renamed, err);
    if (!renamed) {
        return false;
    }
    for (int64_t slot = 0; slot < kept->count; slot++) {
        renamed[slot] = rename_slot(kept, slot, partner, rank);
    }
    qsort(renamed, (size_t)kept->count, sizeof *renamed, compare);
    list->count = kept->count;
    for (int64_t slot = 0; slot < kept->count; slot++) {
        list->first[slot] = renamed[slot].first;
        list->other[slot] = renamed[slot].other;
        copy_slot(&list->contacts, slot, &kept->contacts, renamed[slot].slot);
        for (int k = 0; k < 3 && renamed[slot].swapped; k++) {
            list->contacts.shear[k][slot] = -list->contacts.shear[k][slot];
        }
    }
    gb_bed_list_start(list, particles);
    gb_alloc_free(renamed);
    return true;
}

static bool rename_lists(struct gb_bed *bed, const int32_t *rank, struct gb_error *err)
{
    return rename_list(&bed->pairs, &bed->previous_pairs, GB_BED_PARTNER_PARTICLE, rank,
                       bed->count, err) &&
           rename_list(&bed->walls, &bed->previous_walls, GB_BED_PARTNER_WALL, rank,
                       bed->count, err);
}

bool gb_bed_list_renumber(struct gb_bed *bed, struct gb_error *err)
{
    const size_t count = (size_t)bed->count;
    const struct lattice lattice = lattice_of(bed);
    struct gb_hilbert_entry *order = gb_alloc_array(count, sizeof *order, err);
    gb_bed_row *scratch = gb_alloc_array(count, sizeof *scratch, err);
    int32_t *rank = gb_alloc_array(count, sizeof *rank, err);
    bool done = order && scratch && rank;
    if (done) {
        for (int64_t i = 0; i < bed->count; i++) {
            order[i] = (struct gb_hilbert_entry){key_of(&lattice, bed->position[i]), i};
        }
        gb_hilbert_order(order, bed->count);
        for (int64_t i = 0; i < bed->count; i++) {
            rank[order[i].particle] = (int32_t)i;
        }
        done = rename_lists(bed, rank, err);
    }
    if (done) {
        permute(bed->position, scratch, order, bed->count);
        permute(bed->velocity, scratch, order, bed->count);
        permute(bed->roll, scratch, order, bed->count);
        gb_bed_weigh(bed);
        gb_bed_invalidate_lists(bed);
    }
    gb_alloc_free(order);
    gb_alloc_free(scratch);
    gb_alloc_free(rank);
    return done;
}
