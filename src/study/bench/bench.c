#include "study/bench/bench.h"

#include <gsl/gsl_fit.h>
#include <gsl/gsl_statistics.h>
#include <math.h>

#include <glib.h>

#include "base/clock.h"
#include "measure/observe.h"
#include "study/bench/bench_packing.h"

/* Batches of a round among several, and how long (s) a cell is timed in it at least: of a
 * small one a few batches say little. */
enum { ROUND_BATCHES = 9 };
static const double round_s = 0.2;

/* The same batches on another number of threads, from the same state. */
static bool time_on(const struct gb_model *model, int threads, int batches,
                    const struct gb_world_copy *copy, const double *position,
                    double *median, uint64_t *hash, struct gb_error *err)
{
    struct gb_model threaded = *model;
    threaded.numerics.threads = threads;
    struct gb_world *world = NULL;
    struct gb_relax *relax = NULL;
    const bool done = gb_world_create(&world, &threaded, position, err) &&
                      gb_relax_create(&relax, &threaded, err) &&
                      gb_world_copy_restore(world, copy, err) &&
                      gb_bench_packing_time(world, relax, batches, median, err);
    *hash = done ? gb_world_hash(world) : 0;
    gb_relax_destroy(relax);
    gb_world_destroy(world);
    return done;
}

/* On one core and on all of them; did both come to the same bits? */
static bool time_cores(const struct gb_bench_packing *pressed, int batches, double *one,
                       double *all, bool *same_bits, struct gb_error *err)
{
    const double *position = gb_world_position(pressed->world);
    uint64_t hash_one = 0, hash_all = 0;
    const bool done = time_on(&pressed->model, 1, batches, pressed->copy, position, one,
                              &hash_one, err) &&
                      time_on(&pressed->model, (int)g_get_num_processors(), batches,
                              pressed->copy, position, all, &hash_all, err);
    *same_bits = hash_one == hash_all;
    return done;
}

bool gb_bench_run(struct gb_bench *bench, const struct gb_params *params,
                  double coordination, struct gb_error *err)
{
    struct gb_bench_packing pressed;
    *bench = (struct gb_bench){.cores = (int)g_get_num_processors()};
    const bool done = gb_bench_packing_press(&pressed, params, coordination, err) &&
                      time_cores(&pressed, GB_BENCH_PACKING_BATCHES, &bench->evaluation_s,
                                 &bench->evaluation_all_s, &bench->same_bits, err) &&
                      gb_bench_state_run(&bench->state, params, pressed.copy, err);
    if (done) {
        bench->grow_s = pressed.grow_s;
        bench->coordination = pressed.coordination;
        bench->density = gb_observe_density(pressed.world);
        bench->bytes_per_particle = (double)pressed.bytes / (double)params->count;
    }
    gb_bench_packing_finish(&pressed);
    return done;
}

/* One of several sizes, and its times so far. */
struct growing {
    struct gb_bench_packing pressed;
    GArray *one, *all; /* of double, s */
};

static bool press_size(struct growing *growing, struct gb_bench_size *size,
                       const struct gb_params *params, double coordination,
                       struct gb_error *err)
{
    struct gb_params sized = *params;
    sized.count = size->count;
    const bool done =
        gb_bench_packing_press(&growing->pressed, &sized, coordination, err);
    size->coordination = growing->pressed.coordination;
    size->bytes_per_particle = (double)growing->pressed.bytes / (double)size->count;
    return done;
}

static bool time_round(struct growing *growing, struct gb_error *err)
{
    const double start = gb_clock_s();
    do {
        double one, all;
        bool same_bits;
        if (!time_cores(&growing->pressed, ROUND_BATCHES, &one, &all, &same_bits, err)) {
            return false;
        }
        if (!same_bits) {
            return gb_error_set(err, GB_ERR_GUARD, "other bits on one core than on all");
        }
        g_array_append_val(growing->one, one);
        g_array_append_val(growing->all, all);
    } while (gb_clock_s() - start < round_s);
    return true;
}

static double median_of(GArray *seconds)
{
    return gsl_stats_median((double *)(void *)seconds->data, 1, seconds->len);
}

bool gb_bench_growth_run(struct gb_bench_size *size, size_t sizes,
                         const struct gb_params *params, double coordination,
                         gb_bench_progress *tell, void *data, struct gb_error *err)
{
    struct growing *growing = g_new0(struct growing, sizes);
    bool done = true;
    for (size_t i = 0; i < sizes; i++) {
        growing[i].one = g_array_new(FALSE, FALSE, sizeof(double));
        growing[i].all = g_array_new(FALSE, FALSE, sizeof(double));
    }
    for (int round = 0; round <= GB_BENCH_ROUNDS; round++) {
        for (size_t i = 0; i < sizes && done; i++) {
            done = round == 0
                       ? press_size(&growing[i], &size[i], params, coordination, err)
                       : time_round(&growing[i], err);
            if (done && tell) {
                tell(data, size[i].count, round);
            }
        }
    }
    for (size_t i = 0; i < sizes; i++) {
        if (done) {
            size[i].evaluation_s = median_of(growing[i].one);
            size[i].evaluation_all_s = median_of(growing[i].all);
        }
        gb_bench_packing_finish(&growing[i].pressed);
        g_array_unref(growing[i].one);
        g_array_unref(growing[i].all);
    }
    g_free(growing);
    return done;
}

double gb_bench_exponent(const double *count, const double *cost, size_t n)
{
    double *x = g_new(double, n), *y = g_new(double, n);
    double constant, power, cov00, cov01, cov11, square;
    for (size_t i = 0; i < n; i++) {
        x[i] = log(count[i]);
        y[i] = log(cost[i]);
    }
    gsl_fit_linear(x, 1, y, 1, n, &constant, &power, &cov00, &cov01, &cov11, &square);
    g_free(x);
    g_free(y);
    return power;
}
