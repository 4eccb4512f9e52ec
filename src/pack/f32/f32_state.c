/* State of a world in single precision, and its conversion from and to doubles.
 *
 * Positions are fixed-point numbers: 2^32 units to an edge of the cell.  They resolve 5e-9 d
 * in a cell of 20 d, where a float resolves 1e-6 d.  The difference of two, with wrap-around,
 * is the difference to the nearest periodic image, so that no pair needs an image.
 *
 * Forces and torques are rows.  Each block of particles adds up those of its pairs; a pair with
 * a second particle in a later block ("cross pair") adds to a row of its own, which the other
 * block sums afterwards.  So no two threads write to one row, and the order of the sums does
 * not depend on the number of threads. */

#include "pack/f32/f32_state.h"

#include <stdint.h>
#include <string.h>

#include "base/alloc.h"
#include "base/team.h"
#include "greenbody/status.h"
#include "pack/cell/cell.h"
#include "pack/cell/engine.h"
#include "pack/kernel/simd.h"
#include "pack/list/blocks.h"
#include "pack/list/neighbour_list.h"

/* ---- Rows of force and torque ---- */

/* Particles begin with so many rows for cross pairs in all. */
enum { EXTRA = 64 };

/* Rows of the particles alone. */
static bool wrench_rows_init(struct gb_wrench_rows *rows, int64_t count,
                             struct gb_error *err)
{
    rows->room = count;
    rows->row = gb_alloc_array((size_t)count, sizeof *rows->row, err);
    rows->start = gb_alloc_array(2 * (size_t)count + 1, sizeof *rows->start, err);
    return rows->row && rows->start;
}

static void wrench_rows_finish(struct gb_wrench_rows *rows)
{
    gb_alloc_free(rows->row);
    gb_alloc_free(rows->start);
    *rows = (struct gb_wrench_rows){0};
}

/* Entry of particle j in `start`, for near or far pairs. */
static int64_t entry_of(const struct gb_neighbour_list *list,
                        const struct gb_pair_list *pairs, int64_t j)
{
    return 2 * j + (pairs == &list->far);
}

/* Counts the cross pairs of every particle. */
static void count_pairs(const struct gb_neighbour_list *list,
                        const struct gb_pair_list *pairs, int32_t *count)
{
    for (int64_t b = 0; b < gb_blocks_count(list->count); b++) {
        const int64_t begin = gb_blocks_begin(list->count, b);
        const int64_t end = gb_blocks_end(list->count, b);
        for (int64_t k = pairs->start[begin]; k < pairs->start[end]; k++) {
            count[entry_of(list, pairs, pairs->other[k])] += pairs->other[k] >= end;
        }
    }
}

/* From numbers of rows to one past the last of each. */
static void sum_counts(const struct gb_neighbour_list *list, int32_t *count)
{
    int32_t rows = (int32_t)list->count;
    for (int64_t b = 0; b < gb_blocks_count(list->count); b++) {
        const int64_t end = gb_blocks_end(list->count, b);
        for (int64_t m = 2 * gb_blocks_begin(list->count, b); m < 2 * end; m++) {
            rows += count[m];
            count[m] = rows;
        }
        rows += GB_WRENCH_ROWS_AT_ONCE; /* other threads' rows are not read */
    }
    count[2 * list->count] = rows;
}

/* From the last pair to the first, which leaves the first row of each in `start`. */
static void assign_rows(const struct gb_neighbour_list *list, struct gb_pair_list *pairs,
                        int32_t *start)
{
    for (int64_t b = gb_blocks_count(list->count) - 1; b >= 0; b--) {
        const int64_t begin = gb_blocks_begin(list->count, b);
        const int64_t end = gb_blocks_end(list->count, b);
        for (int64_t k = pairs->start[end] - 1; k >= pairs->start[begin]; k--) {
            const int32_t j = pairs->other[k];
            pairs->row[k] = j < end ? j : --start[entry_of(list, pairs, j)];
        }
    }
}

bool gb_f32_state_assign_rows(struct gb_wrench_rows *rows, struct gb_neighbour_list *list,
                              struct gb_error *err)
{
    const size_t count = (size_t)list->count;
    memset(rows->start, 0, (2 * count + 1) * sizeof *rows->start);
    count_pairs(list, &list->near, rows->start);
    count_pairs(list, &list->far, rows->start);
    sum_counts(list, rows->start);
    const int64_t need = rows->start[2 * count];
    if (need > rows->room) {
        const int64_t room = need + (need - list->count) / 16 + EXTRA;
        void *grown =
            gb_alloc_grow(rows->row, count, (size_t)room, sizeof *rows->row, err);
        if (!grown) {
            return false;
        }
        rows->row = grown;
        rows->room = room;
    }
    assign_rows(list, &list->near, rows->start);
    assign_rows(list, &list->far, rows->start);
    return true;
}

void gb_f32_state_clear_rows(const struct gb_wrench_rows *rows, int64_t begin,
                             int64_t end)
{
    const int32_t first = rows->start[2 * begin];
    memset(rows->row[first], 0,
           (size_t)(rows->start[2 * end] - first) * sizeof *rows->row);
}

/* ---- The state ---- */

bool gb_f32_state_init(struct gb_f32_state *f32, const struct gb_model *model,
                       struct gb_error *err)
{
    const size_t n = (size_t)model->count;
    const size_t groups = (n + GB_F32_STATE_GROUP - 1) / GB_F32_STATE_GROUP;
    f32->kernel = gb_batch_f32_pick(model, 0);
    f32->particle = gb_alloc_array(n, sizeof *f32->particle, err);
    f32->velocity = gb_alloc_array(n, sizeof *f32->velocity, err);
    f32->bound = gb_alloc_array(groups, sizeof *f32->bound, err);
    f32->speed2 =
        gb_alloc_array((size_t)gb_blocks_count(model->count), sizeof *f32->speed2, err);
    return f32->particle && f32->velocity && f32->bound && f32->speed2 &&
           wrench_rows_init(&f32->rows, model->count, err);
}

void gb_f32_state_finish(struct gb_f32_state *f32)
{
    gb_alloc_free(f32->particle);
    gb_alloc_free(f32->velocity);
    gb_alloc_free(f32->bound);
    gb_alloc_free(f32->speed2);
    wrench_rows_finish(&f32->rows);
    *f32 = (struct gb_f32_state){0};
}

/* ---- Conversion ---- */

/* Where the torque begins in a row of force and torque. */
enum { TORQUE = GB_WRENCH_ROWS_TORQUE };

void gb_f32_state_particles(struct gb_engine *engine, int64_t begin, int64_t end)
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

void gb_f32_state_synchronise(struct gb_engine *engine)
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

void gb_f32_state_forces_to_f64(struct gb_engine *engine)
{
    if (engine->state.forces == GB_ENGINE_FORCES_F64) {
        return;
    }
    gb_team_run_ranges(engine->team, engine->particles.count, GB_BLOCKS_GRAIN,
                       widen_range, engine);
    gb_engine_state_convert_forces(&engine->state);
}

void gb_f32_state_forces_from_f64(struct gb_engine *engine)
{
    const struct gb_particles *particles = &engine->particles;
    for (int64_t i = 0; gb_engine_is_f32(engine) && i < particles->count; i++) {
        for (int c = 0; c < 3; c++) {
            engine->f32.rows.row[i][c] = (float)particles->force[3 * i + c];
            engine->f32.rows.row[i][TORQUE + c] = (float)particles->torque[3 * i + c];
        }
    }
}
