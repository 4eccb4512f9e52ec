/* Times the bed of P3 in its die, 1751 spheres at 50 MPa, with every contact law: one step
 * (forces, histories, motion) per sphere.
 * Usage: time_die */
#include <stdio.h>
#include <string.h>

#include <glib.h>
#include <gsl/gsl_statistics.h>

#include "bench.h"
#include "greenbody/snapshot.h"
#include "measure/observe.h"
#include "pack/die/filling.h"
#include "solve/loading/die/die_stages.h"
#include "solve/loading/die/die_state.h"

/* Batches of a round, of which the median counts, and steps of a batch. */
enum { BATCHES = 3, BATCH = 400 };

/* A row of the table. */
struct row {
    const char *name, *law;
    double mu;
    int threads;
    double seconds[ROUNDS]; /* per sphere and step */
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

/* Median time of a step of a row, while the punch stands still. */
static bool time_row(struct gb_bed *bed, const struct row *row, double *seconds,
                     struct gb_error *err)
{
    struct gb_params params;
    struct gb_leapfrog integrator;
    double batch[BATCHES];
    if (!make_params(&params, row->law, row->mu, err) ||
        !gb_bed_use_threads(bed, row->threads, err)) {
        return false;
    }
    const struct gb_bed_law frozen = gb_filling_compaction_law(&params);
    gb_bed_set_law(bed, &frozen);
    gb_die_state_leapfrog_init(&integrator, 0.5, 0.0);
    bed->die.punch_velocity = 0.0;
    for (int b = -1; b < BATCHES; b++) { /* the first one warms up */
        const double start = now_s(row->threads);
        for (int k = 0; k < BATCH; k++) {
            if (!gb_die_state_leapfrog_step(&integrator, bed, err)) {
                return false;
            }
        }
        batch[b < 0 ? 0 : b] = (now_s(row->threads) - start) / BATCH;
    }
    *seconds = gsl_stats_median(batch, 1, BATCHES) / (double)bed->count;
    return true;
}

static bool time_rows(struct gb_bed *bed, struct gb_error *err)
{
    const int cores = (int)g_get_num_processors();
    struct row row[] = {{"Hertz on one core", "hertz", 0.0, 1, {0}},
                        {"Hertz on all cores", "hertz", 0.0, cores, {0}},
                        {"Hertz with friction", "hertz", 0.05, 1, {0}},
                        {"Storakers", "storakers", 0.0, 1, {0}},
                        {"Storakers with friction", "storakers", 0.05, 1, {0}}};
    struct gb_contact_counts counts;
    gb_observe_die_contacts(bed, &counts, NULL, 0, NULL);
    print_fact("timed at coordination", counts.coordination, "");
    for (int round = 0; round < ROUNDS; round++) {
        for (size_t r = 0; r < G_N_ELEMENTS(row); r++) {
            if (!time_row(bed, &row[r], &row[r].seconds[round], err)) {
                return false;
            }
        }
    }
    for (size_t r = 0; r < G_N_ELEMENTS(row); r++) {
        print_figure(row[r].name, figure_of(row[r].seconds), 1e6,
                     "us per sphere and step");
    }
    return true;
}

int main(void)
{
    struct gb_error err = {0};
    struct gb_params params;
    struct gb_model model;
    struct gb_bed *bed = NULL;
    struct gb_die_stages *stages = NULL;
    g_set_prgname("time_die");
    bool good = make_params(&params, "hertz", 0.0, &err) &&
                gb_model_init(&model, &params, &err) &&
                gb_filling_create(&bed, &params, &model, NULL, NULL, &err);
    if (good) {
        const struct gb_bed_law law = gb_filling_compaction_law(&params);
        good = gb_die_stages_create(&stages, &model.die, &law, &err) &&
               press(stages, bed, &err) && time_rows(bed, &err);
    }
    gb_die_stages_destroy(stages);
    gb_bed_destroy(bed);
    return finish(good, &err);
}
