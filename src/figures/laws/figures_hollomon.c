#include "figures/figures_compute.h"

#include <math.h>

#include "figures/laws/hardening_models.h"
#include "scene/derived.h"

enum { POINTS = 401 };

/* The largest strain over that of yield. */
static const double largest_strain = 5.0;

static const double percent = 100.0;

static void draw_curves(struct gb_series *series, const struct gb_params *scene,
                        const double *strain)
{
    for (int row = 0; row < GB_HARDENING_MODELS; row++) {
        const struct gb_params params = gb_hardening_models_scene(scene, row);
        const double strength = 1e-6 * gb_derived_hollomon_pa(&params);
        double *stress =
            gb_series_column(series, "stress_%s_MPa", gb_hardening_models[row].name);
        char *label =
            g_strdup_printf("<i>m</i> = %g, <i>\xcf\x83</i><sub>0</sub> = %.0f MPa",
                            params.hardening, strength);
        for (int k = 0; k < POINTS; k++) {
            stress[k] = strength * pow(strain[k] / percent, params.hardening);
        }
        gb_series_draw(series, strain, stress, NULL, GB_FIGURE_LINE, row, label);
        g_free(label);
    }
}

/* Hooke's law up to the yield point, and that point. */
static void draw_elastic(struct gb_series *series, const struct gb_params *scene,
                         double yield_strain, const double *strain)
{
    double *elastic = gb_series_column(series, "elastic_MPa");
    double *at = gb_series_column(series, "yield_strain_percent");
    double *stress = gb_series_column(series, "yield_MPa");
    for (int k = 0; k < POINTS; k++) {
        elastic[k] = strain[k] > percent * yield_strain * (1.0 + 1e-9)
                         ? (double)NAN
                         : 1e-6 * scene->young_pa * strain[k] / percent;
    }
    at[0] = percent * yield_strain;
    stress[0] = 1e-6 * scene->yield_pa;
    gb_series_draw(series, strain, elastic, NULL, GB_FIGURE_LINE, GB_HARDENING_MODELS,
                   "elastic");
    gb_series_draw(series, at, stress, NULL, GB_FIGURE_POINTS, GB_HARDENING_MODELS + 1,
                   "yield point");
}

/* P3 Fig. 9. */
bool gb_figures_hollomon(struct gb_series *series, const struct gb_figures_input *input,
                         struct gb_error *err)
{
    const struct gb_params *scene = input->scene;
    const double yield_strain = scene->yield_pa / scene->young_pa;
    (void)err;
    gb_series_init(series, POINTS);
    double *strain = gb_series_column(series, "strain_percent");
    for (int k = 0; k < POINTS; k++) {
        strain[k] = percent * largest_strain * yield_strain * k / (POINTS - 1);
    }
    draw_curves(series, scene, strain);
    draw_elastic(series, scene, yield_strain, strain);
    series->x.low = 0.0;
    series->y.low = 0.0;
    gb_series_caption(series,
                      "<i>\xcf\x83</i><sub>0</sub> by the rule of P3: all curves pass "
                      "through the yield point. The 1480 MPa that P3 prints for "
                      "<i>m</i> = 0.05 does not.");
    return true;
}
