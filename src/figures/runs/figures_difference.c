#include "figures/figures_compute.h"

#include <math.h>

#include "figures/figures_label.h"

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
    g_free(buffer);
    gb_series_sample_finish(&sample);
    return good;
}
