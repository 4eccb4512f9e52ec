#include <math.h>
#include <string.h>

#include <glib.h>

#include "base/clock.h"
#include "greenbody/snapshot.h"
#include "io/preset.h"
#include "measure/observe.h"
#include "pack/die/bed_record.h"
#include "pack/die/filling.h"
#include "solve/loading/die/die_stages.h"

/* The targets of P3's experiment: three beds, each filled once and pressed by every
 * model, as many again by the frictionless ones only, and more by the frictionless ones at
 * `fast`: the difference of two laws scatters by 0.0013 from bed to bed, and they are allowed
 * 0.003.  Prints the table. */

enum { BEDS = 3, COMPARED = 6, OF_LAWS = 18, MARKS = 4 };

static const double marks_mpa[MARKS] = {2.0, 10.0, 25.0, 50.0};

struct model {
    const char *preset, *change; /* one key changed, NULL: none */
};

static const struct model models[] = {
    {"p3-hertz-mu0", "numerics.fidelity=fast"},
    {"p3-storakers-m0-mu0", "numerics.fidelity=fast"},
    {"p3-storakers-m0.1-mu0", "numerics.fidelity=fast"},
    {"p3-storakers-m0.2-mu0", "numerics.fidelity=fast"},
    {"p3-hertz-mu0", NULL}, /* balanced */
    {"p3-hertz-mu0.01", "numerics.fidelity=fast"},
    {"p3-hertz-mu0.02", "numerics.fidelity=fast"},
    {"p3-hertz-mu0.05", "numerics.fidelity=fast"},
    {"p3-storakers-m0.2-mu0.01", "numerics.fidelity=fast"},
    {"p3-storakers-m0.2-mu0.02", "numerics.fidelity=fast"},
    {"p3-storakers-m0.2-mu0.05", "numerics.fidelity=fast"},
};

enum {
    MODELS = G_N_ELEMENTS(models),
    FAST = 0,
    STORAKERS = 1,
    BALANCED = 4,
    HERTZ_MU = 5
};

struct result {
    double whole[MARKS], central[MARKS];
    double worst_residual;        /* of the pressure, from 2 MPa on */
    double floor_low, floor_high; /* from 2 MPa on */
};

static struct gb_params load(const struct model *model, int seed)
{
    struct gb_error err = {0};
    struct gb_preset *preset = NULL;
    char *path = g_strdup_printf("%s/%s.ini", GB_TEST_PRESETS, model->preset);
    if (!gb_preset_load(&preset, path, &err)) {
        g_error("%s", err.text);
    }
    struct gb_params params = *gb_preset_params(preset);
    if (model->change && !gb_params_assign(&params, model->change, &err)) {
        g_error("%s", err.text);
    }
    params.seed = (uint64_t)seed;
    gb_preset_destroy(preset);
    g_free(path);
    return params;
}

static struct gb_model freeze(const struct gb_params *params)
{
    struct gb_error err = {0};
    struct gb_model model;
    if (!gb_params_check(params, &err) || !gb_model_init(&model, params, &err)) {
        g_error("%s", err.text);
    }
    return model;
}

/* To the next point; false at the end. */
static bool next_point(struct gb_die_stages *stages, struct gb_bed *bed)
{
    char text[GB_EVENT_TEXT];
    struct gb_error err = {0};
    for (;;) {
        switch (gb_die_stages_advance(stages, bed, 100000, text, sizeof text, &err)) {
        case GB_STEP_MORE:
            if (text[0] != '\0') {
                g_test_message("%s", text);
            }
            break;
        case GB_STEP_POINT:
            return true;
        case GB_STEP_DONE:
            return false;
        case GB_STEP_STOPPED:
            g_error("%s", err.text);
        }
    }
}

static void book(struct result *result, const struct gb_die_stages_report *report,
                 const struct gb_bed *bed, const struct gb_model *model)
{
    const double mpa = 1e-6 * report->wanted * model->pascal_per_stress;
    for (int k = 0; k < MARKS; k++) {
        if (fabs(mpa - marks_mpa[k]) < 0.2) {
            result->whole[k] = gb_observe_die_density(bed, report->height);
            result->central[k] =
                gb_observe_die_central(bed, report->height, model->die.central_radius);
        }
    }
    if (mpa > 1.9) {
        const double residual = fabs(report->carried / report->wanted - 1.0);
        result->worst_residual = fmax(result->worst_residual, residual);
        result->floor_low = fmin(result->floor_low, report->floor_over_punch);
        result->floor_high = fmax(result->floor_high, report->floor_over_punch);
    }
}

static struct result press(struct gb_bed *bed, const struct gb_bed_copy *filled,
                           const struct model *name, int seed)
{
    struct gb_error err = {0};
    struct gb_die_stages *stages = NULL;
    struct result result = {.floor_low = HUGE_VAL};
    const struct gb_params params = load(name, seed);
    const struct gb_model model = freeze(&params);
    const struct gb_bed_law law = gb_filling_compaction_law(&params);
    const double start = gb_clock_process_s(); /* other work does not lengthen it */
    const int64_t evaluations = bed->evaluations;
    g_assert_true(gb_bed_record_restore(bed, filled, &err));
    g_assert_true(gb_die_stages_create(&stages, &model.die, &law, &err));
    g_assert_true(gb_die_stages_begin(stages, bed, &err));
    while (next_point(stages, bed)) {
        const struct gb_die_stages_report report = gb_die_stages_report(stages, bed);
        book(&result, &report, bed, &model);
    }
    gb_die_stages_destroy(stages);
    const double seconds = gb_clock_process_s() - start;
    const double steps = (double)(bed->evaluations - evaluations);
    g_test_message(
        "%-26s %-8s whole %.4f %.4f %.4f %.4f central %.4f %.4f %.4f %.4f residual "
        "%.2f %% floor/punch %.3f to %.3f; %.3g steps, %.1f s, %.4f us",
        name->preset, name->change ? "fast" : "balanced", result.whole[0],
        result.whole[1], result.whole[2], result.whole[3], result.central[0],
        result.central[1], result.central[2], result.central[3],
        100.0 * result.worst_residual, result.floor_low, result.floor_high, steps,
        seconds, 1e6 * seconds / (steps * (double)bed->count));
    return result;
}

struct bed_result {
    double height_um, whole, central;
    struct result model[MODELS];
};

static struct bed_result study(int seed, size_t models_pressed)
{
    struct gb_error err = {0};
    struct bed_result result;
    struct gb_bed *bed = NULL;
    struct gb_die_stages *stages = NULL;
    struct gb_bed_copy *filled = NULL;
    const struct gb_params params = load(&models[0], seed);
    const struct gb_model model = freeze(&params);
    const struct gb_bed_law law = gb_filling_compaction_law(&params);
    const double start = gb_clock_process_s();
    if (!gb_filling_create(&bed, &params, &model, NULL, NULL, &err) ||
        !gb_die_stages_create(&stages, &model.die, &law, &err)) {
        g_error("%s", err.text);
    }
    g_assert_true(next_point(stages, bed));
    g_assert_true(gb_bed_record_take(bed, &filled, &err));
    const struct gb_die_stages_report report = gb_die_stages_report(stages, bed);
    result.height_um = 1e6 * report.height * model.metre_per_length;
    result.whole = gb_observe_die_density(bed, report.height);
    result.central = gb_observe_die_central(bed, report.height, model.die.central_radius);
    g_test_message(
        "bed %d: H0 %.2f um, density %.4f whole, %.4f central; filled in %.1f s", seed,
        result.height_um, result.whole, result.central, gb_clock_process_s() - start);
    for (size_t k = 0; k < models_pressed; k++) {
        result.model[k] = press(bed, filled, &models[k], seed);
    }
    gb_bed_record_destroy(filled);
    gb_die_stages_destroy(stages);
    gb_bed_destroy(bed);
    return result;
}

static void check_bed(const struct bed_result *bed)
{
    const struct result *balanced = &bed->model[BALANCED];
    g_assert_cmpfloat_with_epsilon(bed->height_um, 95.0, 2.0);
    g_assert_cmpfloat_with_epsilon(bed->whole, 0.62, 0.015);
    g_assert_cmpfloat_with_epsilon(balanced->whole[3], 0.66, 0.01);
    for (int k = 0; k < MARKS; k++) {
        g_assert_cmpfloat(balanced->central[k] - balanced->whole[k], >, 0.04);
        g_assert_cmpfloat(balanced->central[k] - balanced->whole[k], <, 0.07);
    }
    g_assert_cmpfloat(balanced->worst_residual, <, 0.01);
    for (size_t m = 0; m < MODELS; m++) {
        /* at 2 MPa the quadratic ramp is five times as steep as the paper's */
        g_assert_cmpfloat(bed->model[m].worst_residual, <, 0.02);
    }
}

/* Mean over so many beds. */
static double mean_of(const struct bed_result *bed, int beds, int model, int mark)
{
    double sum = 0.0;
    for (int b = 0; b < beds; b++) {
        sum += bed[b].model[model].whole[mark] / beds;
    }
    return sum;
}

static double mean(const struct bed_result *bed, int model, int mark)
{
    return mean_of(bed, BEDS, model, mark);
}

/* The density in the central sphere scatters by 0.005 from bed to bed, so that one of a few
 * beds leaves the range around P3's 0.66 to 0.69, and 0.70 at 50 MPa; their mean does not. */
static void check_central(const struct bed_result *bed)
{
    double poured = 0.0, pressed = 0.0;
    for (int b = 0; b < COMPARED; b++) {
        poured += bed[b].central / COMPARED;
        pressed += bed[b].model[BALANCED].central[3] / COMPARED;
    }
    g_test_message("density of the central sphere: %.4f poured, %.4f at 50 MPa", poured,
                   pressed);
    g_assert_cmpfloat(poured, >, 0.66);
    g_assert_cmpfloat(poured, <, 0.69);
    g_assert_cmpfloat_with_epsilon(pressed, 0.70, 0.01);
    for (int b = 0; b < COMPARED; b++) {
        g_assert_cmpfloat_with_epsilon(bed[b].model[BALANCED].central[3], pressed, 0.015);
    }
}

/* Presses of one bed at two fidelities part by 0.001 to 0.003, their means do not. */
static void check_fidelity(const struct bed_result *bed)
{
    for (int k = 0; k < MARKS; k++) {
        const double bias =
            mean_of(bed, COMPARED, FAST, k) - mean_of(bed, COMPARED, BALANCED, k);
        g_test_message("fast less balanced at %g MPa: %+.4f", marks_mpa[k], bias);
        g_assert_cmpfloat_with_epsilon(bias, 0.0, 0.002);
    }
}

/* Standard error of the mean difference of two models, which press the same beds. */
static double error_of_difference(const struct bed_result *bed, int a, int b, int mark)
{
    const double mean = mean_of(bed, OF_LAWS, a, mark) - mean_of(bed, OF_LAWS, b, mark);
    double square = 0.0;
    for (int k = 0; k < OF_LAWS; k++) {
        const double apart =
            bed[k].model[a].whole[mark] - bed[k].model[b].whole[mark] - mean;
        square += apart * apart;
    }
    return sqrt(square / (OF_LAWS * (OF_LAWS - 1.0)));
}

static void check_means(const struct bed_result *bed)
{
    for (int k = 0; k < MARKS; k++) {
        for (int m = STORAKERS; m < STORAKERS + 3; m++) {
            const double law = mean_of(bed, OF_LAWS, m, k);
            const double hertz = mean_of(bed, OF_LAWS, FAST, k);
            const double error = error_of_difference(bed, m, FAST, k);
            g_test_message("%s less Hertz at %g MPa: %+.4f +- %.4f", models[m].preset,
                           marks_mpa[k], law - hertz, error);
            g_assert_cmpfloat(error, <, 0.0005);
            g_assert_cmpfloat_with_epsilon(law, hertz, 0.003);
        }
    }
    const int rows[2][4] = {{FAST, HERTZ_MU, HERTZ_MU + 1, HERTZ_MU + 2},
                            {STORAKERS + 2, HERTZ_MU + 3, HERTZ_MU + 4, HERTZ_MU + 5}};
    for (int law = 0; law < 2; law++) {
        for (int m = 1; m < 4; m++) {
            g_assert_cmpfloat(mean(bed, rows[law][m], 3), <,
                              mean(bed, rows[law][m - 1], 3));
        }
        const double gap = mean(bed, rows[law][0], 3) - mean(bed, rows[law][3], 3);
        g_assert_cmpfloat_with_epsilon(gap, 0.01, 0.005);
    }
}

static void test_targets(void)
{
    struct bed_result bed[OF_LAWS];
    for (int b = 0; b < OF_LAWS; b++) {
        bed[b] = study(b + 1, b < BEDS ? MODELS : b < COMPARED ? HERTZ_MU : BALANCED);
    }
    for (int b = 0; b < BEDS; b++) {
        check_bed(&bed[b]);
    }
    check_central(bed);
    check_fidelity(bed);
    check_means(bed);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/die/targets", test_targets);
    return g_test_run();
}
