#include "figures/figures_compute.h"

#include "figures/figures_label.h"
#include "figures/runs/runs_check.h"

/* A column of curve.csv over the set pressure. */
struct column {
    const char *name;
    const char *suffix; /* of the labels */
    int style, stride;  /* style of the first group, and between groups */
};

/* Mean of every group. */
static bool draw_column(struct gb_series *series, const struct gb_runset *set,
                        const struct gb_series_sample *sample, const double *grid,
                        const struct column *column, struct gb_error *err)
{
    bool good = true;
    for (size_t g = 0; g < set->groups && good; g++) {
        double *mean = gb_series_column(series, "%s_%zu", column->name, g + 1);
        double *error = gb_series_column(series, "%s_se_%zu", column->name, g + 1);
        char *label = gb_figures_label(set, g, NULL);
        char *text = g_strconcat(label, column->suffix, NULL);
        good = gb_series_mean(sample, set, g, mean, error, err);
        gb_series_draw(series, grid, mean, error, GB_FIGURE_LINE,
                       (int)g * column->stride + column->style, text);
        g_free(text);
        g_free(label);
    }
    return good;
}

/* P3 Fig. 17. */
bool gb_figures_die_height(struct gb_series *series, const struct gb_figures_input *input,
                           struct gb_error *err)
{
    struct gb_series_sample sample;
    const struct gb_runset *set = input->set;
    if (!gb_runs_check_die(set, "die-height", err) ||
        !gb_series_sample(&sample, set, "load", "wanted_MPa", "height_change", err)) {
        return false;
    }
    gb_series_init(series, sample.size);
    gb_figures_label_note(series, set);
    const double *grid = gb_series_sample_grid(series, &sample, "p_MPa");
    const struct column strain = {"height_change", "", 0, 1};
    const bool good = draw_column(series, set, &sample, grid, &strain, err);
    gb_series_sample_finish(&sample);
    return good;
}

/* P3 Fig. 18 to 20. */
bool gb_figures_die_density(struct gb_series *series,
                            const struct gb_figures_input *input, struct gb_error *err)
{
    static const struct column columns[2] = {
        {"density", ", whole compact", 0, 2},
        {"central_density", ", central region", 1, 2}};
    struct gb_series_sample whole;
    struct gb_series_sample central = {0};
    const struct gb_runset *set = input->set;
    if (!gb_runs_check_die(set, "die-density", err) ||
        !gb_series_sample(&whole, set, "load", "wanted_MPa", "density", err)) {
        return false;
    }
    bool good =
        gb_series_sample(&central, set, "load", "wanted_MPa", "central_density", err);
    if (good) {
        gb_series_init(series, whole.size);
        gb_figures_label_note(series, set);
        const double *grid = gb_series_sample_grid(series, &whole, "p_MPa");
        good = draw_column(series, set, &whole, grid, &columns[0], err) &&
               draw_column(series, set, &central, grid, &columns[1], err);
    }
    gb_series_sample_finish(&central);
    gb_series_sample_finish(&whole);
    return good;
}
