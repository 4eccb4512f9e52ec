#include "figures/figures_compute.h"

#include <math.h>

#include "figures/laws/hardening_models.h"
#include "scene/contact_pair.h"

enum { POINTS = 201, MODELS = 1 + GB_HARDENING_MODELS };

/* Maximum indentation over the smaller diameter, of equal spheres and of unequal ones:
 * at the same force the small one is indented much deeper. */
static const double max_indentation_equal = 0.01;
static const double max_indentation_unequal = 0.15;

static bool is_equal(const struct gb_params *scene)
{
    return fabs(scene->radius_i_m / scene->radius_j_m - 1.0) < 1e-9;
}

/* mN */
static double force_of(const struct gb_contact_pair *pair, struct gb_law_branch branch)
{
    (void)pair;
    return 1e3 * branch.force;
}

/* ns */
static double step_of(const struct gb_contact_pair *pair, struct gb_law_branch branch)
{
    return 1e9 * gb_contact_pair_critical_step(pair, branch.stiffness);
}

/* Model 0 is Hertz, the others Storakers as printed in P3. */
static struct gb_law_branch branch_at(const struct gb_contact_pair *pair, int model,
                                      double h)
{
    struct gb_law_storakers law = pair->law;
    law.printed = true;
    return model == 0
               ? (struct gb_law_branch){gb_law_hertz_force(&law.hertz, pair->radius, h),
                                        gb_law_hertz_stiffness(&law.hertz, pair->radius,
                                                               h)}
               : gb_law_storakers_loading(&law, pair->radius, h);
}

static bool add_model(struct gb_series *series, const struct gb_figures_input *input,
                      int model, double *h, const char *name,
                      double (*value)(const struct gb_contact_pair *,
                                      struct gb_law_branch),
                      struct gb_error *err)
{
    const struct gb_params params =
        model > 0 ? gb_hardening_models_scene(input->scene, model - 1) : *input->scene;
    struct gb_contact_pair pair;
    if (!gb_contact_pair_init(&pair, &params, err)) {
        return false;
    }
    const double indentation =
        is_equal(&params) ? max_indentation_equal : max_indentation_unequal;
    double *column = gb_series_column(series, "%s_%d", name, model);
    for (int k = 0; k < POINTS; k++) {
        const double at = indentation * pair.diameter * (k + 1) / POINTS;
        h[k] = 1e9 * at;
        column[k] = value(&pair, branch_at(&pair, model, at));
    }
    gb_series_draw(series, h, column, NULL, GB_FIGURE_LINE, model,
                   model > 0 ? gb_hardening_models[model - 1].label : "Hertz, elastic");
    return true;
}

static bool draw_models(struct gb_series *series, const struct gb_figures_input *input,
                        const char *name,
                        double (*value)(const struct gb_contact_pair *,
                                        struct gb_law_branch),
                        struct gb_error *err)
{
    bool good = true;
    gb_series_init(series, POINTS);
    double *h = gb_series_column(series, "h_nm");
    for (int model = 0; model < MODELS && good; model++) {
        good = add_model(series, input, model, h, name, value, err);
    }
    gb_series_caption(
        series,
        "Radii %g and %g \xce\xbcm. <i>m</i>: Stor\xc3\xa5kers as printed, P3 "
        "(16); scenes take the smaller of it and Hertz. 1480 MPa: as printed "
        "for <i>m</i> = 0.05; the rule of P3 gives 1049.",
        1e6 * input->scene->radius_i_m, 1e6 * input->scene->radius_j_m);
    return good;
}

/* Where the weaker body starts to flow, P3 (30). */
static void draw_yield(struct gb_series *series, const struct gb_contact_pair *pair)
{
    const struct gb_law_hertz *law = &pair->law.hertz;
    const double force = gb_law_hertz_yield_force(law, pair->radius, pair->yield_pa);
    double *h = gb_series_column(series, "yield_h_nm");
    double *f = gb_series_column(series, "yield_force_mN");
    h[0] = 1e9 * gb_law_hertz_overlap(law, pair->radius, force);
    f[0] = 1e3 * force;
    gb_series_draw(series, h, f, NULL, GB_FIGURE_POINTS, MODELS, "onset of yield");
    gb_series_caption(series, "Onset of yield, P3 (30): %.3g nm, %.4g mN.", h[0], f[0]);
}

/* Indentation over the diameter of the smaller sphere and, of equal spheres, F/4R^2, about
 * the pressure on an assembly of them: P3 (31), (32). */
static void set_second_axes(struct gb_series *series, const struct gb_contact_pair *pair,
                            bool equal)
{
    series->top = (struct gb_figure_second_axis){
        equal ? "indentation over diameter <i>h</i> / 2<i>R</i> (%)"
              : "indentation over the smaller diameter <i>h</i> / 2<i>r</i> (%)",
        100.0 * 1e-9 / pair->diameter};
    if (equal) {
        series->right = (struct gb_figure_second_axis){
            "pressure <i>F</i> / 4<i>R</i><sup>2</sup> (MPa)",
            1e-6 * 1e-3 / (pair->diameter * pair->diameter)};
    }
}

/* P3 Fig. 10 and 11. */
bool gb_figures_pair_force(struct gb_series *series, const struct gb_figures_input *input,
                           struct gb_error *err)
{
    struct gb_contact_pair pair;
    if (!draw_models(series, input, "force_mN", force_of, err) ||
        !gb_contact_pair_init(&pair, input->scene, err)) {
        return false;
    }
    draw_yield(series, &pair);
    set_second_axes(series, &pair, is_equal(input->scene));
    series->x.low = 0.0;
    series->y.low = 0.0;
    return true;
}

/* P3 Fig. 12. */
bool gb_figures_pair_step(struct gb_series *series, const struct gb_figures_input *input,
                          struct gb_error *err)
{
    return draw_models(series, input, "step_ns", step_of, err);
}
