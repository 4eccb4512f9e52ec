#include "pack/f32/f32_convert.h"

#include "base/team/team.h"
#include "pack/cell/engine.h"
#include "pack/kernel/simd.h"
#include "pack/list/blocks.h"

/* Where the torque begins in a row of force and torque. */
enum { TORQUE = GB_WRENCH_ROWS_TORQUE };

void gb_f32_convert_particles(struct gb_engine *engine, int64_t begin, int64_t end)
{
    const struct gb_particles *particles = &engine->particles;
    const double units[3] = {gb_fixed_position_units(&particles->cell, 0),
                             gb_fixed_position_units(&particles->cell, 1),
                             gb_fixed_position_units(&particles->cell, 2)};
    for (int64_t i = begin; i < end; i++) {
        struct gb_f32_particle *particle = &engine->f32.particle[i];
        const double *position = particles->position + 3 * i;
        const double *rotation = particles->rotation + 3 * i;
        for (int c = 0; c < 3; c++) {
            particle->position[c] = gb_fixed_position_of(position[c], units[c]);
            particle->rotation[c] = (float)rotation[c];
        }
    }
}

GB_SIMD_LOOP void follow_loop(double *restrict position,
                              const struct gb_f32_particle *particle, int64_t count,
                              const double units[3], const double unit[3])
{
    for (int64_t i = 0; i < count; i++) {
        for (int c = 0; c < 3; c++) {
            position[3 * i + c] = gb_fixed_position_follow(
                position[3 * i + c], particle[i].position[c], units[c], unit[c]);
        }
    }
}
GB_SIMD_WIDTHS(follow,
               (double *position, const struct gb_f32_particle *particle, int64_t count,
                const double units[3], const double unit[3]),
               (position, particle, count, units, unit))

static void follow_range(void *data, int64_t begin, int64_t end)
{
    struct gb_engine *engine = data;
    struct gb_particles *particles = &engine->particles;
    double units[3], unit[3];
    for (int c = 0; c < 3; c++) {
        units[c] = gb_fixed_position_units(&particles->cell, c);
        unit[c] = gb_fixed_position_unit(&particles->cell, c);
    }
    follow(particles->position + 3 * begin, engine->f32.particle + begin, end - begin,
           units, unit);
}

void gb_f32_convert_synchronise(struct gb_engine *engine)
{
    if (!gb_engine_state_position_stale(&engine->state)) {
        return;
    }
    gb_team_run_ranges(engine->team, engine->particles.count, GB_BLOCKS_GRAIN,
                       follow_range, engine);
    gb_engine_state_synchronise(&engine->state);
}

static void widen_range(void *data, int64_t begin, int64_t end)
{
    struct gb_engine *engine = data;
    struct gb_particles *particles = &engine->particles;
    for (int64_t i = begin; i < end; i++) {
        for (int c = 0; c < 3; c++) {
            particles->force[3 * i + c] = (double)engine->f32.rows.row[i][c];
            particles->torque[3 * i + c] = (double)engine->f32.rows.row[i][TORQUE + c];
        }
    }
}

void gb_f32_convert_forces_to_f64(struct gb_engine *engine)
{
    if (engine->state.forces == GB_ENGINE_FORCES_F64) {
        return;
    }
    gb_team_run_ranges(engine->team, engine->particles.count, GB_BLOCKS_GRAIN,
                       widen_range, engine);
    gb_engine_state_convert_forces(&engine->state);
}

void gb_f32_convert_forces_from_f64(struct gb_engine *engine)
{
    const struct gb_particles *particles = &engine->particles;
    for (int64_t i = 0; gb_engine_is_f32(engine) && i < particles->count; i++) {
        for (int c = 0; c < 3; c++) {
            engine->f32.rows.row[i][c] = (float)particles->force[3 * i + c];
            engine->f32.rows.row[i][TORQUE + c] = (float)particles->torque[3 * i + c];
        }
    }
}
