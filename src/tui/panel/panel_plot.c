#include <glib.h>
#include <stdio.h>

#include "base/alloc.h"
#include "scene/loading_kind.h"
#include "tui/panel/panels.h"
#include "tui/view/views.h"

/* INSET: size of a pane from which on contact laws are drawn below the curve. */
enum { INSET_FROM_ROWS = 30, INSET_COLS = 50, INSET_SHARE = 3 };

void gb_panel_plot_init(struct gb_panel_plot *panel, const struct gb_term *term,
                        int graph)
{
    *panel = (struct gb_panel_plot){.view = gb_views_at(0)};
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
    gb_compaction_cache_finish(&panel->fits);
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
    static const char *const names[] = {
        [-GB_BRANCH_LOAD] = "compress",      [-GB_BRANCH_RELAX] = "relax",
        [-GB_BRANCH_HOLD] = "hold",          [-GB_BRANCH_UNLOAD] = "unloading",
        [-GB_BRANCH_CONFINED] = "punch off", [-GB_BRANCH_EJECT] = "ejection",
        [-GB_BRANCH_EJECTED] = "ejected"};
    return names[branch < 0 && branch >= GB_BRANCH_LEAST ? -branch : 0];
}

void gb_panel_plot_step_view(struct gb_panel_plot *panel, int step)
{
    panel->view = gb_views_step(panel->view, step, &panel->edited);
}

static void write_title(const struct gb_panel_plot *panel,
                        const struct gb_session *session, char *title, size_t size)
{
    const struct gb_plot_view *view = panel->view;
    const struct gb_session_shown shown = gb_session_shown(session);
    const bool across = view->options & GB_VIEW_PRESSURE_ACROSS;
    const bool pressure = across || view->options & GB_VIEW_PRESSURE_AXIS;
    const bool dynamic = gb_loading_kind_of(shown.params)->given_rate;
    snprintf(title, size, "%s %s%s%s%s%s", view->key,
             view->title_quasistatic != NULL && !dynamic ? view->title_quasistatic
                                                         : view->title,
             pressure && panel->log ? " (log)" : "",
             gb_panel_plot_ranges_any(&panel->ranges) ? ", Z" : "",
             shown.quick && !pressure ? ", quick cell" : "",
             session->frozen ? ", view frozen" : "");
}

/* Text in the middle of an empty plot; a newline ends a line. */
static void write_missing(struct gb_plot *plot, const char *missing)
{
    char **lines = g_strsplit(missing, "\n", -1);
    const int first = plot->rows / 2 - (int)g_strv_length(lines) / 2;
    for (int i = 0; lines[i] != NULL; i++) {
        gb_plot_text(plot, first + i, 2, GB_PLOT_INK_TEXT, lines[i]);
    }
    g_strfreev(lines);
}

/* False: out of memory. */
static bool draw_view(struct gb_panel_plot *panel, struct gb_plot *plot,
                      const struct gb_paint *paint, const struct gb_session *session,
                      const struct gb_plot_view *view)
{
    const char *missing = gb_views_missing(view, session, &panel->edited);
    if (!gb_plot_resize(plot, paint->rect.rows - 1, paint->rect.cols - 2, panel->glyphs,
                        NULL)) {
        gb_paint_text(paint, 1, 1, GB_STYLE_BAD, "no memory for the plot");
        return false;
    }
    panel->target = plot;
    if (missing != NULL) {
        write_missing(plot, missing);
    } else {
        view->draw(panel, session);
    }
    gb_paint_plot(paint, 1, 1, plot);
    return true;
}

/* Rows for the insets below the curve: a third, where that is enough. */
static int inset_rows(const struct gb_panel_plot *panel, const struct gb_rect *rect)
{
    return panel->view == gb_views_at(0) && rect->rows >= INSET_FROM_ROWS &&
                   rect->cols >= INSET_COLS
               ? rect->rows / INSET_SHARE
               : 0;
}

static void draw_insets(struct gb_panel_plot *panel, const struct gb_paint *paint,
                        const struct gb_session *session, int rows)
{
    const int count = MIN(paint->rect.cols / INSET_COLS, GB_PANEL_INSETS);
    int drawn = 0;
    for (size_t i = 0; i < gb_views_count() && drawn < count; i++) {
        const struct gb_plot_view *view = gb_views_at(i);
        if (!(view->options & GB_VIEW_INSET)) {
            continue;
        }
        const int from = drawn * paint->rect.cols / count;
        const int to = (drawn + 1) * paint->rect.cols / count;
        const struct gb_rect rect = {paint->rect.row + paint->rect.rows - rows,
                                     paint->rect.col + from, rows, to - from};
        const struct gb_paint part = gb_paint_at(paint->term, rect);
        char title[96];
        snprintf(title, sizeof title, "%s %s", view->key, view->title);
        gb_paint_title(&part, title, GB_PAINT_UNFOCUSED);
        draw_view(panel, &panel->inset[drawn++], &part, session, view);
    }
}

void gb_panel_plot_draw(struct gb_panel_plot *panel, const struct gb_paint *paint,
                        const struct gb_session *session, enum gb_paint_focus focus)
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
