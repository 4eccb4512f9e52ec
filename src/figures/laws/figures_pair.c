#include "figures/figures_compute.h"

#include <math.h>
#include <stdio.h>

#include "scene/contact_pair.h"

enum { POINTS = 201, MODELS = 5 };

/* Exponents of hardening in P3 section 4. */
static const double hardening[MODELS - 1] = {0.0, 0.05, 0.1, 0.2};

/* Maximum indentation over the smaller diameter, of equal spheres and of unequal ones:
 * at the same force the small one is indented much deeper. */
static const double max_indentation_equal = 0.01;
static const double max_indentation_unequal = 0.15;

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
    struct gb_params params = *input->scene;
    struct gb_contact_pair pair;
    char label[96] = "Hertz, elastic";
    params.hardening = model > 0 ? hardening[model - 1] : params.hardening;
    if (!gb_contact_pair_init(&pair, &params, err)) {
        return false;
    }
    if (model > 0) {
        snprintf(label, sizeof label, "Stor\xc3\xa5kers, <i>m</i> = %g",
                 hardening[model - 1]);
    }
    const double indentation = fabs(params.radius_i_m / params.radius_j_m - 1.0) < 1e-9
                                   ? max_indentation_equal
                                   : max_indentation_unequal;
    double *column = gb_series_column(series, "%s_%d", name, model);
    for (int k = 0; k < POINTS; k++) {
        const double at = indentation * pair.diameter * (k + 1) / POINTS;
        h[k] = 1e9 * at;
        column[k] = value(&pair, branch_at(&pair, model, at));
    }
    gb_series_draw(series, h, column, NULL, GB_FIGURE_LINE, model, label);
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
    gb_series_caption(series,
                      "Radii %g and %g \xce\xbcm. Stor\xc3\xa5kers as printed, P3 (16); "
                      "scenes take the smaller of it and Hertz.",
                      1e6 * input->scene->radius_i_m, 1e6 * input->scene->radius_j_m);
    return good;
}

/* P3 Fig. 10 and 11. */
bool gb_figures_pair_force(struct gb_series *series, const struct gb_figures_input *input,
                           struct gb_error *err)
{
    return draw_models(series, input, "force_mN", force_of, err);
}

/* P3 Fig. 12. */
bool gb_figures_pair_step(struct gb_series *series, const struct gb_figures_input *input,
                          struct gb_error *err)
{
    return draw_models(series, input, "step_ns", step_of, err);
}
