#include "pack/die/bed.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "pack/die/bed_list.h"
#include "pack/die/bed_walls.h"
#include "pack/die/bed_welds.h"
#include "scene/tolerances.h"

/* Evaluations to aim at between two builds of the candidates, which cost a few tens of
 * evaluations, and between two lists drawn from them, which cost less than one. */
static const double candidates_last = 250.0, list_lasts = 12.0;
/* Skins over the smallest radius, at least and at most. */
static const double skin_least = 0.01, skin_most = 2.0, near_least = 0.002;

static bool allocate(struct gb_bed *bed, struct gb_error *err)
{
    gb_bed_row **const rows[] = {
        &bed->position, &bed->velocity,       &bed->spin,           &bed->force,
        &bed->torque,   &bed->built_position, &bed->listed_position};
    struct gb_bed_list *const lists[] = {&bed->pairs, &bed->previous_pairs, &bed->walls,
                                         &bed->previous_walls};
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++) {
        *rows[k] =
            gb_alloc_array((size_t)bed->count + GB_DIE_WALLS, sizeof **rows[k], err);
        if (!*rows[k]) {
            return false;
        }
    }
    for (size_t k = 0; k < sizeof lists / sizeof lists[0]; k++) {
        if (!gb_bed_list_init(lists[k], bed->count, 8 * bed->count, err)) {
            return false;
        }
    }
    bed->counts = gb_alloc_array((size_t)bed->count, sizeof *bed->counts, err);
    if (!bed->counts) {
        return false;
    }
    double **const numbers[] = {&bed->mass, &bed->inverse_mass, &bed->inverse_inertia};
    for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; k++) {
        *numbers[k] = gb_alloc_array((size_t)bed->count, sizeof **numbers[k], err);
        if (!*numbers[k]) {
            return false;
        }
    }
    return true;
}

bool gb_bed_create(struct gb_bed **out, int64_t count, const double *radius,
                   const struct gb_die *die, const struct gb_bed_law *law,
                   double inertia_scale, struct gb_error *err)
{
    struct gb_bed *bed = gb_alloc_array(1, sizeof *bed, err);
    if (!bed) {
        return false;
    }
    bed->count = count;
    bed->die = *die;
    bed->inertia_scale = inertia_scale;
    if (!allocate(bed, err) || !gb_hgrid_init(&bed->hgrid, count, err)) {
        gb_bed_destroy(bed);
        return false;
    }
    bed->smallest = HUGE_VAL;
    for (int64_t i = 0; i < count; i++) {
        bed->position[i][3] = radius[i];
        bed->smallest = fmin(bed->smallest, radius[i]);
    }
    gb_bed_weigh(bed);
    bed->skin = 0.1 * bed->smallest;
    bed->near_skin = 0.5 * bed->skin;
    gb_bed_set_law(bed, law);
    *out = bed;
    return true;
}

void gb_bed_weigh(struct gb_bed *bed)
{
    for (int64_t i = 0; i < bed->count; i++) {
        const double radius = bed->position[i][3], d = 2.0 * radius;
        bed->mass[i] = d * d * d;
        bed->inverse_mass[i] = 1.0 / bed->mass[i];
        bed->inverse_inertia[i] =
            1.0 / (0.4 * bed->mass[i] * radius * radius * bed->inertia_scale);
    }
}

void gb_bed_destroy(struct gb_bed *bed)
{
    if (!bed) {
        return;
    }
    gb_alloc_free(bed->position);
    gb_alloc_free(bed->velocity);
    gb_alloc_free(bed->spin);
    gb_alloc_free(bed->force);
    gb_alloc_free(bed->torque);
    gb_alloc_free(bed->built_position);
    gb_alloc_free(bed->listed_position);
    gb_alloc_free(bed->counts);
    gb_alloc_free(bed->mass);
    gb_alloc_free(bed->inverse_mass);
    gb_alloc_free(bed->inverse_inertia);
    gb_hgrid_finish(&bed->hgrid);
    gb_bed_list_finish(&bed->pairs);
    gb_bed_list_finish(&bed->previous_pairs);
    gb_bed_list_finish(&bed->walls);
    gb_bed_list_finish(&bed->previous_walls);
    gb_bed_welds_destroy(bed->welds);
    gb_alloc_free(bed);
}

static void empty(struct gb_bed_list *list, int64_t particles)
{
    list->count = 0;
    memset(list->start, 0, ((size_t)particles + 1) * sizeof *list->start);
}

void gb_bed_set_law(struct gb_bed *bed, const struct gb_bed_law *law)
{
    bed->law = *law;
    bed->pair_kernel = gb_bed_batch_pick(law, GB_BED_PARTNER_PARTICLE, 0);
    bed->wall_kernel = gb_bed_batch_pick(law, GB_BED_PARTNER_WALL, 0);
    bed->transfer = gb_bed_transfer_pick(0);
    empty(&bed->pairs, bed->count);
    empty(&bed->walls, bed->count);
    bed->listed = false;
}

void gb_bed_invalidate_lists(struct gb_bed *bed)
{
    bed->listed = false;
}

/* A skin that would have lasted as long as it should.  No force depends on it: pairs that do
 * not touch add exact zeros in an order that is the same for any list. */
static double adapted(double skin, double lasted, double wanted)
{
    return lasted > 0.0 ? skin * fmin(fmax(wanted / lasted, 0.5), 2.0) : skin;
}

static void adapt_skins(struct gb_bed *bed, bool candidates)
{
    const double built = (double)(bed->evaluations - bed->built_evaluation);
    const double listed = (double)(bed->evaluations - bed->listed_evaluation);
    if (bed->listed && candidates) {
        bed->skin = fmin(
            fmax(adapted(bed->skin, built, candidates_last), skin_least * bed->smallest),
            skin_most * bed->smallest);
    }
    if (bed->listed) {
        bed->near_skin =
            fmax(adapted(bed->near_skin, listed, list_lasts), near_least * bed->smallest);
    }
    bed->near_skin = fmin(bed->near_skin, 0.5 * bed->skin);
}

/* The farthest that a particle has moved since the candidates were built. */
static double moved_since_build(const struct gb_bed *bed)
{
    double most2 = 0.0;
    for (int64_t i = 0; i < bed->count; i++) {
        double moved2 = 0.0;
        for (int k = 0; k < 3; k++) {
            const double moved = bed->position[i][k] - bed->built_position[i][k];
            moved2 += moved * moved;
        }
        most2 = fmax(most2, moved2);
    }
    return sqrt(most2);
}

/* True while no pair and no wall is missed, if nothing has moved farther than `moved` since
 * the candidates were built. */
static bool candidates_hold(const struct gb_bed *bed, double moved)
{
    const double punch = fabs(bed->die.punch_position - bed->punch_built_position);
    const double top = fabs(bed->die.top - bed->top_built_position);
    return bed->listed && 2.0 * moved < bed->skin &&
           (!bed->die.punch || moved + punch < bed->skin) &&
           (bed->die.bore != GB_DIE_BORE_OPEN || moved + top < bed->skin);
}

/* Lists were made of the present positions. */
static void note_listed(struct gb_bed *bed, double built_moved)
{
    memcpy(bed->listed_position, bed->position,
           (size_t)bed->count * sizeof *bed->position);
    bed->listed_evaluation = bed->evaluations;
    bed->built_moved = built_moved;
}

static bool rebuild(struct gb_bed *bed, struct gb_error *err)
{
    adapt_skins(bed, true);
    if (!gb_bed_list_rebuild(bed, err)) {
        return false;
    }
    memcpy(bed->built_position, bed->position,
           (size_t)bed->count * sizeof *bed->position);
    bed->punch_built_position = bed->die.punch_position;
    bed->top_built_position = bed->die.top;
    bed->built_evaluation = bed->evaluations;
    bed->listed = true;
    bed->rebuilds++;
    note_listed(bed, 0.0);
    return true;
}

static bool refresh_lists(struct gb_bed *bed, double moved2, struct gb_error *err)
{
    const double moved = sqrt(moved2);
    if (2.0 * moved < bed->near_skin && candidates_hold(bed, bed->built_moved + moved)) {
        return true;
    }
    const double built_moved = bed->listed ? moved_since_build(bed) : 0.0;
    if (!candidates_hold(bed, built_moved + 0.5 * bed->near_skin)) {
        return rebuild(bed, err);
    }
    adapt_skins(bed, false);
    if (!gb_bed_list_draw(bed, err)) {
        return false;
    }
    note_listed(bed, built_moved);
    return true;
}

static void sweep_pairs(struct gb_bed *bed, struct gb_bed_batch *b)
{
    struct gb_bed_rows rows = {.position = (const gb_bed_row *)bed->position,
                               .velocity = (const gb_bed_row *)bed->velocity,
                               .spin = (const gb_bed_row *)bed->spin,
                               .force = bed->force,
                               .torque = bed->torque,
                               .friction = bed->law.mu > 0.0};
    b->mu = bed->law.mu;
    for (int64_t slot = 0; slot < bed->pairs.count; slot += b->n) {
        const int64_t left = bed->pairs.count - slot;
        b->n = left < GB_BED_BATCH ? (int)left : GB_BED_BATCH;
        rows.first = bed->pairs.first + slot;
        rows.other = bed->pairs.other + slot;
        bed->transfer.gather(&rows, b);
        bed->pair_kernel(&bed->law, b, &bed->pairs.contacts, slot);
        bed->transfer.scatter(&rows, b);
    }
}

bool gb_bed_evaluate(struct gb_bed *bed, double step, double moved2, struct gb_error *err)
{
    if (!refresh_lists(bed, moved2, err)) {
        return false;
    }
    struct gb_bed_batch batch;
    batch.step = step;
    batch.stiffest = 0.0;
    bed->tally = (struct gb_bed_tally){0};
    const size_t rows = (size_t)bed->count + GB_DIE_WALLS;
    memset(bed->force, 0, rows * sizeof *bed->force);
    memset(bed->torque, 0, rows * sizeof *bed->torque);
    sweep_pairs(bed, &batch);
    gb_bed_walls_sweep(bed, &batch);
    bed->tally.stiffest = batch.stiffest;
    if (bed->welds) {
        gb_bed_welds_sweep(bed, step);
    }
    bed->evaluations++;
    return true;
}

int64_t gb_bed_escaped(const struct gb_bed *bed)
{
    for (int64_t i = 0; i < bed->count; i++) {
        if (!gb_die_contains(&bed->die, bed->position[i])) {
            return i;
        }
    }
    return -1;
}

double gb_bed_solid_volume(const struct gb_bed *bed)
{
    double sum = 0.0;
    for (int64_t i = 0; i < bed->count; i++) {
        sum += bed->mass[i]; /* d^3 */
    }
    return M_PI / 6.0 * sum;
}

static double square(const double row[4])
{
    return row[0] * row[0] + row[1] * row[1] + row[2] * row[2];
}

struct gb_bed_kinetic_energy gb_bed_kinetic_energy(const struct gb_bed *bed)
{
    struct gb_bed_kinetic_energy sum = {0.0, 0.0};
    for (int64_t i = 0; i < bed->count; i++) {
        sum.translational += 0.5 * bed->mass[i] * square(bed->velocity[i]);
        sum.rotational += 0.5 * square(bed->spin[i]) / bed->inverse_inertia[i];
    }
    return sum;
}

double gb_bed_top(const struct gb_bed *bed)
{
    double top = 0.0;
    for (int64_t i = 0; i < bed->count; i++) {
        top = fmax(top, bed->position[i][2] + bed->position[i][3]);
    }
    return top;
}

static double normal_sum(const struct gb_bed_list *list, int64_t *touching)
{
    double sum = 0.0;
    for (int64_t slot = 0; slot < list->count; slot++) {
        if (list->contacts.normal[slot] >= 0.0) {
            sum += list->contacts.normal[slot];
            (*touching)++;
        }
    }
    return sum;
}

double gb_bed_unbalanced_force(const struct gb_bed *bed, double gravity)
{
    int64_t touching = 0;
    double force2 = 0.0;
    const double sum =
        normal_sum(&bed->pairs, &touching) + normal_sum(&bed->walls, &touching);
    for (int64_t i = 0; i < bed->count; i++) {
        const double *f = bed->force[i];
        const double down = f[2] - bed->mass[i] * gravity;
        force2 += f[0] * f[0] + f[1] * f[1] + down * down;
    }
    return sum > 0.0 ? sqrt(force2 / (double)bed->count) * (double)touching / sum
                     : HUGE_VAL;
}
