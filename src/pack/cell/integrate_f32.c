/* Particles lie in memory as three numbers each, which vectors of any width take as they
 * come; the sweep wants rows of four.  A stretch of them at a time is turned from one
 * into the other in the cache. */
#include "pack/cell/integrate_f32.h"

#include <math.h>
#include <string.h>

#include "pack/cell/world_private.h"
#include "pack/kernel/register_rows.h"
#include "pack/kernel/simd.h"
#include "pack/kernel/sweep_f32.h"

/* Particles that are turned together, few enough that the nearest cache holds all there
 * is about them, and their numbers; particles whose squares are added up as floats, and
 * lanes that these sums have whatever the vector width. */
enum { STRETCH = 64, NUMBERS = 3 * STRETCH, SUMMED = 256, LANES = 16 };
enum { FLOCKS = STRETCH / GB_F32_STATE_FLOCK };
_Static_assert((int)STRETCH % (int)GB_F32_STATE_FLOCK == 0 &&
                   (int)SUMMED % (int)STRETCH == 0 &&
                   (int)GB_SWEEP_BLOCK % (int)SUMMED == 0 &&
                   (int)NUMBERS % (int)LANES == 0,
               "no flock lies in two stretches, no stretch in two sums or blocks");

/* Particles from which on they have left the caches since the last pass, and are asked
 * for ahead. */
enum { FETCHED = 131072 };

/* One pass over all blocks. */
struct pass {
    float keep, back, step;
    float kick, kick_turn;
    float inertia;
    float fresh;  /* ways from here on have to be known, others may be overestimated */
    bool bounded; /* there are ways to begin with */
    float most2;  /* squared speed of who goes as far as anybody may */
    float grain;  /* d; rounding to places adds less than this to a way */
    float *turned;
    /* of the axis of every number of a stretch */
    float units[NUMBERS], scale[NUMBERS];
};

/* A stretch on its way; rows of four are read and written at the last particle. */
struct scratch {
    float force[NUMBERS + 1], torque[NUMBERS + 1];
    float way[NUMBERS], turn[NUMBERS + 1];
    float square[NUMBERS];
    int32_t place[NUMBERS + 1];
    float kept[STRETCH]; /* of a motion that goes too far; written where one does */
};

GB_SIMD_LOOP void take_forces(float (*total)[GB_F32_STATE_WRENCH], int particles,
                              struct scratch *restrict s)
{
    for (int i = 0; i < particles; i++) {
        gb_row_store(s->force + 3 * i, gb_row_load(total[i]));
        gb_row_store(s->torque + 3 * i, gb_row_load(total[i] + 4));
    }
}

GB_SIMD_LOOP void take_places(const struct gb_spot *spot, int particles,
                              struct scratch *restrict s)
{
    for (int i = 0; i < particles; i++) {
        memcpy(s->place + 3 * i, spot[i].place, 4 * sizeof *s->place);
    }
}

/* Velocities from forces, and how far they carry. */
GB_SIMD_LOOP void speed_up(const struct pass *pass, float kick, int n,
                           const float *restrict force, float *restrict v,
                           float *restrict way, float *restrict square)
{
    const float keep = pass->keep, back = pass->back, step = pass->step;
    for (int k = 0; k < n; k++) {
        const float before = v[k], after = keep * before + kick * force[k];
        v[k] = after;
        way[k] = step * after - back * before;
        square[k] = after * after;
    }
}

struct sum {
    float lane[LANES];
    double rest; /* of numbers that fill no more lanes */
};

GB_SIMD_LOOP void sum_up(struct sum *restrict sum, const float *restrict number, int n)
{
    int k = 0;
    for (; k + LANES <= n; k += LANES) {
        for (int l = 0; l < LANES; l++) {
            sum->lane[l] += number[k + l];
        }
    }
    for (; k < n; k++) {
        sum->rest += (double)number[k];
    }
}

static double sum_of(const struct sum *sum)
{
    double all = sum->rest;
    for (int l = 0; l < LANES; l++) {
        all += (double)sum->lane[l];
    }
    return all;
}

/* Largest sum of three numbers of a particle. */
GB_SIMD_LOOP float most_of(const float *restrict number, int particles)
{
    float most = 0.0F;
#pragma omp simd reduction(max : most)
    for (int i = 0; i < particles; i++) {
        const float sum = number[3 * i] + number[3 * i + 1] + number[3 * i + 2];
        most = sum > most ? sum : most;
    }
    return most;
}

/* Square roots of it for every flock of them. */
GB_SIMD_LOOP void most_of_flocks(const float *restrict square, int particles,
                                 float *restrict way)
{
    for (int i = 0; i < particles; i += GB_F32_STATE_FLOCK) {
        const int left = particles - i;
        const int n = left < GB_F32_STATE_FLOCK ? left : GB_F32_STATE_FLOCK;
        *way++ = sqrtf(most_of(square + 3 * i, n));
    }
}

GB_SIMD_LOOP void square_all(const float *restrict number, int n, float *restrict square)
{
    for (int k = 0; k < n; k++) {
        square[k] = number[k] * number[k];
    }
}

/* To the nearest place.  A way that is not finite leads anywhere: what is done then is
 * told by the speeds. */
GB_SIMD_LOOP void go(const struct pass *pass, int n, const float *restrict way,
                     int32_t *restrict place)
{
    const float most = 0x1p30F;
    for (int k = 0; k < n; k++) {
        const float far = way[k] * pass->units[k];
        const float near = far < most ? far > -most ? far : -most : most;
        const uint32_t units = (uint32_t)(int32_t)(near + (near < 0.0F ? -0.5F : 0.5F));
        place[k] = (int32_t)((uint32_t)place[k] + units);
    }
}

GB_SIMD_LOOP void ways_since_build(const struct pass *pass, int n,
                                   const int32_t *restrict place,
                                   const uint32_t *restrict built, float *restrict square)
{
    for (int k = 0; k < n; k++) {
        const uint32_t wide = (uint32_t)place[k] - built[k];
        const float way = (float)(int32_t)wide * pass->scale[k];
        square[k] = way * way;
    }
}

/* Ways of the flocks of a stretch; returns the longest.  They grow by the longest step of
 * each flock, a little more than that so that rounding does no harm, and only where that
 * becomes too much is it looked up how far everybody has really come. */
GB_SIMD_LOOP float follow_flocks(const struct pass *pass, int particles,
                                 const uint32_t *built, struct scratch *s, float *travel)
{
    const float slack = 1.0F + 0x1p-16F;
    const int count = (particles + GB_F32_STATE_FLOCK - 1) / GB_F32_STATE_FLOCK;
    float step[FLOCKS], most = 0.0F;
    bool known = pass->bounded;
    if (known) {
        square_all(s->way, 3 * particles, s->square);
        most_of_flocks(s->square, particles, step);
        for (int f = 0; f < count; f++) {
            travel[f] = (travel[f] + step[f] + pass->grain) * slack;
            known = known && travel[f] < pass->fresh;
        }
    }
    if (!known) {
        ways_since_build(pass, 3 * particles, s->place, built, s->square);
        most_of_flocks(s->square, particles, travel);
    }
    for (int f = 0; f < count; f++) {
        most = fmaxf(most, travel[f]);
    }
    return most;
}

GB_SIMD_LOOP void add_to(float *restrict sum, const float *restrict number, int n)
{
    for (int k = 0; k < n; k++) {
        sum[k] += number[k];
    }
}

/* What those keep who would go too far: seldom any, and then true. */
GB_SIMD_LOOP bool slow_down(const struct pass *pass, int particles, struct scratch *s)
{
    if (!(most_of(s->square, particles) > pass->most2)) {
        return false;
    }
    for (int i = 0; i < particles; i++) {
        const float *square = s->square + 3 * i;
        const float speed2 = square[0] + square[1] + square[2];
        s->kept[i] = speed2 > pass->most2 ? sqrtf(pass->most2 / speed2) : 1.0F;
    }
    return true;
}

/* Scales velocities, their squares and the ways they carry. */
GB_SIMD_LOOP void keep_part(const struct pass *pass, int particles, struct scratch *s,
                            float *v, float *way)
{
    for (int k = 0; k < 3 * particles; k++) {
        const float kept = s->kept[k / 3];
        way[k] -= pass->step * (1.0F - kept) * v[k];
        v[k] *= kept;
        s->square[k] *= kept * kept;
    }
}

/* What stands beside the third number of a row is of no use, and does no harm. */
GB_SIMD_LOOP void give_spots(const struct scratch *restrict s, int particles,
                             struct gb_spot *restrict spot)
{
    for (int i = 0; i < particles; i++) {
        memcpy(spot[i].place, s->place + 3 * i, sizeof spot[i].place);
        memcpy(spot[i].turn, s->turn + 3 * i, sizeof spot[i].turn);
    }
}

/* What is added up over some stretches. */
struct motion {
    struct sum speed2, spin2;
    float travel; /* the longest one */
};

GB_SIMD_LOOP void fetch(const void *from, size_t bytes)
{
    enum { LINE = 64 };
    for (size_t at = 0; at < bytes; at += LINE) {
        gb_simd_fetch((const char *)from + at);
    }
}

/* Asks for all about a stretch before the one in front of it is worked on: of four short
 * arrays at a time no processor foresees the next. */
GB_SIMD_LOOP void fetch_stretch(const struct gb_world *world, int64_t begin)
{
    const struct gb_f32_state *single = &world->single;
    const int64_t at = 3 * begin;
    fetch(single->total + begin, STRETCH * sizeof *single->total);
    fetch(single->spot + begin, STRETCH * sizeof *single->spot);
    fetch(single->velocity + at, NUMBERS * sizeof *single->velocity);
    fetch(single->spin + at, NUMBERS * sizeof *single->spin);
}

GB_SIMD_LOOP void drive_stretch(struct gb_world *world, const struct pass *pass,
                                int64_t begin, int particles, struct motion *motion)
{
    const int64_t at = 3 * begin;
    const int n = 3 * particles;
    struct gb_f32_state *single = &world->single;
    float *v = single->velocity + at, *w = single->spin + at;
    struct scratch s;
    s.turn[n] = 0.0F;
    take_forces(single->total + begin, particles, &s);
    speed_up(pass, pass->kick, n, s.force, v, s.way, s.square);
    const bool slow = slow_down(pass, particles, &s);
    if (slow) {
        keep_part(pass, particles, &s, v, s.way);
    }
    sum_up(&motion->speed2, s.square, n);
    take_places(single->spot + begin, particles, &s);
    go(pass, n, s.way, s.place);
    motion->travel =
        fmaxf(motion->travel, follow_flocks(pass, particles, single->built + at, &s,
                                            single->travel + begin / GB_F32_STATE_FLOCK));
    speed_up(pass, pass->kick_turn, n, s.torque, w, s.turn, s.square);
    if (slow) {
        keep_part(pass, particles, &s, w, s.turn);
    }
    sum_up(&motion->spin2, s.square, n);
    if (pass->turned) {
        add_to(pass->turned + at, s.turn, n);
    }
    give_spots(&s, particles, single->spot + begin);
}

GB_SIMD_LOOP void drive_block_loop(struct gb_world *world, const struct pass *pass,
                                   int64_t b)
{
    const int64_t begin = gb_sweep_block_begin(world->count, b);
    const int64_t end = gb_sweep_block_end(world->count, b);
    struct gb_sweep_block *block = &world->block[b];
    float travel = 0.0F;
    block->speed2 = 0.0;
    for (int64_t i = begin; i < end; i += SUMMED) {
        struct motion motion = {0};
        const int64_t stop = end - i < SUMMED ? end : i + SUMMED;
        for (int64_t k = i; k < stop; k += STRETCH) {
            if (world->count >= FETCHED && k + STRETCH < end) {
                fetch_stretch(world, k + STRETCH);
            }
            drive_stretch(world, pass, k, stop - k < STRETCH ? (int)(stop - k) : STRETCH,
                          &motion);
        }
        block->speed2 += sum_of(&motion.speed2);
        block->speed2 += (double)pass->inertia * sum_of(&motion.spin2);
        travel = fmaxf(travel, motion.travel);
    }
    /* places wrap around and can't tell what is not finite */
    block->travel = isfinite(block->speed2) ? (double)travel : (double)NAN;
}
GB_SIMD_WIDTHS(drive_block, (struct gb_world * world, const struct pass *pass, int64_t b),
               (world, pass, b))

/* All blocks, by the threads of the team that calls it; without one, by the caller. */
static void drive_blocks(struct gb_world *world, const struct pass *pass)
{
    const int64_t blocks = gb_sweep_blocks(world->count);
#pragma omp for schedule(static)
    for (int64_t b = 0; b < blocks; b++) {
        drive_block(world, pass, b);
    }
}

static void drive_all(struct gb_world *world, const struct pass *pass)
{
    if (world->threads > 1) {
#pragma omp parallel num_threads(world->threads)
        drive_blocks(world, pass);
    } else { /* a team of one would wait for itself */
        drive_blocks(world, pass);
    }
}

bool gb_integrate_f32_in_use(const struct gb_world *world)
{
    return world->in_single;
}

bool gb_integrate_f32_applies(const struct gb_model *model)
{
    return model->numerics.single;
}

void gb_integrate_f32_reset(struct gb_world *world)
{
    const size_t bytes = 3 * (size_t)world->count * sizeof *world->single.velocity;
    memset(world->single.velocity, 0, bytes);
    memset(world->single.spin, 0, bytes);
}

/* The same three numbers again and again. */
static void fill_axes(struct pass *pass, const struct gb_cell *cell)
{
    pass->grain = 0.0F;
    for (int c = 0; c < 3; c++) {
        const float units = (float)gb_f32_state_units(cell, c);
        const float scale = (float)gb_f32_state_d(cell, c);
        pass->grain += scale;
        for (int k = c; k < NUMBERS; k += 3) {
            pass->units[k] = units;
            pass->scale[k] = scale;
        }
    }
}

double gb_integrate_f32_step(struct gb_world *world, const struct gb_integrate_f32 *by,
                             float *turned)
{
    const double bound = by->most / by->step;
    struct pass pass = {.keep = (float)by->keep,
                        .back = (float)by->back,
                        .step = (float)by->step,
                        .kick = (float)by->kick,
                        .kick_turn = (float)(by->kick / by->inertia),
                        .inertia = (float)by->inertia,
                        .fresh = (float)gb_list_check_fresh(world),
                        .bounded = world->single.bounded,
                        .most2 = (float)(bound * bound),
                        .turned = turned};
    fill_axes(&pass, &world->cell);
    if (world->single.ahead == GB_F32_STATE_POSITIONS) {
        gb_sweep_f32_prepare(world, 0, world->count);
    }
    drive_all(world, &pass);
    double speed2 = 0.0;
    for (int64_t b = 0; b < gb_sweep_blocks(world->count); b++) {
        speed2 += world->block[b].speed2;
    }
    world->single.ahead = GB_F32_STATE_PLACES;
    world->single.driven = world->single.bounded = true;
    return speed2;
}
