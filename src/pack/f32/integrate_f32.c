#include "pack/f32/integrate_f32.h"

#include "base/team/team.h"
#include "pack/cell/world_private.h"
#include "pack/f32/f32_convert.h"
#include "pack/f32/integrate_f32_tile.h"
#include "pack/list/blocks.h"
#include "pack/list/list_check.h"

_Static_assert((int)SUMMED % (int)TILE == 0 && (int)GB_BLOCKS_SIZE % (int)SUMMED == 0,
               "no tile lies in two sums or blocks");

/* Particles from which on their data have left the caches since the last pass. */
enum { PREFETCH = 131072 };

GB_SIMD_LOOP void prefetch_bytes(const void *from, size_t bytes)
{
    enum { LINE = 64 };
    for (size_t at = 0; at < bytes; at += LINE) {
        gb_simd_fetch((const char *)from + at);
    }
}

/* Prefetches a tile while the one before is computed: hardware prefetchers do not follow
 * three short arrays at a time. */
GB_SIMD_LOOP void prefetch_tile(const struct gb_f32_state *f32, int64_t begin)
{
    prefetch_bytes(f32->rows.row + begin, TILE * sizeof *f32->rows.row);
    prefetch_bytes(f32->particle + begin, TILE * sizeof *f32->particle);
    prefetch_bytes(f32->velocity + begin, TILE * sizeof *f32->velocity);
}

GB_ROW_INLINE void update_tile(struct gb_engine *engine, const struct pass *pass,
                               int64_t begin, int particles, struct motion *motion)
{
    struct gb_f32_state *f32 = &engine->f32;
    const double *built = engine->list.built_position + 3 * begin;
    float(*v)[GB_WRENCH_ROWS_WIDTH] = f32->velocity + begin;
    float *bound = &f32->bound[begin / GB_F32_STATE_GROUP], mass_inverse[TILE];
    struct gb_f32_particle *particle = f32->particle + begin;
    struct tile tile;
    struct squares squares;
    for (int i = 0; pass->diameter && i < particles; i++) { /* masses are the diameters */
        mass_inverse[i] = 1.0F / (float)pass->diameter[begin + i];
    }
    if (pass->diameter) {
        update_velocities(pass, f32->rows.row + begin, mass_inverse, particles, v, &tile,
                          &squares);
    } else {
        update_velocities(pass, f32->rows.row + begin, NULL, particles, v, &tile,
                          &squares);
    }
    if (bound_of(squares.velocity) > pass->speed2_max) {
        slow_down(pass, particles, v, &tile, &squares);
    }
    for (int l = 0; l < SUMS; l++) {
        motion->square[l] += squares.sum[l];
    }
    if (sqrtf(tile.square) < pass->most_moved) {
        move_particles(pass, &tile, particles, particle);
    } else {
        move_far(pass, &tile, particles, particle);
    }
    *bound = update_bound(pass, &tile, particles, particle, built, *bound);
    motion->displacement = fmaxf(motion->displacement, *bound);
    if (pass->rotation_total) {
        add_rotations(&tile, particles, pass->rotation_total + 3 * begin);
    }
}

GB_SIMD_LOOP void update_block_loop(struct gb_engine *engine, const struct pass *pass,
                                    int64_t b)
{
    struct gb_f32_state *f32 = &engine->f32;
    const int64_t count = engine->particles.count;
    const int64_t begin = gb_blocks_begin(count, b), end = gb_blocks_end(count, b);
    float displacement = 0.0F;
    double speed2 = 0.0;
    for (int64_t i = begin; i < end; i += SUMMED) {
        struct motion motion = {0};
        const int64_t stop = end - i < SUMMED ? end : i + SUMMED;
        for (int64_t k = i; k < stop; k += TILE) {
            if (count >= PREFETCH && k + TILE < end) {
                prefetch_tile(f32, k + TILE);
            }
            update_tile(engine, pass, k, stop - k < TILE ? (int)(stop - k) : TILE,
                        &motion);
        }
        for (int c = 0; c < ROW; c++) { /* of fourth numbers: 0 */
            speed2 += ((double)motion.square[0][c] + (double)motion.square[1][c]) *
                      (double)(c < TORQUE ? 1.0F : pass->inertia);
        }
        displacement = fmaxf(displacement, motion.displacement);
    }
    f32->speed2[b] = speed2;
    /* fixed-point positions wrap around and cannot represent a number that is not finite */
    engine->check[b].displacement = isfinite(speed2) ? (double)displacement : (double)NAN;
}
GB_SIMD_WIDTHS(update_block,
               (struct gb_engine * engine, const struct pass *pass, int64_t b),
               (engine, pass, b))

struct update {
    struct gb_engine *engine;
    const struct pass *pass;
};

static void update_item(void *data, int64_t b)
{
    const struct update *update = data;
    update_block(update->engine, update->pass, b);
}

static void update_all(struct gb_engine *engine, const struct pass *pass)
{
    struct update update = {engine, pass};
    gb_blocks_run(engine, update_item, &update);
}

bool gb_integrate_f32_in_use(const struct gb_world *world)
{
    return gb_engine_is_f32(&world->engine);
}

bool gb_integrate_f32_applies(const struct gb_model *model)
{
    return model->numerics.single;
}

void gb_integrate_f32_reset(struct gb_world *world)
{
    struct gb_f32_state *f32 = &world->engine.f32;
    memset(f32->velocity, 0,
           (size_t)world->engine.particles.count * sizeof *f32->velocity);
}

/* What the numbers of a row are multiplied with. */
static void fill_row(struct pass *pass, const struct gb_cell *cell,
                     const struct gb_cell *built, const struct gb_integrate_f32 *by)
{
    pass->rounding = 0.0F;
    for (int c = 0; c < 3; c++) {
        pass->unit[c] = (float)gb_fixed_position_unit(cell, c);
        pass->built_units[c] = gb_fixed_position_units(built, c);
        pass->rounding += pass->unit[c];
    }
    double most = INFINITY;
    for (int c = 0; c < TORQUE; c++) {
        const double units = c < 3 ? gb_fixed_position_units(cell, c) : 0.0;
        most = fmin(most, units > 0.0 ? 0x1p30 / units : most);
        pass->units[c] = (float)units;
        pass->kick[c] = (float)by->kick;
        pass->kick[TORQUE + c] = (float)(by->kick / by->inertia);
    }
    pass->most_moved = (float)most;
}

double gb_integrate_f32_step(struct gb_world *world, const struct gb_integrate_f32 *by,
                             float *rotation_total)
{
    struct gb_engine *engine = &world->engine;
    const double limit = by->displacement_max / by->step;
    struct pass pass = {.keep = (float)by->keep,
                        .back = (float)by->back,
                        .step = (float)by->step,
                        .inertia = (float)by->inertia,
                        .margin = (float)gb_list_check_margin(engine),
                        .bounds_known = gb_engine_state_bounds_known(&engine->state),
                        .speed2_max = (float)(limit * limit),
                        .rotation_total = rotation_total,
                        .diameter = engine->particles.diameter};
    fill_row(&pass, &engine->particles.cell, &engine->list.built, by);
    if (gb_engine_state_fixed_stale(&engine->state)) {
        gb_f32_convert_particles(engine, 0, engine->particles.count);
    }
    update_all(engine, &pass);
    double speed2 = 0.0;
    for (int64_t b = 0; b < gb_blocks_count(engine->particles.count); b++) {
        speed2 += engine->f32.speed2[b];
    }
    gb_engine_state_move(&engine->state);
    return speed2;
}
