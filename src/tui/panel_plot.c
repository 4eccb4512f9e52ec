#include <math.h>
#include <stdio.h>

#include "base/alloc.h"
#include "base/units.h"
#include "tui/panels.h"
#include "tui/views.h"

enum { PAGE_POINTS = 10 };

void gb_panel_plot_init(struct gb_panel_plot *panel, const struct gb_term *term)
{
    *panel = (struct gb_panel_plot){.view = GB_VIEW_CURVE};
    gb_plot_init(&panel->plot);
    panel->glyphs = gb_term_braille(term) ? GB_PLOT_BRAILLE
                    : gb_term_utf8(term)  ? GB_PLOT_BLOCK
                                          : GB_PLOT_ASCII;
}

void gb_panel_plot_finish(struct gb_panel_plot *panel)
{
    gb_plot_finish(&panel->plot);
    gb_alloc_free(panel->x);
    gb_alloc_free(panel->y);
}

const char *gb_panel_plot_stage(int branch)
{
    return branch == GB_BRANCH_RELAX  ? "relax"
           : branch == GB_BRANCH_HOLD ? "hold"
                                      : "compress";
}

static bool dynamic(const struct gb_session *session)
{
    return session->runner != NULL &&
           gb_runner_params(session->runner)->kind == GB_KIND_DYNAMIC;
}

/* The views along which a cursor runs. */
static bool of_points(const struct gb_panel_plot *panel)
{
    return panel->view == GB_VIEW_CURVE || panel->view == GB_VIEW_TIME;
}

static void write_title(const struct gb_panel_plot *panel,
                        const struct gb_session *session, char *title, size_t size)
{
    static const char *const names[] = {
        [GB_VIEW_CURVE] = "1 Pressure against density",
        [GB_VIEW_HISTOGRAM] = "2 Particles by their number of contacts",
        [GB_VIEW_ROSE] = "3 Mean normal force by direction",
        [GB_VIEW_TIME] = "4 Pressure against time",
    };
    const bool steps = panel->view == GB_VIEW_TIME && !dynamic(session);
    snprintf(title, size, "%s%s%s",
             steps ? "4 Pressure against step" : names[panel->view],
             of_points(panel) && panel->log ? " (log)" : "",
             session->frozen ? ", view frozen" : "");
}

void gb_panel_plot_draw(struct gb_panel_plot *panel, const struct gb_paint *paint,
                        const struct gb_session *session, bool focus)
{
    char title[96];
    write_title(panel, session, title, sizeof title);
    gb_paint_title(paint, title, focus);
    if (!gb_plot_resize(&panel->plot, paint->rect.rows - 1, paint->rect.cols - 2,
                        panel->glyphs, NULL)) {
        gb_paint_text(paint, 1, 1, GB_STYLE_BAD, "no memory for the plot");
        return;
    }
    switch (panel->view) {
    case GB_VIEW_CURVE:
    case GB_VIEW_TIME:
        gb_view_curve_draw(panel, session);
        break;
    case GB_VIEW_HISTOGRAM:
        gb_view_histogram_draw(panel, session);
        break;
    case GB_VIEW_ROSE:
        gb_view_rose_draw(panel, session);
        break;
    }
    gb_paint_plot(paint, 1, 1, &panel->plot);
}

/* The cursor starts at the newest point, wherever it is moved first. */
static bool move(struct gb_panel_plot *panel, const struct gb_session *session,
                 long long by)
{
    if (session->points == 0 || !of_points(panel)) {
        return true;
    }
    const long long last = (long long)session->points - 1;
    long long to = panel->cursor_on ? (long long)panel->cursor + by : last;
    to = to < 0 ? 0 : to > last ? last : to;
    panel->cursor_on = true;
    panel->cursor = (size_t)to;
    return true;
}

/* The glyphs that this screen can show, in turn. */
static void next_glyphs(struct gb_panel_plot *panel)
{
    panel->glyphs = (panel->glyphs + 1) % GB_PLOT_GLYPHS;
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
        panel->cursor_on = session->points > 0;
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
        panel->hide_earlier = !panel->hide_earlier;
        return true;
    case GB_ACTION_GLYPHS:
        next_glyphs(panel);
        return true;
    case GB_ACTION_VIEW_CURVE:
        panel->view = GB_VIEW_CURVE;
        return true;
    case GB_ACTION_VIEW_HISTOGRAM:
        panel->view = GB_VIEW_HISTOGRAM;
        return true;
    case GB_ACTION_VIEW_ROSE:
        panel->view = GB_VIEW_ROSE;
        return true;
    case GB_ACTION_VIEW_TIME:
        panel->view = GB_VIEW_TIME;
        return true;
    default:
        return false;
    }
}

/* "compress, 10.5 ns", "unload:100MPa". */
static void write_place(const struct gb_session *session, const struct gb_point *point,
                        char *text, size_t size)
{
    if (dynamic(session)) {
        snprintf(text, size, "%s, %.5g ns", gb_panel_plot_stage(point->branch),
                 gb_session_elapsed(GB_KIND_DYNAMIC, point));
    } else {
        gb_curve_branch_name(point, text, size);
    }
}

void gb_panel_plot_explain(const struct gb_panel_plot *panel,
                           const struct gb_session *session, struct gb_message *message)
{
    message->style = GB_STYLE_DIM;
    if (!panel->cursor_on || panel->cursor >= session->points) {
        snprintf(message->text, sizeof message->text,
                 "Left and Right move a cursor along the points; L log or linear; 1 "
                 "curve, 2 contacts, 3 directions, 4 time");
        return;
    }
    const struct gb_point *point =
        gb_curve_at(gb_runner_curve(session->runner), panel->cursor);
    char place[64];
    char p[32];
    char px[32];
    char pz[32];
    write_place(session, point, place, sizeof place);
    message->style = GB_STYLE_PLAIN;
    snprintf(message->text, sizeof message->text,
             "point %zu of %zu (%s)  density %.5f  p %s  px %s  pz %s  contacts %.3f  "
             "bridged %.1f %%",
             panel->cursor + 1, session->points, place, point->density,
             gb_units_format_short(point->p_pa, GB_DIM_PRESSURE, 5, p, sizeof p),
             gb_units_format_short(point->px_pa, GB_DIM_PRESSURE, 5, px, sizeof px),
             gb_units_format_short(point->pz_pa, GB_DIM_PRESSURE, 5, pz, sizeof pz),
             point->coordination, 100.0 * point->bridged);
}
