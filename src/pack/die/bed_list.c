#include "pack/die/bed_list.h"

#include <math.h>

#include "base/alloc.h"

bool gb_bed_list_init(struct gb_bed_list *list, int64_t particles, int64_t room,
                      struct gb_error *err)
{
    *list = (struct gb_bed_list){.room = room};
    list->start = gb_alloc_array((size_t)particles + 1, sizeof *list->start, err);
    list->first = gb_alloc_array((size_t)room + 1, sizeof *list->first, err);
    list->other = gb_alloc_array((size_t)room + 1, sizeof *list->other, err);
    if (!list->start || !list->first || !list->other ||
        !gb_bed_contacts_init(&list->contacts, room, err)) {
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
    gb_bed_contacts_finish(&list->contacts);
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

static void add_slot(struct gb_bed_list *list, int64_t i, int64_t other,
                     const struct gb_bed *bed)
{
    const bool wall = list == &bed->walls;
    const double radius[2] = {bed->position[i][3],
                              wall ? HUGE_VAL : bed->position[other][3]};
    const double mass[2] = {bed->mass[i], wall ? HUGE_VAL : bed->mass[other]};
    list->first[list->count] = (int32_t)i;
    list->other[list->count] = (int32_t)other;
    gb_bed_contacts_set(&list->contacts, list->count++, &bed->law, radius, mass);
}

static double *history(const struct gb_bed_contacts *contacts, int k)
{
    double *const plane[GB_BED_HISTORY] = {contacts->deepest, contacts->permanent,
                                           contacts->shear[0], contacts->shear[1],
                                           contacts->shear[2]};
    return plane[k];
}

static void copy_slot(struct gb_bed_contacts *to, int64_t slot,
                      const struct gb_bed_contacts *from, int64_t old)
{
    for (int k = 0; k < GB_BED_HISTORY; k++) {
        history(to, k)[slot] = history(from, k)[old];
    }
    to->normal[slot] = from->normal[old];
}

void gb_bed_list_transfer(struct gb_bed_list *to, const struct gb_bed_list *from,
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
                add_slot(list, i, wall, bed);
            }
        }
    }
    list->start[bed->count] = list->count;
    gb_bed_list_transfer(list, &bed->previous_walls, bed->count);
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

static bool list_pairs(struct gb_bed *bed, struct gb_error *err)
{
    struct gb_bed_list *list = &bed->pairs;
    const struct gb_hgrid_box box = box_of(bed);
    if (!gb_hgrid_build(&bed->hgrid, &box, bed->count, (const gb_bed_row *)bed->position,
                        NULL, bed->skin, err)) {
        return false;
    }
    swap(list, &bed->previous_pairs);
    if (!make_room(list, bed->count, bed->hgrid.pair_count, err)) {
        return false;
    }
    list->count = 0;
    for (int64_t i = 0; i < bed->count; i++) {
        list->start[i] = list->count;
        for (int64_t k = bed->hgrid.start[i]; k < bed->hgrid.start[i + 1]; k++) {
            add_slot(list, i, bed->hgrid.other[k], bed);
        }
    }
    list->start[bed->count] = list->count;
    gb_bed_list_transfer(list, &bed->previous_pairs, bed->count);
    return true;
}

bool gb_bed_list_rebuild(struct gb_bed *bed, struct gb_error *err)
{
    return list_pairs(bed, err) && list_walls(bed, err);
}
