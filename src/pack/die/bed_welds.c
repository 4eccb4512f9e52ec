#include "pack/die/bed_welds.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "base/alloc.h"
#include "base/vec.h"
#include "law/law_hertz.h"
#include "pack/cell/record_checks.h"

enum { PLANES = 5 }; /* length, radius, force */

static bool create(struct gb_bed_welds **out, int64_t room, struct gb_error *err)
{
    const size_t size = (size_t)room + 1;
    struct gb_bed_welds *welds = gb_alloc_array(1, sizeof *welds, err);
    if (!welds) {
        return false;
    }
    welds->room = room;
    welds->first = gb_alloc_array(size, sizeof *welds->first, err);
    welds->other = gb_alloc_array(size, sizeof *welds->other, err);
    welds->slab = gb_alloc_array(PLANES * size, sizeof *welds->slab, err);
    if (!welds->first || !welds->other || !welds->slab) {
        gb_bed_welds_destroy(welds);
        return false;
    }
    double **const plane[PLANES] = {&welds->length, &welds->radius, &welds->force[0],
                                    &welds->force[1], &welds->force[2]};
    for (size_t k = 0; k < PLANES; k++) {
        *plane[k] = welds->slab + k * size;
    }
    *out = welds;
    return true;
}

void gb_bed_welds_destroy(struct gb_bed_welds *welds)
{
    if (!welds) {
        return;
    }
    gb_alloc_free(welds->first);
    gb_alloc_free(welds->other);
    gb_alloc_free(welds->slab);
    gb_alloc_free(welds);
}

/* Unit vector from the second particle to the first; returns the distance. */
static double direction(const struct gb_bed *bed, int32_t i, int32_t j, double unit[3])
{
    for (int k = 0; k < 3; k++) {
        unit[k] = bed->position[i][k] - bed->position[j][k];
    }
    const double distance = gb_vec_length(unit);
    gb_vec_scale(unit, 1.0 / distance);
    return distance;
}

static void add_weld(struct gb_bed_welds *welds, const struct gb_bed *bed, int64_t slot)
{
    const int32_t i = bed->pairs.first[slot], j = bed->pairs.other[slot];
    const double ri = bed->position[i][3], rj = bed->position[j][3];
    double unit[3];
    const double overlap = fmax(ri + rj - direction(bed, i, j, unit), 0.0);
    const int64_t k = welds->count++;
    welds->first[k] = i;
    welds->other[k] = j;
    welds->length[k] = ri + rj - bed->pairs.contacts.permanent[slot];
    welds->radius[k] =
        gb_bed_batch_radius(&bed->law, gb_law_hertz_radius(ri, rj), overlap);
    welds->force[0][k] = welds->force[1][k] = welds->force[2][k] = 0.0;
}

bool gb_bed_welds_form(struct gb_bed *bed, double strength, struct gb_error *err)
{
    struct gb_bed_welds *welds = NULL;
    int64_t touching = 0;
    for (int64_t slot = 0; slot < bed->pairs.count; slot++) {
        touching += bed->pairs.contacts.normal[slot] > 0.0;
    }
    if (!create(&welds, touching, err)) {
        return false;
    }
    welds->strength = strength;
    for (int64_t slot = 0; slot < bed->pairs.count; slot++) {
        if (bed->pairs.contacts.normal[slot] > 0.0) {
            add_weld(welds, bed, slot);
        }
    }
    welds->formed = welds->count;
    gb_bed_welds_destroy(bed->welds);
    bed->welds = welds;
    return true;
}

static void remove_weld(struct gb_bed_welds *welds, int64_t at)
{
    const size_t behind = (size_t)(--welds->count - at);
    double *const plane[PLANES] = {welds->length, welds->radius, welds->force[0],
                                   welds->force[1], welds->force[2]};
    memmove(welds->first + at, welds->first + at + 1, behind * sizeof *welds->first);
    memmove(welds->other + at, welds->other + at + 1, behind * sizeof *welds->other);
    for (int p = 0; p < PLANES; p++) {
        memmove(plane[p] + at, plane[p] + at + 1, behind * sizeof(double));
    }
}

/* Constants of a weld. */
struct weld {
    double normal, across; /* stiffness, E d */
    double dashpot;
    double inverse_mass;      /* one over the reduced mass */
    double strength, plastic; /* greatest tension, and force across it */
};

static struct weld weld_of(const struct gb_bed *bed, int64_t k)
{
    const struct gb_bed_welds *welds = bed->welds;
    const int32_t i = welds->first[k], j = welds->other[k];
    const struct gb_law_hertz *hertz = &bed->law.normal.hertz;
    const double a = welds->radius[k];
    const double reduced = gb_law_hertz_radius(bed->mass[i], bed->mass[j]);
    struct weld weld = {.normal = 2.0 * hertz->modulus * a,
                        .across = 8.0 * hertz->shear * a,
                        .strength = welds->strength * M_PI * a * a};
    weld.plastic = weld.strength / sqrt(3.0);
    weld.dashpot = 2.0 * bed->law.damping * sqrt(reduced * weld.normal);
    weld.inverse_mass = 1.0 / reduced;
    return weld;
}

/* Velocity of the first surface against the second at the weld.  lever: distance of the
 * centres over the sum of the radii, so that torques conserve the angular momentum. */
static void slip_of(const struct gb_bed *bed, int32_t i, int32_t j, const double unit[3],
                    double lever, double slip[3])
{
    double roll[3], across[3];
    for (int k = 0; k < 3; k++) {
        roll[k] = lever * (bed->roll[i][k] + bed->roll[j][k]);
    }
    gb_vec_cross(roll, unit, across);
    for (int k = 0; k < 3; k++) {
        slip[k] = bed->velocity[i][k] - bed->velocity[j][k] - across[k];
    }
}

/* The force across the weld: projected into the present plane with its length, loaded by the
 * slip of the last step, and cut to its plastic limit. */
static void advance_shear(struct gb_bed_welds *welds, int64_t k, const struct weld *weld,
                          const double unit[3], const double slip[3], double step,
                          double force[3])
{
    double held[3] = {welds->force[0][k], welds->force[1][k], welds->force[2][k]};
    const double before = gb_vec_length(held), rate = gb_vec_dot(slip, unit);
    gb_vec_add(held, -gb_vec_dot(held, unit), unit);
    const double projected = gb_vec_length(held);
    gb_vec_scale(held, projected > 0.0 ? before / projected : 0.0);
    for (int c = 0; c < 3; c++) {
        held[c] -= weld->across * step * (slip[c] - rate * unit[c]);
    }
    const double now = gb_vec_length(held);
    gb_vec_scale(held, now > weld->plastic ? weld->plastic / now : 1.0);
    for (int c = 0; c < 3; c++) {
        welds->force[c][k] = held[c];
        force[c] += held[c];
    }
}

static void apply(struct gb_bed *bed, int32_t i, int32_t j, const double unit[3],
                  double lever, const double force[3], double stiffness)
{
    double moment[3];
    gb_vec_cross(force, unit, moment); /* -n x F */
    for (int c = 0; c < 3; c++) {
        bed->force[i][c] += force[c];
        bed->force[j][c] -= force[c];
        bed->moment[i][c] += lever * moment[c];
        bed->moment[j][c] += lever * moment[c];
    }
    bed->force[i][3] += stiffness;
    bed->force[j][3] += stiffness;
}

enum weld_state { WELD_HOLDS, WELD_BREAKS };

static enum weld_state advance_weld(struct gb_bed *bed, int64_t k, double step,
                                    double *stiffest)
{
    struct gb_bed_welds *welds = bed->welds;
    const int32_t i = welds->first[k], j = welds->other[k];
    const struct weld weld = weld_of(bed, k);
    double unit[3], slip[3], force[3] = {0.0, 0.0, 0.0};
    const double distance = direction(bed, i, j, unit);
    const double lever = distance / (bed->position[i][3] + bed->position[j][3]);
    const double tension = weld.normal * (distance - welds->length[k]);
    const double held = bed->velocity[i][3] + bed->velocity[j][3];
    const double square = (2.0 * weld.normal * weld.inverse_mass + held) / 3.0;
    if (tension > weld.strength) {
        return WELD_BREAKS;
    }
    slip_of(bed, i, j, unit, lever, slip);
    advance_shear(welds, k, &weld, unit, slip, step, force);
    if (tension > 0.0) {
        const double dashpot =
            gb_law_hertz_damping_borne(weld.dashpot, weld.normal, square, step);
        gb_vec_add(force, -tension - dashpot * gb_vec_dot(slip, unit), unit);
    }
    apply(bed, i, j, unit, lever, force, weld.normal);
    *stiffest = fmax(*stiffest, square);
    return WELD_HOLDS;
}

void gb_bed_welds_sweep(struct gb_bed *bed, double step)
{
    double stiffest = 0.0;
    for (int64_t k = 0; k < bed->welds->count;) {
        if (advance_weld(bed, k, step, &stiffest) == WELD_BREAKS) {
            remove_weld(bed->welds, k);
        } else {
            k++;
        }
    }
    bed->tally.stiffest = fmax(bed->tally.stiffest, stiffest);
}

double gb_bed_welds_share(const struct gb_bed *bed)
{
    const struct gb_bed_welds *welds = bed->welds;
    return welds && welds->formed > 0 ? (double)welds->count / (double)welds->formed
                                      : (double)NAN;
}

double gb_bed_welds_energy(const struct gb_bed *bed)
{
    double sum = 0.0, unit[3];
    for (int64_t k = 0; bed->welds && k < bed->welds->count; k++) {
        const struct gb_bed_welds *welds = bed->welds;
        const struct weld weld = weld_of(bed, k);
        const double stretch = fmax(
            direction(bed, welds->first[k], welds->other[k], unit) - welds->length[k],
            0.0);
        const double force[3] = {welds->force[0][k], welds->force[1][k],
                                 welds->force[2][k]};
        sum += 0.5 *
               (weld.normal * stretch * stretch + gb_vec_dot(force, force) / weld.across);
    }
    return sum;
}

bool gb_bed_welds_copy(struct gb_bed_welds **to, const struct gb_bed_welds *from,
                       struct gb_error *err)
{
    if (!from) {
        gb_bed_welds_destroy(*to);
        *to = NULL;
        return true;
    }
    if (*to && (*to)->room < from->count) {
        gb_bed_welds_destroy(*to);
        *to = NULL;
    }
    if (!*to && !create(to, from->room, err)) {
        return false;
    }
    struct gb_bed_welds *copy = *to;
    const size_t count = (size_t)from->count;
    double *const plane[PLANES] = {copy->length, copy->radius, copy->force[0],
                                   copy->force[1], copy->force[2]};
    const double *const source[PLANES] = {from->length, from->radius, from->force[0],
                                          from->force[1], from->force[2]};
    memcpy(copy->first, from->first, count * sizeof *copy->first);
    memcpy(copy->other, from->other, count * sizeof *copy->other);
    for (int p = 0; p < PLANES; p++) {
        memcpy(plane[p], source[p], count * sizeof(double));
    }
    copy->count = from->count;
    copy->formed = from->formed;
    copy->strength = from->strength;
    return true;
}

/* Welds of existing particles with a radius and a length. */
static bool check(const struct gb_bed_welds *welds, int64_t particles,
                  struct gb_error *err)
{
    for (int64_t k = 0; k < welds->count; k++) {
        const int32_t i = welds->first[k], j = welds->other[k];
        if (i < 0 || j <= i || j >= particles || !(welds->length[k] > 0.0) ||
            !(welds->radius[k] >= 0.0)) {
            return gb_record_checks_out_of_range("welds/first", err);
        }
    }
    return true;
}

static bool exchange(struct gb_bed_welds *welds, struct gb_record *record,
                     struct gb_error *err)
{
    static const char *const names[PLANES] = {"welds/length", "welds/radius",
                                              "welds/force_x", "welds/force_y",
                                              "welds/force_z"};
    static const char *const units[PLANES] = {"d", "d", "E d^2", "E d^2", "E d^2"};
    static const struct gb_record_member members[] = {
        {"welds/formed", GB_RECORD_INT64, 1, offsetof(struct gb_bed_welds, formed), "1"},
        {"welds/strength", GB_RECORD_DOUBLE, 1, offsetof(struct gb_bed_welds, strength),
         "E"},
    };
    double *const plane[PLANES] = {welds->length, welds->radius, welds->force[0],
                                   welds->force[1], welds->force[2]};
    bool done = gb_record_members(record, members, 2, welds, err) &&
                gb_record_array(record, "welds/first", GB_RECORD_INT32, welds->count, 1,
                                "1", welds->first, err) &&
                gb_record_array(record, "welds/second", GB_RECORD_INT32, welds->count, 1,
                                "1", welds->other, err);
    for (int p = 0; p < PLANES && done; p++) {
        done = gb_record_array(record, names[p], GB_RECORD_DOUBLE, welds->count, 1,
                               units[p], plane[p], err);
    }
    return done;
}

bool gb_bed_welds_record(struct gb_bed *bed, struct gb_record *record,
                         struct gb_error *err)
{
    int64_t count = 0;
    if (!record->loading) {
        return !bed->welds || exchange(bed->welds, record, err);
    }
    gb_bed_welds_destroy(bed->welds);
    bed->welds = NULL;
    if (!gb_record_find(record, "welds/first")) {
        return true;
    }
    if (!gb_record_rows(record, "welds/first", GB_RECORD_INT32, 1, &count, err) ||
        !create(&bed->welds, count, err)) {
        return false;
    }
    bed->welds->count = count;
    return exchange(bed->welds, record, err) && check(bed->welds, bed->count, err);
}
