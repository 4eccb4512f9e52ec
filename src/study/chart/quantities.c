#include "study/chart/quantities.h"

#include <math.h>
#include <string.h>

#include <glib.h>

#include "base/clock.h"
#include "many/die_summary.h"
#include "many/lab/compaction_data.h"
#include "many/single_run.h"
#include "measure/cap/cap_fit.h"
#include "measure/fit/compaction/compaction_fits.h"
#include "run/moduli/moduli_table.h"
#include "scene/loading_kind.h"
#include "study/card/card_cell.h"
#include "study/compact/cells.h"
#include "study/compact/compact.h"
#include "study/compact/study_text.h"
#include "study/strength/strength_cell.h"
#include "study/yield/yield_cell.h"
#include "study/yield/yield_surface.h"

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
        !gb_yield_cell_measure(point, top_pa, &own, &ask->mark, &options, callbacks,
                               err) ||
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
    if (!gb_strength_cell_measure(test, &own, &ask->mark, &options, NULL, callbacks,
                                  err)) {
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
            const struct gb_quantity *row = gb_quantities_find(name, NULL);
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

/* die: the whole cycle of one bed. */

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
    (void)ask;
    struct gb_runset set = {0};
    const bool good =
        run_cell(&set, params, path, callbacks, err) && gb_die_summary_check(&set, err);
    for (const struct gb_die_summary_row *row = gb_die_summary_table();
         good && row->name != NULL; row++) {
        for (size_t k = 0; k < G_N_ELEMENTS(die_numbers); k++) {
            if (strcmp(row->name, die_numbers[k]) == 0) {
                value[k] = row->value(set.run[0].table);
            }
        }
    }
    gb_runset_finish(&set);
    return good;
}

static const struct gb_quantity_axis die_axes[] = {
    {"numerics.inertia_scale",
     GB_DIM_NONE,
     {0.2, 0.5, 1.0},
     0.2,
     own_inertia,
     set_inertia},
    {"numerics.safety", GB_DIM_NONE, {0.2, 0.5, 1.0}, 1.0, own_safety, set_safety},
    {"die.eject_speed", GB_DIM_SPEED, TIGHTER, 0.3, own_eject, set_eject},
    {"loading.time", GB_DIM_TIME, {5.0, 2.0, 1.0}, -0.5, own_time, set_time},
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

static const struct gb_quantity table[] = {
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

const struct gb_quantity *gb_quantities(void)
{
    return table;
}

const struct gb_quantity *gb_quantities_find(const char *name, struct gb_error *err)
{
    GString *names = g_string_new(NULL);
    const struct gb_quantity *row = table;
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

int gb_quantities_axes(const struct gb_quantity_study *study)
{
    int axes = 0;
    while (study->axis[axes].name != NULL) {
        axes++;
    }
    return axes;
}

const char *gb_quantities_column(const struct gb_quantity_axis *axis)
{
    const char *dot = strchr(axis->name, '.');
    return dot != NULL ? dot + 1 : axis->name;
}

char *gb_quantities_question(const struct gb_quantity_study *study,
                             const struct gb_quantity_ask *ask)
{
    GString *text = g_string_new(NULL);
    g_string_append_printf(text, "study=chart of %s\n", study->name);
    if (study->at != NULL) {
        g_string_append_printf(text, "by_density=%d\nmark=%.17g\n", ask->mark.by_density,
                               ask->mark.value);
    }
    for (int a = 0; a < gb_quantities_axes(study); a++) {
        g_string_append_printf(text, "%s=%.17g\n", study->axis[a].name, ask->setting[a]);
    }
    return g_string_free(text, FALSE);
}

static const struct gb_quantity_study *study_of(GKeyFile *question)
{
    const struct gb_quantity_study *study = NULL;
    char *name = g_key_file_get_string(question, "cell", "study", NULL);
    for (const struct gb_quantity *row = table; row->name != NULL; row++) {
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
    GString *text = g_string_new("cpu_s,failed");
    double number[2 + GB_QUANTITY_VALUES] = {cpu_s, failed};
    size_t count = 2;
    for (const struct gb_quantity *row = table; row->name != NULL; row++) {
        if (row->study == study) {
            g_string_append_printf(text, ",%s", row->name);
            number[count++] = value[row->index];
        }
    }
    g_string_append_c(text, '\n');
    gb_study_text_numbers(text, number, count);
    const bool good = gb_cells_answer(path, ".csv", text, err);
    g_string_free(text, TRUE);
    return good;
}

bool gb_quantities_work(const struct gb_params *params, const char *path,
                        const struct gb_pool_callbacks *callbacks, struct gb_error *err)
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
    for (int a = 0; study != NULL && a < gb_quantities_axes(study); a++) {
        ask.setting[a] = gb_cells_option(question, study->axis[a].name);
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
