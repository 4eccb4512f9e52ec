/* Times one evaluation (forces, torques, histories) with the move of the relaxer in pressed
 * periodic cells, on one core and on all of them.
 * Usage: time_cells [SIZES] [group.key=value]...
 * Without SIZES the rows are the scene as it is, with 1000 particles, in double precision,
 * and with many sizes.  SIZES is a list of particle numbers, "1000,8000,64000": a row for
 * each, and the power of the number that the cost grows with.  The exit status is 1 if the
 * state depends on the number of threads. */
#include <math.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>

#include <glib.h>
#include <gsl/gsl_fit.h>
#include <gsl/gsl_statistics.h>

#include "base/clock.h"
#include "base/team.h"
#include "bench.h"
#include "measure/observe.h"
#include "pack/kernel/simd.h"

/* A cell is timed in a round for at least this long (s): a few batches of a small cell say
 * little. */
static const double round_s = 0.2;
enum { BATCHES = 9, CELLS_MOST = 16, SAMPLES_MOST = 10000 };

/* One of the cells, and the median of each round, s. */
struct cell {
    const char *name;
    struct gb_params params;
    bool busy; /* also time it while another thread computes */
    struct packing packing;
    double one[ROUNDS], all[ROUNDS], all_busy[ROUNDS];
    bool same_bits; /* on one core and on all */
};

/* Times batches on a number of threads, from the pressed state. */
static bool time_on(const struct packing *packing, int threads, double *median,
                    uint64_t *hash, struct gb_error *err)
{
    struct gb_model model = packing->model;
    struct gb_world *world = NULL;
    struct gb_relax *relax = NULL;
    model.numerics.threads = threads;
    const bool good =
        gb_world_create(&world, &model, gb_world_position(packing->world), err) &&
        gb_relax_create(&relax, &model, err) &&
        gb_world_copy_restore(world, packing->copy, err) &&
        packing_time(world, relax, BATCHES, median, err);
    *hash = good ? gb_world_hash(world) : 0;
    gb_relax_destroy(relax);
    gb_world_destroy(world);
    return good;
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

static bool time_busy(const struct packing *packing, int threads, double *median,
                      struct gb_error *err)
{
    pthread_t other;
    atomic_bool over;
    uint64_t hash;
    atomic_init(&over, false);
    if (!gb_team_start_thread(&other, compute, &over, "the thread that keeps a core busy",
                              err)) {
        return false;
    }
    const bool good = time_on(packing, threads, median, &hash, err);
    atomic_store(&over, true);
    pthread_join(other, NULL);
    return good;
}

static bool time_round(struct cell *cell, int round, struct gb_error *err)
{
    static double one[SAMPLES_MOST], all[SAMPLES_MOST], busy[SAMPLES_MOST];
    const int cores = (int)g_get_num_processors();
    const double start = gb_clock_s();
    size_t n = 0;
    do {
        uint64_t on_one, on_all;
        if (!time_on(&cell->packing, 1, &one[n], &on_one, err) ||
            !time_on(&cell->packing, cores, &all[n], &on_all, err) ||
            (cell->busy && !time_busy(&cell->packing, cores, &busy[n], err))) {
            return false;
        }
        cell->same_bits = cell->same_bits && on_one == on_all;
        n++;
    } while (n < SAMPLES_MOST && gb_clock_s() - start < round_s);
    cell->one[round] = gsl_stats_median(one, 1, n);
    cell->all[round] = gsl_stats_median(all, 1, n);
    cell->all_busy[round] = cell->busy ? gsl_stats_median(busy, 1, n) : (double)NAN;
    return true;
}

static bool run(struct cell *cell, size_t cells, struct gb_error *err)
{
    for (size_t i = 0; i < cells; i++) {
        cell[i].same_bits = true;
        if (!packing_press(&cell[i].packing, &cell[i].params, err)) {
            return false;
        }
    }
    for (int round = 0; round < ROUNDS; round++) {
        for (size_t i = 0; i < cells; i++) {
            if (!time_round(&cell[i], round, err)) {
                return false;
            }
        }
    }
    return true;
}

/* --- the two sets of rows --------------------------------------------------------------- */

/* The log-normal law of p1-set2-lognormal about the diameter of the scene.  The scene stays
 * as it is if it has many sizes, or a contact law of one size. */
static bool make_sizes(struct gb_params *params, struct gb_error *err)
{
    struct gb_params sized = *params;
    char median[64], largest[64];
    g_snprintf(median, sizeof median, "particles.median=%.17g nm",
               0.969 * 1e9 * params->diameter_m);
    g_snprintf(largest, sizeof largest, "particles.largest=%.17g nm",
               2.06 * 1e9 * params->diameter_m);
    if (params->distribution != GB_DISTRIBUTION_MONO) {
        return true;
    }
    if (!gb_params_assign(&sized, "particles.distribution=lognormal", err) ||
        !gb_params_assign(&sized, median, err) ||
        !gb_params_assign(&sized, "particles.sigma=0.25", err) ||
        !gb_params_assign(&sized, largest, err)) {
        return false;
    }
    if (gb_params_check(&sized, NULL)) {
        *params = sized;
    }
    return true;
}

static bool plan_rows(struct cell *cell, size_t *cells, const struct gb_params *params,
                      struct gb_error *err)
{
    static const char *const name[] = {"the scene", "1000 particles", "double precision",
                                       "many sizes"};
    *cells = G_N_ELEMENTS(name);
    for (size_t i = 0; i < *cells; i++) {
        cell[i] = (struct cell){.name = name[i], .params = *params};
    }
    cell[0].busy = g_get_num_processors() > 1;
    cell[1].params.count = 1000;
    cell[2].params.precision = GB_PRECISION_DOUBLE;
    return make_sizes(&cell[3].params, err);
}

static bool plan_sizes(struct cell *cell, size_t *cells, const struct gb_params *params,
                       const char *list, struct gb_error *err)
{
    char **word = g_strsplit(list, ",", CELLS_MOST + 1);
    *cells = g_strv_length(word);
    bool good = *cells >= 2 && *cells <= CELLS_MOST;
    for (size_t i = 0; good && i < *cells; i++) {
        cell[i] = (struct cell){.params = *params};
        good = g_ascii_string_to_signed(word[i], 10, 10, 10000000, &cell[i].params.count,
                                        NULL) &&
               (i == 0 || cell[i].params.count > cell[i - 1].params.count);
    }
    g_strfreev(word);
    return good || gb_error_set(err, GB_ERR_INPUT,
                                "%s: expected 2 to %d growing numbers of particles from "
                                "10 to 10000000",
                                list, CELLS_MOST);
}

static void print_rows(struct cell *cell, size_t cells)
{
    const struct packing *scene = &cell[0].packing;
    print_fact("particles", (double)scene->model.count, "");
    print_fact("cores", (double)g_get_num_processors(), "");
    print_fact("initial structure", scene->grow_s, "s");
    print_fact("timed at coordination", scene->coordination, "");
    print_fact("timed at density", gb_observe_density(scene->world), "");
    print_fact("memory", (double)scene->bytes / (double)scene->model.count,
               "bytes per particle");
    for (size_t i = 0; i < cells; i++) {
        const double micro = 1e6 / (double)cell[i].params.count;
        char name[64];
        g_snprintf(name, sizeof name, "%s on one core", cell[i].name);
        print_figure(name, figure_of(cell[i].one), micro, "us per particle");
        g_snprintf(name, sizeof name, "%s on all cores", cell[i].name);
        print_figure(name, figure_of(cell[i].all), micro, "us per particle");
        g_snprintf(name, sizeof name, "%s on all cores, one of them busy", cell[i].name);
        print_figure(name, figure_of(cell[i].all_busy), micro, "us per particle");
    }
}

/* b of cost ~ count^b, by least squares of the logarithms. */
static double exponent(const double *count, const double *cost, size_t n)
{
    double x[CELLS_MOST] = {0}, y[CELLS_MOST] = {0}, constant, power, cov[3], square;
    for (size_t i = 0; i < n; i++) {
        x[i] = log(count[i]);
        y[i] = log(cost[i]);
    }
    gsl_fit_linear(x, 1, y, 1, n, &constant, &power, &cov[0], &cov[1], &cov[2], &square);
    return power;
}

static void print_sizes(struct cell *cell, size_t cells)
{
    double count[CELLS_MOST], one[CELLS_MOST], all[CELLS_MOST];
    printf(" particles   coordination   one core   all cores, us   bytes per particle\n");
    for (size_t i = 0; i < cells; i++) {
        const struct packing *packing = &cell[i].packing;
        count[i] = (double)cell[i].params.count;
        one[i] = figure_of(cell[i].one).value;
        all[i] = figure_of(cell[i].all).value;
        printf("%10.0f   %12.4g   %8.4g   %13.4g   %18.4g\n", count[i],
               packing->coordination, 1e6 * one[i] / count[i], 1e6 * all[i] / count[i],
               (double)packing->bytes / count[i]);
    }
    printf("exponent of the cost        %8.3f   %13.3f\n", exponent(count, one, cells),
           exponent(count, all, cells));
}

int main(int argc, char **argv)
{
    struct gb_error err = {0};
    struct gb_params params;
    static struct cell cell[CELLS_MOST];
    size_t cells = 0;
    g_set_prgname("time_cells");
    const char *sizes = argc > 1 && !strchr(argv[1], '=') ? argv[1] : NULL;
    bool same_bits = true;
    const bool good = make_scene(&params, argv + (sizes ? 2 : 1), &err) &&
                      (sizes ? plan_sizes(cell, &cells, &params, sizes, &err)
                             : plan_rows(cell, &cells, &params, &err)) &&
                      run(cell, cells, &err);
    if (good) {
        printf("vectors: %s\n", gb_simd_name(gb_simd_width(0)));
        (sizes ? print_sizes : print_rows)(cell, cells);
    }
    for (size_t i = 0; i < cells; i++) {
        same_bits = same_bits && (!good || cell[i].same_bits);
        packing_finish(&cell[i].packing);
    }
    if (!same_bits) {
        fputs("time_cells: the state depends on the number of threads\n", stderr);
        return 1;
    }
    return finish(good, &err);
}
