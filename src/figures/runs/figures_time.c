#include "figures/figures_compute.h"

#include <string.h>

#include "figures/figures_label.h"

/* P2 Fig. 1. */
bool gb_figures_time(struct gb_series *series, const struct gb_figures_input *input,
                     struct gb_error *err)
{
    const struct gb_runset *set = input->set;
    struct gb_series_sample sample;
    if (!gb_series_sample(&sample, set, NULL, "time_ns", "p_MPa", err)) {
        return false;
    }
    gb_series_init(series, sample.size);
    gb_figures_label_note(series, set);
    const double *grid = gb_series_sample_grid(series, &sample, "time_ns");
    for (size_t i = 0; i < set->count; i++) {
        const struct gb_runset_run *run = &set->run[i];
        gb_series_note(series, "run %zu: %s, group %zu", i + 1, run->directory,
                       run->group + 1);
        double *column = gb_series_column(series, "run_%zu_MPa", i + 1);
        memcpy(column, sample.rows + i * sample.size, sample.size * sizeof *column);
        if (gb_runset_members(set, run->group) > 1) {
            gb_series_draw(series, grid, column, NULL, GB_FIGURE_FAINT, (int)run->group,
                           NULL);
        }
    }
    const bool good =
        gb_figures_label_means(series, &sample, set, grid, "mean", "_MPa", err);
    gb_series_sample_finish(&sample);
    return good;
}
