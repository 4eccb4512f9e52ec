#include <glib.h>
#include <math.h>
#include <stdio.h>

#include "base/alloc.h"
#include "base/units.h"
#include "scene/loading_kind.h"
#include "tui/panel/panels.h"
#include "tui/view/views.h"

/* INSET: of the pane, below which the laws have no place under the curve. */
enum { PAGE_POINTS = 10, INSET_FROM_ROWS = 30, INSET_COLS = 50 };

void gb_panel_plot_init(struct gb_panel_plot *panel, const struct gb_term *term,
                        int graph)
{
    *panel = (struct gb_panel_plot){.view = GB_VIEW_CURVE};
    gb_plot_init(&panel->plot);
    for (int i = 0; i < GB_PANEL_INSETS; i++) {
        gb_plot_init(&panel->inset[i]);
    }
    panel->shades = gb_term_shaded(term);
    panel->utf8 = gb_term_utf8(term);
    panel->pixels = gb_term_images(term) != GB_IMAGES_NONE;
    panel->glyphs = gb_term_braille(term) ? GB_PLOT_BRAILLE
                    : panel->utf8         ? GB_PLOT_BLOCK
                                          : GB_PLOT_ASCII;
    if (graph != GB_GRAPH_AUTO && panel->utf8) {
        panel->glyphs = graph == GB_GRAPH_BRAILLE ? GB_PLOT_BRAILLE
                        : graph == GB_GRAPH_BLOCK ? GB_PLOT_BLOCK
                                                  : GB_PLOT_ASCII;
    }
}

void gb_panel_plot_finish(struct gb_panel_plot *panel)
{
    gb_plot_finish(&panel->plot);
    for (int i = 0; i < GB_PANEL_INSETS; i++) {
        gb_plot_finish(&panel->inset[i]);
    }
    gb_alloc_free(panel->x);
    gb_alloc_free(panel->y);
}

bool gb_panel_plot_reserve(struct gb_panel_plot *panel, size_t count)
{
    if (count <= panel->capacity) {
        return true;
    }
    const size_t capacity = 2 * count + 64;
    double *x = gb_alloc_array(capacity, sizeof *x, NULL);
    double *y = x == NULL ? NULL : gb_alloc_array(capacity, sizeof *y, NULL);
    if (y == NULL) {
        gb_alloc_free(x);
        return false;
    }
    gb_alloc_free(panel->x);
    gb_alloc_free(panel->y);
    panel->x = x;
    panel->y = y;
    panel->capacity = capacity;
    return true;
}

const char *gb_panel_plot_stage(int branch)
{
    return branch == GB_BRANCH_RELAX  ? "relax"
           : branch == GB_BRANCH_HOLD ? "hold"
                                      : "compress";
}

static bool dynamic(const struct gb_session *session)
{
    return gb_loading_kind_of(gb_session_shown(session).params)->given_rate;
}

/* Everything that is known of a view; one row each, in the order of the keys. */
static const struct view {
    const char *title, *hint;
    bool of_points; /* a cursor runs along the points of the curve */
    bool log;       /* L makes the pressure logarithmic */
    void (*draw)(struct gb_panel_plot *panel, const struct gb_session *session);
} views[GB_VIEWS] = {
    [GB_VIEW_CURVE] = {"Pressure against density",
                       "Left and Right move a cursor along the points; L log or linear",
                       true, true, gb_view_curve_draw},
    [GB_VIEW_HISTOGRAM] = {"Particles by their number of contacts",
                           "share of particles with 0, 1, 2 ... contacts, r < d", false,
                           false, gb_view_histogram_draw},
    [GB_VIEW_ROSE] = {"Mean normal force by direction",
                      "mean force of contacts by the angle to z; round when the load is "
                      "carried equally in all directions",
                      false, false, gb_view_rose_draw},
    [GB_VIEW_TIME] = {"Pressure against time",
                      "Left and Right move a cursor along the points; L log or linear",
                      true, true, gb_view_curve_draw},
    [GB_VIEW_DISTANCES] = {"Radial distribution function g(r)",
                           "density of particles at a distance, over the mean; 1 where "
                           "there is no order left",
                           false, false, gb_view_distances_draw},
    [GB_VIEW_RATIO] = {"Lateral over axial pressure, px/pz",
                       "px/pz against density: 1 would be a fluid; Left and Right move a "
                       "cursor",
                       true, false, gb_view_ratio_draw},
    [GB_VIEW_FORCE] =
        {"Normal force of two particles",
         "the law of the parameters as shown, + and - turn the one with the "
         "focus; dim: as in the run",
         false, false, gb_view_law_force},
    [GB_VIEW_STRENGTH] = {"Strength of a bridge",
                          "mean normal stress that breaks a bridge partly, wholly at h = "
                          "0; dim: as in the run",
                          false, false, gb_view_law_strength},
    [GB_VIEW_PACKING] = {"Packing",
                         "the front of the cell seen along y, darker with depth", false,
                         false, gb_view_packing_draw},
    [GB_VIEW_CHART] = {"Error against cost of numerical choices",
                       "how far each choice of the chart errs, and what it costs", false,
                       false, gb_view_chart_draw},
};

static void write_title(const struct gb_panel_plot *panel,
                        const struct gb_session *session, char *title, size_t size)
{
    const struct view *view = &views[panel->view];
    const bool steps = panel->view == GB_VIEW_TIME && !dynamic(session);
    snprintf(title, size, "%d %s%s%s%s", ((int)panel->view + 1) % 10,
             steps ? "Pressure against step" : view->title,
             view->log && panel->log ? " (log)" : "",
             gb_session_shown(session).quick && !view->log ? ", quick cell" : "",
             session->frozen ? ", view frozen" : "");
}

static bool draw_view(struct gb_panel_plot *panel, struct gb_plot *plot,
                      const struct gb_paint *paint, const struct gb_session *session,
                      enum gb_plot_view view)
{
    if (!gb_plot_resize(plot, paint->rect.rows - 1, paint->rect.cols - 2, panel->glyphs,
                        NULL)) {
        gb_paint_text(paint, 1, 1, GB_STYLE_BAD, "no memory for the plot");
        return false;
    }
    panel->target = plot;
    views[view].draw(panel, session);
    gb_paint_plot(paint, 1, 1, plot);
    return true;
}

/* Rows that the laws take below the curve: a third, where that is enough. */
static int inset_rows(const struct gb_panel_plot *panel, const struct gb_rect *rect)
{
    const bool wanted = panel->view == GB_VIEW_CURVE;
    return wanted && rect->rows >= INSET_FROM_ROWS && rect->cols >= INSET_COLS
               ? rect->rows / 3
               : 0;
}

static void draw_insets(struct gb_panel_plot *panel, const struct gb_paint *paint,
                        const struct gb_session *session, int rows)
{
    static const enum gb_plot_view laws[GB_PANEL_INSETS] = {GB_VIEW_FORCE,
                                                            GB_VIEW_STRENGTH};
    const int count = paint->rect.cols >= GB_PANEL_INSETS * INSET_COLS ? 2 : 1;
    for (int i = 0; i < count; i++) {
        const int from = i * paint->rect.cols / count;
        const int to = (i + 1) * paint->rect.cols / count;
        const struct gb_rect rect = {paint->rect.row + paint->rect.rows - rows,
                                     paint->rect.col + from, rows, to - from};
        const struct gb_paint part = gb_paint_at(paint->term, rect);
        char title[96];
        snprintf(title, sizeof title, "%d %s", (int)laws[i] + 1, views[laws[i]].title);
        gb_paint_title(&part, title, false);
        draw_view(panel, &panel->inset[i], &part, session, laws[i]);
    }
}

void gb_panel_plot_draw(struct gb_panel_plot *panel, const struct gb_paint *paint,
                        const struct gb_session *session, bool focus)
{
    char title[96];
    struct gb_paint upper = *paint;
    const int rows = inset_rows(panel, &paint->rect);
    upper.rect.rows -= rows;
    panel->field = (struct gb_rect){upper.rect.row + 1, upper.rect.col + 1,
                                    upper.rect.rows - 3, upper.rect.cols - 2};
    write_title(panel, session, title, sizeof title);
    gb_paint_title(&upper, title, focus);
    if (draw_view(panel, &panel->plot, &upper, session, panel->view) && rows > 0) {
        draw_insets(panel, paint, session, rows);
    }
}

/* The cursor starts at the newest point, wherever it is moved first. */
static bool move(struct gb_panel_plot *panel, const struct gb_session *session,
                 long long by)
{
    const size_t points = gb_session_shown(session).points;
    if (points == 0 || !views[panel->view].of_points) {
        return true;
    }
    const long long last = (long long)points - 1;
    long long to = panel->cursor_on ? (long long)panel->cursor + by : last;
    to = to < 0 ? 0 : to > last ? last : to;
    panel->cursor_on = true;
    panel->cursor = (size_t)to;
    return true;
}

/* Cells between a point of the curve and a cell of the field; across only where the view
 * has another quantity than the pressure on its y axis. */
static double distance_to(const struct gb_panel_plot *panel,
                          const struct gb_session *session, const struct gb_point *point,
                          int row, int col)
{
    const struct gb_plot *plot = &panel->plot;
    const double x = gb_view_curve_x(panel, session, point);
    const double across =
        gb_plot_axis_position(&plot->x, x) * plot->field_cols - 0.5 - col;
    if (!views[panel->view].log || !(panel->unit_pa > 0.0)) {
        return fabs(across);
    }
    const double y = gb_plot_axis_position(&plot->y, point->p_pa / panel->unit_pa);
    return hypot(across, 2.0 * ((1.0 - y) * plot->field_rows - 0.5 - row));
}

void gb_panel_plot_click(struct gb_panel_plot *panel, const struct gb_session *session,
                         int row, int col)
{
    const struct gb_session_shown shown = gb_session_shown(session);
    const int down = row - 1 - panel->plot.top; /* the plot begins at 1, 1 */
    const int right = col - 1 - panel->plot.left;
    double nearest = HUGE_VAL;
    if (!views[panel->view].of_points || panel->plot.field_cols <= 0) {
        return;
    }
    for (size_t i = 0; i < shown.points; i++) {
        const double distance =
            distance_to(panel, session, gb_curve_at(shown.curve, i), down, right);
        if (distance < nearest) { /* NaN is none */
            nearest = distance;
            panel->cursor = i;
            panel->cursor_on = true;
        }
    }
}

/* The glyphs that this screen can show, in turn. */
static void next_glyphs(struct gb_panel_plot *panel)
{
    if (panel->utf8) {
        panel->glyphs = (panel->glyphs + 1) % GB_PLOT_GLYPHS;
    }
}

static bool show(struct gb_panel_plot *panel, int view)
{
    panel->view = (enum gb_plot_view)view;
    return true;
}

bool gb_panel_plot_act(struct gb_panel_plot *panel, const struct gb_session *session,
                       enum gb_action action)
{
    switch (action) {
    case GB_ACTION_LEFT:
    case GB_ACTION_UP:
        return move(panel, session, -1);
    case GB_ACTION_RIGHT:
    case GB_ACTION_DOWN:
        return move(panel, session, 1);
    case GB_ACTION_PAGE_UP:
        return move(panel, session, -PAGE_POINTS);
    case GB_ACTION_PAGE_DOWN:
        return move(panel, session, PAGE_POINTS);
    case GB_ACTION_HOME:
        panel->cursor_on = gb_session_shown(session).points > 0;
        panel->cursor = 0;
        return true;
    case GB_ACTION_END:
        panel->cursor_on = false;
        return move(panel, session, 0);
    case GB_ACTION_BACK:
        panel->cursor_on = false;
        return true;
    case GB_ACTION_LOG:
        panel->log = !panel->log;
        return true;
    case GB_ACTION_EARLIER:
        panel->hide_previous = !panel->hide_previous;
        return true;
    case GB_ACTION_GLYPHS:
        next_glyphs(panel);
        return true;
    case GB_ACTION_NEXT_VIEW:
        return show(panel, ((int)panel->view + 1) % GB_VIEWS);
    case GB_ACTION_PREVIOUS_VIEW:
        return show(panel, ((int)panel->view + GB_VIEWS - 1) % GB_VIEWS);
    case GB_ACTION_VIEW_CURVE:
    case GB_ACTION_VIEW_HISTOGRAM:
    case GB_ACTION_VIEW_ROSE:
    case GB_ACTION_VIEW_TIME:
    case GB_ACTION_VIEW_DISTANCES:
    case GB_ACTION_VIEW_RATIO:
    case GB_ACTION_VIEW_FORCE:
    case GB_ACTION_VIEW_STRENGTH:
    case GB_ACTION_VIEW_PACKING:
    case GB_ACTION_VIEW_CHART:
        return show(panel, (int)(action - GB_ACTION_VIEW_CURVE));
    default:
        return false;
    }
}

/* "compress, 10.5 ns", "unload:100MPa". */
static void write_point_label(const struct gb_session *session,
                              const struct gb_point *point, char *text, size_t size)
{
    if (dynamic(session)) {
        snprintf(
            text, size, "%s, %.5g ns", gb_panel_plot_stage(point->branch),
            gb_previous_curve_elapsed(gb_session_shown(session).params->kind, point));
    } else {
        gb_curve_branch_name(point, text, size);
    }
}

/* "alumina.csv: curve minus experiment -0.3 +- 0.8 points of density, 9 of 12 reached" */
static bool describe_misfit(const struct gb_session *session, struct gb_message *message)
{
    struct gb_measured_misfit misfit;
    if (session->measured == NULL) {
        return false;
    }
    char *name = g_path_get_basename(session->measured->path);
    gb_session_misfit(session, &misfit);
    int n =
        snprintf(message->text, sizeof message->text, "%.60s: %zu of %zu points reached",
                 name, misfit.reached, session->measured->count);
    if (misfit.reached > 0) {
        n += snprintf(message->text + n, sizeof message->text - (size_t)n,
                      "; density at the same pressure: rms misfit %.2f points, mean "
                      "%+.2f",
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

void gb_panel_plot_describe(const struct gb_panel_plot *panel,
                            const struct gb_session *session, struct gb_message *message)
{
    const struct gb_session_shown shown = gb_session_shown(session);
    message->style = GB_STYLE_DIM;
    if (!panel->cursor_on || panel->cursor >= shown.points ||
        !views[panel->view].of_points) {
        if (views[panel->view].log && describe_misfit(session, message)) {
            return;
        }
        snprintf(message->text, sizeof message->text,
                 "%s; v or 1 to 9 and 0: another view", views[panel->view].hint);
        return;
    }
    const struct gb_point *point = gb_curve_at(shown.curve, panel->cursor);
    char place[64];
    char p[32];
    char px[32];
    char pz[32];
    write_point_label(session, point, place, sizeof place);
    message->style = GB_STYLE_PLAIN;
    snprintf(message->text, sizeof message->text,
             "point %zu of %zu (%s)  density %.5f  p %s  px %s  pz %s  contacts %.3f  "
             "bridged %.1f %%",
             panel->cursor + 1, shown.points, place, point->density,
             gb_units_format_short(point->p_pa, GB_DIM_PRESSURE, 5, p, sizeof p),
             gb_units_format_short(point->px_pa, GB_DIM_PRESSURE, 5, px, sizeof px),
             gb_units_format_short(point->pz_pa, GB_DIM_PRESSURE, 5, pz, sizeof pz),
             point->coordination, 100.0 * point->bridged);
}
