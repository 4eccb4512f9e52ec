#include "figures/figures_compute.h"
#include "figures/figures_label.h"

bool gb_figures_coordination(struct gb_series *series,
                             const struct gb_figures_input *input, struct gb_error *err)
{
    struct gb_series_sample sample;
    const struct gb_runset *set = input->set;
    if (!gb_series_sample(&sample, set, "load", "density", "coordination", err)) {
        return false;
    }
    gb_series_init(series, sample.size);
    gb_figures_label_note(series, set);
    const double *grid = gb_series_sample_grid(series, &sample, "density");
    const bool good =
        gb_figures_label_means(series, &sample, set, grid, "coordination", "", err);
    gb_series_sample_finish(&sample);
    return good;
}
