#include <glib.h>
#include <math.h>
#include <stdio.h>

#include "base/units.h"
#include "scene/loading_kind.h"
#include "scene/path/path.h"
#include "tui/panel/panels.h"
#include "tui/term/text_fit.h"
#include "tui/view/views.h"

/* The cursor along the points of the curve, and its line of values. */

enum { PAGE_POINTS = 10 };

static bool has_cursor(const struct gb_panel_plot *panel)
{
    return panel->view->abscissa != GB_VIEW_NO_CURSOR;
}

double gb_panel_plot_cursor_x(const struct gb_panel_plot *panel,
                              const struct gb_session *session,
                              const struct gb_point *point)
{
    return panel->view->abscissa == GB_VIEW_ELAPSED
               ? gb_previous_curve_elapsed(gb_session_shown(session).params->kind, point)
               : point->density;
}

/* The first movement puts the cursor on the newest point. */
static void move(struct gb_panel_plot *panel, const struct gb_session *session,
                 long long by)
{
    const size_t points = gb_session_shown(session).points;
    if (points == 0 || !has_cursor(panel)) {
        return;
    }
    const long long last = (long long)points - 1;
    const long long to = panel->cursor_on ? (long long)panel->cursor + by : last;
    panel->cursor_on = true;
    panel->cursor = (size_t)CLAMP(to, 0, last);
}

void gb_panel_plot_cursor_navigate(struct gb_panel_plot *panel,
                                   const struct gb_session *session,
                                   enum gb_action action)
{
    if (panel->view->abscissa == GB_VIEW_SETTINGS) {
        gb_panel_plot_settings_navigate(panel, session, action);
        return;
    }
    panel->at_pa = 0.0;
    switch (action) {
    case GB_ACTION_LEFT:
    case GB_ACTION_UP:
        move(panel, session, -1);
        break;
    case GB_ACTION_RIGHT:
    case GB_ACTION_DOWN:
        move(panel, session, 1);
        break;
    case GB_ACTION_PAGE_UP:
        move(panel, session, -PAGE_POINTS);
        break;
    case GB_ACTION_PAGE_DOWN:
        move(panel, session, PAGE_POINTS);
        break;
    case GB_ACTION_HOME:
        panel->cursor_on = gb_session_shown(session).points > 0;
        panel->cursor = 0;
        break;
    case GB_ACTION_END:
        panel->cursor_on = false;
        move(panel, session, 0);
        break;
    case GB_ACTION_BACK:
        panel->cursor_on = false;
        break;
    case GB_ACTION_NONE:
    case GB_ACTION_ENTER:
        break;
    }
}

/* Distance in cells between a point of the curve and a cell of the field; only horizontal
 * where the y axis is not the pressure. */
static double distance_to(const struct gb_panel_plot *panel,
                          const struct gb_session *session, const struct gb_point *point,
                          int row, int col)
{
    const struct gb_plot *plot = &panel->plot;
    const double x = gb_panel_plot_cursor_x(panel, session, point);
    const double across =
        gb_plot_axis_position(&plot->x, x) * plot->field_cols - 0.5 - col;
    if (!(panel->view->options & GB_VIEW_PRESSURE_AXIS) || !(panel->unit_pa > 0.0)) {
        return fabs(across);
    }
    const double y = gb_plot_axis_position(&plot->y, point->p_pa / panel->unit_pa);
    return hypot(across, 2.0 * ((1.0 - y) * plot->field_rows - 0.5 - row));
}

void gb_panel_plot_cursor_click(struct gb_panel_plot *panel,
                                const struct gb_session *session, int row, int col)
{
    const struct gb_session_shown shown = gb_session_shown(session);
    const int down = row - 1 - panel->plot.top; /* the plot begins at 1, 1 */
    const int right = col - 1 - panel->plot.left;
    double nearest = HUGE_VAL;
    if (!has_cursor(panel) || panel->view->abscissa >= GB_VIEW_OWN ||
        panel->plot.field_cols <= 0) {
        return;
    }
    for (size_t i = 0; i < shown.points; i++) {
        const double distance =
            distance_to(panel, session, gb_curve_at(shown.curve, i), down, right);
        if (distance < nearest) { /* false for NaN */
            nearest = distance;
            panel->cursor = i;
            panel->cursor_on = true;
            panel->at_pa = 0.0;
        }
    }
}

/* "compress, 10.5 ns", "unload:100MPa". */
static void write_point_label(const struct gb_session *session,
                              const struct gb_point *point, char *text, size_t size)
{
    const struct gb_params *params = gb_session_shown(session).params;
    if (gb_loading_kind_of(params)->given_rate) {
        snprintf(text, size, "%s, %.5g ns", gb_panel_plot_stage(point->branch),
                 gb_previous_curve_elapsed(params->kind, point));
    } else {
        gb_curve_branch_name(point, text, size);
    }
}

/* "alumina.csv: 9 of 12 points reached; relative density at equal pressure: RMS misfit
 * 0.73 % of theoretical density, mean -0.30 %, 0.8 standard errors" */
static bool describe_misfit(const struct gb_session *session, struct gb_message *message)
{
    struct gb_measured_misfit misfit;
    if (session->measured == NULL) {
        return false;
    }
    char *name = g_path_get_basename(session->measured->path);
    gb_session_misfit(session, &misfit);
    char file[64];
    if (gb_session_measured(session) == NULL) {
        snprintf(message->text, sizeof message->text,
                 "%s: loaded for a scene in %dD, not compared with this one in %dD",
                 gb_text_fit_copy(file, sizeof file, name), session->measured_dimension,
                 gb_session_shown(session).params->dimension);
        g_free(name);
        return true;
    }
    int n = snprintf(message->text, sizeof message->text, "%s: %zu of %zu points reached",
                     gb_text_fit_copy(file, sizeof file, name), misfit.reached,
                     session->measured->count);
    if (misfit.reached > 0) {
        n += snprintf(message->text + n, sizeof message->text - (size_t)n,
                      "; at equal pressure: RMS misfit %.2f %% of theoretical density, "
                      "mean %+.2f %%",
                      100.0 * misfit.rms, 100.0 * misfit.mean);
    }
    if (isfinite(misfit.weighted)) {
        snprintf(message->text + n, sizeof message->text - (size_t)n,
                 ", %.2g standard errors", misfit.weighted);
    }
    message->style = GB_STYLE_PLAIN;
    g_free(name);
    return true;
}

/* "point 12 of 60, leg 2: density 0.4120  p 50 MPa  q 12.3 MPa  strain % x 1.20 ..." */
static void describe_leg(const struct gb_panel_plot *panel, size_t points,
                         const struct gb_point *point, struct gb_message *message)
{
    char p[32], q[32];
    const size_t size = sizeof message->text;
    int n = snprintf(message->text, size,
                     "point %zu of %zu, leg %.0f: density %.5f  p %s  q %s  strain %%",
                     panel->cursor + 1, points, point->leg, point->density,
                     gb_units_format_short(point->p_pa, GB_DIM_PRESSURE, 5, p, sizeof p),
                     gb_units_format_short(point->q_pa, GB_DIM_PRESSURE, 4, q, sizeof q));
    for (int k = 0; k < GB_PATH_COMPONENTS; k++) {
        if (isfinite(point->strain[k]) && (k < 3 || point->strain[k] != 0.0)) {
            n += snprintf(message->text + n, size - (size_t)n, " %s %.2f",
                          gb_path_component_name(k), 100.0 * point->strain[k]);
        }
    }
}

static void describe_point(const struct gb_panel_plot *panel,
                           const struct gb_session *session, struct gb_message *message)
{
    const struct gb_session_shown shown = gb_session_shown(session);
    const struct gb_point *point = gb_curve_at(shown.curve, panel->cursor);
    char label[64];
    char p[32];
    char px[32];
    char pz[32];
    write_point_label(session, point, label, sizeof label);
    message->style = GB_STYLE_PLAIN;
    if (isfinite(point->leg)) {
        describe_leg(panel, shown.points, point, message);
        return;
    }
    snprintf(message->text, sizeof message->text,
             "point %zu of %zu (%s)  rel. density %.5f  p %s  px %s  pz %s  "
             "coordination %.3f  bridged %.1f %%",
             panel->cursor + 1, shown.points, label, point->density,
             gb_units_format_short(point->p_pa, GB_DIM_PRESSURE, 5, p, sizeof p),
             gb_units_format_short(point->px_pa, GB_DIM_PRESSURE, 5, px, sizeof px),
             gb_units_format_short(point->pz_pa, GB_DIM_PRESSURE, 5, pz, sizeof pz),
             point->coordination, 100.0 * point->bridged);
}

bool gb_panel_plot_cursor_shown(const struct gb_panel_plot *panel,
                                const struct gb_session *session)
{
    return gb_panel_plot_pressure_shown(panel) ||
           (panel->cursor_on && panel->cursor < gb_session_shown(session).points &&
            has_cursor(panel));
}

void gb_panel_plot_cursor_describe(const struct gb_panel_plot *panel,
                                   const struct gb_session *session,
                                   struct gb_message *message)
{
    const struct gb_plot_view *view = panel->view;
    message->style = GB_STYLE_DIM;
    if (view->abscissa == GB_VIEW_SETTINGS) {
        gb_panel_plot_settings_describe(panel, session, message);
    } else if (gb_panel_plot_pressure_shown(panel)) {
        gb_panel_plot_pressure_describe(panel, session, message);
    } else if (gb_panel_plot_cursor_shown(panel, session)) {
        describe_point(panel, session, message);
    } else if (!(view->options & GB_VIEW_PRESSURE_AXIS) ||
               !describe_misfit(session, message)) {
        snprintf(message->text, sizeof message->text, "%s; v and V change the view",
                 view->hint);
    }
}
