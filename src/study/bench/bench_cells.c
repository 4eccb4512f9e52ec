#include "study/bench/bench_cells.h"

#include <math.h>
#include <stdatomic.h>

#include <glib.h>
#include <gsl/gsl_statistics.h>

#include "base/clock.h"
#include "base/thread.h"
#include "measure/observe.h"
#include "study/bench/bench_packing.h"

/* Batches of a round, and how long (s) a cell is timed in it at least: of a small one a few
 * batches say little. */
enum { BATCHES = 9 };
static const double round_s = 0.2;

/* One of the cells, and its times: a median per round. */
struct timed {
    struct gb_bench_packing pressed;
    double one[GB_BENCH_ROUNDS], all[GB_BENCH_ROUNDS], all_busy[GB_BENCH_ROUNDS];
};

static bool press(struct timed *timed, struct gb_bench_cell *cell, double coordination,
                  struct gb_error *err)
{
    struct gb_bench_packing *pressed = &timed->pressed;
    if (!gb_bench_packing_press(pressed, &cell->params, coordination, err)) {
        return false;
    }
    cell->grow_s = pressed->grow_s;
    cell->coordination = pressed->coordination;
    cell->density = gb_observe_density(pressed->world);
    cell->bytes_per_particle = (double)pressed->bytes / (double)cell->params.count;
    cell->same_bits = true;
    return !cell->state ||
           gb_bench_state_run(cell->state, &cell->params, pressed->copy, err);
}

/* The same batches on a number of threads, from the same state. */
static bool time_on(const struct gb_bench_packing *pressed, int threads, double *median,
                    uint64_t *hash, struct gb_error *err)
{
    struct gb_model threaded = pressed->model;
    struct gb_world *world = NULL;
    struct gb_relax *relax = NULL;
    threaded.numerics.threads = threads;
    const bool done =
        gb_world_create(&world, &threaded, gb_world_position(pressed->world), err) &&
        gb_relax_create(&relax, &threaded, err) &&
        gb_world_copy_restore(world, pressed->copy, err) &&
        gb_bench_packing_time(world, relax, BATCHES, median, err);
    *hash = done ? gb_world_hash(world) : 0;
    gb_relax_destroy(relax);
    gb_world_destroy(world);
    return done;
}

/* Computes until it is told to end. */
static void *compute(void *data)
{
    const atomic_bool *over = data;
    volatile double sum = 0.0;
    while (!atomic_load(over)) {
        for (int i = 1; i < 1000; i++) {
            sum = sum + 1.0 / i;
        }
    }
    return NULL;
}

static bool time_busy(const struct gb_bench_packing *pressed, int threads, double *median,
                      struct gb_error *err)
{
    pthread_t other;
    atomic_bool over;
    uint64_t hash;
    atomic_init(&over, false);
    if (!gb_thread_start(&other, compute, &over, "the thread that keeps a core busy",
                         err)) {
        return false;
    }
    const bool done = time_on(pressed, threads, median, &hash, err);
    atomic_store(&over, true);
    pthread_join(other, NULL);
    return done;
}

/* Times of one round, repeated until it is long enough. */
struct sample {
    double one, all, all_busy;
};

static bool take_sample(const struct timed *timed, struct gb_bench_cell *cell,
                        struct sample *sample, struct gb_error *err)
{
    const int cores = (int)g_get_num_processors();
    uint64_t on_one = 0, on_all = 0;
    sample->all_busy = NAN;
    if (!time_on(&timed->pressed, 1, &sample->one, &on_one, err) ||
        !time_on(&timed->pressed, cores, &sample->all, &on_all, err)) {
        return false;
    }
    cell->same_bits = cell->same_bits && on_one == on_all;
    return !cell->busy || time_busy(&timed->pressed, cores, &sample->all_busy, err);
}

static double median_of(GArray *samples, size_t member)
{
    const struct sample *sample = (const struct sample *)(void *)samples->data;
    const size_t stride = sizeof *sample / sizeof(double);
    double *copy = g_new(double, samples->len);
    for (guint i = 0; i < samples->len; i++) {
        copy[i] = ((const double *)sample)[i * stride + member];
    }
    const double median = gsl_stats_median(copy, 1, samples->len);
    g_free(copy);
    return median;
}

static bool time_round(struct timed *timed, struct gb_bench_cell *cell, int round,
                       struct gb_error *err)
{
    GArray *samples = g_array_new(FALSE, FALSE, sizeof(struct sample));
    const double start = gb_clock_s();
    bool good = true;
    do {
        struct sample sample;
        good = take_sample(timed, cell, &sample, err);
        g_array_append_val(samples, sample);
    } while (good && gb_clock_s() - start < round_s);
    if (good) {
        timed->one[round] = median_of(samples, 0);
        timed->all[round] = median_of(samples, 1);
        timed->all_busy[round] = cell->busy ? median_of(samples, 2) : (double)NAN;
    }
    g_array_unref(samples);
    return good;
}

bool gb_bench_cells_run(struct gb_bench_cell *cell, size_t cells, double coordination,
                        gb_bench_progress *tell, void *data, struct gb_error *err)
{
    struct timed *timed = g_new0(struct timed, cells);
    bool done = true;
    for (int round = 0; round <= GB_BENCH_ROUNDS; round++) {
        for (size_t i = 0; i < cells && done; i++) {
            done = round == 0 ? press(&timed[i], &cell[i], coordination, err)
                              : time_round(&timed[i], &cell[i], round - 1, err);
            if (done && tell) {
                tell(data, &cell[i], round);
            }
        }
    }
    for (size_t i = 0; i < cells; i++) {
        if (done) {
            cell[i].one = gb_bench_figure_of(timed[i].one, GB_BENCH_ROUNDS);
            cell[i].all = gb_bench_figure_of(timed[i].all, GB_BENCH_ROUNDS);
            cell[i].all_busy = gb_bench_figure_of(timed[i].all_busy, GB_BENCH_ROUNDS);
        }
        gb_bench_packing_finish(&timed[i].pressed);
    }
    g_free(timed);
    return done;
}
