#include "figures/figures_die.h"

#include "figures/figures_label.h"
#include "scene/loading_kind.h"

static bool all_dies(const struct gb_runset *set, const char *figure,
                     struct gb_error *err)
{
    for (size_t i = 0; i < set->count; i++) {
        if (gb_loading_kind_of(&set->run[i].params)->columns != GB_COLUMNS_DIE) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "%.300s: scene.kind is not die; accepted dies for the "
                                "figure %s",
                                set->run[i].directory, figure);
        }
    }
    return true;
}

/* Mean of one column of curve.csv over the pressure of the programme, one curve a group;
 * the styles of groups are `stride` apart. */
static bool draw_column(struct gb_series *series, const struct gb_runset *set,
                        const struct gb_series_sample *sample, const double *grid,
                        const char *name, const char *suffix, int style, int stride,
                        struct gb_error *err)
{
    bool good = true;
    for (size_t g = 0; g < set->groups && good; g++) {
        double *mean = gb_series_column(series, "%s_%zu", name, g + 1);
        double *error = gb_series_column(series, "%s_se_%zu", name, g + 1);
        char *label = gb_figures_label(set, g, NULL);
        char *whole = g_strconcat(label, suffix, NULL);
        good = gb_series_mean(sample, set, g, mean, error, err);
        gb_series_draw(series, grid, mean, error, GB_FIGURE_LINE, (int)g * stride + style,
                       whole);
        g_free(whole);
        g_free(label);
    }
    return good;
}

bool gb_figures_die_height(struct gb_series *series, const struct gb_figures_input *input,
                           struct gb_error *err)
{
    struct gb_series_sample sample;
    const struct gb_runset *set = input->set;
    if (!all_dies(set, "die-height", err) ||
        !gb_series_sample(&sample, set, "load", "wanted_MPa", "height_change", err)) {
        return false;
    }
    gb_series_init(series, sample.size);
    gb_figures_label_note(series, set);
    gb_series_axes(series, "p_MPa", "pressure <i>p</i> (MPa)", "height_change",
                   "change of height \xce\x94<i>H</i> / <i>H</i><sub>0</sub>");
    const double *grid = gb_series_sample_grid(series, &sample, "p_MPa");
    const bool good =
        draw_column(series, set, &sample, grid, "height_change", "", 0, 1, err);
    gb_series_sample_finish(&sample);
    return good;
}

bool gb_figures_die_density(struct gb_series *series,
                            const struct gb_figures_input *input, struct gb_error *err)
{
    struct gb_series_sample whole;
    struct gb_series_sample central = {0};
    const struct gb_runset *set = input->set;
    if (!all_dies(set, "die-density", err) ||
        !gb_series_sample(&whole, set, "load", "wanted_MPa", "density", err)) {
        return false;
    }
    bool good =
        gb_series_sample(&central, set, "load", "wanted_MPa", "central_density", err);
    if (good) {
        gb_series_init(series, whole.size);
        gb_figures_label_note(series, set);
        gb_series_axes(series, "p_MPa", "pressure <i>p</i> (MPa)", "density",
                       "relative density <i>\xcf\x81</i>");
        const double *grid = gb_series_sample_grid(series, &whole, "p_MPa");
        good = draw_column(series, set, &whole, grid, "density", ", whole", 0, 2, err) &&
               draw_column(series, set, &central, grid, "central_density", ", middle", 1,
                           2, err);
    }
    gb_series_sample_finish(&central);
    gb_series_sample_finish(&whole);
    return good;
}
