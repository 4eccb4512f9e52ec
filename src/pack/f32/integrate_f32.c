#include "pack/f32/integrate_f32.h"

#include "base/team/team.h"
#include "pack/cell/world_private.h"
#include "pack/f32/f32_convert.h"
#include "pack/f32/integrate_f32_tile.h"
#include "pack/list/blocks.h"
#include "pack/list/engine_blocks.h"
#include "pack/list/list_check.h"

_Static_assert((int)TILE % (int)GB_F32_STATE_GROUP == 0 && (int)SUMMED % (int)TILE == 0 &&
                   (int)GB_BLOCKS_SIZE % (int)SUMMED == 0 &&
                   (int)NUMBERS % (int)LANES == 0,
               "no group lies in two tiles, no tile in two sums or blocks");

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
 * four short arrays at a time. */
GB_SIMD_LOOP void prefetch_tile(const struct gb_f32_state *f32, int64_t begin)
{
    const int64_t at = 3 * begin;
    prefetch_bytes(f32->rows.row + begin, TILE * sizeof *f32->rows.row);
    prefetch_bytes(f32->particle + begin, TILE * sizeof *f32->particle);
    prefetch_bytes(f32->velocity + at, NUMBERS * sizeof *f32->velocity);
    prefetch_bytes(f32->spin + at, NUMBERS * sizeof *f32->spin);
}

GB_SIMD_LOOP void update_tile(struct gb_f32_state *f32, const struct pass *pass,
                              int64_t begin, int particles, struct motion *motion)
{
    const int64_t at = 3 * begin;
    const int n = 3 * particles;
    float *v = f32->velocity + at, *w = f32->spin + at;
    struct tile s;
    s.rotation[n] = 0.0F;
    load_forces(f32->rows.row + begin, pass->diameter ? pass->diameter + begin : NULL,
                particles, &s);
    update_velocity(pass, pass->kick, n, s.force, v, s.displacement, s.square);
    const bool too_fast = find_too_fast(pass, particles, &s);
    if (too_fast) {
        slow_down(pass, particles, &s, v, s.displacement);
    }
    add_to_sum(&motion->speed2, s.square, n);
    load_positions(f32->particle + begin, particles, &s);
    move_positions(pass, n, s.displacement, s.position);
    motion->displacement = fmaxf(motion->displacement,
                                 update_bounds(pass, particles, f32->built + at, &s,
                                               f32->bound + begin / GB_F32_STATE_GROUP));
    update_velocity(pass, pass->kick_rotation, n, s.torque, w, s.rotation, s.square);
    if (too_fast) {
        slow_down(pass, particles, &s, w, s.rotation);
    }
    add_to_sum(&motion->spin2, s.square, n);
    if (pass->rotation_total) {
        add_all(pass->rotation_total + at, s.rotation, n);
    }
    store_particles(&s, particles, f32->particle + begin);
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
            update_tile(f32, pass, k, stop - k < TILE ? (int)(stop - k) : TILE, &motion);
        }
        speed2 += sum_total(&motion.speed2);
        speed2 += (double)pass->inertia * sum_total(&motion.spin2);
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
    gb_engine_blocks_run(engine, update_item, &update);
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
    const size_t bytes =
        3 * (size_t)world->engine.particles.count * sizeof *f32->velocity;
    memset(f32->velocity, 0, bytes);
    memset(f32->spin, 0, bytes);
}

/* The scales of the three axes, repeated for every particle of a tile. */
static void fill_axes(struct pass *pass, const struct gb_cell *cell)
{
    pass->rounding = 0.0F;
    for (int c = 0; c < 3; c++) {
        const float units = (float)gb_fixed_position_units(cell, c);
        const float unit = (float)gb_fixed_position_unit(cell, c);
        pass->rounding += unit;
        for (int k = c; k < NUMBERS; k += 3) {
            pass->units[k] = units;
            pass->unit[k] = unit;
        }
    }
}

double gb_integrate_f32_step(struct gb_world *world, const struct gb_integrate_f32 *by,
                             float *rotation_total)
{
    struct gb_engine *engine = &world->engine;
    const double limit = by->displacement_max / by->step;
    struct pass pass = {.keep = (float)by->keep,
                        .back = (float)by->back,
                        .step = (float)by->step,
                        .kick = (float)by->kick,
                        .kick_rotation = (float)(by->kick / by->inertia),
                        .inertia = (float)by->inertia,
                        .margin = (float)gb_list_check_margin(engine),
                        .bounds_known = gb_engine_state_bounds_known(&engine->state),
                        .speed2_max = (float)(limit * limit),
                        .rotation_total = rotation_total,
                        .diameter = engine->particles.diameter};
    fill_axes(&pass, &engine->particles.cell);
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
