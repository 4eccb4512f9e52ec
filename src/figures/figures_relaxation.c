#include "figures/figures_relaxation.h"

#include <math.h>

#include "base/alloc.h"
#include "figures/figures_label.h"
#include "figures/figures_rate.h"
#include "measure/fit/average.h"
#include "measure/fit/fit.h"

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

/* What is found from a group of runs. */
struct group_fit {
    struct gb_fit_decay decay;
    double fall_error, efold_error;
};

static bool fit_mean(struct gb_fit_decay *fit, const struct gb_average_curve *curves,
                     size_t members, struct gb_error *err)
{
    double *t = NULL;
    double *p = NULL;
    size_t count = 0;
    const bool good = mean_of_curves(curves, members, &t, &p, &count, err) &&
                      gb_fit_decay(fit, t, p, count, err);
    gb_alloc_free(t);
    gb_alloc_free(p);
    return good;
}

/* Standard errors from the fits without one of the runs each; a fit that fails is left
 * out. */
static void jackknife(struct group_fit *fit, struct gb_average_curve *curves,
                      size_t members)
{
    double *fall = g_new(double, 2 * members);
    double *efold = fall + members;
    for (size_t i = 0; i < members; i++) {
        struct gb_fit_decay without;
        struct gb_error ignored = {0};
        const struct gb_average_curve aside = curves[i];
        curves[i] = curves[members - 1]; /* order does not matter to a mean */
        const bool good =
            members > 1 && fit_mean(&without, curves, members - 1, &ignored);
        curves[i] = aside;
        fall[i] = good ? gb_fit_decay_fall(&without) : (double)NAN;
        efold[i] = good ? gb_fit_decay_efold(&without) : (double)NAN;
    }
    fit->fall_error = gb_average_jackknife(fall, members);
    fit->efold_error = gb_average_jackknife(efold, members);
    g_free(fall);
}

static bool fit_group(struct group_fit *fit, const struct gb_runset *set, size_t group,
                      struct gb_error *err)
{
    const size_t members = gb_runset_members(set, group);
    struct gb_average_curve *curves = g_new0(struct gb_average_curve, members);
    double **points = g_new0(double *, 2 * members);
    struct gb_error why = {0};
    bool good = load_relaxations(set, group, points, curves, err);
    if (good && !fit_mean(&fit->decay, curves, members, &why)) {
        good = gb_error_set(err, why.code, "%.300s: relaxation: %s",
                            gb_runset_first(set, group)->directory, why.text);
    }
    if (good) {
        jackknife(fit, curves, members);
    }
    for (size_t i = 0; i < 2 * members; i++) {
        gb_alloc_free(points[i]);
    }
    g_free(points);
    g_free(curves);
    return good;
}

/* Columns of one parameter: value and interval. */
static void value_columns(struct gb_series *series, const char *name, const char *unit,
                          const struct group_fit *fits, size_t offset)
{
    double *value = gb_series_column(series, "%s_%s", name, unit);
    double *low = gb_series_column(series, "%s_low_%s", name, unit);
    double *high = gb_series_column(series, "%s_high_%s", name, unit);
    for (size_t g = 0; g < series->rows; g++) {
        const struct gb_fit_value *found =
            (const struct gb_fit_value *)(const void *)((const char *)&fits[g].decay +
                                                        offset);
        value[g] = found->value;
        low[g] = found->low;
        high[g] = found->high;
    }
}

static void fall_columns(struct gb_series *series, const struct group_fit *fits)
{
    double *const columns[] = {
        gb_series_column(series, "scatter_MPa"), gb_series_column(series, "fall_MPa"),
        gb_series_column(series, "fall_se_MPa"), gb_series_column(series, "efold_ns"),
        gb_series_column(series, "efold_se_ns")};
    for (size_t g = 0; g < series->rows; g++) {
        const double row[] = {fits[g].decay.scatter, gb_fit_decay_fall(&fits[g].decay),
                              fits[g].fall_error, gb_fit_decay_efold(&fits[g].decay),
                              fits[g].efold_error};
        for (size_t k = 0; k < G_N_ELEMENTS(row); k++) {
            columns[k][g] = row[k];
        }
    }
}

/* The two times against the rate; bars: half of the 95 % interval. */
static void draw_times(struct gb_series *series, const double *rate,
                       const struct group_fit *fits)
{
    static const char *const names[] = {"fast, <i>\xcf\x84</i><sub>1</sub>",
                                        "slow, <i>\xcf\x84</i><sub>2</sub>"};
    gb_series_axes(series, "rate_per_s", "densification rate <i>v</i> (1/s)", "tau_ns",
                   "relaxation time <i>\xcf\x84</i> (ns)");
    series->x.log = series->y.log = true;
    for (int k = 0; k < GB_FIT_TERMS; k++) {
        double *time = gb_series_column(series, "drawn_%d_ns", k + 1);
        double *half = gb_series_column(series, "half_%d_ns", k + 1);
        for (size_t g = 0; g < series->rows; g++) {
            time[g] = fits[g].decay.tau[k].value;
            half[g] = 0.5 * (fits[g].decay.tau[k].high - fits[g].decay.tau[k].low);
        }
        gb_series_draw(series, rate, time, half, GB_FIGURE_POINTS, k, names[k]);
    }
    gb_series_say(series, "Times of the two exponentials of P2 (4); bars: 95 %% "
                          "intervals.");
}

static void relaxation_columns(struct gb_series *series, const struct gb_runset *set,
                               const struct group_fit *fits)
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
        terms[g] = fits[g].decay.terms;
        gb_series_note(series, "group %zu: %s%s%d exponentials, %s", g + 1, label,
                       *label ? "; " : "", fits[g].decay.terms,
                       reasons[fits[g].decay.reason]);
        g_free(label);
    }
    value_columns(series, "p0", "MPa", fits, offsetof(struct gb_fit_decay, p0));
    value_columns(series, "p1", "MPa", fits, offsetof(struct gb_fit_decay, amplitude[0]));
    value_columns(series, "tau1", "ns", fits, offsetof(struct gb_fit_decay, tau[0]));
    value_columns(series, "p2", "MPa", fits, offsetof(struct gb_fit_decay, amplitude[1]));
    value_columns(series, "tau2", "ns", fits, offsetof(struct gb_fit_decay, tau[1]));
    fall_columns(series, fits);
    draw_times(series, rate, fits);
}

bool gb_figures_relaxation(struct gb_series *series, const struct gb_figures_input *input,
                           struct gb_error *err)
{
    const struct gb_runset *set = input->set;
    if (!gb_figures_rate_check(set, "relaxation", err)) {
        return false;
    }
    struct group_fit *fits = g_new0(struct group_fit, set->groups);
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
        gb_series_note(series,
                       "fall: of p in all; efold: time after which 1/e of it is left; "
                       "their standard errors from the fits without one run each");
        relaxation_columns(series, set, fits);
    }
    g_free(fits);
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

enum { CURVE_POINTS = 600 };

/* Column of t and p of the mean of a group, thinned evenly in log t, and its fit. */
static bool curve_columns(struct gb_series *series, const struct gb_runset *set,
                          size_t group, struct gb_error *err)
{
    double *t = NULL;
    double *p = NULL;
    size_t count = 0;
    struct gb_fit_decay fit;
    double *time = gb_series_column(series, "t_%zu_ns", group + 1);
    double *mean = gb_series_column(series, "p_%zu_MPa", group + 1);
    double *fitted = gb_series_column(series, "fit_%zu_MPa", group + 1);
    const bool good = mean_relaxation(set, group, &t, &p, &count, err);
    const bool known = good && gb_fit_decay(&fit, t, p, count, NULL);
    size_t filled = 0;
    double next = 0.0;
    for (size_t k = 0; k < count && good && filled < CURVE_POINTS; k++) {
        if (t[k] > 0.0 && t[k] >= next) {
            next = t[k] * pow(t[count - 1] / fmax(t[k], 1e-300),
                              1.0 / (double)(CURVE_POINTS - filled));
            time[filled] = t[k];
            fitted[filled] = known ? gb_fit_decay_at(&fit, t[k]) : NAN;
            mean[filled++] = p[k];
        }
    }
    gb_alloc_free(t);
    gb_alloc_free(p);
    char *label = gb_figures_label(set, group, NULL);
    gb_series_draw(series, time, mean, NULL, GB_FIGURE_LINE, (int)group, label);
    gb_series_draw(series, time, fitted, NULL, GB_FIGURE_FAINT, 3, NULL);
    g_free(label);
    return good;
}

bool gb_figures_relaxation_curve(struct gb_series *series,
                                 const struct gb_figures_input *input,
                                 struct gb_error *err)
{
    const struct gb_runset *set = input->set;
    if (!gb_figures_rate_check(set, "decay", err)) {
        return false;
    }
    gb_series_init(series, CURVE_POINTS);
    const size_t most = gb_figures_label_groups(series, set);
    if (most > 1) {
        gb_series_say(series, "Means of %zu runs.", most);
    }
    gb_series_axes(series, "t_ns", "time since the end of compression <i>t</i> (ns)",
                   "p_MPa", "pressure <i>p</i> (MPa)");
    series->x.log = true;
    gb_series_say(series, "Thin black: fit of P2 (4).");
    bool good = true;
    for (size_t g = 0; g < set->groups && good; g++) {
        good = curve_columns(series, set, g, err);
    }
    return good;
}
