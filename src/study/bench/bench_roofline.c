#include "study/bench/bench_roofline.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/clock.h"
#include "pack/cell/world.h"
#include "pack/f32/f32_state.h"
#include "pack/kernel/simd.h"
#include "study/bench/bench_packing.h"

enum { BATCHES = 9 };

/* Flops of the loops of batch_3d.h and batch_far.h per pair in single precision, counted in
 * the instructions of their AVX-512 variants (both halves of `advance`; `attract`). */
struct count {
    double near[3]; /* normal forces only, friction, friction and bridges */
    double far;
};
static const struct count equal_count = {{65.0, 248.0, 340.0}, 18.0};
static const struct count sized_count = {{101.0, 312.0, 420.0}, 36.0};

/* Per particle, integrate_f32.c and the sums of sweep_f32.c: six numbers of a wrench
 * squared and multiplied with a velocity; velocity, displacement, square, position and
 * bound of six numbers.  Per near pair, the sums of both wrenches. */
static const double particle_flops = 6.0 * 4.0 + 6.0 * 9.0, pair_flops = 2.0 * 6.0;

static double flops_of(const struct gb_model *model, double near, double far)
{
    const struct count *count = model->polydisperse ? &sized_count : &equal_count;
    const int law = model->terms.bridges ? 2 : model->terms.friction ? 1 : 0;
    return near * (count->near[law] + pair_flops) + far * (count->far + 6.0) +
           particle_flops;
}

/* A near pair: its record read and written, three indices.  A far pair: three indices.  A
 * particle: its row read and written, its wrench written by the sweep and read by the
 * move, velocity and spin read and written, start of its pairs and of its rows in both lists. */
static double bytes_of(const struct gb_world *world, double near, double far)
{
    const double number = sizeof(float), index = sizeof(int32_t);
    const int planes = gb_world_contacts(world)->planes;
    const double sizes = gb_world_diameters(world) ? sizeof(double) : 0.0;
    return near * (2.0 * planes * number + 3.0 * index) + far * 3.0 * index +
           2.0 * sizeof(struct gb_f32_particle) + 2.0 * GB_WRENCH_ROWS_WIDTH * number +
           2.0 * 6.0 * number + 2.0 * sizeof(int64_t) + 2.0 * index + sizes;
}

/* Independent chains, twice as many as units times latency would need; the start values
 * and factors keep the numbers normal. */
enum { CHAINS = 256, PEAK_PASSES = 200 };

GB_SIMD_LOOP void peak_loop(float *restrict a, float *restrict b, int passes)
{
    for (int pass = 0; pass < passes; pass++) {
#pragma GCC unroll 4
        for (int k = 0; k < CHAINS; k++) {
            float x = a[k], y = b[k];
            for (int i = 0; i < 16; i++) { /* in registers */
                x = x * 0.999F;
                y = y + 1e-3F;
            }
            a[k] = x;
            b[k] = y;
        }
    }
}
GB_SIMD_WIDTHS(peak, (float *a, float *b, int passes), (a, b, passes))

static double measure_peak(void)
{
    static float a[CHAINS], b[CHAINS];
    double least = INFINITY;
    for (int k = 0; k < CHAINS; k++) {
        a[k] = b[k] = 1.0F;
    }
    for (int batch = 0; batch < BATCHES; batch++) {
        const double start = gb_clock_process_s();
        peak(a, b, PEAK_PASSES);
        least = fmin(least, gb_clock_process_s() - start);
    }
    return 2.0 * 16.0 * CHAINS * PEAK_PASSES / least;
}

/* Bytes read and written per second by copies of half of `bytes` to the other half. */
static double measure_copy(char *buffer, size_t bytes)
{
    const size_t half = bytes / 2;
    const int copies = half > ((size_t)1 << 24) ? 1 : (int)(((size_t)1 << 25) / half) + 1;
    double least = INFINITY;
    for (int batch = 0; batch < BATCHES; batch++) {
        const double start = gb_clock_process_s();
        for (int c = 0; c < copies; c++) {
            char *to = buffer + (c % 2 ? 0 : half), *from = buffer + (c % 2 ? half : 0);
            memcpy(to, from, half);
            __asm__ volatile("" : : "r"(to) : "memory");
        }
        least = fmin(least, gb_clock_process_s() - start);
    }
    return 2.0 * (double)half * copies / least;
}

static bool measure(struct gb_bench_roofline *roofline,
                    const struct gb_bench_packing *pressed, char *buffer, size_t room,
                    struct gb_error *err)
{
    double seconds[GB_BENCH_ROUNDS], flops[GB_BENCH_ROUNDS], copy[GB_BENCH_ROUNDS],
        memory[GB_BENCH_ROUNDS];
    const double count = (double)pressed->model.count;
    struct gb_model single = pressed->model;
    size_t touched = (size_t)(roofline->bytes * count);
    touched = touched < room ? touched : room;
    single.numerics.threads = 1;
    for (int round = 0; round < GB_BENCH_ROUNDS; round++) {
        struct gb_world *world = NULL;
        struct gb_relax *relax = NULL;
        const bool timed =
            gb_world_create(&world, &single, gb_world_position(pressed->world), err) &&
            gb_relax_create(&relax, &single, err) &&
            gb_world_copy_restore(world, pressed->copy, err) &&
            gb_bench_packing_time(world, relax, BATCHES, &seconds[round], err);
        gb_relax_destroy(relax);
        gb_world_destroy(world);
        if (!timed) {
            return false;
        }
        seconds[round] /= count;
        flops[round] = measure_peak();
        copy[round] = measure_copy(buffer, touched);
        memory[round] = measure_copy(buffer, room);
    }
    roofline->evaluation = gb_bench_figure_of(seconds, GB_BENCH_ROUNDS);
    roofline->peak = gb_bench_figure_of(flops, GB_BENCH_ROUNDS);
    roofline->bandwidth = gb_bench_figure_of(copy, GB_BENCH_ROUNDS);
    roofline->memory = gb_bench_figure_of(memory, GB_BENCH_ROUNDS);
    return true;
}

/* Counts hold for these kernels only. */
static bool check_scene(const struct gb_params *params, struct gb_error *err)
{
    struct gb_model model;
    if (!gb_model_init(&model, params, err)) {
        return false;
    }
    return (model.numerics.single && !model.terms.plain) ||
           gb_error_set(err, GB_ERR_INPUT,
                        "--roofline: accepted a scene in single precision with "
                        "contact.normal = rod");
}

bool gb_bench_roofline_run(struct gb_bench_roofline *roofline,
                           const struct gb_params *params, double coordination,
                           struct gb_error *err)
{
    enum { ROOM = 1 << 28 };
    struct gb_bench_packing pressed = {0};
    if (!check_scene(params, err)) {
        return false;
    }
    char *buffer = gb_alloc_array(ROOM, 1, err);
    bool done = buffer && gb_bench_packing_press(&pressed, params, coordination, err);
    if (done) {
        const struct gb_neighbour_list *list = gb_world_pairs(pressed.world);
        const double count = (double)params->count;
        memset(buffer, 1, ROOM); /* pages exist */
        roofline->near = (double)list->near.pair_count / count;
        roofline->far = (double)list->far.pair_count / count;
        roofline->flops = flops_of(&pressed.model, roofline->near, roofline->far);
        roofline->bytes = bytes_of(pressed.world, roofline->near, roofline->far);
        done = measure(roofline, &pressed, buffer, ROOM, err);
    }
    gb_bench_packing_finish(&pressed);
    gb_alloc_free(buffer);
    return done;
}

double gb_bench_roofline_least_s(const struct gb_bench_roofline *roofline)
{
    return fmax(roofline->flops / roofline->peak.value,
                roofline->bytes / roofline->bandwidth.value);
}
