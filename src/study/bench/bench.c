#include "study/bench/bench.h"

#include <gsl/gsl_fit.h>
#include <gsl/gsl_statistics.h>
#include <math.h>
#include <string.h>

#include <glib.h>

#include "base/alloc.h"
#include "base/clock.h"
#include "measure/observe.h"
#include "pack/cell/world.h"
#include "pack/structure/chain_growth.h"
#include "pack/structure/hilbert.h"
#include "run/experiment.h"
#include "scene/loading_kind.h"
#include "scene/model.h"
#include "solve/relax/relax.h"

/* Batches timed, and evaluations in each: the median of the batches is what counts,
 * because other work on the machine comes and goes. */
enum { BATCHES = 15, BATCH = 24 };

/* Batches of a round among several, and how long (s) a cell is timed in it at least: of a
 * small one a few batches say little. */
enum { ROUND_BATCHES = 9 };
static const double round_s = 0.2;

/* Strain steps on the way to the wanted coordination number, and where to give up. */
static const double press_step = 0.01, bench_step = 0.001;
enum { PRESS_MOST = 200 };

/* On one core it is processor time that counts, which other work on the machine does not
 * lengthen; on several it is the wall clock. */
enum clock { PROCESSOR_TIME, WALL_CLOCK };

static double now(enum clock clock)
{
    return clock == PROCESSOR_TIME ? gb_clock_process_s() : gb_clock_s();
}

static bool grow(struct gb_world **world, const struct gb_model *model, double *seconds,
                 struct gb_error *err)
{
    double *position = gb_alloc_array(3 * (size_t)model->count, sizeof *position, err);
    if (!position) {
        return false;
    }
    const struct gb_chain_growth order = gb_chain_growth_from_model(model);
    const double start = gb_clock_s();
    const bool done = gb_chain_growth_run(&order, position, err);
    *seconds = gb_clock_s() - start;
    const bool made = done && gb_hilbert_sort(model, position, err) &&
                      gb_world_create(world, model, position, err);
    gb_alloc_free(position);
    return made;
}

static void squeeze(struct gb_world *world, struct gb_relax *relax, double step)
{
    const double factor[3] = {1.0, 1.0, 1.0 - step};
    gb_world_strain(world, factor);
    gb_relax_start(relax, world);
}

static bool press(struct gb_world *world, struct gb_relax *relax, double coordination,
                  struct gb_error *err)
{
    for (int step = 0; step < PRESS_MOST; step++) {
        if (gb_relax_advance(relax, world, relax->max_evaluations, err) ==
            GB_RELAX_FAILED) {
            return false;
        }
        struct gb_contact_counts counts;
        gb_observe_contacts(world, &counts, NULL, 0, NULL);
        if (counts.coordination >= coordination) {
            return true;
        }
        squeeze(world, relax, press_step);
    }
    return gb_error_set(err, GB_ERR_GUARD, "coordination %g: not reached", coordination);
}

/* Median time of one evaluation with its move.  The tolerance is out of reach, so that
 * every batch has its full length. */
static bool time_batches(struct gb_world *world, struct gb_relax *relax, int batches,
                         double *median, struct gb_error *err)
{
    double seconds[BATCHES];
    const enum clock clock =
        gb_world_model(world)->numerics.threads == 1 ? PROCESSOR_TIME : WALL_CLOCK;
    relax->tolerance = 0.0;
    for (int batch = 0; batch < batches; batch++) {
        squeeze(world, relax, bench_step);
        const double start = now(clock);
        if (gb_relax_advance(relax, world, BATCH, err) == GB_RELAX_FAILED) {
            return false;
        }
        seconds[batch] = (now(clock) - start) / BATCH;
    }
    *median = gsl_stats_median(seconds, 1, (size_t)batches);
    return true;
}

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
                      time_batches(world, relax, batches, median, err);
    *hash = done ? gb_world_hash(world) : 0;
    gb_relax_destroy(relax);
    gb_world_destroy(world);
    return done;
}

/* A packing that was pressed, and what it is timed with. */
struct pressed {
    struct gb_model model;
    struct gb_world *world;
    struct gb_world_copy *copy;
    double grow_s, coordination;
    size_t bytes; /* held by world and relaxer */
};

static bool make_pressed(struct pressed *pressed, const struct gb_params *params,
                         double coordination, struct gb_error *err)
{
    struct gb_relax *relax = NULL;
    struct gb_contact_counts counts;
    const size_t before = gb_alloc_bytes();
    *pressed = (struct pressed){0};
    const bool done =
        gb_loading_kind_check_cell(params, "the benchmark of one preset", err) &&
        gb_model_init(&pressed->model, params, err) &&
        grow(&pressed->world, &pressed->model, &pressed->grow_s, err) &&
        gb_relax_create(&relax, &pressed->model, err) &&
        (gb_relax_start(relax, pressed->world), true) &&
        press(pressed->world, relax, coordination, err) &&
        gb_world_copy_save(pressed->world, &pressed->copy, err);
    if (done) {
        gb_observe_contacts(pressed->world, &counts, NULL, 0, NULL);
        pressed->coordination = counts.coordination;
        pressed->bytes = gb_alloc_bytes() - before;
    }
    gb_relax_destroy(relax);
    return done;
}

static void finish_pressed(struct pressed *pressed)
{
    gb_world_copy_destroy(pressed->copy);
    gb_world_destroy(pressed->world);
}

/* On one core and on all of them; did both come to the same bits? */
static bool time_cores(const struct pressed *pressed, int batches, double *one,
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
    struct pressed pressed;
    *bench = (struct gb_bench){.cores = (int)g_get_num_processors()};
    const bool done = make_pressed(&pressed, params, coordination, err) &&
                      time_cores(&pressed, BATCHES, &bench->evaluation_s,
                                 &bench->evaluation_all_s, &bench->same_bits, err) &&
                      gb_bench_state_run(&bench->state, params, pressed.copy, err);
    if (done) {
        bench->grow_s = pressed.grow_s;
        bench->coordination = pressed.coordination;
        bench->density = gb_observe_density(pressed.world);
        bench->bytes_per_particle = (double)pressed.bytes / (double)params->count;
    }
    finish_pressed(&pressed);
    return done;
}

/* One of several sizes, and its times so far. */
struct growing {
    struct pressed pressed;
    GArray *one, *all; /* of double, s */
};

static bool press_size(struct growing *growing, struct gb_bench_size *size,
                       const struct gb_params *params, double coordination,
                       struct gb_error *err)
{
    struct gb_params sized = *params;
    sized.count = size->count;
    const bool done = make_pressed(&growing->pressed, &sized, coordination, err);
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
        finish_pressed(&growing[i].pressed);
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

/* Changes of the contact law, as bits. */
enum change {
    NO_BRIDGES = 1,
    NO_FRICTION = 2, /* a friction law without friction has no bridges */
    NO_ATTRACTION = 4,
    NO_COHESION = 8 /* Hertz, Mindlin and Coulomb only */
};

/* What a packing is timed without. */
struct variant {
    const char *name;
    unsigned changes; /* enum change */
};

static const struct variant variants[GB_BENCH_TERMS] = {
    {"all terms", 0},
    {"without bridges", NO_BRIDGES},
    {"without friction and bridges", NO_BRIDGES | NO_FRICTION},
    {"without attraction", NO_ATTRACTION},
    {"grains without cohesion", NO_BRIDGES | NO_ATTRACTION | NO_COHESION},
    {"elastic spheres only", NO_BRIDGES | NO_FRICTION | NO_ATTRACTION},
};

static bool keeps(const struct variant *variant, enum change change)
{
    return (variant->changes & change) == 0;
}

static bool leave_out(struct gb_params *params, const struct variant *variant,
                      struct gb_error *err)
{
    return (keeps(variant, NO_COHESION) ||
            gb_params_assign(params, "contact.normal=hertz", err)) &&
           (keeps(variant, NO_BRIDGES) ||
            gb_params_assign(params, "contact.bridge_length=1 d", err)) &&
           (keeps(variant, NO_FRICTION) ||
            (gb_params_assign(params, "contact.mu=0", err) &&
             gb_params_assign(params, "contact.mu_pivot=0", err))) &&
           (keeps(variant, NO_ATTRACTION) ||
            gb_params_assign(params, "material.epsilon=0 kB", err));
}

/* The packing as pressed, under another law. */
static bool time_variant(const struct gb_world *pressed, const struct gb_params *params,
                         const struct variant *variant, double *median,
                         struct gb_error *err)
{
    struct gb_params changed = *params;
    struct gb_model model;
    struct gb_world *world = NULL;
    struct gb_relax *relax = NULL;
    changed.threads = 1;
    if (!leave_out(&changed, variant, err) || !gb_model_init(&model, &changed, err)) {
        return false;
    }
    const struct gb_terms *carried = &gb_world_model(pressed)->terms;
    if ((!keeps(variant, NO_BRIDGES) && !carried->bridges) ||
        (!keeps(variant, NO_FRICTION) && !carried->friction) ||
        (!keeps(variant, NO_ATTRACTION) && !carried->attraction)) {
        *median = NAN;
        return true;
    }
    memcpy(model.edges, gb_world_cell(pressed)->edge, sizeof model.edges);
    const bool done = gb_world_create(&world, &model, gb_world_position(pressed), err) &&
                      gb_relax_create(&relax, &model, err) &&
                      time_batches(world, relax, BATCHES, median, err);
    gb_relax_destroy(relax);
    gb_world_destroy(world);
    return done;
}

bool gb_bench_terms(struct gb_bench_term term[GB_BENCH_TERMS],
                    const struct gb_params *params, double coordination,
                    struct gb_error *err)
{
    struct pressed pressed;
    bool done = make_pressed(&pressed, params, coordination, err);
    for (int i = 0; i < GB_BENCH_TERMS && done; i++) {
        term[i].name = variants[i].name;
        done =
            time_variant(pressed.world, params, &variants[i], &term[i].evaluation_s, err);
    }
    finish_pressed(&pressed);
    return done;
}

static bool planar_params(struct gb_params *params, struct gb_error *err)
{
    static const char *const assignment[] = {
        "scene.kind=dynamic",         "scene.dimension=2",
        "particles.count=1000",       "contact.mu=0.5",
        "loading.geometry=isotropic", "loading.until=density = 0.91",
        "loading.relax=0.5 ns",       "loading.hold=0 ns",
        "loading.rate=6.8e8 1/s",     "numerics.time_step=0.04 T",
        "numerics.threads=1",
    };
    gb_params_init(params);
    for (size_t i = 0; i < G_N_ELEMENTS(assignment); i++) {
        if (!gb_params_assign(params, assignment[i], err)) {
            return false;
        }
    }
    return true;
}

bool gb_bench_planar(double *particle_steps_per_s, struct gb_error *err)
{
    const double from = 0.89;
    struct gb_params params;
    struct gb_experiment *experiment = NULL;
    if (!planar_params(&params, err) ||
        !gb_experiment_create(&experiment, &params, NULL, NULL, err)) {
        return false;
    }
    double seconds = 0.0;
    int64_t steps = 0;
    enum gb_step_outcome how = GB_STEP_MORE;
    while (how == GB_STEP_MORE || how == GB_STEP_POINT) {
        const struct gb_point *point = gb_experiment_point(experiment);
        const bool timed = point->branch == GB_BRANCH_LOAD && point->density >= from;
        const double start = now(PROCESSOR_TIME);
        how = gb_experiment_advance(experiment, 1000, err);
        if (timed && how == GB_STEP_POINT) {
            seconds += now(PROCESSOR_TIME) - start;
            steps += point->evaluations;
        }
    }
    gb_experiment_destroy(experiment);
    *particle_steps_per_s = (double)(steps * params.count) / seconds;
    return how == GB_STEP_DONE;
}
