#include <math.h>

#include <glib.h>

#include "base/alloc.h"
#include "many/relaxation_curves.h"
#include "measure/fit/power.h"
#include "measure/theory.h"
#include "scene/derived.h"
#include "study/papers/papers_measures.h"

/* P2's fast stage takes 0.07 to 0.45 ns, its slow one 4 to 30 ns (Table 1): a single
 * exponential belongs to the stage on whose side of this its time lies, ns. */
static const double stages_ns = 1.0;

/* P2 (9), and the densities at which the curves are compared. */
static const double end_density = 0.95;
static const double exponent = 0.25, power = 3.0;
static const double densities[] = {0.6, 0.65, 0.7, 0.75, 0.8, 0.85, 0.9, 0.925, 0.95};

static bool fit_decay(const struct gb_papers_view *view,
                      const struct gb_papers_comparison *row, struct gb_fit_decay *fit)
{
    struct gb_runset set;
    struct gb_mean_curves curves = {0};
    const bool good =
        gb_papers_sample_point(view, gb_papers_experiments_index(row->experiment[0]),
                               row->point, &set) > 0 &&
        gb_relaxation_curves_read(&curves, &set, 0, NULL) &&
        gb_relaxation_curves_fit(fit, curves.curve, curves.count, NULL);
    gb_mean_curves_finish(&curves);
    g_free(set.run);
    return good;
}

/* Mean pressure of an experiment at a density; false with fewer than two cells. */
static bool mean_pressure(const struct gb_papers_view *view, const char *experiment,
                          double density, struct gb_power_point *point)
{
    const struct gb_papers_comparison at = {.column = "p_MPa", .at = density};
    struct gb_runset set;
    const size_t count =
        gb_papers_sample_point(view, gb_papers_experiments_index(experiment), 0, &set);
    double *values = g_new(double, count + 1);
    for (size_t i = 0; i < count; i++) {
        values[i] = gb_papers_measures_at_density(&set.run[i], &at);
    }
    *point = (struct gb_power_point){.rho = density};
    const size_t used = gb_average_values(values, count, &point->p, &point->error);
    point->v = count > 0 ? set.run[0].params.rate_per_s : 0.0;
    g_free(values);
    g_free(set.run);
    return used > 1 && point->error > 0.0;
}

double gb_papers_rates_p0(const struct gb_papers_view *view,
                          const struct gb_papers_comparison *row)
{
    struct gb_fit_decay fit;
    return fit_decay(view, row, &fit) ? fit.p0.value : (double)NAN;
}

/* Of the mean curve, so that it is there without exponentials, too. */
double gb_papers_rates_fall(const struct gb_papers_view *view,
                            const struct gb_papers_comparison *row)
{
    const double end = gb_papers_rates_p0(view, row);
    struct gb_power_point point;
    (void)mean_pressure(view, row->experiment[0], end_density, &point);
    return point.p - end;
}

/* The slow exponential of a fit; -1: it has none. */
static int find_slow(const struct gb_fit_decay *fit)
{
    const int term = fit->terms - 1;
    return term >= 0 && fit->tau[term].value >= stages_ns ? term : -1;
}

double gb_papers_rates_slow_amplitude(const struct gb_papers_view *view,
                                      const struct gb_papers_comparison *row)
{
    struct gb_fit_decay fit;
    const int term = fit_decay(view, row, &fit) ? find_slow(&fit) : -1;
    return term >= 0 ? fit.amplitude[term].value : (double)NAN;
}

/* What the slow stage leaves of the fall: a fit extrapolates to times before its first
 * point. */
double gb_papers_rates_fast_amplitude(const struct gb_papers_view *view,
                                      const struct gb_papers_comparison *row)
{
    const double slow = gb_papers_rates_slow_amplitude(view, row);
    return gb_papers_rates_fall(view, row) - (isnan(slow) ? 0.0 : slow);
}

/* Where a falling curve that begins at (0, from) first reaches a level; NaN: nowhere. */
static double reach(const double *t, const double *p, size_t count, double from,
                    double level)
{
    double t0 = 0.0;
    double p0 = from;
    for (size_t k = 0; k < count; k++) {
        if (t[k] > t0 && p[k] <= level && p0 > level) {
            return t0 + (p0 - level) / (p0 - p[k]) * (t[k] - t0);
        }
        t0 = t[k];
        p0 = p[k];
    }
    return NAN;
}

/* On the mean curve itself, for the same reason. */
double gb_papers_rates_fast(const struct gb_papers_view *view,
                            const struct gb_papers_comparison *row)
{
    struct gb_runset set;
    struct gb_mean_curves curves = {0};
    struct gb_power_point start;
    double *t = NULL;
    double *p = NULL;
    size_t count = 0;
    double efold = NAN;
    const double end = gb_papers_rates_p0(view, row);
    (void)mean_pressure(view, row->experiment[0], end_density, &start);
    if (gb_papers_sample_point(view, gb_papers_experiments_index(row->experiment[0]),
                               row->point, &set) > 0 &&
        gb_relaxation_curves_read(&curves, &set, 0, NULL) &&
        gb_mean_curves_mean(curves.curve, curves.count, &t, &p, &count, NULL)) {
        efold = reach(t, p, count, start.p, end + (start.p - end) / M_E);
    }
    gb_alloc_free(t);
    gb_alloc_free(p);
    gb_mean_curves_finish(&curves);
    g_free(set.run);
    return efold < stages_ns ? efold : (double)NAN;
}

double gb_papers_rates_slow(const struct gb_papers_view *view,
                            const struct gb_papers_comparison *row)
{
    struct gb_fit_decay fit;
    const int term = fit_decay(view, row, &fit) ? find_slow(&fit) : -1;
    return term >= 0 ? fit.tau[term].value : (double)NAN;
}

enum { POINTS = GB_PAPERS_USED * G_N_ELEMENTS(densities) };

static size_t collect(const struct gb_papers_view *view,
                      const struct gb_papers_comparison *row,
                      struct gb_power_point points[POINTS])
{
    size_t count = 0;
    for (size_t k = 0; k < G_N_ELEMENTS(densities); k++) {
        for (int e = 0; e < GB_PAPERS_USED && row->experiment[e] != NULL; e++) {
            count +=
                mean_pressure(view, row->experiment[e], densities[k], &points[count]);
        }
    }
    return count;
}

/* The law (9) of the scenes; false without runs. */
static bool law_of(const struct gb_papers_view *view,
                   const struct gb_papers_comparison *row, struct gb_power_law *law)
{
    const struct gb_runset *set =
        &view->data->experiment[gb_papers_experiments_index(row->experiment[0])].set;
    *law = (struct gb_power_law){exponent, power, 0.0};
    if (set->count > 0) {
        law->rho0 = gb_derived_structure_density(&set->run[0].params);
    }
    return set->count > 0;
}

double gb_papers_rates_kv(const struct gb_papers_view *view,
                          const struct gb_papers_comparison *row)
{
    struct gb_power_point points[POINTS];
    struct gb_power_law law;
    struct gb_power_rate fit;
    return law_of(view, row, &law) &&
                   gb_power_rate(&fit, &law, points, collect(view, row, points), NULL)
               ? fit.k_v.value
               : (double)NAN;
}

double gb_papers_rates_excess(const struct gb_papers_view *view,
                              const struct gb_papers_comparison *row)
{
    struct gb_power_law law;
    return law_of(view, row, &law)
               ? gb_papers_rates_kv(view, row) * pow(row->at, law.exponent) *
                     pow(end_density - law.rho0, law.power)
               : (double)NAN;
}

double gb_papers_rates_exponent(const struct gb_papers_view *view,
                                const struct gb_papers_comparison *row)
{
    struct gb_power_point points[POINTS];
    struct gb_power_law law;
    struct gb_fit_value fit;
    return law_of(view, row, &law) &&
                   gb_power_exponent(&fit, &law, points, collect(view, row, points), NULL)
               ? fit.value
               : (double)NAN;
}

double gb_papers_rates_asymptote(const struct gb_papers_view *view,
                                 const struct gb_papers_comparison *row)
{
    struct gb_power_point point;
    struct gb_model model;
    double density = NAN;
    const struct gb_runset *set =
        &view->data->experiment[gb_papers_experiments_index(row->experiment[0])].set;
    return set->count > 0 && mean_pressure(view, row->experiment[0], row->at, &point) &&
                   gb_model_init(&model, &set->run[0].params, NULL) &&
                   gb_theory_density(&model, 1e6 * point.p, &density, NULL)
               ? fabs(density / row->at - 1.0)
               : (double)NAN;
}
