#include "study/chart/chart_plan.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <glib.h>

#include "scene/loading_kind.h"
#include "scene/model.h"
#include "scene/seed.h"
#include "scene/tolerances.h"
#include "solve/relax/relax.h"

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
        return gb_error_set(err, GB_ERR_INPUT, "--vary: accepted up to %d combinations",
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
                     "--vary %.80s: accepted group.key=a,b,... with %s", *vary, keys);
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
    if (last > 1 &&
        gb_chart_plan_effort(&all[last]) > effort_max * gb_chart_plan_effort(&all[0])) {
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
                                "--at %.80s: accepted up to %d pressures, as in "
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

double gb_chart_plan_effort(const struct gb_chart_setting *setting)
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
    const double x = gb_chart_plan_effort(a), y = gb_chart_plan_effort(b);
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
                        "structure.seed = %" PRIu64 ": accepted up to %" PRIu64
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
