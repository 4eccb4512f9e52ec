/* A bed of spheres of many sizes in a die: storage, lists on time, measures.
 *
 * bed_list.c builds the lists, bed_sweep.c computes forces and moves the particles.  This file
 * owns the arrays, cuts the particles into blocks for the threads, and rebuilds lists when
 * particles have moved too far for them.  Skins adapt so that rebuilds cost little. */

#include "pack/die/bed.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "base/alloc.h"
#include "base/team.h"
#include "base/vec.h"
#include "greenbody/status.h"
#include "pack/die/bed_list.h"
#include "pack/die/bed_sweep.h"
#include "pack/die/bed_welds.h"
#include "scene/tolerances.h"

/* ---- Blocks ---- */

/* Consecutive particles of a bed, which one thread computes with the pairs that they are
 * the first of.  Blocks follow from the number of particles alone, not from that of the threads.
 * Larger ones have fewer pairs with a particle in another block, each of which has a row of its
 * own; smaller ones distribute better over threads: the size doubles while this many are left. */
enum { GB_BED_BLOCKS_SIZE = 128, GB_BED_BLOCKS_SIZE_MAX = 512, GB_BED_BLOCKS_LEFT = 12 };

/* Particles in a block, of so many in all. */
static int64_t bed_blocks_size(int64_t particles)
{
    int64_t size = GB_BED_BLOCKS_SIZE;
    while (size < GB_BED_BLOCKS_SIZE_MAX && particles >= 2 * size * GB_BED_BLOCKS_LEFT) {
        size *= 2;
    }
    return size;
}

int64_t gb_bed_blocks_begin(int64_t particles, int64_t b)
{
    return b * bed_blocks_size(particles);
}

int64_t gb_bed_blocks_end(int64_t particles, int64_t b)
{
    const int64_t end = gb_bed_blocks_begin(particles, b + 1);
    return end < particles ? end : particles;
}

static void release_crossings(struct gb_bed_blocks *blocks)
{
    gb_alloc_free(blocks->target);
    gb_alloc_free(blocks->row);
    gb_alloc_free(blocks->row_particle);
    blocks->target = blocks->row = blocks->row_particle = NULL;
    blocks->room = 0;
}

static bool make_room(struct gb_bed_blocks *blocks, int64_t crossings,
                      struct gb_error *err)
{
    if (crossings <= blocks->room) {
        return true;
    }
    const size_t room = (size_t)(crossings + crossings / 4);
    release_crossings(blocks);
    blocks->target = gb_alloc_array(room, sizeof *blocks->target, err);
    blocks->row = gb_alloc_array(room, sizeof *blocks->row, err);
    blocks->row_particle = gb_alloc_array(room, sizeof *blocks->row_particle, err);
    if (!blocks->target || !blocks->row || !blocks->row_particle) {
        release_crossings(blocks);
        return false;
    }
    blocks->room = (int64_t)room;
    return true;
}

bool gb_bed_blocks_init(struct gb_bed_blocks *blocks, int64_t particles,
                        struct gb_error *err)
{
    const int64_t size = bed_blocks_size(particles);
    const int64_t count = (particles + size - 1) / size;
    const size_t ends = (size_t)count + 1;
    *blocks = (struct gb_bed_blocks){.count = count, .size = size};
    blocks->block = gb_alloc_array((size_t)count, sizeof *blocks->block, err);
    blocks->cost = gb_alloc_array(ends, sizeof *blocks->cost, err);
    blocks->crossing = gb_alloc_array(ends, sizeof *blocks->crossing, err);
    blocks->entry = gb_alloc_array(ends, sizeof *blocks->entry, err);
    if (!blocks->block || !blocks->cost || !blocks->crossing || !blocks->entry ||
        !make_room(blocks, 2 * particles, err)) {
        gb_bed_blocks_finish(blocks);
        return false;
    }
    return true;
}

void gb_bed_blocks_finish(struct gb_bed_blocks *blocks)
{
    gb_alloc_free(blocks->block);
    gb_alloc_free(blocks->cost);
    gb_alloc_free(blocks->crossing);
    gb_alloc_free(blocks->entry);
    release_crossings(blocks);
    *blocks = (struct gb_bed_blocks){0};
}

bool gb_bed_blocks_number(struct gb_bed_blocks *blocks, struct gb_error *err)
{
    for (int64_t b = 0; b < blocks->count; b++) {
        blocks->crossing[b + 1] = blocks->crossing[b] + blocks->block[b].crossings;
    }
    return make_room(blocks, blocks->crossing[blocks->count], err);
}

void gb_bed_blocks_enter(struct gb_bed_blocks *blocks)
{
    int64_t *entry = blocks->entry;
    const int64_t crossings = blocks->crossing[blocks->count];
    memset(entry, 0, ((size_t)blocks->count + 1) * sizeof *entry);
    for (int64_t c = 0; c < crossings; c++) {
        entry[blocks->target[c] / blocks->size + 1]++;
    }
    for (int64_t b = 0; b < blocks->count; b++) {
        entry[b + 1] += entry[b];
    }
    for (int64_t c = 0; c < crossings; c++) { /* entry[b] becomes the end of block b */
        const int32_t particle = blocks->target[c];
        const int64_t e = entry[particle / blocks->size]++;
        blocks->row[e] = (int32_t)c;
        blocks->row_particle[e] = particle;
    }
    memmove(entry + 1, entry, (size_t)blocks->count * sizeof *entry);
    entry[0] = 0;
}

/* ---- Storage ---- */

/* Evaluations to aim at between two builds of the candidates, which cost some ten
 * evaluations, and between two lists drawn from them, which cost less than one. */
static const double candidates_last = 400.0, list_lasts = 24.0;

/* Skins over the smallest radius, at least and at most; near_skin over the skin, at most, and
 * over twice the deviation that is expected. */
static const double skin_least = 0.01, skin_most = 4.0, near_least = 0.002;

static const double near_most = 0.25, near_margin = 1.5;

static double square(const double x[3])
{
    return x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
}

static bool allocate(struct gb_bed *bed, struct gb_error *err)
{
    gb_bed_row **const rows[] = {
        &bed->position,       &bed->velocity,        &bed->roll,
        &bed->built_position, &bed->listed_position, &bed->listed_velocity};
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
    if (!bed->counts || !gb_bed_blocks_init(&bed->blocks, bed->count, err) ||
        !gb_bed_list_make_rows(bed, err)) {
        return false;
    }
    double **const numbers[] = {&bed->mass, &bed->inverse_mass};
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
    bed->inertia = 0.4 * inertia_scale;
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

bool gb_bed_use_threads(struct gb_bed *bed, int threads, struct gb_error *err)
{
    gb_team_destroy(bed->team);
    const bool created = gb_team_create(&bed->team, threads, err);
    bed->hgrid.team = bed->team;
    return created;
}

void gb_bed_run_blocks(struct gb_bed *bed, gb_team_item *work, void *data)
{
    gb_team_run_costs(bed->team, bed->blocks.count, bed->blocks.cost, work, data);
}

int64_t gb_bed_wall_rows(const struct gb_bed *bed, int64_t b)
{
    const int64_t even = (bed->count + 1) / 2 * 2; /* a block has its cache lines */
    return even + b * GB_DIE_WALLS;
}

int64_t gb_bed_crossing_rows(const struct gb_bed *bed)
{
    return gb_bed_wall_rows(bed, bed->blocks.count);
}

void gb_bed_weigh(struct gb_bed *bed)
{
    for (int64_t i = 0; i < bed->count; i++) {
        const double d = 2.0 * bed->position[i][3];
        bed->mass[i] = d * d * d;
        bed->inverse_mass[i] = 1.0 / bed->mass[i];
    }
}

void gb_bed_destroy(struct gb_bed *bed)
{
    if (!bed) {
        return;
    }
    gb_alloc_free(bed->position);
    gb_alloc_free(bed->velocity);
    gb_alloc_free(bed->roll);
    gb_alloc_free(bed->force);
    gb_alloc_free(bed->moment);
    gb_alloc_free(bed->built_position);
    gb_alloc_free(bed->listed_position);
    gb_alloc_free(bed->listed_velocity);
    gb_alloc_free(bed->counts);
    gb_alloc_free(bed->near);
    gb_bed_blocks_finish(&bed->blocks);
    gb_team_destroy(bed->team);
    gb_alloc_free(bed->mass);
    gb_alloc_free(bed->inverse_mass);
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

/* ---- Evaluation ---- */

void gb_bed_invalidate_lists(struct gb_bed *bed)
{
    bed->listed = false;
}

/* The candidates' skin that would have lasted as long as it should.  No force depends on it:
 * pairs that do not touch add exact zeros in an order that is the same for any list.  The next
 * time step does (gb_bed_tally). */
static void adapt_skin(struct gb_bed *bed)
{
    const double lasted = (double)(bed->evaluations - bed->built_evaluation);
    if (bed->listed && lasted > 0.0) {
        bed->skin *= fmin(fmax(candidates_last / lasted, 0.5), 2.0);
    }
    bed->skin =
        fmin(fmax(bed->skin, skin_least * bed->smallest), skin_most * bed->smallest);
}

/* That of the list from the deviation at its age: steady pushes deviate with its square. */
static void adapt_near_skin(struct gb_bed *bed, double deviation)
{
    const double share = bed->listed_age / bed->listed_time;
    if (bed->listed && share > 0.0 && deviation < HUGE_VAL) {
        const double wanted = near_margin * 2.0 * deviation / (share * share);
        bed->near_skin = fmin(fmax(wanted, 0.5 * bed->near_skin), 2.0 * bed->near_skin);
    }
    bed->near_skin =
        fmin(fmax(bed->near_skin, near_least * bed->smallest), near_most * bed->skin);
}

/* The farthest that a particle has moved since the candidates were built, and the greatest
 * speed. */
static void find_fastest(const struct gb_bed *bed, double *moved, double *speed)
{
    double most2 = 0.0, speed2 = 0.0;
    for (int64_t i = 0; i < bed->count; i++) {
        double by[3];
        for (int k = 0; k < 3; k++) {
            by[k] = bed->position[i][k] - bed->built_position[i][k];
        }
        most2 = fmax(most2, square(by));
        speed2 = fmax(speed2, square(bed->velocity[i]));
    }
    *moved = sqrt(most2);
    *speed = sqrt(speed2);
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

static void note_built(struct gb_bed *bed)
{
    memcpy(bed->built_position, bed->position,
           (size_t)bed->count * sizeof *bed->position);
    bed->punch_built_position = bed->die.punch_position;
    bed->top_built_position = bed->die.top;
    bed->built_evaluation = bed->evaluations;
    bed->listed = true;
    bed->rebuilds++;
}

/* Lists were made of the present positions. */
static void note_listed(struct gb_bed *bed)
{
    const size_t bytes = (size_t)bed->count * sizeof *bed->position;
    memcpy(bed->listed_position, bed->position, bytes);
    memcpy(bed->listed_velocity, bed->velocity, bytes);
    bed->listed_evaluation = bed->evaluations;
    bed->listed_age = 0.0;
}

static bool make_lists(struct gb_bed *bed, double step, double deviation,
                       struct gb_error *err)
{
    double moved = 0.0, speed = 0.0;
    find_fastest(bed, &moved, &speed);
    adapt_near_skin(bed, deviation);
    bed->listed_time = list_lasts * step;
    const double follows = speed * bed->listed_time + 0.5 * bed->near_skin;
    /* the build tells of a position that is not a number */
    if (isnan(deviation) || !candidates_hold(bed, moved + follows)) {
        adapt_skin(bed);
        bed->skin = fmax(bed->skin, 4.0 * follows);
        moved = 0.0;
        if (!gb_bed_list_rebuild(bed, err)) {
            return false;
        }
        note_built(bed);
    } else if (!gb_bed_list_draw(bed, err)) {
        return false;
    }
    bed->moved_most = moved + follows;
    note_listed(bed);
    return true;
}

static bool refresh_lists(struct gb_bed *bed, double step, double deviation2,
                          struct gb_error *err)
{
    const double deviation = sqrt(deviation2);
    const bool holds = bed->listed_age <= bed->listed_time &&
                       2.0 * deviation < bed->near_skin &&
                       candidates_hold(bed, bed->moved_most);
    return holds || make_lists(bed, step, deviation, err);
}

bool gb_bed_evaluate_blocks(struct gb_bed *bed, double step, double deviation2,
                            struct gb_error *err)
{
    if (!refresh_lists(bed, step, deviation2, err)) {
        return false;
    }
    gb_bed_sweep(bed, step);
    if (bed->welds) {
        gb_bed_welds_sweep(bed, step);
    }
    bed->evaluations++;
    return true;
}

bool gb_bed_evaluate(struct gb_bed *bed, double step, double deviation2,
                     struct gb_error *err)
{
    if (!gb_bed_evaluate_blocks(bed, step, deviation2, err)) {
        return false;
    }
    gb_bed_sweep_sum(bed);
    return true;
}

/* ---- Measures ---- */

int64_t gb_bed_escaped(const struct gb_bed *bed)
{
    for (int64_t i = 0; i < bed->count; i++) {
        if (!gb_die_contains(&bed->die, bed->position[i])) {
            return i;
        }
    }
    return -1;
}

double gb_bed_deepest(const struct gb_bed *bed, int64_t pair[2])
{
    double deepest = 0.0;
    for (int64_t slot = 0; slot < bed->pairs.count; slot++) {
        const int32_t i = bed->pairs.first[slot], j = bed->pairs.other[slot];
        const double *a = bed->position[i], *b = bed->position[j];
        const double r[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
        const double overlap =
            (a[3] + b[3] - gb_vec_length(r)) / (2.0 * fmin(a[3], b[3]));
        if (overlap > deepest) {
            deepest = overlap;
            pair[0] = i;
            pair[1] = j;
        }
    }
    return deepest;
}

double gb_bed_solid_volume(const struct gb_bed *bed)
{
    double sum = 0.0;
    for (int64_t i = 0; i < bed->count; i++) {
        sum += bed->mass[i]; /* d^3 */
    }
    return M_PI / 6.0 * sum;
}

struct gb_bed_kinetic_energy gb_bed_kinetic_energy(const struct gb_bed *bed)
{
    struct gb_bed_kinetic_energy sum = {0.0, 0.0};
    for (int64_t i = 0; i < bed->count; i++) {
        sum.translational += 0.5 * bed->mass[i] * square(bed->velocity[i]);
        sum.rotational += 0.5 * bed->inertia * bed->mass[i] * square(bed->roll[i]);
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
