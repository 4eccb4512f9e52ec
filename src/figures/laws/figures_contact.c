#include <math.h>

#include "figures/figures_compute.h"
#include "figures/laws/rod_model.h"

enum { POINTS = 401 };

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
        {deep, normal_nn(model, deep, 0.0), "<i>C\xe2\x80\xb2</i>", GB_FIGURE_ABOVE_LEFT},
    };
    g_array_append_vals(series->annotations, notes, G_N_ELEMENTS(notes));
}

/* P1 Fig. 1: loading from a gap; unloading from C, where a bridge forms, and from C', where
 * it formed before. */
bool gb_figures_contact(struct gb_series *series, const struct gb_figures_input *input,
                        struct gb_error *err)
{
    struct gb_model model;
    if (!gb_rod_model_init(&model, input->scene, "contact", err)) {
        return false;
    }
    if (!model.terms.bridges) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "contact: the scene has no bridges; accepted "
                            "contact.bridge_length below 1 d");
    }
    const double length = model.bridge.length;
    const double deep = max_overlap * length;
    const struct branch branches[] = {
        {"loading", min_overlap * length, deep, 0.0, "loading"},
        {"C", length, 0.0, length, "unloading from <i>C</i>"},
        {"later", deep, deep - length, deep, "unloading from <i>C\xe2\x80\xb2</i>"},
    };
    gb_series_init(series, POINTS);
    for (size_t k = 0; k < G_N_ELEMENTS(branches); k++) {
        draw_branch(series, &model, &branches[k], (int)k);
    }
    add_point_labels(series, &model, length);
    gb_series_caption(series,
                      "<i>d</i> = %g nm, <i>\xce\xb1</i> = %g, "
                      "\xce\x94<i>r</i><sub>ch</sub> = %g <i>d</i>. A bridge forms at "
                      "<i>C</i> and breaks at <i>D</i>.",
                      1e9 * model.metre_per_length, input->scene->alpha, length);
    return true;
}
