/* Reported quantities (moduli, yield surface, card, ...) against the cost of their numerical
 * choices: the table of quantities with their studies, the cells, and the table of errors. */
#include "study/quantity_chart.h"

#include <glib.h>
#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "base/clock.h"
#include "base/listing.h"
#include "base/number.h"
#include "base/table.h"
#include "base/units.h"
#include "greenbody/params.h"
#include "many/compaction_data.h"
#include "many/die_summary.h"
#include "many/pool.h"
#include "many/single_run.h"
#include "measure/average.h"
#include "measure/cap_fit.h"
#include "measure/compaction_fits.h"
#include "run/cost.h"
#include "run/moduli_table.h"
#include "scene/field/keep_points.h"
#include "scene/loading_kind.h"
#include "scene/model.h"
#include "study/card.h"
#include "study/cells.h"
#include "study/compact.h"
#include "study/strength.h"
#include "study/yield.h"

/* Every number that a study reports, and how one cell gives it with chosen numerics: the
 * table of `greenbody chart --quantity` and of the test that all of them have converged.
 *
 * A quantity is a row.  Quantities of one study share the measurement of a cell. */

/* Factors of a number that is more accurate the smaller it is. */
#define TIGHTER                                                                          \
    {                                                                                    \
        0.2, 0.5, 1.0, 2.0                                                               \
    }

/* Axes of the run that makes a cell. */

static double own_tolerance(const struct gb_params *params, const struct gb_model *model)
{
    (void)params;
    return model->numerics.tolerance;
}

static void set_tolerance(struct gb_params *params, double value)
{
    params->tolerance = value;
}

static double own_step(const struct gb_params *params, const struct gb_model *model)
{
    (void)params;
    return model->strain_step / model->numerics.parts;
}

/* As many recorded points as before, where the step allows it. */
static void set_step(struct gb_params *params, double value)
{
    params->strain_part = value;
    params->strain_step = fmax(params->strain_step, value);
}

static const struct gb_quantity_axis run_axes[] = {
    {"numerics.tolerance", GB_DIM_NONE, TIGHTER, 0.3, own_tolerance, set_tolerance},
    {"loading.step", GB_DIM_FRACTION, TIGHTER, 0.3, own_step, set_step},
    {0},
};

/* Runs the cell into a directory and reads its curve. */
static bool run_cell(struct gb_runset *set, const struct gb_params *params,
                     const char *path, const struct gb_pool_callbacks *callbacks,
                     struct gb_error *err)
{
    char *directory = g_strdup(path);
    const bool good = gb_single_run(params, directory, callbacks, err) &&
                      gb_runset_read(set, &directory, 1, err);
    g_free(directory);
    return good;
}

/* moduli: Newton's method on the compact has no setting; the compact has. */

enum { YOUNG, POISSON };

static bool take_moduli(void *data, const struct gb_moduli_table_row *row,
                        struct gb_error *err)
{
    double *value = data;
    (void)err;
    if (isnan(value[YOUNG])) { /* the mark comes before the end of the run */
        value[YOUNG] = row->value[gb_moduli_table_find("E_GPa")];
        value[POISSON] = row->value[gb_moduli_table_find("nu")];
    }
    return true;
}

static bool check_moduli(const struct gb_params *params, struct gb_error *err)
{
    return gb_loading_kind_check_cell(params, "moduli", err);
}

static bool measure_moduli(double value[GB_QUANTITY_VALUES],
                           const struct gb_params *params,
                           const struct gb_quantity_ask *ask, const char *path,
                           const struct gb_pool_callbacks *callbacks,
                           struct gb_error *err)
{
    (void)path;
    const struct gb_keep_points at = {.count = 1, .point = {ask->mark}};
    const struct gb_moduli_table_sink sink = {.row = take_moduli,
                                              .data = value,
                                              .cancelled = callbacks->cancelled,
                                              .cancel_data = callbacks->data};
    struct gb_params own = *params;
    int missed = 0;
    own.unload_count = 0;
    own.path[0] = '\0';
    own.until_density = ask->mark.by_density ? ask->mark.value : (double)NAN;
    own.until_pressure_pa = ask->mark.by_density ? (double)NAN : ask->mark.value;
    return gb_moduli_table_run(&own, &at, &sink, &missed, err);
}

static const struct gb_quantity_study moduli = {
    .name = "moduli",
    .at = "density = 0.5",
    .cells = 8,
    .runs = 1.5,
    .axis = run_axes,
    .check = check_moduli,
    .measure = measure_moduli,
};

/* Compacts: axes are the options of their study; how they are pressed does not vary. */

enum { TOLERANCE, STEP };

/* The default of a member of a study's options. */
#define OWN_OPTION(study, member)                                                        \
    static double own_##study##_##member(const struct gb_params *params,                 \
                                         const struct gb_model *model)                   \
    {                                                                                    \
        struct gb_##study##_options options;                                             \
        (void)params;                                                                    \
        (void)model;                                                                     \
        gb_##study##_options_init(&options);                                             \
        return options.member;                                                           \
    }

static bool check_compact(const struct gb_params *params, struct gb_error *err)
{
    struct gb_params ignored;
    return gb_compact_params(&ignored, params, err);
}

/* yield: the surface of one cell. */

OWN_OPTION(yield, tolerance)
OWN_OPTION(yield, step)

enum { HALF_P, HALF_Q, TENSION_END };

static bool measure_yield(double value[GB_QUANTITY_VALUES],
                          const struct gb_params *params,
                          const struct gb_quantity_ask *ask, const char *path,
                          const struct gb_pool_callbacks *callbacks, struct gb_error *err)
{
    (void)path;
    struct gb_yield_options options;
    struct gb_yield_point point[GB_YIELD_DIRECTIONS_MAX];
    struct gb_yield_surface surface = {.offset = 0.0};
    struct gb_params own;
    double top_pa[2];
    gb_yield_options_init(&options);
    options.tolerance = ask->setting[TOLERANCE];
    options.step = ask->setting[STEP];
    const struct gb_yield_surface_data data = {point, &top_pa[0], &top_pa[1], 1,
                                               options.directions};
    if (!gb_compact_params(&own, params, err) ||
        !gb_yield_measure(point, top_pa, &own, &ask->mark, &options, callbacks, err) ||
        !gb_yield_surface_measure(&surface, &data, err)) {
        return false;
    }
    value[HALF_P] = 1e-6 * surface.quantity[GB_YIELD_HALF_P].value;
    value[HALF_Q] = 1e-6 * surface.quantity[GB_YIELD_HALF_Q].value;
    value[TENSION_END] = 1e-6 * surface.quantity[GB_YIELD_TENSION].value;
    return true;
}

static const struct gb_quantity_axis yield_axes[] = {
    {"tolerance", GB_DIM_NONE, TIGHTER, 0.25, own_yield_tolerance, NULL},
    {"step", GB_DIM_FRACTION, TIGHTER, 0.6, own_yield_step, NULL},
    {0},
};

static const struct gb_quantity_study yield = {
    .name = "yield",
    .at = "density = 0.5",
    .cells = 8,
    .runs = 0.6,
    .axis = yield_axes,
    .check = check_compact,
    .measure = measure_yield,
};

/* card: the surface of one compact of one cell. */

OWN_OPTION(card, tolerance)
OWN_OPTION(card, step)

enum { CARD_D, CARD_BETA, CARD_R, CARD_P_B, CARD_YOUNG, CARD_POISSON };

static bool measure_card(double value[GB_QUANTITY_VALUES], const struct gb_params *params,
                         const struct gb_quantity_ask *ask, const char *path,
                         const struct gb_pool_callbacks *callbacks, struct gb_error *err)
{
    (void)path;
    struct gb_card_options options;
    struct gb_card_cell cell = {.point = NULL};
    struct gb_cap_fit cap;
    struct gb_error ignored = {0};
    gb_card_options_init(&options);
    options.density[0] = ask->mark.value;
    options.levels = 1;
    options.tolerance = ask->setting[TOLERANCE];
    options.step = ask->setting[STEP];
    const bool good = gb_card_cell_measure(&cell, params, 1, &options, callbacks, err);
    if (good && gb_cap_fit(&cap, (const struct gb_yield_point *)(void *)cell.point->data,
                           cell.point->len, options.transition, options.flow, &ignored)) {
        value[CARD_D] = 1e-6 * cap.d.value;
        value[CARD_BETA] = cap.beta.value * 180.0 / G_PI;
        value[CARD_R] = cap.r.value;
        value[CARD_P_B] = 1e-6 * cap.p_b.value;
    }
    if (good) {
        const double bulk = cell.level[0].bulk, shear = cell.level[0].shear_modulus;
        value[CARD_YOUNG] = 1e-9 * 9.0 * bulk * shear / (3.0 * bulk + shear);
        value[CARD_POISSON] = (3.0 * bulk - 2.0 * shear) / (2.0 * (3.0 * bulk + shear));
    }
    gb_card_cell_finish(&cell);
    return good;
}

static const struct gb_quantity_axis card_axes[] = {
    {"tolerance", GB_DIM_NONE, TIGHTER, 0.25, own_card_tolerance, NULL},
    {"step", GB_DIM_FRACTION, TIGHTER, 0.6, own_card_step, NULL},
    {0},
};

static const struct gb_quantity_study card = {
    .name = "card",
    .at = "density = 0.5",
    .by_density = true,
    .cells = 8,
    .runs = 1.2,
    .axis = card_axes,
    .check = check_compact,
    .measure = measure_card,
};

/* strength: the tests of a compact. */

OWN_OPTION(strength, tolerance)
OWN_OPTION(strength, step)

static bool measure_strength(double value[GB_QUANTITY_VALUES],
                             const struct gb_params *params,
                             const struct gb_quantity_ask *ask, const char *path,
                             const struct gb_pool_callbacks *callbacks,
                             struct gb_error *err)
{
    (void)path;
    struct gb_strength_options options;
    struct gb_strength_broken test[GB_STRENGTH_TESTS];
    struct gb_params own;
    gb_strength_options_init(&options);
    options.tolerance = ask->setting[TOLERANCE];
    options.step = ask->setting[STEP];
    if (!gb_compact_params(&own, params, err)) {
        return false;
    }
    own.on_collapse = GB_COLLAPSE_STOP;
    if (!gb_strength_measure(test, &own, &ask->mark, &options, NULL, callbacks, err)) {
        return false;
    }
    for (int t = 0; t < GB_STRENGTH_TESTS; t++) {
        value[t] = 1e-6 * test[t].strength;
        value[GB_STRENGTH_TESTS + t] = 100.0 * test[t].at_peak;
    }
    return true;
}

static const struct gb_quantity_axis strength_axes[] = {
    {"tolerance", GB_DIM_NONE, TIGHTER, 0.25, own_strength_tolerance, NULL},
    {"step", GB_DIM_FRACTION, TIGHTER, 0.6, own_strength_step, NULL},
    {0},
};

static const struct gb_quantity_study strength = {
    .name = "strength",
    .at = "density = 0.5",
    .cells = 8,
    .runs = 0.5,
    .axis = strength_axes,
    .check = check_compact,
    .measure = measure_strength,
};

/* fit: equations of compaction, fitted to the curve of each cell. */

static bool check_fit(const struct gb_params *params, struct gb_error *err)
{
    return gb_loading_kind_check_cell(params, "fit in a chart", err) &&
           (!gb_loading_kind_of(params)->follows_time ||
            gb_error_set(err, GB_ERR_INPUT,
                         "scene.kind = %s: expected quasistatic for fit in a chart",
                         gb_loading_kind_of(params)->name));
}

/* The constants by their names, "heckel_K". */
static void take_constants(double *value, const struct gb_compaction_fits *fits)
{
    for (size_t i = 0; i < fits->fitted; i++) {
        for (size_t k = 0; k < gb_compaction_fits_values(fits, i); k++) {
            const struct gb_compaction_value one = gb_compaction_fits_value(fits, i, k);
            char *name = g_strconcat(fits->fit[i].equation->name, "_", one.name, NULL);
            const struct gb_quantity *row = gb_quantity_chart_find(name, NULL);
            if (row != NULL) {
                value[row->index] = one.value.value;
            }
            g_free(name);
        }
    }
}

static bool measure_fit(double value[GB_QUANTITY_VALUES], const struct gb_params *params,
                        const struct gb_quantity_ask *ask, const char *path,
                        const struct gb_pool_callbacks *callbacks, struct gb_error *err)
{
    (void)ask;
    const struct gb_compaction_window window = {(double)NAN, (double)NAN, (double)NAN,
                                                false};
    struct gb_runset set = {0};
    struct gb_compaction_data data = {0};
    struct gb_compaction_fits fits;
    struct gb_params own = *params;
    own.unload_count = 0;
    const bool good =
        run_cell(&set, &own, path, callbacks, err) &&
        gb_compaction_data_runs(&data, &set, 0, &window, err) &&
        gb_compaction_fits(&fits, &data.points, NULL, GB_COMPACTION_LINEAR, err);
    if (good) {
        take_constants(value, &fits);
    }
    gb_compaction_data_finish(&data);
    gb_runset_finish(&set);
    return good;
}

static const struct gb_quantity_study fit = {
    .name = "fit",
    .cells = 8,
    .runs = 1.0,
    .axis = run_axes,
    .check = check_fit,
    .measure = measure_fit,
};

/* die: the whole cycle of one bed.  Every setting begins with the same bed, filled with the
 * default: beds that differ scatter more than settings do. */

enum { INERTIA, SAFETY, EJECT, RAMP };

static double own_inertia(const struct gb_params *params, const struct gb_model *model)
{
    (void)model;
    return params->inertia_scale;
}

static void set_inertia(struct gb_params *params, double value)
{
    params->inertia_scale = value;
}

static double own_safety(const struct gb_params *params, const struct gb_model *model)
{
    (void)params;
    return model->die.safety;
}

static void set_safety(struct gb_params *params, double value)
{
    params->safety = value;
}

static double own_eject(const struct gb_params *params, const struct gb_model *model)
{
    (void)model;
    return params->eject_m_s;
}

static void set_eject(struct gb_params *params, double value)
{
    params->eject_m_s = value;
}

static double own_time(const struct gb_params *params, const struct gb_model *model)
{
    (void)params;
    return model->die.ramp_time * model->die.second_per_time;
}

static void set_time(struct gb_params *params, double value)
{
    params->ramp_s = value;
}

/* Rows of many/die_summary.h. */
static const char *const die_numbers[] = {"axial_percent", "radial_percent",
                                          "ejection_mN", "residual_radial_MPa"};

static bool check_die(const struct gb_params *params, struct gb_error *err)
{
    return (gb_loading_kind_of(params)->columns == GB_COLUMNS_DIE &&
            params->die_cycle == GB_DIE_CYCLE_FULL) ||
           gb_error_set(err, GB_ERR_INPUT,
                        "scene.kind, die.cycle: expected die and full for quantities of "
                        "a die cycle");
}

static bool measure_die(double value[GB_QUANTITY_VALUES], const struct gb_params *params,
                        const struct gb_quantity_ask *ask, const char *path,
                        const struct gb_pool_callbacks *callbacks, struct gb_error *err)
{
    struct gb_runset set = {0};
    struct gb_params first = *params;
    char *directory = g_strdup(path);
    set_inertia(&first, ask->own[INERTIA]);
    set_safety(&first, ask->own[SAFETY]);
    const bool good = gb_single_run_after(params, &first, directory, callbacks, err) &&
                      gb_runset_read(&set, &directory, 1, err) &&
                      gb_die_summary_check(&set, err);
    for (const struct gb_die_summary_row *row = gb_die_summary_table();
         good && row->name != NULL; row++) {
        for (size_t k = 0; k < G_N_ELEMENTS(die_numbers); k++) {
            if (strcmp(row->name, die_numbers[k]) == 0) {
                value[k] = row->value(set.run[0].table);
            }
        }
    }
    gb_runset_finish(&set);
    g_free(directory);
    return good;
}

static const struct gb_quantity_axis die_axes[] = {
    [INERTIA] = {"numerics.inertia_scale",
                 GB_DIM_NONE,
                 {0.2, 0.5, 1.0},
                 0.2,
                 own_inertia,
                 set_inertia},
    [SAFETY] =
        {"numerics.safety", GB_DIM_NONE, {0.2, 0.5, 1.0}, 1.0, own_safety, set_safety},
    [EJECT] = {"die.eject_speed", GB_DIM_SPEED, TIGHTER, 0.3, own_eject, set_eject},
    [RAMP] = {"loading.time", GB_DIM_TIME, {5.0, 2.0, 1.0}, -0.5, own_time, set_time},
    {0},
};

static const struct gb_quantity_study die = {
    .name = "die",
    .cells = 8,
    .runs = 1.0,
    .axis = die_axes,
    .check = check_die,
    .measure = measure_die,
};

static const struct gb_quantity quantities[] = {
    {"E", "GPa", "Young's modulus of a compact", &moduli, YOUNG},
    {"nu", "1", "Poisson's ratio of a compact", &moduli, POISSON},
    {"yield_half_p", "MPa", "semi-axis p of the yield surface", &yield, HALF_P},
    {"yield_half_q", "MPa", "semi-axis q of the yield surface", &yield, HALF_Q},
    {"yield_tension", "MPa", "tension end of the yield surface", &yield, TENSION_END},
    {"d", "MPa", "cohesion of the card", &card, CARD_D},
    {"beta", "deg", "angle of friction of the card", &card, CARD_BETA},
    {"R", "1", "shape of the cap of the card", &card, CARD_R},
    {"p_b", "MPa", "yield pressure of the card", &card, CARD_P_B},
    {"card_E", "GPa", "Young's modulus of the card", &card, CARD_YOUNG},
    {"card_nu", "1", "Poisson's ratio of the card", &card, CARD_POISSON},
    {"strength_tension", "MPa", "largest tensile stress after unloading", &strength,
     GB_STRENGTH_TENSION},
    {"strength_compression", "MPa", "largest stress of compression, after unloading",
     &strength, GB_STRENGTH_COMPRESSION},
    {"strength_shear", "MPa", "largest shear stress after unloading", &strength,
     GB_STRENGTH_SHEAR},
    {"broken_tension", "%", "bridges lost at that stress", &strength,
     GB_STRENGTH_TESTS + GB_STRENGTH_TENSION},
    {"broken_compression", "%", "bridges lost at that stress", &strength,
     GB_STRENGTH_TESTS + GB_STRENGTH_COMPRESSION},
    {"broken_shear", "%", "bridges lost at that stress", &strength,
     GB_STRENGTH_TESTS + GB_STRENGTH_SHEAR},
    {"axial_springback", "%", "of the ejected compact", &die, 0},
    {"radial_springback", "%", "of the ejected compact", &die, 1},
    {"ejection_force", "mN", "largest force of ejection", &die, 2},
    {"residual_stress", "MPa", "radial, at rest with the punch off", &die, 3},
    {"heckel_K", "1/MPa", "constant of Heckel's equation", &fit, 0},
    {"heckel_A", "1", "constant of Heckel's equation", &fit, 1},
    {"kawakita_a", "1", "constant of Kawakita's equation", &fit, 2},
    {"kawakita_b", "1/MPa", "constant of Kawakita's equation", &fit, 3},
    {0},
};

const struct gb_quantity *gb_quantity_chart_quantities(void)
{
    return quantities;
}

const struct gb_quantity *gb_quantity_chart_find(const char *name, struct gb_error *err)
{
    GString *names = g_string_new(NULL);
    const struct gb_quantity *row = quantities;
    for (; row->name != NULL && strcmp(row->name, name) != 0; row++) {
        g_string_append_printf(names, "%s%s", names->len > 0 ? ", " : "", row->name);
    }
    if (row->name == NULL) {
        gb_error_set(err, GB_ERR_INPUT, "--quantity = %.40s: expected %s", name,
                     names->str);
    }
    g_string_free(names, TRUE);
    return row->name != NULL ? row : NULL;
}

int gb_quantity_chart_axes(const struct gb_quantity_study *study)
{
    int axes = 0;
    while (study->axis[axes].name != NULL) {
        axes++;
    }
    return axes;
}

/* Name of an axis without its group: a column. */
static const char *quantities_column(const struct gb_quantity_axis *axis)
{
    const char *dot = strchr(axis->name, '.');
    return dot != NULL ? dot + 1 : axis->name;
}

/* The lines of a question (study/cells.h): study, mark, and the values. */
static char *quantities_question(const struct gb_quantity_study *study,
                                 const struct gb_quantity_ask *ask)
{
    GString *text = g_string_new(NULL);
    g_string_append_printf(text, "study=chart of %s\n", study->name);
    if (study->at != NULL) {
        g_string_append_printf(text, "by_density=%d\nmark=%.17g\n", ask->mark.by_density,
                               ask->mark.value);
    }
    for (int a = 0; a < gb_quantity_chart_axes(study); a++) {
        g_string_append_printf(text, "%s=%.17g\nown.%s=%.17g\n", study->axis[a].name,
                               ask->setting[a], study->axis[a].name, ask->own[a]);
    }
    return g_string_free(text, FALSE);
}

static const struct gb_quantity_study *study_of(GKeyFile *question)
{
    const struct gb_quantity_study *study = NULL;
    char *name = g_key_file_get_string(question, "cell", "study", NULL);
    for (const struct gb_quantity *row = quantities; row->name != NULL; row++) {
        if (name != NULL && g_str_has_prefix(name, "chart of ") &&
            strcmp(name + strlen("chart of "), row->study->name) == 0) {
            study = row->study;
        }
    }
    g_free(name);
    return study;
}

static bool answer(const struct gb_quantity_study *study, const double *value,
                   double cpu_s, bool failed, const char *path, struct gb_error *err)
{
    struct gb_listing *listing = gb_listing_new();
    double number[2 + GB_QUANTITY_VALUES] = {cpu_s, failed};
    size_t count = 2;
    gb_listing_columns(listing, "%.8g", "cpu_s,failed");
    for (const struct gb_quantity *row = quantities; row->name != NULL; row++) {
        if (row->study == study) {
            gb_listing_columns(listing, "%.8g", row->name);
            number[count++] = value[row->index];
        }
    }
    gb_listing_numbers(listing, number, count);
    const bool good = gb_cells_table(path, ".csv", listing, err);
    gb_listing_free(listing);
    return good;
}

/* Work of a pool: measures the cell of a question.  PATH.csv receives cpu_s, failed (1: a
 * guard has ended it) and a column for each quantity of the study. */
static bool quantities_work(const struct gb_params *params, const char *path,
                            const struct gb_pool_callbacks *callbacks,
                            struct gb_error *err)
{
    GKeyFile *question = NULL;
    struct gb_quantity_ask ask;
    struct gb_lock lock;
    double value[GB_QUANTITY_VALUES];
    if (!gb_cells_question(&question, &lock, path, err)) {
        return false;
    }
    const struct gb_quantity_study *study = study_of(question);
    ask.mark.by_density = gb_cells_option(question, "by_density") != 0.0;
    ask.mark.value = gb_cells_option(question, "mark");
    for (int a = 0; study != NULL && a < gb_quantity_chart_axes(study); a++) {
        char *own = g_strconcat("own.", study->axis[a].name, NULL);
        ask.setting[a] = gb_cells_option(question, study->axis[a].name);
        ask.own[a] = gb_cells_option(question, own);
        g_free(own);
    }
    g_key_file_free(question);
    if (study == NULL) {
        gb_lock_release(&lock);
        return gb_error_set(err, GB_ERR_INPUT, "%.300s.ini: no question of a chart",
                            path);
    }
    for (int k = 0; k < GB_QUANTITY_VALUES; k++) {
        value[k] = (double)NAN;
    }
    const double begin = gb_clock_process_s();
    struct gb_error why = {0};
    const bool good = study->measure(value, params, &ask, path, callbacks, &why);
    const double cpu_s = gb_clock_process_s() - begin;
    const bool measured =
        good || why.code == GB_ERR_GUARD || why.code == GB_ERR_NOT_CONVERGED;
    const bool answered = measured ? answer(study, value, cpu_s, !good, path, err)
                                   : gb_error_set(err, why.code, "%s", why.text);
    gb_lock_release(&lock);
    return answered;
}

/* --- the chart ------------------------------------------------------------------------ */

/* Limits a mistyped list. */
enum { SETTINGS_MAX = 2000, DESCRIPTION = 160 };

/* More axes than this are varied one at a time. */
enum { TOGETHER_MAX = 2 };

/* Seconds that a bed takes for each of its particles in a die cycle, on one machine. */
static const double bed_s = 0.1;

/* Above this multiple of today's time the advice says so. */
static const double cost_most = 3.0;

static const struct gb_quantity_setting *setting_at(const struct gb_quantity_chart *chart,
                                                    guint i)
{
    return &g_array_index(chart->setting, struct gb_quantity_setting, i);
}

static struct gb_quantity_cell *cell_at(const struct gb_quantity_chart *chart,
                                        guint setting, int seed)
{
    return &chart->cell[setting * (guint)chart->seeds + (guint)seed];
}

/* The plan */

static bool add(GArray *settings, const struct gb_quantity_setting *setting,
                struct gb_error *err)
{
    /* the default is a row even where it equals the reference */
    for (guint i = settings->len == 1 ? 1 : 0; i < settings->len; i++) {
        if (memcmp(&g_array_index(settings, struct gb_quantity_setting, i), setting,
                   sizeof *setting) == 0) {
            return true;
        }
    }
    if (settings->len >= SETTINGS_MAX) {
        return gb_error_set(err, GB_ERR_INPUT, "--vary: expected up to %d combinations",
                            SETTINGS_MAX);
    }
    g_array_append_vals(settings, setting, 1);
    return true;
}

/* Splits "axis=text".  text: into the assignment. */
static bool find_axis(const struct gb_quantity_study *study, const char *option,
                      const char *assignment, int *axis, const char **text,
                      struct gb_error *err)
{
    const char *equals = strchr(assignment, '=');
    GString *names = g_string_new(NULL);
    const size_t length = equals != NULL ? (size_t)(equals - assignment) : 0;
    bool found = false;
    for (int a = 0; a < gb_quantity_chart_axes(study) && !found; a++) {
        const char *name = study->axis[a].name;
        found = equals != NULL && strlen(name) == length &&
                strncmp(name, assignment, length) == 0;
        *axis = a;
        g_string_append_printf(names, "%s%s", a > 0 ? ", " : "", name);
    }
    if (!found) {
        gb_error_set(err, GB_ERR_INPUT, "--%s %.80s: expected NAME=VALUE with one of %s",
                     option, assignment, names->str);
    }
    *text = found ? equals + 1 : NULL;
    g_string_free(names, TRUE);
    return found;
}

static bool read_value(const struct gb_quantity_study *study, const char *option,
                       int axis, const char *text, double *value, struct gb_error *err)
{
    struct gb_error why = {0};
    if (!gb_units_parse(text, (enum gb_dimension)study->axis[axis].dimension, value,
                        &why)) {
        return gb_error_set(err, GB_ERR_INPUT, "--%s %s=%.60s: %.200s", option,
                            study->axis[axis].name, text, why.text);
    }
    return *value > 0.0 ||
           gb_error_set(err, GB_ERR_INPUT, "--%s %s=%.60s: expected a number above 0",
                        option, study->axis[axis].name, text);
}

/* All combinations of the lists from `vary` on. */
static bool add_product(GArray *settings, const struct gb_quantity_study *study,
                        const struct gb_quantity_setting *from, const char *const *vary,
                        struct gb_error *err)
{
    const char *list;
    int axis = 0;
    if (*vary == NULL) {
        return add(settings, from, err);
    }
    if (!find_axis(study, "vary", *vary, &axis, &list, err)) {
        return false;
    }
    char **values = g_strsplit(list, ",", -1);
    bool good = true;
    for (int i = 0; values[i] != NULL && good; i++) {
        struct gb_quantity_setting one = *from;
        good = read_value(study, "vary", axis, values[i], &one.value[axis], err) &&
               add_product(settings, study, &one, vary + 1, err);
    }
    g_strfreev(values);
    return good;
}

/* The default times a factor, within the range of the key. */
static double scaled(const struct gb_quantity_axis *axis, double own, int factor)
{
    const struct gb_field *field =
        axis->set != NULL ? gb_params_find_name(axis->name, NULL) : NULL;
    const double value = own * axis->factor[factor];
    return field != NULL && field->type == GB_FIELD_NUMBER ? fmax(value, field->min)
                                                           : value;
}

/* All combinations of the factors of the axes from `axis` to before `end`. */
static bool add_factors(GArray *settings, const struct gb_quantity_study *study,
                        const struct gb_quantity_setting *from, int axis, int end,
                        struct gb_error *err)
{
    if (axis >= end || axis >= GB_QUANTITY_AXES) {
        return add(settings, from, err);
    }
    for (int k = 0; k < GB_QUANTITY_FACTORS && study->axis[axis].factor[k] > 0.0; k++) {
        struct gb_quantity_setting one = *from;
        one.value[axis] = scaled(&study->axis[axis], from->value[axis], k);
        if (!add_factors(settings, study, &one, axis + 1, end, err)) {
            return false;
        }
    }
    return true;
}

static bool add_reference(GArray *settings, const struct gb_quantity_study *study,
                          const struct gb_quantity_setting *own,
                          const char *const *changes, struct gb_error *err)
{
    struct gb_quantity_setting reference = *own;
    for (int a = 0; a < gb_quantity_chart_axes(study); a++) {
        reference.value[a] = scaled(&study->axis[a], own->value[a], 0);
    }
    for (int i = 0; changes != NULL && changes[i] != NULL; i++) {
        const char *text;
        int axis = 0;
        if (!find_axis(study, "reference", changes[i], &axis, &text, err) ||
            !read_value(study, "reference", axis, text, &reference.value[axis], err)) {
            return false;
        }
    }
    return add(settings, &reference, err);
}

/* Time of a cell over that with the default. */
static double effort_of(const struct gb_quantity_chart *chart, guint setting)
{
    double effort = 1.0;
    for (int a = 0; a < gb_quantity_chart_axes(chart->study); a++) {
        effort *=
            pow(setting_at(chart, setting)->value[a] / setting_at(chart, 1)->value[a],
                -chart->study->axis[a].effort);
    }
    return effort;
}

static bool plan(struct gb_quantity_chart *chart, const char *const *vary,
                 const char *const *reference, struct gb_error *err)
{
    const struct gb_quantity_study *study = chart->study;
    struct gb_model model;
    struct gb_quantity_setting own = {{0.0}};
    if (!gb_model_init(&model, &chart->params, err)) {
        return false;
    }
    for (int a = 0; a < gb_quantity_chart_axes(study); a++) {
        own.value[a] = study->axis[a].own(&chart->params, &model);
    }
    if (!add_reference(chart->setting, study, &own, reference, err) ||
        !add(chart->setting, &own, err)) {
        return false;
    }
    const int axes = gb_quantity_chart_axes(study);
    const int together = axes <= TOGETHER_MAX ? axes : 1;
    for (int a = 0; vary == NULL && a < axes; a += together) {
        if (!add_factors(chart->setting, study, &own, a, a + together, err)) {
            return false;
        }
    }
    return vary == NULL || vary[0] == NULL ||
           add_product(chart->setting, study, &own, vary, err);
}

static bool read_mark(struct gb_quantity_chart *chart, const char *at,
                      struct gb_error *err)
{
    const char *text = at != NULL ? at : chart->study->at;
    struct gb_keep_points points = {0};
    struct gb_error why = {0};
    if (chart->study->at == NULL) {
        return at == NULL ||
               gb_error_set(err, GB_ERR_INPUT,
                            "--at %.80s: expected none for a quantity of %s", at,
                            chart->study->name);
    }
    if (!gb_keep_points_parse(text, &points, &why) || points.count != 1 ||
        points.every > 0) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--at %.80s: expected one density or pressure, as in "
                            "'density = 0.5' or '100 MPa'",
                            text);
    }
    if (chart->study->by_density && !points.point[0].by_density) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--at %.80s: expected a density for a quantity of %s", text,
                            chart->study->name);
    }
    chart->mark = points.point[0];
    return true;
}

static void add_cells(struct gb_quantity_chart *chart)
{
    const struct gb_quantity_study *study = chart->study;
    for (guint s = 0; s < chart->setting->len; s++) {
        struct gb_quantity_ask ask = {.mark = chart->mark};
        struct gb_params params = chart->params;
        GString *head = g_string_new(study->name);
        params.threads = 1;
        params.snapshots_at[0] = '\0';
        params.export_format = GB_LIVE_NONE;
        memcpy(ask.setting, setting_at(chart, s)->value, sizeof ask.setting);
        memcpy(ask.own, setting_at(chart, 1)->value, sizeof ask.own);
        for (int a = 0; a < gb_quantity_chart_axes(study); a++) {
            g_string_append_printf(head, "-%s-%.6g", quantities_column(&study->axis[a]),
                                   ask.setting[a]);
            if (study->axis[a].set != NULL) {
                study->axis[a].set(&params, ask.setting[a]);
            }
        }
        for (int c = 0; c < chart->seeds; c++) {
            char *question = quantities_question(study, &ask);
            char *cell = study->at != NULL ? gb_cells_name(&chart->mark, c)
                                           : g_strdup_printf("cell-%03d", c + 1);
            params.seed = chart->params.seed + (uint64_t)c;
            gb_cells_add(&chart->cells, &params,
                         g_strdup_printf("%s-%s", head->str, cell), question);
            g_free(cell);
            g_free(question);
        }
        g_string_free(head, TRUE);
    }
}

bool gb_quantity_chart_read(struct gb_quantity_chart *chart, struct gb_error *err)
{
    gb_cells_find_done(&chart->cells);
    for (guint i = 0; i < chart->cells.list->len; i++) {
        const struct gb_cells_item *item = g_ptr_array_index(chart->cells.list, i);
        struct gb_quantity_cell *cell = &chart->cell[i];
        struct gb_table *answers = NULL;
        if (!item->done || cell->done) {
            continue;
        }
        char *path = g_strconcat(chart->cells.directory, "/", item->name, ".csv", NULL);
        bool good = gb_table_read(&answers, path, NULL, err);
        const double *cpu_s = good ? gb_table_column(answers, "cpu_s", err) : NULL;
        const double *failed = good ? gb_table_column(answers, "failed", err) : NULL;
        good = cpu_s != NULL && failed != NULL && gb_table_rows(answers) == 1;
        for (const struct gb_quantity *row = gb_quantity_chart_quantities();
             good && row->name != NULL; row++) {
            const double *value = row->study == chart->study
                                      ? gb_table_column(answers, row->name, err)
                                      : NULL;
            good = value != NULL || row->study != chart->study;
            if (value != NULL) {
                cell->value[row->index] = value[0];
            }
        }
        if (good) {
            cell->done = true;
            cell->failed = failed[0] != 0.0;
            cell->cpu_s = cpu_s[0];
        }
        gb_table_destroy(answers);
        g_free(path);
        if (!good) {
            return false;
        }
    }
    return true;
}

bool gb_quantity_chart_init(struct gb_quantity_chart *chart,
                            const struct gb_quantity_study *study,
                            const struct gb_params *params, const char *at,
                            const char *const *vary, const char *const *reference,
                            int seeds, const char *directory, struct gb_error *err)
{
    *chart = (struct gb_quantity_chart){
        .study = study,
        .params = *params,
        .seeds = seeds,
        .setting = g_array_new(FALSE, FALSE, sizeof(struct gb_quantity_setting)),
    };
    if (params->seed > UINT64_MAX - (uint64_t)seeds) {
        return gb_error_set(
            err, GB_ERR_INPUT,
            "structure.seed: expected at most 2^64 - 1 - %d in a chart of "
            "%d seeds",
            seeds, seeds);
    }
    if (!study->check(params, err) || !read_mark(chart, at, err) ||
        !plan(chart, vary, reference, err) ||
        !gb_cells_init(&chart->cells, directory, err)) {
        return false;
    }
    add_cells(chart);
    chart->cell = g_new0(struct gb_quantity_cell, chart->cells.list->len);
    return gb_quantity_chart_read(chart, err);
}

void gb_quantity_chart_finish(struct gb_quantity_chart *chart)
{
    gb_cells_finish(&chart->cells);
    if (chart->setting != NULL) {
        g_array_free(chart->setting, TRUE);
    }
    g_free(chart->cell);
    memset(chart, 0, sizeof *chart);
}

double gb_quantity_chart_cost_s(const struct gb_quantity_chart *chart, size_t *missing)
{
    double there = 0.0, spent = 0.0, left = 0.0;
    *missing = 0;
    for (guint s = 0; s < chart->setting->len; s++) {
        for (int c = 0; c < chart->seeds; c++) {
            const struct gb_quantity_cell *cell = cell_at(chart, s, c);
            there += cell->done ? effort_of(chart, s) : 0.0;
            left += cell->done ? 0.0 : effort_of(chart, s);
            spent += cell->cpu_s;
            *missing += !cell->done;
        }
    }
    if (there > 0.0) {
        return left * spent / there;
    }
    const double assumed = gb_cost_assumed_s(&chart->params);
    return left * (isfinite(assumed) ? chart->study->runs * assumed
                                     : bed_s * (double)chart->params.count);
}

double gb_quantity_chart_spent_s(const struct gb_quantity_chart *chart)
{
    double spent = 0.0;
    for (guint i = 0; i < chart->cells.list->len; i++) {
        spent += chart->cell[i].cpu_s;
    }
    return spent;
}

bool gb_quantity_chart_work(struct gb_quantity_chart *chart, int jobs,
                            const struct gb_cells_callbacks *callbacks,
                            struct gb_error *err)
{
    const bool worked =
        gb_cells_work(&chart->cells, jobs, quantities_work, callbacks, err);
    struct gb_error why = {0};
    const bool read = gb_quantity_chart_read(chart, &why);
    if (worked && !read) {
        return gb_error_set(err, why.code, "%s", why.text);
    }
    return worked && gb_cells_check(&chart->cells, err);
}

/* The table */

/* --- errors against cost -------------------------------------------------------------- */

/* Half of the 95 % interval of a mean. */
static double half_95(double error, size_t count)
{
    return count > 1 ? error * gsl_cdf_tdist_Pinv(0.975, (double)count - 1.0)
                     : (double)NAN;
}

static void fill(struct gb_quantity_result *row, const struct gb_quantity_chart *chart,
                 const struct gb_quantity *quantity, guint setting)
{
    double *value = g_new(double, 2 * (gsize)chart->seeds), *error = value + chart->seeds;
    double cpu = 0.0, ignored;
    size_t count = 0;
    row->setting = *setting_at(chart, setting);
    for (int c = 0; c < chart->seeds; c++) {
        const struct gb_quantity_cell *cell = cell_at(chart, setting, c);
        const struct gb_quantity_cell *reference = cell_at(chart, 0, c);
        if (cell->done) {
            const double own = cell->value[quantity->index];
            row->seeds++;
            row->failed += cell->failed || isnan(own);
            cpu += cell->cpu_s;
            value[count] = own;
            error[count++] =
                reference->done ? own - reference->value[quantity->index] : (double)NAN;
        }
    }
    row->cpu_s = cpu / (double)row->seeds;
    const size_t values = gb_average_values(value, count, &row->value, &ignored);
    row->scatter = ignored * sqrt((double)values);
    const size_t pairs = gb_average_values(error, count, &row->error, &row->error_se);
    row->error_95 = half_95(row->error_se, pairs);
    row->bound = setting > 0 ? fabs(row->error) + row->error_95 : (double)NAN;
    row->noise_limited = isfinite(row->bound) && fabs(row->error) <= row->error_95;
    g_free(value);
}

/* All cells of the chart are there, and have values. */
static bool is_complete(const struct gb_quantity_table *table,
                        const struct gb_quantity_result *row)
{
    return isfinite(row->bound) && row->failed == 0 &&
           row->seeds == gb_quantity_chart_table_at(table, 0)->seeds;
}

static void mark(struct gb_quantity_table *table)
{
    struct gb_quantity_result *row = (void *)table->row->data, *best = NULL;
    for (guint i = 1; i < table->row->len; i++) {
        row[i].front = is_complete(table, &row[i]);
        for (guint k = 1; k < table->row->len && row[i].front; k++) {
            row[i].front = !(is_complete(table, &row[k]) && row[k].cpu_s < row[i].cpu_s &&
                             row[k].bound < row[i].bound);
        }
        if (is_complete(table, &row[i]) && row[i].bound <= table->allowed &&
            (best == NULL || row[i].cpu_s < best->cpu_s)) {
            best = &row[i];
        }
    }
    if (best != NULL) {
        best->chosen = true;
    }
}

void gb_quantity_chart_table_init(struct gb_quantity_table *table,
                                  const struct gb_quantity_chart *chart,
                                  const struct gb_quantity *quantity, double allowed)
{
    const double cells = chart->study->cells;
    *table = (struct gb_quantity_table){
        .quantity = quantity,
        .row = g_array_new(FALSE, TRUE, sizeof(struct gb_quantity_result)),
    };
    g_array_set_size(table->row, chart->setting->len);
    struct gb_quantity_result *row = (void *)table->row->data;
    for (guint i = 0; i < table->row->len; i++) {
        fill(&row[i], chart, quantity, i);
    }
    double squares = 0.0, degrees = 0.0;
    for (guint i = 0; i < table->row->len; i++) {
        const double own = row[i].seeds - row[i].failed - 1;
        row[i].cost = row[i].cpu_s / row[1].cpu_s;
        if (isfinite(row[i].scatter)) {
            squares += own * row[i].scatter * row[i].scatter;
            degrees += own;
        }
    }
    table->half_interval = half_95(sqrt(squares / degrees / cells), (size_t)cells);
    table->allowed = isfinite(allowed) ? allowed : table->half_interval;
    mark(table);
}

void gb_quantity_chart_table_finish(struct gb_quantity_table *table)
{
    if (table->row != NULL) {
        g_array_free(table->row, TRUE);
    }
    *table = (struct gb_quantity_table){0};
}

const struct gb_quantity_result *
gb_quantity_chart_table_at(const struct gb_quantity_table *table, size_t row)
{
    return &g_array_index(table->row, struct gb_quantity_result, row);
}

const struct gb_quantity_result *
gb_quantity_chart_table_chosen(const struct gb_quantity_table *table)
{
    for (guint i = 0; i < table->row->len; i++) {
        if (gb_quantity_chart_table_at(table, i)->chosen) {
            return gb_quantity_chart_table_at(table, i);
        }
    }
    return NULL;
}

/* "tolerance 0.001, step 0.05 %".  Returns buffer. */
static char *describe(const struct gb_quantity_study *study,
                      const struct gb_quantity_setting *setting, char *buffer,
                      size_t size)
{
    buffer[0] = '\0';
    for (int a = 0; a < gb_quantity_chart_axes(study); a++) {
        char value[48];
        const size_t used = strlen(buffer);
        gb_units_format_short(setting->value[a],
                              (enum gb_dimension)study->axis[a].dimension, 4, value,
                              sizeof value);
        snprintf(buffer + used, size - used, "%s%s %s", a > 0 ? ", " : "",
                 quantities_column(&study->axis[a]), value);
    }
    return buffer;
}

GString *gb_quantity_chart_table_csv(const struct gb_quantity_table *table,
                                     const char *comment)
{
    const struct gb_quantity_study *study = table->quantity->study;
    const int axes = gb_quantity_chart_axes(study);
    struct gb_listing *listing = gb_listing_new();
    gb_listing_comment(listing, "greenbody " GB_VERSION);
    gb_listing_comment(listing, comment);
    gb_listing_columns(listing, "%s", "quantity,unit");
    for (int a = 0; a < axes; a++) {
        gb_listing_columns(listing, "%.8g", quantities_column(&study->axis[a]));
    }
    gb_listing_columns(
        listing, "%.8g",
        "reference,default,seeds,failed,cpu_s,cost,value,scatter,error,"
        "error_se,error_95,bound,half_interval,noise_limited,front,chosen");
    for (guint i = 0; i < table->row->len; i++) {
        const struct gb_quantity_result *row = gb_quantity_chart_table_at(table, i);
        if (row->seeds == 0) {
            continue;
        }
        gb_listing_text(listing, table->quantity->name);
        gb_listing_text(listing, table->quantity->unit);
        const double number[] = {i == 0,
                                 i == 1,
                                 row->seeds,
                                 row->failed,
                                 row->cpu_s,
                                 row->cost,
                                 row->value,
                                 row->scatter,
                                 i == 0 ? (double)NAN : row->error,
                                 i == 0 ? (double)NAN : row->error_se,
                                 i == 0 ? (double)NAN : row->error_95,
                                 row->bound,
                                 table->half_interval,
                                 row->noise_limited,
                                 row->front,
                                 row->chosen};
        gb_listing_numbers(listing, row->setting.value, (size_t)axes);
        gb_listing_numbers(listing, number, G_N_ELEMENTS(number));
    }
    return gb_listing_end(listing, GB_LISTING_CSV);
}

static void add_row(GString *text, const struct gb_quantity_table *table, guint i)
{
    const struct gb_quantity_result *row = gb_quantity_chart_table_at(table, i);
    char setting[DESCRIPTION], deviation[64] = "", share[GB_NUMBER_MAX] = "";
    char number[GB_NUMBER_MAX];
    if (i == 0) {
        snprintf(deviation, sizeof deviation, "value %s",
                 gb_number_shown("%.4g", row->value, number));
    } else if (row->failed > 0) {
        snprintf(deviation, sizeof deviation, "%d of %d failed", row->failed, row->seeds);
    } else if (!isfinite(row->bound)) {
        snprintf(deviation, sizeof deviation, "needs 2 seeds");
    } else {
        snprintf(deviation, sizeof deviation, "%+.3g ± %.2g", row->error, row->error_95);
        gb_number_shown("%.2f", row->bound / table->half_interval, share);
    }
    const int wide = (int)(strlen(deviation) - (size_t)g_utf8_strlen(deviation, -1));
    g_string_append_printf(
        text, "%c%c%c%c %7.3g  %5s  %5d  %-*s  %5s  %s\n",
        i == 0   ? 'R'
        : i == 1 ? 'D'
                 : ' ',
        row->front ? 'F' : ' ', row->noise_limited ? 'n' : ' ', row->chosen ? '*' : ' ',
        row->cpu_s, gb_number_shown("%.2f", row->cost, number), row->seeds, 20 + wide,
        deviation, share,
        describe(table->quantity->study, &row->setting, setting, sizeof setting));
}

GString *gb_quantity_chart_table_text(const struct gb_quantity_table *table)
{
    const struct gb_quantity *quantity = table->quantity;
    const bool unit = strcmp(quantity->unit, "1") != 0;
    GString *text = g_string_new(NULL);
    char setting[DESCRIPTION], number[GB_NUMBER_MAX];
    g_string_append_printf(text, "%s%s%s, %s (%s)\n", quantity->name, unit ? ", " : "",
                           unit ? quantity->unit : "", quantity->meaning,
                           quantity->study->name);
    g_string_append(text, "       CPU s   cost  seeds  deviation, 95 %       share  "
                          "setting\n");
    for (guint i = 0; i < table->row->len; i++) {
        if (gb_quantity_chart_table_at(table, i)->seeds > 0) {
            add_row(text, table, i);
        }
    }
    g_string_append(
        text,
        "R reference, D the default, F Pareto-optimal in cost and deviation,\n"
        "n the interval contains 0, * recommended; CPU s of one cell, cost over the cost of\n"
        "the default; share: upper bound of the deviation over half of the interval\n\n");
    if (!isfinite(table->allowed)) {
        g_string_append(text, "two seeds of a setting are needed for an interval\n");
        return text;
    }
    g_string_append_printf(text, "half of the 95 %% interval of %d cells: %s\n",
                           quantity->study->cells,
                           gb_number_shown("%.3g", table->half_interval, number));
    const struct gb_quantity_result *chosen = gb_quantity_chart_table_chosen(table);
    if (chosen == NULL) {
        g_string_append_printf(
            text,
            "no setting is known to deviate by less than %.3g; more seeds reduce the "
            "uncertainty\n",
            table->allowed);
    } else {
        g_string_append_printf(
            text, "cheapest setting that deviates by less than %.3g: %s", table->allowed,
            describe(quantity->study, &chosen->setting, setting, sizeof setting));
        if (isfinite(chosen->cost)) {
            g_string_append_printf(
                text, " (%.2g times the default's time%s)", chosen->cost,
                chosen->cost > cost_most ? ", which is more than three" : "");
        }
        g_string_append_c(text, '\n');
    }
    return text;
}
