/* The list check: do the lists still hold every pair?
 *
 * If two particles are within the reach now, they were at most reach (1 + strain) + both
 * displacements apart at the build.  Pairs nearer than reach + skin were listed then.  So the
 * lists are complete while no particle has moved farther than the margin, about half the skin.
 *
 * Among thousands of particles a few, without load, move much farther than the others.  They
 * alone would force a rebuild.  These escaped particles are checked one by one: their partners are
 * looked up in the bins of the build, one or two bins to each side.  The lists are valid as
 * long as they hold the pairs that are found.  list_patch.c inserts pairs that are missing. */

#include "pack/list/list_check.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#include "base/team.h"
#include "pack/cell/engine.h"
#include "pack/list/blocks.h"

/* ---- Range of the check ---- */

/* Pairs count as touching, or as within the cutoff, from a distance larger by this (d): a
 * sweep in single precision has a coarser resolution.  It also bounds the rounding of
 * squared distances (d^2). */
#define TOLERANCE 1e-6

/* Largest number of bins to each side. */
enum { SPAN_MAX = 2 };

/* Distance (d) that two particles at the cutoff may still approach or separate by before
 * one of the lists misses the pair. */
static double skin_left(const struct gb_engine *engine, double *reach)
{
    const struct gb_numerics *numerics = &engine->model->numerics;
    *reach = engine->list.largest - 1.0 + numerics->cutoff;
    return numerics->skin - *reach * engine->list.strain - 2.0 * TOLERANCE;
}

double gb_list_check_margin(const struct gb_engine *engine)
{
    double reach;
    return 0.5 * skin_left(engine, &reach);
}

/* Search radius of the check.  A partner that moved less than `near` since the build lies
 * within one bin of the particle's bin at that time; less than `far`, within two bins. */
struct search {
    double near, far; /* d */
};

static struct search search_radii(const struct gb_engine *engine)
{
    double reach;
    const double left = skin_left(engine, &reach), strain = 1.0 + engine->list.strain;
    const double width = reach + engine->model->numerics.skin;
    return (struct search){left / strain, (left + width) / strain};
}

enum gb_list_check_verdict gb_list_check_judge(const struct gb_engine *engine,
                                               double displacement)
{
    const double margin = gb_list_check_margin(engine);
    if (margin <= 0.0) {
        return GB_LIST_CHECK_INVALID; /* the strain has used up the skin */
    }
    if (displacement < margin) {
        return GB_LIST_CHECK_VALID;
    }
    return displacement < search_radii(engine).far ? GB_LIST_CHECK_UNCERTAIN
                                                : GB_LIST_CHECK_INVALID;
}

/* ---- Partners of one escaped particle ---- */

/* Squared distance of two fixed-point positions, nearest images, d^2. */
static double fixed_distance2(const struct gb_engine *engine, const int32_t from[3],
                              const int32_t to[3])
{
    double squared = 0.0;
    for (int k = 0; k < 3; k++) {
        const int32_t units =
            gb_fixed_position_difference((uint32_t)to[k], (uint32_t)from[k]);
        const double r =
            (double)units * gb_fixed_position_unit(&engine->particles.cell, k);
        squared += r * r;
    }
    return squared;
}

static double distance2_tilted(const struct gb_cell *cell, const double *xi,
                               const double *xj)
{
    double r[3] = {xi[0] - xj[0], xi[1] - xj[1], xi[2] - xj[2]};
    gb_cell_nearest(cell, r);
    return gb_vec_dot(r, r);
}

/* Without a tilt the distance stays in registers. */
static inline double distance2_straight(const struct gb_cell *cell, const double *xi,
                                        const double *xj)
{
    double squared = 0.0;
    for (int k = 0; k < 3; k++) {
        const double r = xi[k] - xj[k], edge = cell->edge[k];
        const double nearest = cell->periodic[k] ? r - edge * gb_cell_whole(r / edge) : r;
        squared += nearest * nearest;
    }
    return squared;
}

/* Squared distance of nearest images, d^2. */
static double distance2(const struct gb_engine *engine, bool tilted, int64_t i, int64_t j)
{
    const struct gb_particles *particles = &engine->particles;
    const double *xi = particles->position + 3 * i, *xj = particles->position + 3 * j;
    if (gb_engine_is_f32(engine)) {
        return fixed_distance2(engine, engine->f32.particle[i].position,
                               engine->f32.particle[j].position);
    }
    return tilted ? distance2_tilted(&particles->cell, xi, xj)
                  : distance2_straight(&particles->cell, xi, xj);
}

/* True if the pair is in the list with the image that is the nearest one now. */
static bool holds(const struct gb_engine *engine, const struct gb_pair_list *list,
                  int64_t i, int64_t j, double squared)
{
    const int64_t low = i < j ? i : j, high = i < j ? j : i;
    for (int64_t k = list->start[low]; k < list->start[low + 1]; k++) {
        double r[3];
        if (list->other[k] == high) {
            return gb_engine_branch_vector(engine, list, low, k, r) <=
                   squared + TOLERANCE;
        }
    }
    return false;
}

static void add_missing(struct gb_missing_pairs *missing, int64_t i, int64_t j, bool near)
{
    if (missing->count == GB_MISSING_PAIRS_MAX) {
        missing->incomplete = true;
        return;
    }
    missing->pair[missing->count++] = (struct gb_missing_pair){
        (int32_t)(i < j ? i : j), (int32_t)(i < j ? j : i), near};
}

/* Adds the pair if it is not in the list that belongs to its distance. */
static void check_pair(const struct gb_engine *engine, bool tilted, int64_t i, int64_t j,
                       struct gb_missing_pairs *missing)
{
    const struct gb_neighbour_list *list = &engine->list;
    const double *d = list->diameter;
    const double touch = (d ? 0.5 * (d[i] + d[j]) : 1.0) + TOLERANCE;
    const double reach = touch + engine->model->numerics.cutoff - 1.0;
    const double squared = distance2(engine, tilted, i, j);
    const bool touches = squared < touch * touch;
    if (squared < reach * reach && !holds(engine, &list->near, i, j, squared) &&
        (touches || !holds(engine, &list->far, i, j, squared))) {
        add_missing(missing, i, j, touches);
    }
}

/* Possible partners of an escaped particle.  They lie scattered in memory, so all of them
 * are prefetched before the first is read. */
enum { CANDIDATES = 256 };

struct candidates {
    bool tilted; /* gb_cell_tilted of the cell */
    int count;
    int32_t particle[CANDIDATES];
};

/* Keeps the candidates that are near enough to be in a list of particle i. */
static void keep_near(const struct gb_engine *engine, int64_t i,
                      struct candidates *candidates)
{
    const double gap = engine->model->numerics.cutoff - 1.0 + TOLERANCE;
    const double *d = engine->list.diameter;
    int kept = 0;
    for (int k = 0; k < candidates->count; k++) {
        const int32_t j = candidates->particle[k];
        const double reach = gap + (d ? 0.5 * (d[i] + d[j]) : 1.0);
        const double squared = distance2(engine, candidates->tilted, i, j);
        candidates->particle[kept] = j;
        kept += squared < reach * reach && j != i;
    }
    candidates->count = kept;
}

static void prefetch_pairs(const struct gb_engine *engine, int64_t i,
                           const struct candidates *candidates)
{
    const struct gb_pair_list *near = &engine->list.near, *far = &engine->list.far;
    for (int k = 0; k < candidates->count; k++) {
        const int64_t low = i < candidates->particle[k] ? i : candidates->particle[k];
        __builtin_prefetch(&near->start[low]);
        __builtin_prefetch(&far->start[low]);
    }
    for (int k = 0; k < candidates->count; k++) {
        const int64_t low = i < candidates->particle[k] ? i : candidates->particle[k];
        __builtin_prefetch(&near->other[near->start[low]]);
        __builtin_prefetch(&near->image[near->start[low]]);
    }
}

static void flush_candidates(const struct gb_engine *engine, int64_t i,
                             struct candidates *candidates,
                             struct gb_missing_pairs *missing)
{
    keep_near(engine, i, candidates);
    prefetch_pairs(engine, i, candidates);
    for (int k = 0; k < candidates->count; k++) {
        check_pair(engine, candidates->tilted, i, candidates->particle[k], missing);
    }
    candidates->count = 0;
}

/* Bin that particle i would have had at the build, had the cell only been strained since. */
static void bin_at_build(const struct gb_engine *engine, int64_t i, int bin[3])
{
    const struct gb_neighbour_list *list = &engine->list;
    double now[3], x[3];
    gb_engine_position(engine, i, now);
    gb_cell_fraction(&list->unit, now, x);
    gb_cell_wrap(&list->built, x);
    gb_neighbour_list_bin(&list->grid, x, bin);
}

/* Adjacent bins along x: their particles are contiguous in bin_particle. */
struct run {
    int first, last;
};

/* Runs of `span` bins to each side of particle i; two runs where they wrap around. */
enum { RUNS = 2 * (2 * SPAN_MAX + 1) * (2 * SPAN_MAX + 1) };

static int find_runs(const struct gb_engine *engine, int64_t i, int span, struct run *run)
{
    const struct gb_neighbour_grid *grid = &engine->list.grid;
    int bin[3], low[3], count[3], runs = 0;
    bin_at_build(engine, i, bin);
    for (int k = 0; k < 3; k++) { /* every bin once, where there are few */
        const bool all = grid->n[k] <= 2 * span + 1;
        low[k] = all ? 0 : bin[k] - span + (bin[k] < span ? grid->n[k] : 0);
        count[k] = all ? grid->n[k] : 2 * span + 1;
    }
    const int wrapped = low[0] + count[0] - grid->n[0];
    for (int r = 0; r < count[1] * count[2]; r++) {
        const int at[3] = {0, (low[1] + r % count[1]) % grid->n[1],
                           (low[2] + r / count[1]) % grid->n[2]};
        const int row = gb_neighbour_list_bin_index(grid, at);
        const int end = wrapped > 0 ? grid->n[0] : low[0] + count[0];
        run[runs++] = (struct run){row + low[0], row + end - 1};
        if (wrapped > 0) {
            run[runs++] = (struct run){row, row + wrapped - 1};
        }
    }
    return runs;
}

static void prefetch_particle(const struct gb_engine *engine, int32_t j)
{
    __builtin_prefetch(gb_engine_is_f32(engine)
                           ? (const void *)&engine->f32.particle[j]
                           : engine->particles.position + 3 * (int64_t)j);
}

/* Adds the pairs of escaped particle i that are not in the list they belong to.  The search
 * covers `span` bins to each side of the particle's bin at the build. */
static void search_partners(const struct gb_engine *engine, int64_t i, int span,
                            struct gb_missing_pairs *missing)
{
    const int32_t *start = engine->list.bin_start, *particle = engine->list.bin_particle;
    struct run run[RUNS];
    struct candidates candidates;
    candidates.tilted = gb_cell_tilted(&engine->particles.cell);
    candidates.count = 0;
    const int runs = find_runs(engine, i, span, run);
    for (int r = 0; r < runs; r++) {
        __builtin_prefetch(&start[run[r].first]);
    }
    for (int r = 0; r < runs; r++) {
        __builtin_prefetch(&particle[start[run[r].first]]);
    }
    for (int r = 0; r < runs; r++) {
        const int32_t stop = start[run[r].last + 1];
        for (int32_t k = start[run[r].first]; k < stop; k++) {
            prefetch_particle(engine, particle[k]);
            candidates.particle[candidates.count++] = particle[k];
            if (candidates.count == CANDIDATES) {
                flush_candidates(engine, i, &candidates, missing);
            }
        }
    }
    flush_candidates(engine, i, &candidates, missing);
}

/* ---- All escaped particles of a block ---- */

/* A check pays up to so many escaped particles ... */
enum {
    ESCAPED_BASE = 20,
    PARTICLES_PER_ESCAPED = 256,    /* ... and one more for so many particles; */
    PARTICLES_PER_ESCAPED_BLOCK = 8 /* in one block, as a region can be more active */
};

/* Squared non-affine displacement of particle i since the build, d^2. */
static double displacement2(const struct gb_engine *engine, int64_t i, bool tilted)
{
    double x[3];
    gb_engine_position(engine, i, x);
    if (tilted) {
        const double at[3] = {x[0], x[1], x[2]}; /* x itself stays in registers */
        return gb_neighbour_list_displacement2_tilted(&engine->list, i, at);
    }
    return gb_neighbour_list_displacement2_scaled(&engine->list, i, x);
}

/* True if particle i begins a group whose bound shows that none of its particles has
 * escaped. */
static bool group_inside(const struct gb_engine *engine, int64_t i, double margin)
{
    return gb_engine_state_moved(&engine->state) && i % GB_F32_STATE_GROUP == 0 &&
           (double)engine->f32.bound[i / GB_F32_STATE_GROUP] < margin;
}

/* Finds the pairs of the escaped particles among begin .. end - 1 that are not in the list
 * they belong to. */
static void find_missing(const struct gb_engine *engine, int64_t begin, int64_t end,
                         struct gb_missing_pairs *missing)
{
    const double margin = gb_list_check_margin(engine), near = search_radii(engine).near;
    const bool tilted = gb_cell_tilted(&engine->list.unit);
    *missing = (struct gb_missing_pairs){0};
    for (int64_t i = begin; i < end && !missing->incomplete; i++) {
        if (group_inside(engine, i, margin)) {
            i += GB_F32_STATE_GROUP - 1;
            continue;
        }
        const double square = displacement2(engine, i, tilted);
        if (square < margin * margin) {
            continue;
        }
        missing->escaped++;
        missing->incomplete =
            PARTICLES_PER_ESCAPED_BLOCK * (missing->escaped - ESCAPED_BASE) > end - begin;
        /* of a missing pair at least the particle that moved farther must find the other, so
         * it searches two bins */
        search_partners(engine, i, square < near * near ? 1 : 2, missing);
    }
}

bool gb_list_check_too_many(int64_t escaped, int64_t particles)
{
    return PARTICLES_PER_ESCAPED * (escaped - ESCAPED_BASE) > particles;
}

/* ---- All blocks ---- */

void gb_list_check_measure(struct gb_engine *engine, int64_t b)
{
    const int64_t count = engine->particles.count;
    engine->check[b].displacement = gb_neighbour_list_displacement(
        &engine->list, engine->particles.position, gb_blocks_begin(count, b),
        gb_blocks_end(count, b));
}

double gb_list_check_largest(const struct gb_engine *engine)
{
    const int64_t blocks = gb_blocks_count(engine->particles.count);
    double largest = 0.0;
    for (int64_t b = 0; b < blocks; b++) {
        const double displacement = engine->check[b].displacement;
        if (!(displacement <= largest)) {
            largest = displacement;
        }
        if (isnan(displacement)) {
            break;
        }
    }
    return largest;
}

static void find_in_block(void *data, int64_t b)
{
    struct gb_engine *engine = data;
    const int64_t count = engine->particles.count;
    struct gb_list_check_block *block = &engine->check[b];
    block->missing = (struct gb_missing_pairs){0};
    if (gb_list_check_judge(engine, block->displacement) != GB_LIST_CHECK_VALID) {
        find_missing(engine, gb_blocks_begin(count, b), gb_blocks_end(count, b),
                     &block->missing);
    }
}

/* True if the lists miss a pair, or are too old for the check. */
static bool any_missing(const struct gb_engine *engine, int64_t blocks)
{
    int64_t escaped = 0;
    for (int64_t b = 0; b < blocks; b++) {
        const struct gb_missing_pairs *missing = &engine->check[b].missing;
        if (missing->incomplete || missing->count > 0) {
            return true;
        }
        escaped += missing->escaped;
    }
    return gb_list_check_too_many(escaped, engine->particles.count);
}

bool gb_list_check_run(struct gb_engine *engine)
{
    const int64_t blocks = gb_blocks_count(engine->particles.count);
    if (engine->state.lists == GB_ENGINE_LISTS_PATCHED) {
        return true;
    }
    const enum gb_list_check_verdict verdict =
        gb_list_check_judge(engine, gb_list_check_largest(engine));
    if (verdict != GB_LIST_CHECK_UNCERTAIN) {
        return verdict == GB_LIST_CHECK_VALID;
    }
    gb_blocks_run(engine, find_in_block, engine);
    return !any_missing(engine, blocks);
}
