#include "figures/figures_compute.h"
#include "figures/figures_label.h"
#include "measure/theory.h"
#include "scene/loading_kind.h"

static bool any_planar_dynamic(const struct gb_runset *set)
{
    for (size_t g = 0; g < set->groups; g++) {
        const struct gb_params *params = &gb_runset_first(set, g)->params;
        if (gb_loading_kind_of(params)->given_rate && params->dimension == 2) {
            return true;
        }
    }
    return false;
}

/* P2 (8), of discs at any rate. */
static void draw_published(struct gb_series *series, const struct gb_runset *set,
                           const double *density)
{
    double *column = gb_series_column(series, "P2_8");
    for (size_t i = 0; i < series->rows; i++) {
        column[i] = gb_theory_coordination(density[i]);
    }
    gb_series_draw(series, density, column, NULL, GB_FIGURE_LINE, (int)set->groups,
                   "P2 (8)");
}

/* P1 Fig. 8; P2 (8). */
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
    static const struct gb_figures_label_axes axes = {"load", "density", "coordination"};
    bool good =
        gb_figures_label_means(series, &sample, set, grid, "coordination", "", err);
    if (good && any_planar_dynamic(set)) {
        draw_published(series, set, grid);
    }
    good = good && gb_figures_label_unrelaxed(series, set, &axes, err);
    gb_series_sample_finish(&sample);
    return good;
}
