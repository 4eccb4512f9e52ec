#include "figures/figures_compute.h"

#include <math.h>

#include "figures/figures_label.h"
#include "measure/theory.h"
#include "scene/loading_kind.h"
#include "scene/model.h"
#include "scene/size/sizes.h"

/* Whether two models have the same asymptote. */
static bool same_asymptote(const struct gb_model *a, const struct gb_model *b)
{
    return a->rod.hertz == b->rod.hertz && a->rod.rod == b->rod.rod &&
           a->adhesion == b->adhesion && a->pascal_per_stress == b->pascal_per_stress;
}

/* P2 (5)-(8), once for groups with the same laws. */
static bool asymptote_columns(struct gb_series *series, const double *density,
                              const struct gb_runset *set, struct gb_error *err)
{
    struct gb_model *models = g_new0(struct gb_model, set->groups);
    size_t known = 0;
    bool good = true;
    for (size_t g = 0; g < set->groups && good; g++) {
        const struct gb_params *params = &gb_runset_first(set, g)->params;
        if (!gb_loading_kind_of(params)->given_rate || params->dimension != 2 ||
            gb_sizes_polydisperse(params)) {
            continue;
        }
        struct gb_model *model = &models[known];
        good = gb_model_init(model, params, err);
        bool seen = !good;
        for (size_t i = 0; i < known && !seen; i++) {
            seen = same_asymptote(&models[i], model);
        }
        if (seen) {
            continue;
        }
        known++;
        gb_series_note(series, "asymptote %zu: P2 (5)-(8) with the laws of group %zu",
                       known, g + 1);
        double *column = gb_series_column(series, "asymptote_%zu_MPa", known);
        for (size_t i = 0; i < series->rows; i++) {
            column[i] = 1e-6 * gb_theory_pressure(model, density[i]);
        }
        gb_series_draw(series, density, column, NULL, GB_FIGURE_LINE,
                       (int)(set->groups + known - 1), "asymptote");
        series->y.low = 0.0; /* the asymptote has no meaning in tension */
    }
    g_free(models);
    return good;
}

/* The inset of P1 Fig. 5 shows the curves up to this fraction of the maximum pressure. */
static const double inset_fraction = 0.05;

static void set_inset(struct gb_series *series, size_t groups)
{
    const double *density = g_ptr_array_index(series->columns, 0);
    double max = 0.0;
    size_t last = series->rows;
    for (size_t g = 0; g < groups; g++) {
        const double *mean = g_ptr_array_index(series->columns, 1 + 2 * g);
        for (size_t i = 0; i < series->rows; i++) {
            max = isfinite(mean[i]) ? fmax(max, mean[i]) : max;
        }
    }
    for (size_t g = 0; g < groups; g++) {
        const double *mean = g_ptr_array_index(series->columns, 1 + 2 * g);
        size_t i = 0;
        while (i < last && !(mean[i] > inset_fraction * max)) {
            i++;
        }
        last = i;
    }
    if (last > 1 && last < series->rows) {
        series->inset[0] = density[0];
        series->inset[1] = density[last];
    }
}

static bool all_quasistatic(const struct gb_runset *set)
{
    for (size_t i = 0; i < set->count; i++) {
        if (gb_loading_kind_of(&set->run[i].params)->follows_time) {
            return false;
        }
    }
    return true;
}

/* P1 Fig. 5, P2 Fig. 2. */
bool gb_figures_densification(struct gb_series *series,
                              const struct gb_figures_input *input, struct gb_error *err)
{
    const struct gb_runset *set = input->set;
    struct gb_series_sample sample;
    if (!gb_series_sample(&sample, set, "load", "density", "p_MPa", err)) {
        return false;
    }
    gb_series_init(series, sample.size);
    gb_figures_label_note(series, set);
    const double *grid = gb_series_sample_grid(series, &sample, "density");
    static const struct gb_figures_label_axes axes = {"load", "density", "p_MPa"};
    bool good = gb_figures_label_means(series, &sample, set, grid, "mean", "_MPa", err) &&
                asymptote_columns(series, grid, set, err);
    if (good && all_quasistatic(set)) {
        set_inset(series, set->groups);
    }
    good = good && gb_figures_label_unrelaxed(series, set, &axes, err);
    gb_series_sample_finish(&sample);
    return good;
}
