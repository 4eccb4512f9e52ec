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

void gb_bed_list_copy_slot(struct gb_bed_contacts *to, int64_t slot,
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
                gb_bed_list_copy_slot(&to->contacts, slot, &from->contacts, old);
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
                gb_bed_list_copy_slot(&to->contacts, to->count++, &from->contacts, slot);
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

/* True for a gap below near_skin, or one that is not a number. */
static bool near(const struct gb_bed *bed, int64_t i, int64_t j)
{
    const double *a = bed->position[i], *b = bed->position[j];
    const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    const double reach = a[3] + b[3] + bed->near_skin;
    return !(x * x + y * y + z * z >= reach * reach);
}

static void copy_constants(struct gb_bed_contacts *to, int64_t slot,
                           const struct gb_bed_contacts *from, int64_t old)
{
    to->hertz[slot] = from->hertz[old];
    to->damping[slot] = from->damping[old];
    to->inverse_mass[slot] = from->inverse_mass[old];
    to->transition[slot] = from->transition[old];
}

/* The near candidates of particle i.  Those that the last list has, from slot `old` on, keep
 * their histories; their constants as well unless these are to be set anew. */
static void draw_pairs_of(struct gb_bed *bed, int64_t i, int64_t old, bool anew)
{
    struct gb_bed_list *list = &bed->pairs;
    const struct gb_bed_list *last = &bed->previous_pairs;
    for (int64_t k = bed->hgrid.start[i]; k < bed->hgrid.start[i + 1]; k++) {
        const int32_t j = bed->hgrid.other[k];
        if (!near(bed, i, j)) {
            continue;
        }
        while (old < last->start[i + 1] && last->other[old] < j) {
            old++;
        }
        const bool known = old < last->start[i + 1] && last->other[old] == j;
        if (!known || anew) {
            add_slot(list, i, j, bed);
        } else {
            list->first[list->count] = (int32_t)i;
            list->other[list->count] = j;
            copy_constants(&list->contacts, list->count++, &last->contacts, old);
        }
        if (known) {
            gb_bed_list_copy_slot(&list->contacts, list->count - 1, &last->contacts, old);
        }
    }
}

static bool draw_pairs(struct gb_bed *bed, bool anew, struct gb_error *err)
{
    struct gb_bed_list *list = &bed->pairs;
    swap(list, &bed->previous_pairs);
    if (!make_room(list, bed->count, bed->hgrid.pair_count, err)) {
        return false;
    }
    list->count = 0;
    for (int64_t i = 0; i < bed->count; i++) {
        list->start[i] = list->count;
        draw_pairs_of(bed, i, bed->previous_pairs.start[i], anew);
    }
    list->start[bed->count] = list->count;
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
           draw_pairs(bed, anew, err) && list_walls(bed, err);
}
