/* Velocity update in single precision, for relaxers with inertia.
 *
 * One pass over each block of particles does all that lies between two evaluations:
 * velocities, fixed-point positions and rotation increments for the next sweep, and bounds of
 * the displacements since the list build.  A block is cut into tiles that fit the first cache.
 * Forces, velocities and displacements are rows of eight numbers: four of translation, four of
 * rotation.  A vector register loads several rows, one row or half of one. */

#include "pack/f32/integrate_f32.h"

#include <math.h>
#include <string.h>

#include "base/team.h"
#include "pack/cell/world_private.h"
#include "pack/f32/f32_state.h"
#include "pack/kernel/register_rows.h"
#include "pack/kernel/simd.h"
#include "pack/list/blocks.h"
#include "pack/list/list_check.h"

/* ---- A tile: constants and sums ---- */

/* Numbers of a particle; particles of a tile, few enough for the first cache, and their
 * numbers; particles whose squares are summed as floats, in so many rows. */
enum { ROW = GB_WRENCH_ROWS_WIDTH, TORQUE = GB_WRENCH_ROWS_TORQUE };

enum { TILE = GB_F32_STATE_GROUP, SUMMED = 256, SUMS = 2 };

/* Constants of one pass over all blocks. */
struct pass {
    float keep, back, step;
    float inertia;
    float margin; /* d; a bound from here on is replaced by the displacement itself */
    bool bounds_known; /* from the updates before */
    float speed2_max;  /* squared velocity of the largest displacement */
    float rounding;    /* d; upper bound of the rounding to fixed point */
    float *rotation_total;
    const double *diameter; /* of all particles; NULL: all are 1 */
    float unit[3];          /* d per fixed-point unit */
    double built_units[3];  /* fixed-point units per d at the list build */
    float most_moved;       /* d; farther ones are not fixed-point differences */
    gb_row units;           /* fixed-point units per d, and 0 */
    gb_row_pair kick;       /* of velocities per force */
};

struct tile {
    gb_row_pair displacement[TILE];
    float square; /* bound of the squared displacements that are finite */
};

/* Sums over some tiles. */
struct motion {
    gb_row_pair square[SUMS]; /* of velocities: even particles, odd particles */
    float displacement;       /* largest bound, d */
};

/* Of a tile: squares of velocities, summed, and the largest ones of velocities and of
 * displacements, number by number of a row; even particles, odd particles. */
struct squares {
    gb_row_pair sum[SUMS], velocity[SUMS], displacement[SUMS];
};

/* Upper bound of the squared lengths of the vectors that rows begin with: from the largest
 * square along each axis. */
GB_ROW_INLINE float bound_of(const gb_row_pair most[SUMS])
{
    float sum = 0.0F;
    for (int c = 0; c < 3; c++) {
        sum += most[0][c] > most[1][c] ? most[0][c] : most[1][c];
    }
    return sum;
}

GB_ROW_INLINE void clear_squares(struct squares *squares)
{
    const gb_row_pair none = {0.0F};
    for (int l = 0; l < SUMS; l++) {
        squares->sum[l] = squares->velocity[l] = squares->displacement[l] = none;
    }
}

/* ---- Velocities of a tile ---- */

/* What an update multiplies with, in registers. */
struct factors {
    float keep, back, step;
    gb_row_pair kick;
};

/* Velocities of a particle from the forces on it; their displacement. */
GB_ROW_INLINE void update_velocity(const struct factors *by, const float *force,
                                   float mass_inverse, float *v,
                                   gb_row_pair *displacement, int odd,
                                   struct squares *squares)
{
    gb_row_pair before, after;
    memcpy(&before, v, sizeof before);
    memcpy(&after, force, sizeof after);
    after = by->keep * before + by->kick * (after * mass_inverse);
    memcpy(v, &after, sizeof after);
    const gb_row_pair moved = by->step * after - by->back * before;
    const gb_row_pair square = after * after, square_moved = moved * moved;
    *displacement = moved;
    squares->sum[odd] += square;
    gb_row_pair_raise(&squares->velocity[odd], &square);
    gb_row_pair_raise(&squares->displacement[odd], &square_moved);
}

/* Velocities of a tile; mass_inverse: of each particle where masses are unequal, else
 * NULL. */
GB_ROW_INLINE void update_velocities(const struct pass *pass,
                                     float (*force)[GB_WRENCH_ROWS_WIDTH],
                                     const float *mass_inverse, int particles,
                                     float (*v)[GB_WRENCH_ROWS_WIDTH], struct tile *tile,
                                     struct squares *squares)
{
    const struct factors by = {pass->keep, pass->back, pass->step, pass->kick};
    int i = 0;
    clear_squares(squares);
    for (; i + SUMS <= particles; i += SUMS) {
        for (int l = 0; l < SUMS; l++) {
            update_velocity(&by, force[i + l], mass_inverse ? mass_inverse[i + l] : 1.0F,
                            v[i + l], &tile->displacement[i + l], l, squares);
        }
    }
    if (i < particles) {
        update_velocity(&by, force[i], mass_inverse ? mass_inverse[i] : 1.0F, v[i],
                        &tile->displacement[i], 0, squares);
    }
    tile->square = bound_of(squares->displacement);
}

/* Slows particles down whose velocity is above the limit, and their rotation with them;
 * sums and bounds follow. */
GB_ROW_INLINE void slow_down(const struct pass *pass, int particles,
                             float (*v)[GB_WRENCH_ROWS_WIDTH], struct tile *tile,
                             struct squares *squares)
{
    clear_squares(squares);
    for (int i = 0; i < particles; i++) {
        gb_row_pair velocity;
        memcpy(&velocity, v[i], sizeof velocity);
        gb_row_pair square = velocity * velocity;
        const float speed2 = square[0] + square[1] + square[2];
        if (speed2 > pass->speed2_max) {
            const float kept = sqrtf(pass->speed2_max / speed2);
            tile->displacement[i] -= pass->step * (1.0F - kept) * velocity;
            velocity *= kept;
            square *= kept * kept;
            memcpy(v[i], &velocity, sizeof velocity);
        }
        const gb_row_pair square_by = tile->displacement[i] * tile->displacement[i];
        squares->sum[i % SUMS] += square;
        gb_row_pair_raise(&squares->displacement[i % SUMS], &square_by);
    }
    tile->square = bound_of(squares->displacement);
}

/* ---- Positions of a tile, and the bound of its displacements ---- */

/* Moves particles by displacements in fixed-point units, rounded to the nearest; their
 * increments of rotation. */
GB_ROW_INLINE void move_particles(const struct pass *pass, const struct tile *tile,
                                  int particles, struct gb_f32_particle *particle)
{
    const gb_row_int sign = {INT32_MIN, INT32_MIN, INT32_MIN, INT32_MIN};
    const gb_row half = {0.5F, 0.5F, 0.5F, 0.5F}, units = pass->units;
    for (int i = 0; i < particles; i++) {
        const gb_row_pair by = tile->displacement[i];
        const gb_row exact = __builtin_shufflevector(by, by, 0, 1, 2, 3) * units;
        const gb_row up = (gb_row)(((gb_row_int)exact & sign) | (gb_row_int)half);
        const gb_row_int moved = __builtin_convertvector(exact + up, gb_row_int);
        gb_row_word at;
        memcpy(&at, particle[i].position, sizeof at);
        at += (gb_row_word)moved;
        memcpy(particle[i].position, &at, sizeof at);
        gb_row_store(particle[i].rotation, __builtin_shufflevector(by, by, 4, 5, 6, 7));
    }
}

/* The same for displacements of any length.  The result for one that is not finite is
 * undefined; the sum of squared velocities reports it. */
GB_ROW_INLINE void move_far(const struct pass *pass, const struct tile *tile,
                            int particles, struct gb_f32_particle *particle)
{
    const float most = 0x1p30F;
    for (int i = 0; i < particles; i++) {
        for (int c = 0; c < 3; c++) {
            const float exact = tile->displacement[i][c] * pass->units[c];
            const float bounded = exact < most ? exact > -most ? exact : -most : most;
            const uint32_t moved =
                (uint32_t)(int32_t)(bounded + (bounded < 0.0F ? -0.5F : 0.5F));
            particle[i].position[c] =
                (int32_t)((uint32_t)particle[i].position[c] + moved);
            particle[i].rotation[c] = tile->displacement[i][TORQUE + c];
        }
    }
}

/* Largest displacement since the list build, where the particles were at `built`, d. */
GB_ROW_INLINE float displacement_since_build(const struct pass *pass, int particles,
                                             const struct gb_f32_particle *particle,
                                             const double *built)
{
    float most = 0.0F;
    for (int i = 0; i < particles; i++) {
        float square = 0.0F;
        for (int c = 0; c < 3; c++) {
            const int32_t from =
                gb_fixed_position_of(built[3 * i + c], pass->built_units[c]);
            const float moved = (float)gb_fixed_position_difference(
                                    (uint32_t)particle[i].position[c], (uint32_t)from) *
                                pass->unit[c];
            square += moved * moved;
        }
        most = square > most ? square : most;
    }
    return sqrtf(most);
}

/* Bound of the displacements of a tile since the list build: grows by that of this update
 * and an allowance for rounding.  Only where it reaches the margin of the list check is
 * the true displacement computed. */
GB_ROW_INLINE float update_bound(const struct pass *pass, const struct tile *tile,
                                 int particles, const struct gb_f32_particle *particle,
                                 const double *built, float bound)
{
    const float slack = 1.0F + 0x1p-16F;
    const float grown = (bound + sqrtf(tile->square) + pass->rounding) * slack;
    return pass->bounds_known && grown < pass->margin
               ? grown
               : displacement_since_build(pass, particles, particle, built);
}

/* Adds up the increments of rotation, three numbers a particle. */
GB_ROW_INLINE void add_rotations(const struct tile *tile, int particles, float *total)
{
    for (int i = 0; i < particles; i++) {
        for (int c = 0; c < 3; c++) {
            total[3 * i + c] += tile->displacement[i][TORQUE + c];
        }
    }
}

/* ---- Blocks ---- */

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

/* ---- Interface ---- */

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
        gb_f32_state_particles(engine, 0, engine->particles.count);
    }
    update_all(engine, &pass);
    double speed2 = 0.0;
    for (int64_t b = 0; b < gb_blocks_count(engine->particles.count); b++) {
        speed2 += engine->f32.speed2[b];
    }
    gb_engine_state_move(&engine->state);
    return speed2;
}
