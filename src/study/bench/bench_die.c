#include "study/bench/bench_die.h"

#include <string.h>

#include <glib.h>
#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics.h>

#include "base/clock.h"
#include "greenbody/snapshot.h"
#include "measure/observe_die.h"
#include "pack/die/filling.h"
#include "solve/leapfrog.h"
#include "solve/loading/die/die_stages.h"

/* Batches timed in a round, and steps in each: the median counts.  On one thread processor time,
 * because other work on the machine comes and goes. */
enum { BATCHES = 3, BATCH = 400 };

/* A row of the table. */
struct row {
    const char *law;
    double mu;
    int threads;
    struct gb_bench_figure *figure;
};

/* P3's powder; the fall is shortened, since only the speed matters. */
static bool make_params(struct gb_params *params, const char *law, double mu,
                        struct gb_error *err)
{
    static const char *const assignment[] = {
        "scene.kind=die",
        "loading.geometry=die",
        "loading.until=50 MPa",
        "loading.time=2 us",
        "loading.ramp=quadratic",
        "loading.record_pressure=50 MPa",
        "material.young=180 GPa",
        "material.poisson=0.3",
        "material.density=5910 kg/m3",
        "material.hardening=0.1",
        "contact.damping=0.9",
        "particles.count=1751",
        "particles.diameter=4.65 um",
        "particles.distribution=lognormal",
        "particles.median=4.26 um",
        "particles.sigma=0.42",
        "particles.least=1.5 um",
        "particles.largest=18.5 um",
        "die.fill_gravity=4000000",
        "die.gravity=40000",
        "die.ease=2 us",
        "die.flatten=0 um",
    };
    gb_params_init(params);
    for (size_t i = 0; i < G_N_ELEMENTS(assignment); i++) {
        if (!gb_params_assign(params, assignment[i], err)) {
            return false;
        }
    }
    params->normal = strcmp(law, "hertz") == 0 ? GB_NORMAL_HERTZ : GB_NORMAL_STORAKERS;
    params->mu = mu;
    return gb_params_check(params, err);
}

static bool press(struct gb_die_stages *stages, struct gb_bed *bed, struct gb_error *err)
{
    char text[GB_EVENT_TEXT];
    enum gb_step_outcome how = GB_STEP_MORE;
    while (how == GB_STEP_MORE || how == GB_STEP_POINT) {
        how = gb_die_stages_advance(stages, bed, 100000, text, sizeof text, err);
    }
    return how == GB_STEP_DONE;
}

/* Median time of a step of a row, the punch standing still where it is. */
static bool time_row(struct gb_bed *bed, const struct row *row, double *seconds,
                     struct gb_error *err)
{
    double (*const clock_s)(void) = row->threads > 1 ? gb_clock_s : gb_clock_process_s;
    struct gb_params params;
    struct gb_leapfrog integrator;
    double batch[BATCHES];
    if (!make_params(&params, row->law, row->mu, err) ||
        !gb_bed_use_threads(bed, row->threads, err)) {
        return false;
    }
    const struct gb_bed_law frozen = gb_filling_compaction_law(&params);
    gb_bed_set_law(bed, &frozen);
    gb_leapfrog_init(&integrator, 0.5, 0.0);
    bed->die.punch_velocity = 0.0;
    for (int b = -1; b < BATCHES; b++) { /* the first one warms up */
        const double start = clock_s();
        for (int k = 0; k < BATCH; k++) {
            if (!gb_leapfrog_step(&integrator, bed, err)) {
                return false;
            }
        }
        batch[b < 0 ? 0 : b] = (clock_s() - start) / BATCH;
    }
    gsl_sort(batch, 1, BATCHES);
    *seconds = gsl_stats_median_from_sorted_data(batch, 1, BATCHES) / (double)bed->count;
    return true;
}

static bool time_rows(struct gb_bench_die *bench, struct gb_bed *bed,
                      struct gb_error *err)
{
    const int cores = (int)g_get_num_processors();
    const struct row row[] = {{"hertz", 0.0, 1, &bench->hertz},
                              {"hertz", 0.0, cores, &bench->hertz_all},
                              {"hertz", 0.05, 1, &bench->hertz_friction},
                              {"storakers", 0.0, 1, &bench->storakers},
                              {"storakers", 0.05, 1, &bench->storakers_friction}};
    double seconds[G_N_ELEMENTS(row)][GB_BENCH_ROUNDS];
    struct gb_contact_counts counts;
    gb_observe_die_contacts(bed, &counts, NULL, 0, NULL);
    bench->coordination = counts.coordination;
    bench->near = 2.0 * (double)bed->pairs.count / (double)bed->count;
    for (int round = 0; round < GB_BENCH_ROUNDS; round++) {
        for (size_t r = 0; r < G_N_ELEMENTS(row); r++) {
            if (!time_row(bed, &row[r], &seconds[r][round], err)) {
                return false;
            }
        }
    }
    for (size_t r = 0; r < G_N_ELEMENTS(row); r++) {
        *row[r].figure = gb_bench_figure_of(seconds[r], GB_BENCH_ROUNDS);
    }
    return true;
}

bool gb_bench_die_run(struct gb_bench_die *bench, struct gb_error *err)
{
    struct gb_params params;
    struct gb_model model;
    struct gb_bed *bed = NULL;
    struct gb_die_stages *stages = NULL;
    *bench = (struct gb_bench_die){0};
    bool done = make_params(&params, "hertz", 0.0, err) &&
                gb_model_init(&model, &params, err) &&
                gb_filling_create(&bed, &params, &model, NULL, NULL, err);
    if (done) {
        const struct gb_bed_law law = gb_filling_compaction_law(&params);
        done = gb_die_stages_create(&stages, &model.die, &law, err) &&
               press(stages, bed, err) && time_rows(bench, bed, err);
    }
    gb_die_stages_destroy(stages);
    gb_bed_destroy(bed);
    return done;
}
