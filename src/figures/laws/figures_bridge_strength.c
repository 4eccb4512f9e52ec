#include <stdio.h>

#include "figures/figures_compute.h"
#include "figures/laws/rod_model.h"

enum { POINTS = 401 };

static const double bridge_lengths[] = {0.005, 0.01, 0.015}; /* d */
static const double max_overlap = 0.05;                      /* d */

/* Strength of bridges of one length over the overlap h. */
static bool add_length(struct gb_series *series, const struct gb_params *preset,
                       const double *h, size_t index, struct gb_error *err)
{
    char label[96];
    struct gb_model model;
    struct gb_params scene = *preset;
    const double length = bridge_lengths[index];
    scene.bridge_length = (struct gb_relative){length, true};
    if (!gb_rod_model_init(&model, &scene, "bridge-strength", err)) {
        return false;
    }
    double *strength = gb_series_column(series, "strength_%g_GPa", length);
    for (int k = 0; k < POINTS; k++) {
        strength[k] = 1e-9 * model.pascal_per_stress *
                      gb_law_bridge_peel_stress(&model.bridge, &model.rod, h[k]);
    }
    snprintf(label, sizeof label, "\xce\x94<i>r</i><sub>ch</sub> = %g <i>d</i>", length);
    gb_series_draw(series, h, strength, NULL, GB_FIGURE_LINE, (int)index, label);
    return true;
}

/* P1 Fig. 2. */
bool gb_figures_bridge_strength(struct gb_series *series,
                                const struct gb_figures_input *input,
                                struct gb_error *err)
{
    bool good = true;
    gb_series_init(series, POINTS);
    double *h = gb_series_column(series, "h");
    for (int k = 0; k < POINTS; k++) {
        h[k] = max_overlap * k / (POINTS - 1);
    }
    for (size_t i = 0; i < G_N_ELEMENTS(bridge_lengths) && good; i++) {
        good = add_length(series, input->scene, h, i, err);
    }
    return good;
}
