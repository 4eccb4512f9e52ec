#include "pack/die/bed_order.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "pack/die/bed_list.h"
#include "pack/structure/hilbert.h"

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
        gb_bed_list_copy_slot(&list->contacts, slot, &kept->contacts, renamed[slot].slot);
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

bool gb_bed_order_renumber(struct gb_bed *bed, struct gb_error *err)
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
