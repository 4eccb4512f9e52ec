#include <glib.h>
#include <math.h>
#include <stdio.h>

#include "scene/contact_pair.h"
#include "scene/normal_law.h"
#include "tui/view/views.h"

/* Largest overlap drawn, in diameters of the smaller body. */
static const double depth = 0.05;

enum { POINTS = 160 };
enum { INK_LAW = GB_PLOT_INK_SERIES, INK_BACK = GB_PLOT_INK_SERIES + 1 };

struct line {
    double x[POINTS], y[POINTS]; /* um, N */
};

static bool plastic(const struct gb_params *params)
{
    return params->normal == GB_NORMAL_STORAKERS;
}

static void follow(const struct gb_contact_pair *pair, bool flows, double max,
                   struct line *line)
{
    for (int i = 0; i < POINTS; i++) {
        const double h = max * i / (POINTS - 1);
        line->x[i] = 1e6 * h;
        line->y[i] = flows ? gb_law_storakers_load(&pair->law, pair->radius, h)
                           : gb_law_hertz_force(&pair->law.hertz, pair->radius, h);
    }
}

/* Unloading from the largest overlap. */
static void follow_back(const struct gb_contact_pair *pair, double max, struct line *line)
{
    for (int i = 0; i < POINTS; i++) {
        const double h = max * (POINTS - 1 - i) / (POINTS - 1);
        double deepest = max;
        line->x[i] = 1e6 * h;
        line->y[i] = gb_law_storakers_update(&pair->law, pair->radius, h, &deepest).force;
    }
}

static void draw(struct gb_plot *plot, const struct line *line, int ink, int marker)
{
    const struct gb_plot_series series = {
        .x = line->x, .y = line->y, .count = POINTS, .ink = ink, .marker = marker};
    gb_plot_line(plot, &series);
}

/* The law of the run, if it differs. */
static bool draw_before(struct gb_plot *plot, const struct gb_params *edited,
                        const struct gb_session *session, double max)
{
    struct gb_contact_pair pair;
    struct line line;
    const struct gb_params *run =
        session->runner != NULL ? gb_runner_params(session->runner) : NULL;
    if (run == NULL || !gb_normal_law_of(run)->pair ||
        gb_params_diff_count(edited, run) == 0 ||
        !gb_contact_pair_init(&pair, run, NULL)) {
        return false;
    }
    follow(&pair, plastic(run), max, &line);
    draw(plot, &line, GB_PLOT_INK_DIM, 3);
    return true;
}

void gb_view_pair_draw(struct gb_panel_plot *panel, const struct gb_session *session)
{
    const struct gb_params *params = &panel->edited;
    struct gb_plot *plot = panel->target;
    struct gb_contact_pair pair;
    struct line line;
    struct line back;
    if (!gb_contact_pair_init(&pair, params, NULL)) {
        gb_plot_text(plot, 1, 1, GB_PLOT_INK_TEXT, "the parameters conflict");
        return;
    }
    const double max = depth * pair.diameter;
    follow(&pair, plastic(params), max, &line);
    const double x_ends[2] = {0.0, 1e6 * max};
    const double y_ends[2] = {0.0, line.y[POINTS - 1]};
    gb_plot_axes(plot, x_ends, y_ends, GB_PLOT_LINEAR, "overlap, um", "normal force, N");
    struct gb_plot_entry entry[3];
    int entries = 0;
    if (draw_before(plot, params, session, max)) {
        entry[entries++] = (struct gb_plot_entry){GB_PLOT_INK_DIM, 3, "law of the run"};
    }
    if (plastic(params)) {
        follow_back(&pair, max, &back);
        draw(plot, &back, INK_BACK, 2);
        entry[entries++] = (struct gb_plot_entry){INK_BACK, 2, "unloading"};
    }
    draw(plot, &line, INK_LAW, 1);
    entry[entries++] = (struct gb_plot_entry){
        INK_LAW, 1, "" /* name of the law */
    };
    snprintf(entry[entries - 1].name, sizeof entry[0].name, "%s",
             plastic(params) ? "Storakers, loading" : "Hertz");
    gb_plot_legend(plot, entry, entries);
}
