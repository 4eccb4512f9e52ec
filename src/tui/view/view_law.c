/* Views of the contact law of the edited parameters: normal force against overlap on
 * loading and unloading, and the strength of bridges.  If the run has other parameters,
 * its law is drawn dim.  Scenes with the laws of a pair (Hertz, Storakers) have a view
 * of their own. */
#include <glib.h>
#include <math.h>
#include <stdio.h>

#include "scene/contact_pair.h"
#include "scene/model.h"
#include "scene/normal_law.h"
#include "tui/view/views.h"

/* Largest overlap drawn, in diameters of the smaller body. */
static const double depth = 0.05;

enum { VIEW_PAIR_POINTS = 160 };
enum { VIEW_PAIR_INK_LAW = GB_PLOT_INK_SERIES, INK_BACK = GB_PLOT_INK_SERIES + 1 };

struct view_pair_line {
    double x[VIEW_PAIR_POINTS], y[VIEW_PAIR_POINTS]; /* um, N */
};

static bool plastic(const struct gb_params *params)
{
    return params->normal == GB_NORMAL_STORAKERS;
}

static void follow(const struct gb_contact_pair *pair, bool flows, double max,
                   struct view_pair_line *line)
{
    for (int i = 0; i < VIEW_PAIR_POINTS; i++) {
        const double h = max * i / (VIEW_PAIR_POINTS - 1);
        line->x[i] = 1e6 * h;
        line->y[i] = flows ? gb_law_storakers_load(&pair->law, pair->radius, h)
                           : gb_law_hertz_force(&pair->law.hertz, pair->radius, h);
    }
}

/* Follows unloading from the largest overlap. */
static void follow_back(const struct gb_contact_pair *pair, double max,
                        struct view_pair_line *line)
{
    for (int i = 0; i < VIEW_PAIR_POINTS; i++) {
        const double h = max * (VIEW_PAIR_POINTS - 1 - i) / (VIEW_PAIR_POINTS - 1);
        double deepest = max;
        line->x[i] = 1e6 * h;
        line->y[i] = gb_law_storakers_update(&pair->law, pair->radius, h, &deepest).force;
    }
}

static void view_pair_draw(struct gb_plot *plot, const struct view_pair_line *line,
                           int ink, int marker)
{
    const struct gb_plot_series series = {.x = line->x,
                                          .y = line->y,
                                          .count = VIEW_PAIR_POINTS,
                                          .ink = ink,
                                          .marker = marker};
    gb_plot_line(plot, &series);
}

/* Draws the law of the run if it differs. */
static bool draw_before(struct gb_plot *plot, const struct gb_params *edited,
                        const struct gb_session *session, double max)
{
    struct gb_contact_pair pair;
    struct view_pair_line line;
    const struct gb_params *run =
        session->runner != NULL ? gb_runner_params(session->runner) : NULL;
    if (run == NULL || !gb_normal_law_of(run)->pair ||
        gb_previous_diff_count(edited, run) == 0 ||
        !gb_contact_pair_init(&pair, run, NULL)) {
        return false;
    }
    follow(&pair, plastic(run), max, &line);
    view_pair_draw(plot, &line, GB_PLOT_INK_DIM, 3);
    return true;
}

/* Draws Hertz' or Storakers' law, for scenes that use it; called by gb_view_law_force. */
static void view_law_pair(struct gb_panel_plot *panel, const struct gb_session *session)
{
    const struct gb_params *params = &panel->edited;
    struct gb_plot *plot = panel->target;
    struct gb_contact_pair pair;
    struct view_pair_line line;
    struct view_pair_line back;
    if (!gb_contact_pair_init(&pair, params, NULL)) {
        gb_plot_text(plot, 1, 1, GB_PLOT_INK_TEXT, "the parameters conflict");
        return;
    }
    const double max = depth * pair.diameter;
    follow(&pair, plastic(params), max, &line);
    const double x_ends[2] = {0.0, 1e6 * max};
    const double y_ends[2] = {0.0, line.y[VIEW_PAIR_POINTS - 1]};
    gb_plot_axes(plot, x_ends, y_ends, GB_PLOT_LINEAR, "overlap, um", "normal force, N");
    struct gb_plot_entry entry[3];
    int entries = 0;
    if (draw_before(plot, params, session, max)) {
        entry[entries++] = (struct gb_plot_entry){GB_PLOT_INK_DIM, 3, "law of the run"};
    }
    if (plastic(params)) {
        follow_back(&pair, max, &back);
        view_pair_draw(plot, &back, INK_BACK, 2);
        entry[entries++] = (struct gb_plot_entry){INK_BACK, 2, "unloading"};
    }
    view_pair_draw(plot, &line, VIEW_PAIR_INK_LAW, 1);
    entry[entries++] = (struct gb_plot_entry){
        VIEW_PAIR_INK_LAW, 1, "" /* set to the name of the law */
    };
    snprintf(entry[entries - 1].name, sizeof entry[0].name, "%s",
             plastic(params) ? "Storakers, loading" : "Hertz");
    gb_plot_legend(plot, entry, entries);
}

/* Points per curve.  Largest overlap: with bridges, in bridge lengths beyond the
 * formation of a bridge; without bridges and adhesion, in diameters. */
enum { POINTS = 160 };
static const double bridge_lengths = 2.5;
static const double depth_min = 0.012;
/* The gap is drawn until the attraction has fallen to this fraction. */
static const double gap_share = 0.1;
static const double gap_max = 0.1;

enum { INK_LAW = GB_PLOT_INK_SERIES, INK_BRIDGE = GB_PLOT_INK_SERIES + 1 };

struct line {
    double x[POINTS], y[POINTS];
};

static bool has_bridges(const struct gb_model *model)
{
    return model->terms.bridges && model->bridge.length < 1.0;
}

/* Finds the range of overlaps to draw, in diameters. */
static void find_range(const struct gb_model *model, double range[2])
{
    range[0] = model->terms.attraction
                   ? 1.0 - gb_law_dispersion_range(&model->dispersion, gap_share)
                   : -depth_min / 3.0;
    range[0] = fmax(range[0], -gap_max);
    range[1] = fmax(depth_min, 2.0 * model->h_eq);
    if (has_bridges(model)) {
        range[1] = fmax(range[1], bridge_lengths * model->bridge.length);
    }
    range[1] = fmin(range[1], 0.9);
}

static double nano_metre(const struct gb_model *model, double length)
{
    return 1e9 * model->metre_per_length * length;
}

static double nano_newton(const struct gb_model *model, double force)
{
    return 1e9 * model->newton_per_force * force;
}

/* Follows f_n = f_e - f_a of a contact at its largest overlap so far: P1 Fig. 1,
 * A-B-C-C'. */
static void follow_loading(const struct gb_model *model, const double range[2],
                           struct line *line)
{
    for (int i = 0; i < POINTS; i++) {
        const double h = range[0] + (range[1] - range[0]) * i / (POINTS - 1);
        const double pull = model->terms.attraction
                                ? gb_law_dispersion_force(&model->dispersion, 1.0 - h)
                                : 0.0;
        line->x[i] = nano_metre(model, h);
        line->y[i] = nano_newton(model, gb_normal_law_force(model, h) - pull);
    }
}

/* Follows unloading of a bridged contact from its largest overlap until it breaks: C-D.
 */
static void follow_bridge(const struct gb_model *model, double deepest, double x[2],
                          double y[2])
{
    const double pull = model->terms.attraction ? model->adhesion : 0.0;
    const double h[2] = {deepest, deepest - model->bridge.length};
    for (int i = 0; i < 2; i++) {
        x[i] = nano_metre(model, h[i]);
        y[i] = nano_newton(model, gb_law_bridge_force(&model->rod, deepest, h[i]) - pull);
    }
}

static void extend(double ends[2], const double *value, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        ends[0] = fmin(ends[0], value[i]);
        ends[1] = fmax(ends[1], value[i]);
    }
}

static void draw(struct gb_plot *plot, const double *x, const double *y, size_t count,
                 int ink, int marker)
{
    const struct gb_plot_series series = {
        .x = x, .y = y, .count = count, .ink = ink, .marker = marker};
    gb_plot_line(plot, &series);
}

static void draw_zero(struct gb_plot *plot, const double range[2])
{
    const double zero[2] = {0.0, 0.0};
    draw(plot, range, zero, 2, GB_PLOT_INK_AXIS, 0);
}

/* Makes the models of the edited parameters, and of the run if they differ. */
static bool freeze(const struct gb_panel_plot *panel, const struct gb_session *session,
                   struct gb_model *model, struct gb_model *before)
{
    before->count = 0;
    if (!gb_model_init(model, &panel->edited, NULL)) {
        gb_plot_text(panel->target, 1, 1, GB_PLOT_INK_TEXT, "the parameters conflict");
        return false;
    }
    if (session->runner != NULL &&
        gb_previous_diff_count(&panel->edited, gb_runner_params(session->runner)) > 0 &&
        !gb_model_init(before, gb_runner_params(session->runner), NULL)) {
        before->count = 0;
    }
    return true;
}

static void write_numbers(struct gb_plot *plot, const struct gb_model *model)
{
    char text[96];
    snprintf(text, sizeof text, "adhesion %.4g nN, equilibrium h = %.4g nm",
             nano_newton(model, model->adhesion), nano_metre(model, model->h_eq));
    const int col = plot->left + plot->field_cols - (int)g_utf8_strlen(text, -1) - 1;
    if (model->terms.attraction && col > plot->left && plot->field_rows > 12) {
        gb_plot_text(plot, plot->top + plot->field_rows - 2, col, GB_PLOT_INK_TEXT, text);
    }
}

void gb_view_law_force(struct gb_panel_plot *panel, const struct gb_session *session)
{
    struct gb_plot *plot = panel->target;
    struct gb_model model;
    struct gb_model before;
    struct line line;
    struct line old;
    double range[2];
    double bridge_x[2][2];
    double bridge_y[2][2];
    if (gb_normal_law_of(&panel->edited)->pair) {
        view_law_pair(panel, session);
        return;
    }
    if (!freeze(panel, session, &model, &before)) {
        return;
    }
    find_range(&model, range);
    follow_loading(&model, range, &line);
    double y_ends[2] = {0.0, 0.0};
    extend(y_ends, line.y, POINTS);
    for (int k = 0; has_bridges(&model) && k < 2; k++) {
        follow_bridge(&model, (k + 1) * model.bridge.length, bridge_x[k], bridge_y[k]);
        extend(y_ends, bridge_y[k], 2);
    }
    const double x_ends[2] = {line.x[0], line.x[POINTS - 1]};
    gb_plot_axes(plot, x_ends, y_ends, GB_PLOT_LINEAR, "overlap h = d - r, nm",
                 "normal force, nN");
    draw_zero(plot, x_ends);
    struct gb_plot_entry entry[3] = {{INK_LAW, 1, "unbridged contact"},
                                     {INK_BRIDGE, 2, "bridged contact, unloading"},
                                     {GB_PLOT_INK_DIM, 3, "law of the run"}};
    int entries = has_bridges(&model) ? 2 : 1;
    if (before.count > 0) {
        double old_range[2];
        find_range(&before, old_range);
        follow_loading(&before, old_range, &old);
        draw(plot, old.x, old.y, POINTS, GB_PLOT_INK_DIM, 3);
        entry[entries++] = entry[2];
    }
    for (int k = 0; has_bridges(&model) && k < 2; k++) {
        draw(plot, bridge_x[k], bridge_y[k], 2, INK_BRIDGE, 2);
    }
    draw(plot, line.x, line.y, POINTS, INK_LAW, 1);
    write_numbers(plot, &model);
    gb_plot_legend(plot, entry, entries);
}

/* Follows the mean normal stress that breaks a bridge partly (h > 0) or completely (h =
 * 0), GPa. */
static void follow_strength(const struct gb_model *model, double max, struct line *line)
{
    for (int i = 0; i < POINTS; i++) {
        const double h = max * i / (POINTS - 1);
        line->x[i] = nano_metre(model, h);
        line->y[i] = 1e-9 * model->pascal_per_stress *
                     gb_law_bridge_peel_stress(&model->bridge, &model->rod, h);
    }
}

/* Range of P1 Fig. 2. */
static const double strength_depth = 0.1;

void gb_view_law_strength(struct gb_panel_plot *panel, const struct gb_session *session)
{
    struct gb_plot *plot = panel->target;
    struct gb_model model;
    struct gb_model before;
    struct line line;
    struct line old;
    if (!freeze(panel, session, &model, &before)) {
        return;
    }
    if (!has_bridges(&model) || panel->edited.normal != GB_NORMAL_ROD) {
        gb_plot_text(plot, plot->rows / 2, 2, GB_PLOT_INK_TEXT,
                     "no bridges in this scene");
        return;
    }
    const bool compare = before.count > 0 && has_bridges(&before);
    const double max = fmin(strength_depth, 0.9 - model.bridge.length);
    follow_strength(&model, max, &line);
    double y_ends[2] = {0.0, 0.0};
    extend(y_ends, line.y, POINTS);
    if (compare) {
        follow_strength(&before, fmin(strength_depth, 0.9 - before.bridge.length), &old);
        extend(y_ends, old.y, POINTS);
    }
    const double x_ends[2] = {0.0, line.x[POINTS - 1]};
    gb_plot_axes(plot, x_ends, y_ends, GB_PLOT_LINEAR, "overlap h = d - r, nm",
                 "bridge strength, GPa");
    if (compare) {
        draw(plot, old.x, old.y, POINTS, GB_PLOT_INK_DIM, 3);
    }
    draw(plot, line.x, line.y, POINTS, INK_BRIDGE, 2);
    const struct gb_plot_entry entry[2] = {{INK_BRIDGE, 2, "bridge strength"},
                                           {GB_PLOT_INK_DIM, 3, "law of the run"}};
    gb_plot_legend(plot, entry, compare ? 2 : 1);
}
