/* Accuracy against cost of the numerical settings of a scene: one cell with one setting, the
 * plan of settings, and the directory that keeps the cells. */
#include "study/chart.h"

#include <errno.h>
#include <fcntl.h>
#include <glib.h>
#include <inttypes.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/file.h"
#include "base/listing.h"
#include "base/table.h"
#include "base/units.h"
#include "greenbody/params.h"
#include "greenbody/status.h"
#include "io/preset.h"
#include "many/runset.h"
#include "measure/average.h"
#include "run/experiment.h"
#include "scene/loading_kind.h"
#include "scene/model.h"
#include "scene/seed.h"
#include "scene/tolerances.h"
#include "solve/relax/relax.h"

/* One cell simulated with one setting of the numerics: a measurement of `greenbody chart`.
 */

/* --- one cell ------------------------------------------------------------------------- */

/* Evaluations between two calls of `cancelled`. */
enum { SLICE = 2000 };

bool gb_chart_setting_of(struct gb_chart_setting *setting, const struct gb_params *params,
                         struct gb_error *err)
{
    struct gb_model model;
    if (!gb_model_init(&model, params, err)) {
        return false;
    }
    const bool dynamic = gb_loading_kind_at(model.kind)->follows_time;
    *setting = (struct gb_chart_setting){
        .count = model.count,
        .strain_step = dynamic ? (double)NAN : model.strain_step / model.numerics.parts,
        .tolerance = dynamic ? (double)NAN : model.numerics.tolerance,
        .cutoff = model.numerics.cutoff,
        .single = model.numerics.single,
        .time_step =
            model.dynamics.time_step > 0.0 ? model.dynamics.time_step : (double)NAN,
        .step_error = dynamic && !(model.dynamics.time_step > 0.0)
                          ? model.dynamics.step_error
                          : (double)NAN,
    };
    g_strlcpy(setting->relaxer, dynamic ? "verlet" : model.numerics.relaxer,
              sizeof setting->relaxer);
    return true;
}

void gb_chart_apply(struct gb_params *params, const struct gb_chart_setting *setting)
{
    if (setting->count != params->count) {
        params->count = setting->count;
        params->base = (struct gb_relative){0.0, true}; /* auto */
    }
    params->cutoff = (struct gb_relative){setting->cutoff, true};
    if (gb_loading_kind_of(params)->follows_time) {
        params->time_step = (struct gb_relative){setting->time_step, true};
        if (isnan(setting->time_step)) {
            params->step_error = setting->step_error;
        }
        return;
    }
    g_strlcpy(params->relaxer, setting->relaxer, sizeof params->relaxer);
    params->precision = setting->single ? GB_PRECISION_SINGLE : GB_PRECISION_DOUBLE;
    /* as many recorded points as before, where the setting allows it */
    params->strain_part = setting->strain_step;
    params->strain_step = fmax(params->strain_step, setting->strain_step);
    params->tolerance = setting->tolerance;
}

static bool same_number(double a, double b)
{
    /* rounding differs between a step divided and a part multiplied */
    return fabs(a - b) <= 1e-12 * fabs(a) || (isnan(a) && isnan(b));
}

bool gb_chart_same(const struct gb_chart_setting *a, const struct gb_chart_setting *b)
{
    return strcmp(a->relaxer, b->relaxer) == 0 && a->count == b->count &&
           a->single == b->single && same_number(a->strain_step, b->strain_step) &&
           same_number(a->tolerance, b->tolerance) && same_number(a->cutoff, b->cutoff) &&
           same_number(a->time_step, b->time_step) &&
           same_number(a->step_error, b->step_error);
}

char *gb_chart_describe(const struct gb_chart_setting *setting, char *buffer, size_t size)
{
    char numbers[96] = "";
    if (isfinite(setting->strain_step)) {
        snprintf(numbers, sizeof numbers, "step %.4g %%, tolerance %.4g",
                 100.0 * setting->strain_step, setting->tolerance);
    } else if (isfinite(setting->time_step)) {
        snprintf(numbers, sizeof numbers, "time step %.4g T", setting->time_step);
    } else {
        snprintf(numbers, sizeof numbers, "time step by an error of %.4g %%",
                 100.0 * setting->step_error);
    }
    snprintf(buffer, size, "%s, %s, cutoff %.4g d, %s precision, %lld particles",
             setting->relaxer, numbers, setting->cutoff,
             setting->single ? "single" : "double", (long long)setting->count);
    return buffer;
}

/* CPU time of this thread. */
static double chart_cpu_s(void)
{
    return gb_clock_thread_s();
}

/* The recorded loading branch. */
struct branch {
    GArray *pressure, *density, *coordination; /* of double */
};

static void branch_init(struct branch *branch)
{
    branch->pressure = g_array_new(FALSE, FALSE, sizeof(double));
    branch->density = g_array_new(FALSE, FALSE, sizeof(double));
    branch->coordination = g_array_new(FALSE, FALSE, sizeof(double));
}

static void branch_finish(struct branch *branch)
{
    g_array_free(branch->pressure, TRUE);
    g_array_free(branch->density, TRUE);
    g_array_free(branch->coordination, TRUE);
}

static double crossing(const struct branch *branch, const GArray *y, double pressure)
{
    const struct gb_average_curve curve = {
        .x = (const double *)(const void *)branch->pressure->data,
        .y = (const double *)(const void *)y->data,
        .count = y->len,
    };
    return gb_average_crossing(&curve, pressure, NULL);
}

static void add_point(struct branch *branch, const struct gb_point *point)
{
    if (point->branch == GB_BRANCH_LOAD) {
        g_array_append_val(branch->pressure, point->p_pa);
        g_array_append_val(branch->density, point->density);
        g_array_append_val(branch->coordination, point->coordination);
    }
}

static bool advance(struct gb_chart_run *run, struct gb_experiment *experiment,
                    struct branch *branch, bool (*cancelled)(void *data, double cpu_s),
                    void *data, struct gb_error *err)
{
    const double start = chart_cpu_s();
    struct gb_error why = {0};
    enum gb_step_outcome how = GB_STEP_MORE;
    while (how == GB_STEP_MORE || how == GB_STEP_POINT) {
        how = gb_experiment_advance(experiment, SLICE, &why);
        run->cpu_s = chart_cpu_s() - start;
        if (how == GB_STEP_POINT) {
            run->evaluations += (double)gb_experiment_point(experiment)->evaluations;
            add_point(branch, gb_experiment_point(experiment));
        }
        if (cancelled && cancelled(data, run->cpu_s)) {
            return gb_error_set(err, GB_ERR_CANCELLED, "cancelled");
        }
    }
    run->failed = how == GB_STEP_STOPPED;
    const bool guarded = why.code == GB_ERR_GUARD || why.code == GB_ERR_NOT_CONVERGED;
    return !run->failed || guarded || gb_error_set(err, why.code, "%s", why.text);
}

static struct gb_params scene_of(const struct gb_chart_run *run,
                                 const struct gb_params *scene, const double *pressure_pa,
                                 int pressures)
{
    struct gb_params params = *scene;
    gb_chart_apply(&params, &run->setting);
    params.seed = run->seed;
    params.threads = 1;
    params.unload_count = 0;
    params.hold_s = 0.0;
    for (int k = 0; k < pressures && isfinite(params.until_pressure_pa); k++) {
        params.until_pressure_pa =
            k == 0 ? pressure_pa[0] : fmax(params.until_pressure_pa, pressure_pa[k]);
    }
    return params;
}

bool gb_chart_press(struct gb_chart_run *run, const struct gb_params *scene,
                    const double *pressure_pa, int pressures,
                    bool (*cancelled)(void *data, double cpu_s), void *data,
                    struct gb_error *err)
{
    const struct gb_params params = scene_of(run, scene, pressure_pa, pressures);
    struct gb_experiment *experiment = NULL;
    if (!gb_experiment_create(&experiment, &params, NULL, NULL, err)) {
        return false;
    }
    struct branch branch;
    branch_init(&branch);
    run->evaluations = 0.0;
    const bool done = advance(run, experiment, &branch, cancelled, data, err);
    for (int k = 0; k < GB_CHART_PRESSURES; k++) {
        const bool there = done && !run->failed && k < pressures;
        run->density[k] =
            there ? crossing(&branch, branch.density, pressure_pa[k]) : (double)NAN;
        run->coordination[k] =
            there ? crossing(&branch, branch.coordination, pressure_pa[k]) : (double)NAN;
    }
    branch_finish(&branch);
    gb_experiment_destroy(experiment);
    return done;
}

/* --- the plan ------------------------------------------------------------------------- */

/* The reference of a quasi-static chart: a fifth of P1's strain step, relaxed twice as
 * far as fidelity = reference; of a dynamic one P2's own step. */
static const double reference_step = 2e-4, reference_tolerance = 1e-3;
static const double reference_time_step = 0.04;

/* Limits a mistyped list. */
enum { SETTINGS_MAX = 2000 };

static const char *const varied[] = {
    "loading.step",        "numerics.relaxer",   "numerics.tolerance",
    "numerics.cutoff",     "numerics.precision", "numerics.time_step",
    "numerics.step_error", "particles.count",    NULL,
};

/* Adds the setting of params, if it is new. */
static bool add(GArray *settings, const struct gb_params *params, struct gb_error *err)
{
    struct gb_chart_setting setting;
    if (!gb_params_check(params, err) || !gb_chart_setting_of(&setting, params, err)) {
        return false;
    }
    /* the preset's own is a row even where it equals the reference */
    for (guint i = settings->len == 1 ? 1 : 0; i < settings->len; i++) {
        if (gb_chart_same(&g_array_index(settings, struct gb_chart_setting, i),
                          &setting)) {
            return true;
        }
    }
    if (settings->len >= SETTINGS_MAX) {
        return gb_error_set(err, GB_ERR_INPUT, "--vary: expected up to %d combinations",
                            SETTINGS_MAX);
    }
    g_array_append_val(settings, setting);
    return true;
}

/* A strain step that is compared is not divided into parts. */
static bool assign(struct gb_params *params, const char *assignment, struct gb_error *err)
{
    if (!gb_params_assign(params, assignment, err)) {
        return false;
    }
    if (g_str_has_prefix(assignment, "loading.step=")) {
        params->strain_part = params->strain_step;
    }
    return true;
}

static bool add_assigned(GArray *settings, const struct gb_params *params,
                         const char *first, const char *second, struct gb_error *err)
{
    struct gb_params changed = *params;
    return assign(&changed, first, err) &&
           (second == NULL || assign(&changed, second, err)) &&
           add(settings, &changed, err);
}

/* All combinations of the lists from `vary` on. */
static bool add_product(GArray *settings, const struct gb_params *params,
                        const char *const *vary, struct gb_error *err)
{
    if (*vary == NULL) {
        return add(settings, params, err);
    }
    const char *equals = strchr(*vary, '=');
    char *key = equals ? g_strndup(*vary, (gsize)(equals - *vary)) : g_strdup(*vary);
    if (!equals || !g_strv_contains(varied, key)) {
        char *keys = g_strjoinv(", ", (char **)(void *)varied);
        gb_error_set(err, GB_ERR_INPUT,
                     "--vary %.80s: expected group.key=a,b,... with %s", *vary, keys);
        g_free(keys);
        g_free(key);
        return false;
    }
    char **values = g_strsplit(equals + 1, ",", -1);
    bool good = true;
    for (int i = 0; values[i] != NULL && good; i++) {
        struct gb_params changed = *params;
        char *assignment = g_strconcat(key, "=", values[i], NULL);
        good = assign(&changed, assignment, err) &&
               add_product(settings, &changed, vary + 1, err);
        g_free(assignment);
    }
    g_strfreev(values);
    g_free(key);
    return good;
}

/* Settings with more than this fraction of the cost of the reference are left out. */
static const double effort_max = 0.25;

static void drop_expensive(GArray *settings)
{
    const struct gb_chart_setting *all = (const void *)settings->data;
    const guint last = settings->len - 1;
    if (last > 1 && gb_chart_effort(&all[last]) > effort_max * gb_chart_effort(&all[0])) {
        g_array_set_size(settings, last);
    }
}

static bool add_grid(GArray *settings, const struct gb_params *params,
                     struct gb_error *err)
{
    static const char *const step[] = {"loading.step=0.02 %", "loading.step=0.05 %",
                                       "loading.step=0.1 %",  "loading.step=0.2 %",
                                       "loading.step=0.5 %",  "loading.step=1 %"};
    static const char *const tolerance[] = {
        "numerics.tolerance=0.05",  "numerics.tolerance=0.03",
        "numerics.tolerance=0.02",  "numerics.tolerance=0.01",
        "numerics.tolerance=0.005", "numerics.tolerance=0.002"};
    static const char *const tight[] = {
        "numerics.tolerance=1e-3", "numerics.tolerance=1e-4", "numerics.tolerance=1e-5"};
    for (int m = 0; gb_relax_table()[m] != NULL; m++) {
        const char *name = gb_relax_table()[m]->name;
        struct gb_params changed = *params;
        g_strlcpy(changed.relaxer, name, sizeof changed.relaxer);
        if (gb_relax_table()[m]->slow) {
            /* hundreds of evaluations per step: one loose setting, and P1's own step */
            if (!add_assigned(settings, &changed, step[4], tolerance[0], err) ||
                !add_assigned(settings, &changed, step[2], tolerance[3], err)) {
                return false;
            }
            continue;
        }
        for (size_t s = 0; s < G_N_ELEMENTS(step); s++) {
            for (size_t t = 0; t < G_N_ELEMENTS(tolerance); t++) {
                if (!add_assigned(settings, &changed, step[s], tolerance[t], err)) {
                    return false;
                }
                drop_expensive(settings);
            }
        }
        /* the effect of the tolerance alone */
        for (size_t t = 0; t < G_N_ELEMENTS(tight); t++) {
            if (!add_assigned(settings, &changed, step[5], tight[t], err)) {
                return false;
            }
        }
    }
    return true;
}

/* The cutoffs of the three fidelities, other keys as in the preset. */
static bool add_cutoffs(GArray *settings, const struct gb_params *params,
                        struct gb_error *err)
{
    static const double share[] = {GB_CUTOFF_FRACTION_FAST, GB_CUTOFF_FRACTION_BALANCED,
                                   GB_CUTOFF_FRACTION_REFERENCE};
    struct gb_model model;
    if (!gb_model_init(&model, params, err)) {
        return false;
    }
    for (size_t k = 0; k < G_N_ELEMENTS(share) && model.terms.attraction; k++) {
        struct gb_params changed = *params;
        changed.cutoff = (struct gb_relative){
            fmax(gb_law_dispersion_range(&model.dispersion, share[k]), GB_CUTOFF_MIN),
            true};
        if (!add(settings, &changed, err)) {
            return false;
        }
    }
    return true;
}

/* The preset's setting in both precisions, where both exist. */
static bool add_precisions(GArray *settings, const struct gb_params *params,
                           struct gb_error *err)
{
    struct gb_params changed = *params;
    for (int p = GB_PRECISION_DOUBLE; p <= GB_PRECISION_SINGLE; p++) {
        changed.precision = p;
        if (params->dimension == 3 && !add(settings, &changed, err)) {
            return false;
        }
    }
    return true;
}

/* From a quarter to eight times the particles, where the cell is large enough. */
static bool add_sizes(GArray *settings, const struct gb_params *params,
                      struct gb_error *err)
{
    static const double factor[] = {0.25, 0.5, 2.0, 4.0, 8.0};
    for (size_t k = 0; k < G_N_ELEMENTS(factor); k++) {
        struct gb_params changed = *params;
        struct gb_error too_small = {0};
        changed.count = (int64_t)round(factor[k] * (double)params->count);
        changed.base = (struct gb_relative){0.0, true};
        if (!add(settings, &changed, &too_small) && too_small.code != GB_ERR_INPUT) {
            *err = too_small;
            return false;
        }
    }
    return true;
}

static bool add_dynamic(GArray *settings, const struct gb_params *params,
                        struct gb_error *err)
{
    static const char *const step[] = {
        "numerics.time_step=0.08 T", "numerics.time_step=0.15 T",
        "numerics.time_step=0.3 T",  "numerics.time_step=0.5 T",
        "numerics.time_step=0.7 T",
    };
    for (size_t k = 0; k < G_N_ELEMENTS(step); k++) {
        if (!add_assigned(settings, params, step[k], NULL, err)) {
            return false;
        }
    }
    for (const char *const *error =
             (const char *const[]){"0.02 %", "0.1 %", "0.5 %", NULL};
         *error != NULL; error++) {
        char *assignment = g_strconcat("numerics.step_error=", *error, NULL);
        const bool good =
            add_assigned(settings, params, "numerics.time_step=auto", assignment, err);
        g_free(assignment);
        if (!good) {
            return false;
        }
    }
    return true;
}

static bool add_reference(GArray *settings, const struct gb_params *params,
                          const char *const *changes, struct gb_error *err)
{
    struct gb_params reference = *params;
    reference.fidelity = GB_FIDELITY_REFERENCE;
    reference.cutoff = (struct gb_relative){(double)NAN, true};
    g_strlcpy(reference.relaxer, "fire", sizeof reference.relaxer);
    reference.tolerance = reference_tolerance;
    reference.strain_part = fmin(reference_step, params->strain_step);
    if (gb_loading_kind_of(params)->follows_time) {
        reference.time_step = (struct gb_relative){reference_time_step, true};
    }
    for (int i = 0; changes && changes[i]; i++) {
        if (!assign(&reference, changes[i], err)) {
            return false;
        }
    }
    return add(settings, &reference, err);
}

/* Pressures are read as the value of loading.unload_from. */
static bool plan_pressures(struct gb_chart_plan *plan, const char *text,
                           struct gb_error *err)
{
    struct gb_params read = plan->params;
    if (text) {
        const struct gb_field *field = gb_params_find("loading", "unload_from");
        struct gb_error why = {0};
        if (!gb_params_set(&read, field, text, &why) ||
            read.unload_count > GB_CHART_PRESSURES || read.unload_count == 0) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "--at %.80s: expected up to %d pressures, as in "
                                "'100 MPa; 1 GPa'",
                                text, GB_CHART_PRESSURES);
        }
    } else if (read.unload_count == 0) {
        read.unload_from_pa[read.unload_count++] = 100e6;
    }
    for (int k = 0; k < read.unload_count && plan->pressures < GB_CHART_PRESSURES; k++) {
        plan->pressure_pa[plan->pressures++] = read.unload_from_pa[k];
    }
    const double last = plan->pressure_pa[plan->pressures - 1];
    const double end = isfinite(read.until_pressure_pa) ? read.until_pressure_pa : 1e9;
    if (!text && end > last && plan->pressures < GB_CHART_PRESSURES) {
        plan->pressure_pa[plan->pressures++] = end;
    }
    return true;
}

double gb_chart_effort(const struct gb_chart_setting *setting)
{
    const double reach = setting->cutoff * setting->cutoff;
    if (isnan(setting->strain_step)) {
        const double step = isnan(setting->time_step) ? sqrt(50.0 * setting->step_error)
                                                      : setting->time_step;
        return reach * (double)setting->count / step;
    }
    const struct gb_relaxer *relaxer = gb_relax_find(setting->relaxer);
    const double slow = relaxer != NULL && relaxer->slow ? 100.0 : 1.0;
    return reach * slow * (double)setting->count /
           sqrt(setting->strain_step * setting->tolerance);
}

static int by_effort(const void *a, const void *b)
{
    const double x = gb_chart_effort(a), y = gb_chart_effort(b);
    return (x > y) - (x < y);
}

/* An empty list is as good as NULL. */
static bool given(const char *const *list)
{
    return list != NULL && list[0] != NULL;
}

static bool check_seeds(const struct gb_params *params, int seeds, struct gb_error *err)
{
    const size_t cells = seeds > 0 ? (size_t)seeds : 1;
    const uint64_t most = UINT64_MAX - (cells - 1);
    if (!gb_seed_check_cells(params, cells, err)) {
        return false;
    }
    return params->seed <= most ||
           gb_error_set(err, GB_ERR_INPUT,
                        "structure.seed = %" PRIu64 ": expected up to %" PRIu64
                        " in a chart of %d seeds",
                        params->seed, most, seeds);
}

/* Settings are compared by tolerances in one unit. */
static bool check_scale(const struct gb_params *params, struct gb_error *err)
{
    return params->tolerance_scale == GB_TOLERANCE_CONTACT ||
           gb_loading_kind_of(params)->follows_time ||
           gb_error_set(err, GB_ERR_INPUT,
                        "numerics.tolerance_scale: must be contact in a chart");
}

bool gb_chart_plan_init(struct gb_chart_plan *plan, const struct gb_params *params,
                        const char *const *vary, const char *const *reference,
                        const char *pressures, int seeds, struct gb_error *err)
{
    *plan = (struct gb_chart_plan){.params = *params, .seeds = seeds};
    GArray *settings = g_array_new(FALSE, FALSE, sizeof(struct gb_chart_setting));
    bool good = gb_loading_kind_check_cell(params, "a chart", err) &&
                check_seeds(params, seeds, err) && check_scale(params, err) &&
                plan_pressures(plan, pressures, err) &&
                add_reference(settings, params, reference, err) &&
                add(settings, params, err);
    if (good && given(vary)) {
        good = add_product(settings, params, vary, err);
    } else if (good && gb_loading_kind_of(params)->follows_time) {
        good = add_dynamic(settings, params, err) && add_sizes(settings, params, err);
    } else if (good) {
        good = add_grid(settings, params, err) && add_cutoffs(settings, params, err) &&
               add_precisions(settings, params, err) && add_sizes(settings, params, err);
    }
    plan->settings = settings->len;
    plan->setting = (struct gb_chart_setting *)(void *)g_array_free(settings, FALSE);
    if (good && plan->settings > 2) {
        qsort(plan->setting + 2, plan->settings - 2, sizeof *plan->setting, by_effort);
    }
    return good;
}

void gb_chart_plan_finish(struct gb_chart_plan *plan)
{
    g_free(plan->setting);
    *plan = (struct gb_chart_plan){0};
}

/* --- the directory -------------------------------------------------------------------- */

/* Keys of the settings, and those without effect on the results. */
static const char *const free_keys[] = {
    "loading.step",
    "loading.unload_from",
    "numerics.fidelity",
    "numerics.relaxer",
    "numerics.tolerance",
    "numerics.cutoff",
    "numerics.precision",
    "numerics.time_step",
    "numerics.step_error",
    "numerics.strain_part",
    NULL,
};

static char *path_of(const struct gb_chart_log *log, const char *name)
{
    return g_build_filename(log->directory, name, NULL);
}

static bool exists(const struct gb_chart_log *log, const char *name)
{
    char *path = path_of(log, name);
    const bool there = g_file_test(path, G_FILE_TEST_EXISTS);
    g_free(path);
    return there;
}

static bool lock_directory(struct gb_chart_log *log, struct gb_error *err)
{
    log->lock = open(log->directory, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (log->lock < 0) {
        return gb_error_set(err, errno == ENOTDIR ? GB_ERR_INPUT : GB_ERR_MACHINE,
                            "%.300s: %s", log->directory, g_strerror(errno));
    }
    return flock(log->lock, LOCK_EX | LOCK_NB) == 0 ||
           gb_error_set(err, GB_ERR_INPUT, "%.300s: a chart is under way there",
                        log->directory);
}

/* Apart from the preset that the workbench puts there. */
static bool is_empty(const char *directory)
{
    GDir *dir = g_dir_open(directory, 0, NULL);
    bool empty = dir != NULL;
    const char *name;
    while (empty && (name = g_dir_read_name(dir)) != NULL) {
        empty = strcmp(name, "scene.ini") == 0;
    }
    if (dir) {
        g_dir_close(dir);
    }
    return empty;
}

static bool write_scene(const struct gb_chart_log *log, struct gb_error *err)
{
    struct gb_preset *preset = NULL;
    if (!gb_preset_create(&preset, err)) {
        return false;
    }
    *gb_preset_params(preset) = log->plan->params;
    char *path = path_of(log, "preset.ini");
    const bool good = gb_preset_save(preset, path, GB_PRESET_ALL_KEYS, err);
    g_free(path);
    gb_preset_destroy(preset);
    return good;
}

static bool check_scene(const struct gb_chart_log *log, struct gb_error *err)
{
    char *path = path_of(log, "preset.ini");
    struct gb_preset *preset = NULL;
    bool good = gb_preset_load(&preset, path, err);
    if (good) {
        const struct gb_field *field = gb_runset_differing_key(
            gb_preset_params(preset), &log->plan->params, free_keys);
        good = field == NULL ||
               gb_error_set(err, GB_ERR_INPUT,
                            "%.300s: the chart of a scene with another %s.%s; expected: "
                            "the same scene, or a new directory",
                            path, field->group, field->key);
    }
    gb_preset_destroy(preset);
    g_free(path);
    return good;
}

/* "density_100MPa" */
static void column_name(const struct gb_chart_log *log, const char *what, int k,
                        char *name, size_t size)
{
    g_snprintf(name, (gulong)size, "%s_%.6gMPa", what, log->plan->pressure_pa[k] / 1e6);
}

struct columns {
    const double *count, *step, *tolerance, *cutoff, *bits, *time_step, *step_error,
        *failed, *evaluations, *cpu_s;
    const uint64_t *seed;
    const double *density[GB_CHART_PRESSURES], *coordination[GB_CHART_PRESSURES];
};

static bool find_columns(const struct gb_chart_log *log, const struct gb_table *table,
                         struct columns *c, struct gb_error *err)
{
    const struct {
        const char *name;
        const double **column;
    } wanted[] = {
        {"particles", &c->count},
        {"step", &c->step},
        {"tolerance", &c->tolerance},
        {"cutoff_d", &c->cutoff},
        {"bits", &c->bits},
        {"time_step_T", &c->time_step},
        {"step_error", &c->step_error},
        {"failed", &c->failed},
        {"evaluations", &c->evaluations},
        {"cpu_s", &c->cpu_s},
    };
    c->seed = gb_table_whole(table);
    bool good = c->seed != NULL || gb_table_column(table, "seed", err) != NULL;
    for (size_t i = 0; i < G_N_ELEMENTS(wanted) && good; i++) {
        *wanted[i].column = gb_table_column(table, wanted[i].name, err);
        good = *wanted[i].column != NULL;
    }
    for (int k = 0; k < log->plan->pressures && good; k++) {
        char name[48];
        column_name(log, "density", k, name, sizeof name);
        c->density[k] = gb_table_column(table, name, err);
        column_name(log, "coordination", k, name, sizeof name);
        c->coordination[k] = c->density[k] ? gb_table_column(table, name, err) : NULL;
        good = c->coordination[k] != NULL;
    }
    return good;
}

static bool read_runs(struct gb_chart_log *log, struct gb_error *err)
{
    char *path = path_of(log, "runs.csv");
    struct gb_table *table = NULL;
    struct columns c = {0};
    const bool good = gb_table_read_whole(&table, path, "relaxer", "seed", err) &&
                      find_columns(log, table, &c, err);
    for (size_t i = 0; good && i < gb_table_rows(table); i++) {
        struct gb_chart_run run = {
            .setting = {.count = (int64_t)c.count[i],
                        .strain_step = c.step[i],
                        .tolerance = c.tolerance[i],
                        .cutoff = c.cutoff[i],
                        .single = c.bits[i] < 64.0,
                        .time_step = c.time_step[i],
                        .step_error = c.step_error[i]},
            .seed = c.seed[i],
            .failed = c.failed[i] != 0.0,
            .evaluations = c.evaluations[i],
            .cpu_s = c.cpu_s[i],
        };
        g_strlcpy(run.setting.relaxer, gb_table_word(table, i),
                  sizeof run.setting.relaxer);
        for (int k = 0; k < log->plan->pressures; k++) {
            run.density[k] = c.density[k][i];
            run.coordination[k] = c.coordination[k][i];
        }
        g_array_append_val(log->runs, run);
    }
    gb_table_destroy(table);
    g_free(path);
    return good;
}

static void add_row(const struct gb_chart_log *log, struct gb_listing *listing,
                    const struct gb_chart_run *run)
{
    const struct gb_chart_setting *c = &run->setting;
    const double setting[] = {(double)c->count, c->strain_step, c->tolerance, c->cutoff,
                              gb_chart_bits(c), c->time_step,   c->step_error};
    const double result[] = {(double)run->failed, run->evaluations, run->cpu_s};
    gb_listing_text(listing, c->relaxer);
    gb_listing_numbers(listing, setting, G_N_ELEMENTS(setting));
    gb_listing_whole(listing, run->seed);
    gb_listing_numbers(listing, result, G_N_ELEMENTS(result));
    for (int k = 0; k < log->plan->pressures; k++) {
        gb_listing_number(listing, run->density[k]);
        gb_listing_number(listing, run->coordination[k]);
    }
}

static bool write_runs(const struct gb_chart_log *log, struct gb_error *err)
{
    struct gb_listing *listing = gb_listing_new();
    gb_listing_comment(listing,
                       "greenbody " GB_VERSION "\ncells simulated for chart.csv; "
                       "cpu_s: of the loading, one thread");
    gb_listing_columns(listing, "%s", "relaxer");
    gb_listing_columns(
        listing, "%.17g",
        "particles,step,tolerance,cutoff_d,bits,time_step_T,step_error,seed,"
        "failed,evaluations,cpu_s");
    for (int k = 0; k < log->plan->pressures; k++) {
        char name[48];
        column_name(log, "density", k, name, sizeof name);
        gb_listing_columns(listing, "%.17g", name);
        column_name(log, "coordination", k, name, sizeof name);
        gb_listing_columns(listing, "%.17g", name);
    }
    for (guint i = 0; i < log->runs->len; i++) {
        add_row(log, listing, &g_array_index(log->runs, struct gb_chart_run, i));
    }
    return gb_listing_store(listing, log->directory, "runs.csv", err);
}

bool gb_chart_open(struct gb_chart_log *log, const char *directory,
                   const struct gb_chart_plan *plan, struct gb_error *err)
{
    *log = (struct gb_chart_log){.directory = g_strdup(directory), .plan = plan};
    log->lock = -1;
    log->runs = g_array_new(FALSE, FALSE, sizeof(struct gb_chart_run));
    if (g_mkdir_with_parents(directory, 0777) != 0) {
        const int why = errno;
        const bool input = why == ENOTDIR || why == EEXIST || why == ENAMETOOLONG;
        return gb_error_set(err, input ? GB_ERR_INPUT : GB_ERR_MACHINE, "%.300s: %s",
                            directory, g_strerror(why));
    }
    if (!lock_directory(log, err)) {
        return false;
    }
    if (exists(log, "runs.csv")) {
        return check_scene(log, err) && read_runs(log, err);
    }
    if (!is_empty(directory)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%.300s: holds other files and no chart; expected: a new or "
                            "empty directory, or a directory of a chart",
                            directory);
    }
    return write_scene(log, err) && write_runs(log, err);
}

void gb_chart_close(struct gb_chart_log *log)
{
    if (log->directory && log->lock >= 0) {
        close(log->lock);
    }
    if (log->runs) {
        g_array_free(log->runs, TRUE);
    }
    g_free(log->directory);
    *log = (struct gb_chart_log){.lock = -1};
}

const struct gb_chart_run *gb_chart_find(const struct gb_chart_log *log,
                                         const struct gb_chart_setting *setting,
                                         uint64_t seed)
{
    for (guint i = 0; i < log->runs->len; i++) {
        const struct gb_chart_run *run =
            &g_array_index(log->runs, struct gb_chart_run, i);
        if (run->seed == seed && gb_chart_same(&run->setting, setting)) {
            return run;
        }
    }
    return NULL;
}

bool gb_chart_add(struct gb_chart_log *log, const struct gb_chart_run *run,
                  struct gb_error *err)
{
    g_array_append_val(log->runs, *run);
    return write_runs(log, err);
}

bool gb_chart_keep(const struct gb_chart_log *log, const char *name, const GString *text,
                   struct gb_error *err)
{
    char *path = path_of(log, name);
    const bool good = gb_file_replace(path, text->str, text->len, err);
    g_free(path);
    return good;
}
