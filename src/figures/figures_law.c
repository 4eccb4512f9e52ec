#include "figures/figures_law.h"

#include <math.h>
#include <stdio.h>

#include "scene/model.h"

enum { POINTS = 401 };

/* f_n in nN at overlap h; h_min 0: no bridge. */
static double normal_nn(const struct gb_model *model, double h, double h_min)
{
    const double attraction = gb_law_dispersion_force(&model->dispersion, 1.0 - h);
    const double force = h_min > h ? gb_law_bridge_force(&model->rod, h_min, h)
                                   : gb_law_rod_force(&model->rod, h);
    return 1e9 * model->newton_per_force * (force - attraction);
}

/* A branch in columns of its own: h and force, from one overlap to another. */
static void branch(struct gb_series *series, const struct gb_model *model,
                   const char *name, double from, double to, double h_min, int style,
                   const char *label)
{
    double *h = gb_series_column(series, "h_%s", name);
    double *force = gb_series_column(series, "f_%s_nN", name);
    for (int k = 0; k < POINTS; k++) {
        h[k] = from + (to - from) * k / (POINTS - 1);
        force[k] = normal_nn(model, h[k], h_min);
    }
    gb_series_draw(series, h, force, NULL, GB_FIGURE_LINE, style, label);
}

static void mark(struct gb_series *series, double x, double y, const char *text,
                 bool below, bool left)
{
    const struct gb_figure_note note = {x, y, text, below, left};
    g_array_append_val(series->marks, note);
}

static void mark_points(struct gb_series *series, const struct gb_model *model,
                        double length, double far, double deep)
{
    mark(series, -far, normal_nn(model, -far, 0.0), "<i>A</i>", false, false);
    mark(series, 0.0, normal_nn(model, 0.0, 0.0), "<i>B</i>", true, false);
    mark(series, length, normal_nn(model, length, 0.0), "<i>C</i>", true, false);
    mark(series, 0.0, normal_nn(model, 0.0, length), "<i>D</i>", true, true);
    mark(series, deep, normal_nn(model, deep, 0.0), "<i>C\xe2\x80\xb2</i>", false, true);
}

/* The model of a scene whose contacts are those of P1. */
static bool freeze_rods(struct gb_model *model, const struct gb_params *scene,
                        const char *figure, struct gb_error *err)
{
    if (!gb_model_init(model, scene, err)) {
        return false;
    }
    return !model->cohesionless ||
           gb_error_set(err, GB_ERR_INPUT, "%s: accepted contact.normal = rod", figure);
}

bool gb_figures_law_contact(struct gb_series *series,
                            const struct gb_figures_input *input, struct gb_error *err)
{
    struct gb_model model;
    if (!freeze_rods(&model, input->scene, "contact", err)) {
        return false;
    }
    if (!model.terms.bridges) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "contact: the scene has no bridges; accepted "
                            "contact.bridge_length below 1 d");
    }
    const double length = model.bridge.length;
    const double far = 1.25 * length;
    const double deep = 2.5 * length;
    gb_series_init(series, POINTS);
    gb_series_axes(series, "h", "overlap <i>h</i> / <i>d</i>", "force_nN",
                   "normal force <i>f<sub>n</sub></i> (nN)");
    branch(series, &model, "loading", -far, deep, 0.0, 0, "pressed");
    branch(series, &model, "C", length, 0.0, length, 1, "released at <i>C</i>");
    branch(series, &model, "later", deep, deep - length, deep, 2,
           "released at <i>C\xe2\x80\xb2</i>");
    mark_points(series, &model, length, far, deep);
    gb_series_say(series,
                  "<i>d</i> = %g nm, <i>\xce\xb1</i> = %g, "
                  "\xce\x94<i>r</i><sub>ch</sub> = %g <i>d</i>. A bridge forms at "
                  "<i>C</i> and breaks at <i>D</i>.",
                  1e9 * model.metre_per_length, input->scene->alpha, length);
    return true;
}

bool gb_figures_law_strength(struct gb_series *series,
                             const struct gb_figures_input *input, struct gb_error *err)
{
    static const double lengths[] = {0.005, 0.01, 0.015}; /* d */
    static const double deepest = 0.05;
    gb_series_init(series, POINTS);
    gb_series_axes(series, "h", "overlap <i>h</i> / <i>d</i>", "strength_GPa",
                   "breaking stress <i>\xcf\x83<sub>u</sub></i> (GPa)");
    double *h = gb_series_column(series, "h");
    for (int k = 0; k < POINTS; k++) {
        h[k] = deepest * k / (POINTS - 1);
    }
    for (size_t i = 0; i < sizeof lengths / sizeof lengths[0]; i++) {
        char label[96];
        struct gb_model model;
        struct gb_params scene = *input->scene;
        scene.bridge_length = (struct gb_relative){lengths[i], true};
        if (!freeze_rods(&model, &scene, "bridge-strength", err)) {
            return false;
        }
        double *strength = gb_series_column(series, "strength_%g_GPa", lengths[i]);
        for (int k = 0; k < POINTS; k++) {
            strength[k] = 1e-9 * model.pascal_per_stress *
                          gb_law_bridge_peel_stress(&model.bridge, &model.rod, h[k]);
        }
        snprintf(label, sizeof label, "\xce\x94<i>r</i><sub>ch</sub> = %g <i>d</i>",
                 lengths[i]);
        gb_series_draw(series, h, strength, NULL, GB_FIGURE_LINE, (int)i, label);
    }
    return true;
}
