#include "cli/figures_relaxation.h"

#include <math.h>

#include "base/alloc.h"
#include "cli/figures_rate.h"
#include "measure/average.h"
#include "measure/fit.h"

/* Time at which a run's compression ended: its last row of loading. */
static bool end_of_loading(const struct gb_runset_run *run, double *end,
                           struct gb_error *err)
{
    double *x = NULL;
    double *y = NULL;
    size_t count = 0;
    if (!gb_runset_points(run, "load", "time_ns", "p_MPa", &x, &y, &count, err)) {
        return false;
    }
    *end = x[count - 1];
    gb_alloc_free(x);
    gb_alloc_free(y);
    return true;
}

/* Relaxations of a group, t from the end of each run's loading.  points: two arrays per
 * run, owned by the caller also on error. */
static bool load_relaxations(const struct gb_runset *set, size_t group, double **points,
                             struct gb_average_curve *curves, struct gb_error *err)
{
    size_t k = 0;
    for (size_t i = 0; i < set->count; i++) {
        double end = 0.0;
        size_t count = 0;
        if (set->run[i].group != group) {
            continue;
        }
        if (!end_of_loading(&set->run[i], &end, err) ||
            !gb_runset_points(&set->run[i], "hold", "time_ns", "p_MPa", &points[2 * k],
                              &points[2 * k + 1], &count, err)) {
            return false;
        }
        for (size_t j = 0; j < count; j++) {
            points[2 * k][j] -= end;
        }
        curves[k] = (struct gb_average_curve){points[2 * k], points[2 * k + 1], count};
        k++;
    }
    return true;
}

/* Mean of the curves where all of them are; arrays for gb_alloc_free, also on error. */
static bool mean_of_curves(const struct gb_average_curve *curves, size_t members,
                           double **t, double **p, size_t *count, struct gb_error *err)
{
    size_t size = 0;
    if (!gb_average_grid(curves, members, GB_SERIES_PLACES, t, &size, err)) {
        return false;
    }
    double *rows = gb_alloc_array(members * size, sizeof *rows, err);
    *p = gb_alloc_array(size, sizeof **p, err);
    bool good = rows != NULL && *p != NULL;
    for (size_t i = 0; i < members && good; i++) {
        good = gb_average_resample(&curves[i], *t, size, rows + i * size, err);
    }
    if (good) {
        gb_average_rows(rows, members, size, true, *p, NULL);
    }
    *count = 0;
    for (size_t i = 0; i < size && good; i++) {
        if (isfinite((*p)[i])) {
            (*t)[*count] = (*t)[i];
            (*p)[(*count)++] = (*p)[i];
        }
    }
    gb_alloc_free(rows);
    return good;
}

static bool mean_relaxation(const struct gb_runset *set, size_t group, double **t,
                            double **p, size_t *count, struct gb_error *err)
{
    const size_t members = gb_runset_members(set, group);
    struct gb_average_curve *curves = g_new0(struct gb_average_curve, members);
    double **points = g_new0(double *, 2 * members);
    const bool good = load_relaxations(set, group, points, curves, err) &&
                      mean_of_curves(curves, members, t, p, count, err);
    for (size_t i = 0; i < 2 * members; i++) {
        gb_alloc_free(points[i]);
    }
    g_free(points);
    g_free(curves);
    return good;
}

static bool fit_group(struct gb_fit_decay *fit, const struct gb_runset *set, size_t group,
                      struct gb_error *err)
{
    double *t = NULL;
    double *p = NULL;
    size_t count = 0;
    struct gb_error why = {0};
    bool good = mean_relaxation(set, group, &t, &p, &count, err);
    if (good && !gb_fit_decay(fit, t, p, count, &why)) {
        good = gb_error_set(err, why.code, "%.300s: relaxation: %s",
                            gb_runset_first(set, group)->directory, why.text);
    }
    gb_alloc_free(t);
    gb_alloc_free(p);
    return good;
}

/* Columns of one parameter: value and interval. */
static void value_columns(struct gb_series *series, const char *name, const char *unit,
                          const struct gb_fit_decay *fits, size_t offset)
{
    double *value = gb_series_column(series, "%s_%s", name, unit);
    double *low = gb_series_column(series, "%s_low_%s", name, unit);
    double *high = gb_series_column(series, "%s_high_%s", name, unit);
    for (size_t g = 0; g < series->rows; g++) {
        const struct gb_fit_value *found =
            (const struct gb_fit_value *)(const void *)((const char *)&fits[g] + offset);
        value[g] = found->value;
        low[g] = found->low;
        high[g] = found->high;
    }
}

static void relaxation_columns(struct gb_series *series, const struct gb_runset *set,
                               const struct gb_fit_decay *fits)
{
    static const char *const reasons[] = {
        "all that (4) has", "the F test shows no more",
        "the interval of one more contains zero or has no end",
        "one more did not settle"};
    double *group = gb_series_column(series, "group");
    double *rate = gb_series_column(series, "rate_per_s");
    double *runs = gb_series_column(series, "runs");
    double *terms = gb_series_column(series, "exponentials");
    for (size_t g = 0; g < set->groups; g++) {
        char *label = gb_runset_label(set, g);
        group[g] = (double)(g + 1);
        rate[g] = gb_runset_first(set, g)->params.rate_per_s;
        runs[g] = (double)gb_runset_members(set, g);
        terms[g] = fits[g].terms;
        gb_series_note(series, "group %zu: %s%s%d exponentials, %s", g + 1, label,
                       *label ? "; " : "", fits[g].terms, reasons[fits[g].reason]);
        g_free(label);
    }
    value_columns(series, "p0", "MPa", fits, offsetof(struct gb_fit_decay, p0));
    value_columns(series, "p1", "MPa", fits, offsetof(struct gb_fit_decay, amplitude[0]));
    value_columns(series, "tau1", "ns", fits, offsetof(struct gb_fit_decay, tau[0]));
    value_columns(series, "p2", "MPa", fits, offsetof(struct gb_fit_decay, amplitude[1]));
    value_columns(series, "tau2", "ns", fits, offsetof(struct gb_fit_decay, tau[1]));
    double *scatter = gb_series_column(series, "scatter_MPa");
    for (size_t g = 0; g < set->groups; g++) {
        scatter[g] = fits[g].scatter;
    }
}

bool gb_figures_relaxation(struct gb_series *series, const struct gb_runset *set,
                           const struct gb_figures_request *request, struct gb_error *err)
{
    (void)request;
    if (!gb_figures_rate_check(set, "relaxation", err)) {
        return false;
    }
    struct gb_fit_decay *fits = g_new0(struct gb_fit_decay, set->groups);
    bool good = true;
    for (size_t g = 0; g < set->groups && good; g++) {
        good = fit_group(&fits[g], set, g, err);
    }
    if (good) {
        gb_series_init(series, set->groups);
        gb_series_note(series,
                       "p(t) = p0 + p1 exp(-t/tau1) + p2 exp(-t/tau2), P2 (4), fitted to "
                       "the mean of the runs; t from the end of compression");
        gb_series_note(series,
                       "intervals are at 95 %%, for as many points as the correlation of "
                       "the residuals leaves independent");
        relaxation_columns(series, set, fits);
    }
    g_free(fits);
    return good;
}
