#include "figures/figures_compute.h"

#include <math.h>

#include "figures/figures_label.h"
#include "figures/runs/rate_points.h"

/* Standard errors of the two means are taken as independent, an upper bound for replicas
 * with the same seeds. */
static void difference_columns(struct gb_series *series, size_t group, const char *label,
                               const double *mean, const double *error,
                               const double *reference, const double *reference_error)
{
    double *difference = gb_series_column(series, "difference_%zu_MPa", group + 1);
    double *column_error = gb_series_column(series, "se_%zu_MPa", group + 1);
    for (size_t i = 0; i < series->rows; i++) {
        difference[i] = mean[i] - reference[i];
        column_error[i] = hypot(error[i], reference_error[i]);
    }
    gb_series_draw(series, g_ptr_array_index(series->columns, 0), difference,
                   column_error, GB_FIGURE_LINE, (int)group, label);
}

/* P2 (9) less its value at the reference rate, with the printed k_v; rate 0: the
 * quasi-static pressure. */
static void law_column(struct gb_series *series, const struct gb_power_law *law,
                       double rate, double reference_rate, double *column)
{
    const double *density = g_ptr_array_index(series->columns, 0);
    for (size_t i = 0; i < series->rows; i++) {
        const double k_v = gb_rate_points_printed_k_v;
        column[i] = density[i] < law->rho0
                        ? (double)NAN
                        : gb_rate_points_excess(law, k_v, rate, density[i]) -
                              gb_rate_points_excess(law, k_v, reference_rate, density[i]);
    }
}

/* P2 (9) of each group and of quasi-static pressing, where the runs differ in their rate
 * alone; the k_v of these runs as a comment and in the caption. */
static void draw_law(struct gb_series *series, const struct gb_figures_input *input)
{
    const struct gb_runset *set = input->set;
    const double *density = g_ptr_array_index(series->columns, 0);
    const double reference_rate =
        gb_runset_first(set, input->reference)->params.rate_per_s;
    struct gb_rate_points points;
    struct gb_power_rate rate;
    struct gb_error ignored = {0};
    if (!gb_rate_points_find(&points, input, "difference", &ignored)) {
        return;
    }
    for (size_t g = 0; g < set->groups; g++) {
        if (g != input->reference) {
            double *column = gb_series_column(series, "P2_%zu_MPa", g + 1);
            law_column(series, &points.law, gb_runset_first(set, g)->params.rate_per_s,
                       reference_rate, column);
            gb_series_draw(series, density, column, NULL, GB_FIGURE_FAINT, (int)g, NULL);
        }
    }
    double *still = gb_series_column(series, "P2_quasistatic_MPa");
    law_column(series, &points.law, 0.0, reference_rate, still);
    gb_series_draw(series, density, still, NULL, GB_FIGURE_LINE, (int)set->groups,
                   "quasi-static, P2 (9)");
    gb_series_caption(series,
                      "Thin: P2 (9), <i>k<sub>v</sub></i> = %g MPa s<sup>1/4</sup>.",
                      gb_rate_points_printed_k_v);
    if (gb_rate_points_fit(&rate, &points, series)) {
        gb_series_caption(series, "These runs: <i>k<sub>v</sub></i> = %.3g.",
                          rate.k_v.value);
    }
    gb_rate_points_finish(&points);
}

/* P2 Fig. 3. */
bool gb_figures_difference(struct gb_series *series, const struct gb_figures_input *input,
                           struct gb_error *err)
{
    const struct gb_runset *set = input->set;
    struct gb_series_sample sample;
    const size_t reference = input->reference;
    if (set->groups < 2) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "difference: all runs have equal presets; accepted runs of "
                            "two groups at least");
    }
    if (!gb_series_sample(&sample, set, "load", "density", "p_MPa", err)) {
        return false;
    }
    gb_series_init(series, sample.size);
    gb_figures_label_note(series, set);
    gb_series_note(series, "reference: group %zu", reference + 1);
    gb_series_sample_grid(series, &sample, "density");
    double *buffer = g_new(double, 4 * sample.size + 1);
    double *const at[4] = {buffer, buffer + sample.size, buffer + 2 * sample.size,
                           buffer + 3 * sample.size};
    bool good = gb_series_mean(&sample, set, reference, at[0], at[1], err);
    for (size_t g = 0; g < set->groups && good; g++) {
        if (g != reference) {
            good = gb_series_mean(&sample, set, g, at[2], at[3], err);
            char *label = gb_figures_label(set, g, NULL);
            difference_columns(series, g, label, at[2], at[3], at[0], at[1]);
            g_free(label);
        }
    }
    if (good) {
        draw_law(series, input);
    }
    g_free(buffer);
    gb_series_sample_finish(&sample);
    return good;
}
