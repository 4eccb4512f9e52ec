#include "pack/list/list_check.h"

#include <math.h>

#include "base/team/team.h"
#include "pack/cell/engine.h"
#include "pack/list/blocks.h"
#include "pack/list/engine_blocks.h"
#include "pack/list/escaped_search.h"

/* Escaped particles up to which the check is always worth it, and beyond them one of so
 * many particles; inside one block more, as one region can be more active than the rest. */
enum { ESCAPED_BASE = 20 };
enum { PARTICLES_PER_ESCAPED = 256, PARTICLES_PER_ESCAPED_BLOCK = 8 };

/* Distance (d) that two particles at the cutoff may still approach or separate by before
 * one of the lists misses the pair. */
static double skin_left(const struct gb_engine *engine, double *reach)
{
    const struct gb_numerics *numerics = &engine->model->numerics;
    *reach = engine->list.largest - 1.0 + numerics->cutoff;
    return numerics->skin - *reach * engine->list.strain -
           2.0 * GB_ESCAPED_SEARCH_TOLERANCE;
}

/* Two particles within the reach now were at most reach (1 + strain) + both displacements
 * apart at the build; nearer than reach + skin they are in a list. */
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

static struct search search_of(const struct gb_engine *engine)
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
    return displacement < search_of(engine).far ? GB_LIST_CHECK_UNCERTAIN
                                                : GB_LIST_CHECK_INVALID;
}

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

/* True if a group begins with particle i whose bound excludes an escaped particle. */
static bool group_inside(const struct gb_engine *engine, int64_t i, double margin)
{
    return gb_engine_state_moved(&engine->state) && i % GB_F32_STATE_GROUP == 0 &&
           (double)engine->f32.bound[i / GB_F32_STATE_GROUP] < margin;
}

void gb_list_check_find(const struct gb_engine *engine, int64_t begin, int64_t end,
                        struct gb_missing_pairs *missing)
{
    const double margin = gb_list_check_margin(engine), near = search_of(engine).near;
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
        /* of a pair that moved far apart, one at least finds the other: the one that moved
         * farther searches two bins */
        gb_escaped_search_run(engine, i, square < near * near ? 1 : 2, missing);
    }
}

bool gb_list_check_too_many(int64_t escaped, int64_t particles)
{
    return PARTICLES_PER_ESCAPED * (escaped - ESCAPED_BASE) > particles;
}

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
        gb_list_check_find(engine, gb_blocks_begin(count, b), gb_blocks_end(count, b),
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
    gb_engine_blocks_run(engine, find_in_block, engine);
    return !any_missing(engine, blocks);
}
