#include "figures/figures_compute.h"

#include <math.h>

#include "base/alloc.h"
#include "figures/figures_label.h"
#include "figures/runs/runs_check.h"
#include "many/mean_curves.h"
#include "measure/fit/fit.h"

/* Points of a curve. */
enum { CURVE_POINTS = 600 };

/* Columns of t and p, thinned evenly in log t, and of the fit. */
static void fill_columns(const double *t, const double *p, size_t count,
                         const struct gb_fit_decay *fit, double *const column[3])
{
    size_t filled = 0;
    double next = 0.0;
    for (size_t k = 0; k < count && filled < CURVE_POINTS; k++) {
        if (t[k] > 0.0 && t[k] >= next) {
            next = t[k] * pow(t[count - 1] / fmax(t[k], 1e-300),
                              1.0 / (double)(CURVE_POINTS - filled));
            column[0][filled] = t[k];
            column[1][filled] = p[k];
            column[2][filled++] = fit != NULL ? gb_fit_decay_at(fit, t[k]) : NAN;
        }
    }
}

static void note_value(GString *text, const char *name, const struct gb_fit_value *value,
                       const char *unit)
{
    g_string_append_printf(text, ", %s = %.5g (%.5g to %.5g) %s", name, value->value,
                           value->low, value->high, unit);
}

/* The parameters of a fit with their 95 % intervals. */
static void note_fit(struct gb_series *series, size_t group,
                     const struct gb_fit_decay *fit)
{
    static const char *const names[GB_FIT_TERMS][2] = {{"p1", "tau1"}, {"p2", "tau2"}};
    GString *text = g_string_new(NULL);
    note_value(text, "p0", &fit->p0, "MPa");
    for (int k = 0; k < fit->terms; k++) {
        note_value(text, names[k][0], &fit->amplitude[k], "MPa");
        note_value(text, names[k][1], &fit->tau[k], "ns");
    }
    gb_series_note(series, "group %zu: fit of P2 (4)%s", group + 1, text->str);
    g_string_free(text, TRUE);
}

/* The mean of a group and its fit, where it converges. */
static bool draw_group(struct gb_series *series, const struct gb_runset *set,
                       size_t group, struct gb_error *err)
{
    double *t = NULL;
    double *p = NULL;
    size_t count = 0;
    struct gb_mean_curves curves;
    struct gb_fit_decay fit;
    if (!gb_mean_curves_relaxation(&curves, set, group, err)) {
        gb_mean_curves_finish(&curves);
        return false;
    }
    double *const column[3] = {gb_series_column(series, "t_%zu_ns", group + 1),
                               gb_series_column(series, "p_%zu_MPa", group + 1),
                               gb_series_column(series, "fit_%zu_MPa", group + 1)};
    const bool good =
        gb_mean_curves_mean(curves.curve, curves.count, &t, &p, &count, err);
    if (good) {
        const bool fitted = gb_fit_decay(&fit, t, p, count, NULL);
        fill_columns(t, p, count, fitted ? &fit : NULL, column);
        if (fitted) {
            note_fit(series, group, &fit);
        }
    }
    gb_alloc_free(t);
    gb_alloc_free(p);
    gb_mean_curves_finish(&curves);
    char *label = gb_figures_label(set, group, NULL);
    gb_series_draw(series, column[0], column[1], NULL, GB_FIGURE_LINE, (int)group, label);
    gb_series_draw(series, column[0], column[2], NULL, GB_FIGURE_FAINT,
                   gb_figure_black(0), NULL);
    g_free(label);
    return good;
}

/* P2 (4). */
bool gb_figures_decay(struct gb_series *series, const struct gb_figures_input *input,
                      struct gb_error *err)
{
    const struct gb_runset *set = input->set;
    if (!gb_runs_check_dynamic(set, "decay", err)) {
        return false;
    }
    gb_series_init(series, CURVE_POINTS);
    const size_t max = gb_figures_label_groups(series, set);
    if (max > 1) {
        gb_series_caption(series, "Means of %zu runs.", max);
    }
    gb_series_caption(series, "Thin black: fit of P2 (4).");
    bool good = true;
    for (size_t g = 0; g < set->groups && good; g++) {
        good = draw_group(series, set, g, err);
    }
    return good;
}
