/* The state of a bed outside of it: copies in memory, a hash, and records of checkpoints.
 *
 * A copy restores the bed after a measure that disturbs it.  A record goes to a file; it holds
 * what later steps depend on (positions, velocities, histories, die, welds).  Lists are left
 * out, since no force depends on them. */

#include "pack/die/bed_record.h"

#include <gsl/gsl_sort.h>
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "base/alloc.h"
#include "base/vec.h"
#include "pack/cell/record_checks.h"
#include "pack/die/bed.h"
#include "pack/die/bed_list.h"
#include "pack/die/bed_welds.h"

/* ---- Copy ---- */

struct gb_bed_copy {
    int64_t count;
    gb_bed_row *rows; /* positions, velocities, spins */
    struct gb_die die;
    struct gb_bed_list pairs, walls; /* what touches */
    struct gb_bed_welds *welds;
    double skin;
};

enum { ROW_KINDS = 3 };

static bool make_copy(struct gb_bed_copy **out, int64_t count, struct gb_error *err)
{
    struct gb_bed_copy *copy = gb_alloc_array(1, sizeof *copy, err);
    if (!copy) {
        return false;
    }
    copy->count = count;
    copy->rows = gb_alloc_array(ROW_KINDS * (size_t)count, sizeof *copy->rows, err);
    if (!copy->rows) {
        gb_bed_record_destroy(copy);
        return false;
    }
    *out = copy;
    return true;
}

void gb_bed_record_destroy(struct gb_bed_copy *copy)
{
    if (!copy) {
        return;
    }
    gb_alloc_free(copy->rows);
    gb_bed_list_finish(&copy->pairs);
    gb_bed_list_finish(&copy->walls);
    gb_bed_welds_destroy(copy->welds);
    gb_alloc_free(copy);
}

bool gb_bed_record_take(const struct gb_bed *bed, struct gb_bed_copy **copy,
                        struct gb_error *err)
{
    if (!*copy && !make_copy(copy, bed->count, err)) {
        return false;
    }
    gb_bed_row *const rows[ROW_KINDS] = {bed->position, bed->velocity, bed->roll};
    for (int k = 0; k < ROW_KINDS; k++) {
        memcpy((*copy)->rows + k * bed->count, rows[k],
               (size_t)bed->count * sizeof *rows[k]);
    }
    (*copy)->die = bed->die;
    (*copy)->skin = bed->skin;
    return gb_bed_list_copy_touching(&(*copy)->pairs, &bed->pairs, bed->count, err) &&
           gb_bed_list_copy_touching(&(*copy)->walls, &bed->walls, bed->count, err) &&
           gb_bed_welds_copy(&(*copy)->welds, bed->welds, err);
}

bool gb_bed_record_restore(struct gb_bed *bed, const struct gb_bed_copy *copy,
                           struct gb_error *err)
{
    gb_bed_row *const rows[ROW_KINDS] = {bed->position, bed->velocity, bed->roll};
    for (int k = 0; k < ROW_KINDS; k++) {
        memcpy(rows[k], copy->rows + k * bed->count,
               (size_t)bed->count * sizeof *rows[k]);
    }
    bed->die = copy->die;
    bed->skin = copy->skin;
    gb_bed_weigh(bed);   /* numbers may have changed */
    bed->listed = false; /* rebuilt at the next evaluation, from these: */
    return gb_bed_list_copy_touching(&bed->pairs, &copy->pairs, bed->count, err) &&
           gb_bed_list_copy_touching(&bed->walls, &copy->walls, bed->count, err) &&
           gb_bed_welds_copy(&bed->welds, copy->welds, err);
}

/* ---- Hash ---- */

static uint64_t mix_list(uint64_t hash, const struct gb_bed_list *list)
{
    const struct gb_bed_contacts *c = &list->contacts;
    for (int64_t slot = 0; slot < list->count; slot++) {
        if (c->normal[slot] < 0.0) {
            continue;
        }
        const double history[] = {c->deepest[slot], c->shear[0][slot], c->shear[1][slot],
                                  c->shear[2][slot]};
        hash = gb_record_fnv(hash, &list->first[slot], sizeof list->first[slot]);
        hash = gb_record_fnv(hash, &list->other[slot], sizeof list->other[slot]);
        hash = gb_record_fnv(hash, history, sizeof history);
    }
    return hash;
}

static uint64_t mix_welds(uint64_t hash, const struct gb_bed_welds *welds)
{
    for (int64_t k = 0; welds && k < welds->count; k++) {
        const double state[] = {welds->length[k], welds->radius[k], welds->force[0][k],
                                welds->force[1][k], welds->force[2][k]};
        hash = gb_record_fnv(hash, &welds->first[k], sizeof welds->first[k]);
        hash = gb_record_fnv(hash, &welds->other[k], sizeof welds->other[k]);
        hash = gb_record_fnv(hash, state, sizeof state);
    }
    return hash;
}

uint64_t gb_bed_record_hash(const struct gb_bed *bed)
{
    const size_t bytes = (size_t)bed->count * sizeof(gb_bed_row);
    uint64_t hash = GB_RECORD_FNV;
    hash = gb_record_fnv(hash, bed->position, bytes);
    hash = gb_record_fnv(hash, bed->velocity, bytes);
    hash = gb_record_fnv(hash, bed->roll, bytes);
    hash = gb_record_fnv(hash, &bed->die.punch_position, sizeof bed->die.punch_position);
    hash = gb_record_fnv(hash, &bed->die.punch_velocity, sizeof bed->die.punch_velocity);
    if (bed->die.bore != GB_DIE_BORE_ENDLESS) {
        hash = gb_record_fnv(hash, &bed->die.top, sizeof bed->die.top);
    }
    return mix_welds(mix_list(mix_list(hash, &bed->pairs), &bed->walls), bed->welds);
}

/* ---- Record ---- */

#define AT(member) offsetof(struct gb_bed, member)

static const struct gb_record_member members[] = {
    {"bed/funnel", GB_RECORD_BOOL, 1, AT(die.funnel), "1"},
    {"bed/punch", GB_RECORD_BOOL, 1, AT(die.punch), "1"},
    {"bed/punch_place", GB_RECORD_DOUBLE, 1, AT(die.punch_position), "d"},
    {"bed/punch_speed", GB_RECORD_DOUBLE, 1, AT(die.punch_velocity), "d/T"},
    {"bed/stiffest", GB_RECORD_DOUBLE, 1, AT(tally.stiffest), "1/T^2"},
    {"bed/floor_force", GB_RECORD_DOUBLE, 1, AT(tally.floor), "E d^2"},
    {"bed/punch_force", GB_RECORD_DOUBLE, 1, AT(tally.punch), "E d^2"},
    {"bed/side_moment", GB_RECORD_DOUBLE, 2, AT(tally.side), "E d^3"},
    {"bed/evaluations", GB_RECORD_INT64, 1, AT(evaluations), "1"},
    {"bed/bore", GB_RECORD_INT32, 1, AT(die.bore), "1"},
    {"bed/top", GB_RECORD_DOUBLE, 1, AT(die.top), "d"},
    {"bed/side_speed", GB_RECORD_DOUBLE, 1, AT(die.side_velocity), "d/T"},
    {"bed/side_drag", GB_RECORD_DOUBLE, 1, AT(tally.drag), "E d^2"},
    /* the next lists are made with these; their pairs limit the time step (gb_bed_tally) */
    {"bed/skin", GB_RECORD_DOUBLE, 1, AT(skin), "d"},
    {"bed/near_skin", GB_RECORD_DOUBLE, 1, AT(near_skin), "d"},
};

#undef AT

static bool record_members(struct gb_bed *bed, struct gb_record *record,
                           struct gb_error *err)
{
    if (!gb_record_members(record, members, sizeof members / sizeof members[0], bed,
                           err)) {
        return false;
    }
    if (!(bed->near_skin > 0.0 && bed->skin > bed->near_skin && bed->skin < 1e9)) {
        return gb_record_checks_out_of_range("bed/skin", err);
    }
    return ((int)bed->die.bore >= 0 && bed->die.bore <= GB_DIE_BORE_GONE) ||
           gb_record_checks_out_of_range("bed/bore", err);
}

static bool rows(struct gb_bed *bed, struct gb_record *record, const char *name,
                 const char *unit, gb_bed_row *data, struct gb_error *err)
{
    return gb_record_array(record, name, GB_RECORD_DOUBLE, bed->count, 4, unit, data,
                           err);
}

/* After the positions, whose rows have the radii. */
static bool record_rotation(struct gb_bed *bed, struct gb_record *record,
                            struct gb_error *err)
{
    return rows(bed, record, "bed/roll", "d/T", bed->roll, err) &&
           rows(bed, record, "bed/moment", "E d^2", bed->moment, err);
}

static bool finite_positions(const struct gb_bed *bed)
{
    for (int64_t i = 0; i < bed->count; i++) {
        const double *x = bed->position[i];
        if (!(fabs(x[0]) + fabs(x[1]) + fabs(x[2]) < 1e9 && x[3] > 0.0)) {
            return false;
        }
    }
    return true;
}

/* The same powder, under any numbers: sorted masses are equal. */
static bool equal_masses(const double *a, const double *b, int64_t count)
{
    for (int64_t i = 0; i < count; i++) {
        if (!(fabs(a[i] - b[i]) <= 1e-9 * b[i])) {
            return false;
        }
    }
    return true;
}

/* Radii are those that the parameters give, in the order of the record. */
static bool accept_radii(struct gb_bed *bed, struct gb_error *err)
{
    const size_t count = (size_t)bed->count;
    double *given = gb_alloc_array(2 * count, sizeof *given, err);
    if (!given) {
        return false;
    }
    double *recorded = given + count;
    memcpy(given, bed->mass, count * sizeof *given);
    gb_bed_weigh(bed);
    memcpy(recorded, bed->mass, count * sizeof *recorded);
    gsl_sort(given, 1, count);
    gsl_sort(recorded, 1, count);
    const bool equal = equal_masses(recorded, given, bed->count);
    gb_alloc_free(given);
    return equal || gb_record_checks_out_of_range("bed/place", err);
}

static bool accept_positions(struct gb_bed *bed, const struct gb_record *record,
                             struct gb_error *err)
{
    if (!finite_positions(bed)) {
        return gb_record_checks_out_of_range("bed/place", err);
    }
    return !record->loading || accept_radii(bed, err);
}

/* Sorted contacts of existing particles. */
static bool check_list(const struct gb_bed_list *list, int64_t count,
                       enum gb_bed_partner partner, const char *name,
                       struct gb_error *err)
{
    for (int64_t k = 0; k < list->count; k++) {
        const int32_t i = list->first[k], j = list->other[k];
        const bool known = partner == GB_BED_PARTNER_WALL ? j >= 0 && j < GB_DIE_WALLS
                                                          : j > i && j < count;
        const bool follows = k == 0 || list->first[k - 1] < i ||
                             (list->first[k - 1] == i && list->other[k - 1] < j);
        if (i < 0 || i >= count || !known || !follows) {
            return gb_record_checks_out_of_range(name, err);
        }
    }
    return true;
}

/* A list of touching contacts only. */
static bool exchange_list(struct gb_bed *bed, enum gb_bed_partner partner,
                          struct gb_bed_list *list, struct gb_record *record,
                          struct gb_error *err)
{
    static const char *const names[2][8] = {
        {"bed/first", "bed/second", "bed/deepest", "bed/rest", "bed/shear_x",
         "bed/shear_y", "bed/shear_z", "bed/normal"},
        {"walls/first", "walls/wall", "walls/deepest", "walls/rest", "walls/shear_x",
         "walls/shear_y", "walls/shear_z", "walls/normal"}};
    static const char *const units[8] = {"1",     "1",     "d",     "d",
                                         "E d^2", "E d^2", "E d^2", "E d^2"};
    const char *const *name = names[partner == GB_BED_PARTNER_WALL];
    int64_t count = list->count;
    if (record->loading &&
        (!gb_record_rows(record, name[0], GB_RECORD_INT32, 1, &count, err) ||
         !gb_bed_list_init(list, bed->count, count, err))) {
        return false;
    }
    list->count = count;
    struct gb_bed_contacts *c = &list->contacts;
    double *const plane[6] = {c->deepest,  c->permanent, c->shear[0],
                              c->shear[1], c->shear[2],  c->normal};
    int32_t *const index[2] = {list->first, list->other};
    for (int k = 0; k < 8; k++) {
        void *data = k < 2 ? (void *)index[k] : (void *)plane[k - 2];
        if (!gb_record_array(record, name[k], k < 2 ? GB_RECORD_INT32 : GB_RECORD_DOUBLE,
                             count, 1, units[k], data, err)) {
            return false;
        }
    }
    if (!check_list(list, bed->count, partner, name[0], err)) {
        return false;
    }
    gb_bed_list_start(list, bed->count);
    return true;
}

static bool exchange_contacts(struct gb_bed *bed, enum gb_bed_partner partner,
                              struct gb_record *record, struct gb_error *err)
{
    struct gb_bed_list *own = partner == GB_BED_PARTNER_WALL ? &bed->walls : &bed->pairs;
    struct gb_bed_list kept = {0};
    bool done = record->loading || gb_bed_list_copy_touching(&kept, own, bed->count, err);
    done = done && exchange_list(bed, partner, &kept, record, err);
    if (done && record->loading) {
        done = gb_bed_list_copy_touching(own, &kept, bed->count, err);
        bed->listed = false;
    }
    gb_bed_list_finish(&kept);
    return done;
}

bool gb_bed_record(struct gb_bed *bed, struct gb_record *record, struct gb_error *err)
{
    return record_members(bed, record, err) &&
           rows(bed, record, "bed/place", "d", bed->position, err) &&
           rows(bed, record, "bed/speed", "d/T", bed->velocity, err) &&
           rows(bed, record, "bed/force", "E d^2", bed->force, err) &&
           record_rotation(bed, record, err) && accept_positions(bed, record, err) &&
           exchange_contacts(bed, GB_BED_PARTNER_PARTICLE, record, err) &&
           exchange_contacts(bed, GB_BED_PARTNER_WALL, record, err) &&
           gb_bed_welds_record(bed, record, err);
}
