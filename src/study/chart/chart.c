#include "study/chart/chart.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include <glib.h>

#include "base/clock.h"
#include "base/units.h"
#include "measure/fit/average.h"
#include "run/experiment.h"
#include "scene/loading_kind.h"
#include "scene/model.h"

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

double gb_chart_cpu_s(void)
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
    const double start = gb_chart_cpu_s();
    struct gb_error why = {0};
    enum gb_step_outcome how = GB_STEP_MORE;
    while (how == GB_STEP_MORE || how == GB_STEP_POINT) {
        how = gb_experiment_advance(experiment, SLICE, &why);
        run->cpu_s = gb_chart_cpu_s() - start;
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
