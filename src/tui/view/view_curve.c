#include "tui/view/view_curve.h"

#include <glib.h>
#include <math.h>
#include <string.h>

#include "scene/loading_kind.h"
#include "tui/session/overlay/previous_list.h"
#include "tui/term/text_fit.h"
#include "tui/view/view_legs.h"

/* Largest ratio of pressures on a logarithmic axis: smaller pressures come from single
 * contacts. */
static const double log_range = 1e5;

/* From this pressure on an axis is in GPa. */
static const double giga_from_pa = 9.9e9;

double gb_view_curve_unit(double highest_pa)
{
    return highest_pa >= giga_from_pa ? 1e9 : 1e6;
}

const char *gb_view_curve_unit_label(double unit_pa)
{
    return unit_pa > 1e6 ? "p, GPa" : "p, MPa";
}

void gb_view_curve_add(struct gb_view_curve *view, const struct gb_plot_series *series,
                       const char *name)
{
    gb_plot_line(&view->panel->plot, series);
    if (view->entries < GB_VIEW_CURVE_ENTRIES) {
        struct gb_plot_entry *entry = &view->entry[view->entries++];
        entry->ink = series->ink;
        entry->marker = series->marker;
        gb_text_fit_copy(entry->name, sizeof entry->name, name);
    }
}

static bool against_time(const struct gb_view_curve *view)
{
    return view->panel->view->abscissa == GB_VIEW_ELAPSED;
}

static int kind_of(const struct gb_session *session)
{
    return gb_session_shown(session).params->kind;
}

double gb_view_curve_x(const struct gb_view_curve *view, const struct gb_point *point)
{
    return gb_panel_plot_cursor_x(view->panel, view->session, point);
}

const double *gb_view_curve_previous_x(const struct gb_view_curve *view,
                                       const struct gb_previous_curve *previous)
{
    if (!against_time(view)) {
        return previous->density;
    }
    return previous->params.kind == kind_of(view->session) ? previous->elapsed : NULL;
}

bool gb_view_curve_quick_superseded(const struct gb_session *session)
{
    return session->runner != NULL && !gb_quick_cell_live(&session->quick_cell) &&
           gb_params_diff_count(&session->quick_cell.full_params,
                                gb_runner_params(session->runner)) == 0;
}

/* A superseded quick curve is hidden together with the previous curves.  Against the step
 * number, quick cells of quasi-static runs are hidden: their strain steps are longer. */
bool gb_view_curve_quick_shown(const struct gb_view_curve *view)
{
    const struct gb_session *session = view->session;
    return session->quick_cell.points > 0 &&
           (!against_time(view) || gb_loading_kind_at(kind_of(session))->given_rate) &&
           !(view->panel->hide_previous && gb_view_curve_quick_superseded(session));
}

int gb_view_curve_quick_ink(const struct gb_session *session)
{
    const int colour = gb_previous_list_free_colour(session);
    return colour > 0 ? gb_views_curve_ink(colour) : GB_PLOT_INK_TEXT;
}

bool gb_view_curve_several(const struct gb_view_curve *view)
{
    const struct gb_session *session = view->session;
    bool several = session->runner != NULL && gb_view_curve_quick_shown(view) &&
                   !gb_view_curve_quick_superseded(session);
    for (int k = 0; k < session->previous_count; k++) {
        const struct gb_previous_curve *previous = &session->previous[k];
        several |= previous->label.colour > 0 &&
                   gb_previous_list_shown(previous, view->panel->hide_previous);
    }
    return several;
}

const struct gb_runset_view_group *
gb_view_curve_replicas(const struct gb_view_curve *view)
{
    return against_time(view) ? NULL : gb_session_replicas(view->session);
}

static enum gb_plot_range_of across(const struct gb_view_curve *view)
{
    return against_time(view) ? GB_PLOT_RANGE_TIME : GB_PLOT_RANGE_DENSITY;
}

/* Range of the data. */
struct ends {
    const struct gb_plot_ranges *typed;
    enum gb_plot_range_of across; /* quantity of the x axis */
    double x[2], y[2], min_positive;
};

/* Points outside a typed range do not count for the other axis. */
static void extend(struct ends *ends, double x, double y)
{
    if (!isfinite(x) || !isfinite(y) ||
        !gb_panel_plot_ranges_inside(ends->typed, ends->across, x) ||
        !gb_panel_plot_ranges_inside(ends->typed, GB_PLOT_RANGE_PRESSURE, y)) {
        return;
    }
    ends->x[0] = fmin(ends->x[0], x);
    ends->x[1] = fmax(ends->x[1], x);
    ends->y[0] = fmin(ends->y[0], y);
    ends->y[1] = fmax(ends->y[1], y);
    if (y > 0.0) {
        ends->min_positive = fmin(ends->min_positive, y);
    }
}

static void extend_by_curve(struct ends *ends, const struct gb_view_curve *view,
                            const struct gb_curve *curve, size_t points)
{
    for (size_t i = 0; i < points; i++) {
        const struct gb_point *point = gb_curve_at(curve, i);
        extend(ends, gb_view_curve_x(view, point), point->p_pa);
    }
}

static void extend_by_overlays(struct ends *ends, const struct gb_view_curve *view)
{
    const struct gb_session *session = view->session;
    const struct gb_measured *data = gb_session_measured(session);
    for (size_t i = 0; data != NULL && !against_time(view) && i < data->count; i++) {
        extend(ends, data->density[i], data->pressure_pa[i]);
    }
    for (int k = 0; k < session->previous_count; k++) {
        const struct gb_previous_curve *previous = &session->previous[k];
        const double *x = gb_previous_list_shown(previous, view->panel->hide_previous)
                              ? gb_view_curve_previous_x(view, previous)
                              : NULL;
        for (size_t i = 0; x != NULL && i < previous->count; i++) {
            extend(ends, x[i], previous->pressure_pa[i]);
        }
    }
    const struct gb_runset_view_group *band = gb_view_curve_replicas(view);
    for (size_t k = 0; band != NULL && k < session->replica_band.runset.levels; k++) {
        extend(ends, band->mean[k], session->replica_band.runset.level_pa[k]);
    }
}

static struct ends find_ends(const struct gb_view_curve *view)
{
    const struct gb_session *session = view->session;
    struct ends ends = {
        &view->panel->ranges,  across(view), {HUGE_VAL, -HUGE_VAL},
        {HUGE_VAL, -HUGE_VAL}, HUGE_VAL};
    if (session->runner != NULL) {
        extend_by_curve(&ends, view, gb_runner_curve(session->runner), session->points);
    }
    if (gb_view_curve_quick_shown(view)) {
        extend_by_curve(&ends, view, gb_runner_curve(session->quick_cell.runner),
                        session->quick_cell.points);
    }
    extend_by_overlays(&ends, view);
    ends.y[0] = view->panel->log && ends.y[1] > 0.0
                    ? fmax(ends.min_positive, ends.y[1] / log_range)
                    : fmin(ends.y[0], 0.0);
    return ends;
}

static void draw_axes(struct gb_view_curve *view)
{
    struct ends ends = find_ends(view);
    const struct gb_plot_ranges *typed = &view->panel->ranges;
    const char *x_label = !against_time(view) ? "relative density"
                          : gb_loading_kind_at(kind_of(view->session))->given_rate
                              ? "t, ns"
                              : "step";
    view->unit_pa = gb_view_curve_unit(ends.y[1]);
    view->panel->unit_pa = view->unit_pa;
    double y_ends[2] = {ends.y[0] / view->unit_pa, ends.y[1] / view->unit_pa};
    gb_panel_plot_ranges_x(typed, across(view), 1.0, &view->panel->plot, ends.x);
    gb_panel_plot_ranges_y(typed, GB_PLOT_RANGE_PRESSURE, view->unit_pa,
                           &view->panel->plot, y_ends);
    gb_plot_axes(&view->panel->plot, ends.x, y_ends,
                 view->panel->log ? GB_PLOT_LOG : GB_PLOT_LINEAR, x_label,
                 gb_view_curve_unit_label(view->unit_pa));
}

/* Text of the empty plot before the first point. */
static void draw_waiting(const struct gb_view_curve *view)
{
    const struct gb_session_shown shown = gb_session_shown(view->session);
    const char *text = shown.curve == NULL ? "not started: r starts it"
                       : shown.state == GB_RUN_PACKING
                           ? "building the initial structure ..."
                           : "waiting for the first point ...";
    struct gb_plot *plot = &view->panel->plot;
    gb_plot_text(plot, plot->top + plot->field_rows / 2,
                 plot->left + (plot->field_cols - (int)strlen(text)) / 2,
                 GB_PLOT_INK_TEXT, text);
}

/* The legend lists the line on top, which is drawn last, first. */
static void draw_legend(struct gb_view_curve *view)
{
    for (int i = 0; i < view->entries / 2; i++) {
        const struct gb_plot_entry entry = view->entry[i];
        view->entry[i] = view->entry[view->entries - 1 - i];
        view->entry[view->entries - 1 - i] = entry;
    }
    gb_plot_legend(&view->panel->plot, view->entry, view->entries);
}

static void draw_cursor(const struct gb_view_curve *view)
{
    const struct gb_session_shown shown = gb_session_shown(view->session);
    struct gb_panel_plot *panel = view->panel;
    if (gb_panel_plot_pressure_shown(panel) && !against_time(view)) {
        const double density = gb_panel_plot_pressure_density(panel, view->session);
        if (isfinite(density)) {
            gb_plot_cursor(&panel->plot, density, panel->at_pa / view->unit_pa);
        }
    } else if (panel->cursor_on && panel->cursor < shown.points) {
        const struct gb_point *point = gb_curve_at(shown.curve, panel->cursor);
        gb_plot_cursor(&panel->plot, gb_view_curve_x(view, point),
                       point->p_pa / view->unit_pa);
    }
}

void gb_view_curve_draw(struct gb_panel_plot *panel, const struct gb_session *session)
{
    struct gb_view_curve view = {
        .panel = panel, .session = session, .path = gb_view_legs_path(session)};
    draw_axes(&view);
    gb_view_overlays_previous(&view);
    gb_view_overlays_quick(&view);
    gb_view_overlays_replicas(&view);
    gb_view_overlays_measured(&view);
    if (session->points > 0 && gb_panel_plot_reserve(panel, 2 * session->points + 1)) {
        gb_view_branches_draw(&view);
        gb_view_overlays_what_ifs(&view);
    } else if (session->quick_cell.points == 0) {
        draw_waiting(&view);
        return;
    }
    draw_legend(&view);
    draw_cursor(&view);
}
