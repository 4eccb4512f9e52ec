/* Figures of the contact laws alone; they take a preset in place of runs. */
#include <math.h>
#include <stdio.h>

#include "figures/figures.h"
#include "greenbody/params.h"
#include "scene/contact_pair.h"
#include "scene/derived.h"
#include "scene/model.h"

/* Hardening of P3 section 4.  sigma_0 passes through the yield point by P3's rule (1049 MPa
 * for m = 0.05); the last row has the 1480 MPa that P3 prints for m = 0.05, which does not.
 */
struct hardening_model {
    double exponent;    /* m */
    double strength_pa; /* sigma_0; NaN: by the rule */
    const char *label;  /* Pango markup */
    const char *name;   /* in a column of numbers */
};

enum { HARDENING_MODELS = 5, POINTS = 401 /* of a curve */ };

static const struct hardening_model hardening_models[HARDENING_MODELS] = {
    {0.0, NAN, "<i>m</i> = 0", "m0"},
    {0.05, NAN, "<i>m</i> = 0.05", "m0.05"},
    {0.1, NAN, "<i>m</i> = 0.1", "m0.1"},
    {0.2, NAN, "<i>m</i> = 0.2", "m0.2"},
    {0.05, 1480e6, "<i>m</i> = 0.05, 1480 MPa", "m0.05_printed"},
};

/* A scene with the hardening of a row.  material.hollomon of the scene stays where the row
 * has no sigma_0. */
static struct gb_params hardened_scene(const struct gb_params *scene, int row)
{
    const struct hardening_model *model = &hardening_models[row];
    struct gb_params params = *scene;
    params.hardening = model->exponent;
    params.hollomon_pa =
        isnan(model->strength_pa) ? params.hollomon_pa : model->strength_pa;
    return params;
}

/* Model of a scene with the contact laws of P1.  Errors: those of gb_model_init;
 * GB_ERR_INPUT for a scene with other contact laws. */
static bool init_rod_model(struct gb_model *model, const struct gb_params *scene,
                           const char *figure, struct gb_error *err)
{
    if (!gb_model_init(model, scene, err)) {
        return false;
    }
    return !model->cohesionless ||
           gb_error_set(err, GB_ERR_INPUT, "%s: expected contact.normal = rod", figure);
}

/* Range of the overlap, in lengths of a bridge. */
static const double min_overlap = -1.25;
static const double max_overlap = 2.5;

/* f_n in nN at overlap h; h_min 0: no bridge. */
static double normal_nn(const struct gb_model *model, double h, double h_min)
{
    const double attraction = gb_law_dispersion_force(&model->dispersion, 1.0 - h);
    const double force = h_min > h ? gb_law_bridge_force(&model->rod, h_min, h)
                                   : gb_law_rod_force(&model->rod, h);
    return 1e9 * model->newton_per_force * (force - attraction);
}

/* Part of the force curve; h_min as above. */
struct branch {
    const char *name; /* of its columns */
    double from, to, h_min;
    const char *label;
};

static void draw_branch(struct gb_series *series, const struct gb_model *model,
                        const struct branch *branch, int style)
{
    double *h = gb_series_column(series, "h_%s", branch->name);
    double *force = gb_series_column(series, "f_%s_nN", branch->name);
    for (int k = 0; k < POINTS; k++) {
        h[k] = branch->from + (branch->to - branch->from) * k / (POINTS - 1);
        force[k] = normal_nn(model, h[k], branch->h_min);
    }
    gb_series_draw(series, h, force, NULL, GB_FIGURE_LINE, style, branch->label);
}

/* Points of P1 Fig. 1. */
static void add_point_labels(struct gb_series *series, const struct gb_model *model,
                             double length)
{
    const double far = min_overlap * length;
    const double deep = max_overlap * length;
    const struct gb_figure_annotation notes[] = {
        {far, normal_nn(model, far, 0.0), "<i>A</i>", GB_FIGURE_ABOVE_RIGHT},
        {0.0, normal_nn(model, 0.0, 0.0), "<i>B</i>", GB_FIGURE_BELOW_LEFT},
        {length, normal_nn(model, length, 0.0), "<i>C</i>", GB_FIGURE_BELOW_RIGHT},
        {0.0, normal_nn(model, 0.0, length), "<i>D</i>", GB_FIGURE_BELOW_LEFT},
        {deep, normal_nn(model, deep, 0.0), "<i>C′</i>", GB_FIGURE_ABOVE_LEFT},
    };
    g_array_append_vals(series->annotations, notes, G_N_ELEMENTS(notes));
}

/* P1 Fig. 1: loading from a gap; unloading from C, where a bridge forms, and from C', where
 * it formed before. */
static bool compute_contact(struct gb_series *series,
                            const struct gb_figures_input *input, struct gb_error *err)
{
    struct gb_model model;
    if (!init_rod_model(&model, input->scene, "contact", err)) {
        return false;
    }
    if (!model.terms.bridges) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "contact: the scene has no bridges; expected "
                            "contact.bridge_length below 1 d");
    }
    const double length = model.bridge.length;
    const double deep = max_overlap * length;
    const struct branch branches[] = {
        {"loading", min_overlap * length, deep, 0.0, "loading"},
        {"C", length, 0.0, length, "unloading from <i>C</i>"},
        {"later", deep, deep - length, deep, "unloading from <i>C′</i>"},
    };
    gb_series_init(series, POINTS);
    for (size_t k = 0; k < G_N_ELEMENTS(branches); k++) {
        draw_branch(series, &model, &branches[k], (int)k);
    }
    add_point_labels(series, &model, length);
    gb_series_caption(series,
                      "<i>d</i> = %g nm, <i>α</i> = %g, "
                      "Δ<i>r</i><sub>ch</sub> = %g <i>d</i>. A bridge forms at "
                      "<i>C</i> and breaks at <i>D</i>.",
                      1e9 * model.metre_per_length, input->scene->alpha, length);
    return true;
}

static const double bridge_lengths[] = {0.005, 0.01, 0.015}; /* d */
static const double bridge_strength_max_overlap = 0.05;      /* d */

/* Strength of bridges of one length over the overlap h. */
static bool add_length(struct gb_series *series, const struct gb_params *preset,
                       const double *h, size_t index, struct gb_error *err)
{
    char label[96];
    struct gb_model model;
    struct gb_params scene = *preset;
    const double length = bridge_lengths[index];
    scene.bridge_length = (struct gb_relative){length, true};
    if (!init_rod_model(&model, &scene, "bridge-strength", err)) {
        return false;
    }
    double *strength = gb_series_column(series, "strength_%g_GPa", length);
    for (int k = 0; k < POINTS; k++) {
        strength[k] = 1e-9 * model.pascal_per_stress *
                      gb_law_bridge_peel_stress(&model.bridge, &model.rod, h[k]);
    }
    snprintf(label, sizeof label, "Δ<i>r</i><sub>ch</sub> = %g <i>d</i>", length);
    gb_series_draw(series, h, strength, NULL, GB_FIGURE_LINE, (int)index, label);
    return true;
}

/* P1 Fig. 2. */
static bool compute_bridge_strength(struct gb_series *series,
                                    const struct gb_figures_input *input,
                                    struct gb_error *err)
{
    bool good = true;
    gb_series_init(series, POINTS);
    double *h = gb_series_column(series, "h");
    for (int k = 0; k < POINTS; k++) {
        h[k] = bridge_strength_max_overlap * k / (POINTS - 1);
    }
    for (size_t i = 0; i < G_N_ELEMENTS(bridge_lengths) && good; i++) {
        good = add_length(series, input->scene, h, i, err);
    }
    return good;
}

/* The largest strain over that of yield. */
static const double largest_strain = 5.0;

static const double percent = 100.0;

static void draw_curves(struct gb_series *series, const struct gb_params *scene,
                        const double *strain)
{
    for (int row = 0; row < HARDENING_MODELS; row++) {
        const struct gb_params params = hardened_scene(scene, row);
        const double strength = 1e-6 * gb_derived_hollomon_pa(&params);
        double *stress =
            gb_series_column(series, "stress_%s_MPa", hardening_models[row].name);
        char *label = g_strdup_printf("<i>m</i> = %g, <i>σ</i><sub>0</sub> = %.0f MPa",
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
    gb_series_draw(series, strain, elastic, NULL, GB_FIGURE_LINE, HARDENING_MODELS,
                   "elastic");
    gb_series_draw(series, at, stress, NULL, GB_FIGURE_POINTS, HARDENING_MODELS + 1,
                   "yield point");
}

/* P3 Fig. 9. */
static bool compute_hollomon(struct gb_series *series,
                             const struct gb_figures_input *input, struct gb_error *err)
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
    gb_series_caption(series, "<i>σ</i><sub>0</sub> by the rule of P3: all curves pass "
                              "through the yield point. The 1480 MPa that P3 prints for "
                              "<i>m</i> = 0.05 does not.");
    return true;
}

enum { PAIR_POINTS = 201, MODELS = 1 + HARDENING_MODELS };

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
        model > 0 ? hardened_scene(input->scene, model - 1) : *input->scene;
    struct gb_contact_pair pair;
    if (!gb_contact_pair_init(&pair, &params, err)) {
        return false;
    }
    const double indentation =
        is_equal(&params) ? max_indentation_equal : max_indentation_unequal;
    double *column = gb_series_column(series, "%s_%d", name, model);
    for (int k = 0; k < PAIR_POINTS; k++) {
        const double at = indentation * pair.diameter * (k + 1) / PAIR_POINTS;
        h[k] = 1e9 * at;
        column[k] = value(&pair, branch_at(&pair, model, at));
    }
    gb_series_draw(series, h, column, NULL, GB_FIGURE_LINE, model,
                   model > 0 ? hardening_models[model - 1].label : "Hertz, elastic");
    return true;
}

static bool draw_models(struct gb_series *series, const struct gb_figures_input *input,
                        const char *name,
                        double (*value)(const struct gb_contact_pair *,
                                        struct gb_law_branch),
                        struct gb_error *err)
{
    bool good = true;
    gb_series_init(series, PAIR_POINTS);
    double *h = gb_series_column(series, "h_nm");
    for (int model = 0; model < MODELS && good; model++) {
        good = add_model(series, input, model, h, name, value, err);
    }
    gb_series_caption(
        series,
        "Radii %g and %g μm. <i>m</i>: Storåkers as printed, P3 "
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
static bool compute_pair_force(struct gb_series *series,
                               const struct gb_figures_input *input, struct gb_error *err)
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
static bool compute_pair_step(struct gb_series *series,
                              const struct gb_figures_input *input, struct gb_error *err)
{
    return draw_models(series, input, "step_ns", step_of, err);
}

const struct gb_figures_row gb_figures_laws_rows[] = {
    {"contact", "normal force of two particles, loading and unloading", "P1 Fig. 1",
     GB_FIGURES_SCENE, .preset = "p1-set2-16nm",
     .x = {.name = "h", .label = "overlap <i>h</i> / <i>d</i>"},
     .y = {.name = "force_nN", .label = "normal force <i>f<sub>n</sub></i> (nN)"},
     .compute = compute_contact},
    {"bridge-strength", "strength of a bridge of three lengths", "P1 Fig. 2",
     GB_FIGURES_SCENE, .preset = "p1-set2-16nm",
     .x = {.name = "h", .label = "overlap <i>h</i> / <i>d</i>"},
     .y = {.name = "strength_GPa", .label = "bridge strength <i>σ<sub>u</sub></i> (GPa)"},
     .compute = compute_bridge_strength},
    {"hollomon", "stress against strain of hardening materials", "P3 Fig. 9",
     GB_FIGURES_SCENE, .preset = "p3-pair",
     .x = {.name = "strain_percent", .label = "strain <i>ε</i> (%)"},
     .y = {.name = "stress_MPa", .label = "stress <i>σ</i> (MPa)"},
     .compute = compute_hollomon},
    {"pair", "force between two equal spheres, elastic and plastic", "P3 Fig. 10",
     GB_FIGURES_SCENE, .preset = "p3-pair",
     .x = {.name = "h_nm", .label = "indentation <i>h</i> (nm)"},
     .y = {.name = "force_mN", .label = "force <i>F</i> (mN)"},
     .compute = compute_pair_force},
    {"line", "force on a small sphere between two large ones", "P3 Fig. 11",
     GB_FIGURES_SCENE, .preset = "p3-line",
     .x = {.name = "h_nm", .label = "indentation <i>h</i> (nm)"},
     .y = {.name = "force_mN", .label = "force <i>F</i> (mN)"},
     .compute = compute_pair_force},
    {"critical-step", "critical time step of two equal spheres", "P3 Fig. 12",
     GB_FIGURES_SCENE, .preset = "p3-pair",
     .x = {.name = "h_nm", .label = "indentation <i>h</i> (nm)"},
     .y = {.name = "step_ns", .label = "critical time step Δ<i>t</i><sub>cr</sub> (ns)"},
     .compute = compute_pair_step},
    {0},
};
