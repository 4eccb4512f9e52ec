#include <glib.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "base/units.h"
#include "tui/views.h"

/* Decades of pressure that a logarithmic axis shows at most: below are the first
 * contacts, which say nothing. */
static const double decades_most = 1e5;

enum { MARK_LOAD = 1, MARK_UNLOAD = 2, UNLOAD_SPACING = 7 };

enum { ENTRIES = 1 + GB_UNLOAD_MAX + GB_SESSION_EARLIER };

struct legend {
    struct gb_plot_entry entry[ENTRIES];
    int count;
};

static void add_entry(struct legend *legend, const struct gb_plot_series *series,
                      const char *name)
{
    if (legend->count < ENTRIES) {
        struct gb_plot_entry *entry = &legend->entry[legend->count++];
        entry->ink = series->ink;
        entry->marker = series->marker;
        g_strlcpy(entry->name, name, sizeof entry->name);
    }
}

/* Range of the data. */
struct ends {
    double x[2], y[2], least_positive;
};

static void extend(struct ends *ends, double x, double y)
{
    if (!isfinite(x) || !isfinite(y)) {
        return;
    }
    ends->x[0] = fmin(ends->x[0], x);
    ends->x[1] = fmax(ends->x[1], x);
    ends->y[0] = fmin(ends->y[0], y);
    ends->y[1] = fmax(ends->y[1], y);
    if (y > 0.0) {
        ends->least_positive = fmin(ends->least_positive, y);
    }
}

static const struct gb_curve *curve_of(const struct gb_session *session)
{
    return session->runner == NULL ? NULL : gb_runner_curve(session->runner);
}

static struct ends find_ends(const struct gb_panel_plot *panel,
                             const struct gb_session *session)
{
    struct ends ends = {{HUGE_VAL, -HUGE_VAL}, {HUGE_VAL, -HUGE_VAL}, HUGE_VAL};
    for (size_t i = 0; i < session->points; i++) {
        const struct gb_point *point = gb_curve_at(curve_of(session), i);
        extend(&ends, point->density, point->p_pa);
    }
    for (int k = 0; !panel->hide_earlier && k < session->earlier_count; k++) {
        const struct gb_earlier *earlier = &session->earlier[k];
        for (size_t i = 0; i < earlier->count; i++) {
            extend(&ends, earlier->density[i], earlier->pressure_pa[i]);
        }
    }
    if (panel->log && ends.y[1] > 0.0) {
        ends.y[0] = fmax(ends.least_positive, ends.y[1] / decades_most);
    } else {
        ends.y[0] = fmin(ends.y[0], 0.0);
    }
    return ends;
}

static bool reserve(struct gb_panel_plot *panel, size_t count)
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

static void draw_earlier(struct gb_panel_plot *panel, const struct gb_session *session,
                         double unit_pa, struct legend *legend)
{
    for (int k = 0; k < session->earlier_count; k++) {
        const struct gb_earlier *earlier = &session->earlier[k];
        if (!reserve(panel, earlier->count)) {
            return;
        }
        for (size_t i = 0; i < earlier->count; i++) {
            panel->y[i] = earlier->pressure_pa[i] / unit_pa;
        }
        const struct gb_plot_series series = {.x = earlier->density,
                                              .y = panel->y,
                                              .count = earlier->count,
                                              .ink = GB_PLOT_INK_DIM,
                                              .marker = earlier->letter};
        gb_plot_line(&panel->plot, &series);
        add_entry(legend, &series, earlier->difference);
    }
}

/* Points of a branch; an unloading one begins at the loading point it left. */
static size_t gather(struct gb_panel_plot *panel, const struct gb_session *session,
                     int branch, double unit_pa, double *from_pa)
{
    size_t n = 0;
    const struct gb_point *before = NULL;
    for (size_t i = 0; i < session->points; i++) {
        const struct gb_point *point = gb_curve_at(curve_of(session), i);
        const bool mine = branch == 0 ? point->branch <= 0 : point->branch == branch;
        if (mine && n == 0 && branch > 0 && before != NULL) {
            panel->x[n] = before->density;
            panel->y[n++] = before->p_pa / unit_pa;
        }
        if (mine) {
            panel->x[n] = point->density;
            panel->y[n++] = point->p_pa / unit_pa;
            *from_pa = point->branch_from_pa;
        }
        before = point->branch <= 0 ? point : before;
    }
    return n;
}

static void draw_branch(struct gb_panel_plot *panel, const struct gb_session *session,
                        int branch, double unit_pa, struct legend *legend)
{
    double from_pa = 0.0;
    const size_t count = gather(panel, session, branch, unit_pa, &from_pa);
    if (count == 0) {
        return;
    }
    char name[64] = "load";
    if (branch > 0) {
        char pressure[32];
        gb_units_format_short(from_pa, GB_DIM_PRESSURE, 3, pressure, sizeof pressure);
        snprintf(name, sizeof name, "unload from %s", pressure);
    }
    const struct gb_plot_series series = {
        .x = panel->x,
        .y = panel->y,
        .count = count,
        .ink = GB_PLOT_INK_SERIES + (branch > 0 ? 1 + (branch - 1) % 5 : 0),
        .marker = branch > 0 ? MARK_UNLOAD + (branch - 1) % 7 : MARK_LOAD,
        .spacing = branch > 0 ? UNLOAD_SPACING : 0};
    gb_plot_line(&panel->plot, &series);
    add_entry(legend, &series, name);
}

static int last_branch(const struct gb_session *session)
{
    int last = 0;
    for (size_t i = 0; i < session->points; i++) {
        const int branch = gb_curve_at(curve_of(session), i)->branch;
        last = branch > last ? branch : last;
    }
    return last;
}

/* What stands in the empty field before there is a point. */
static void draw_waiting(struct gb_panel_plot *panel, const struct gb_session *session)
{
    const char *text = session->runner == NULL ? "no run: r starts one"
                       : session->now.state == GB_RUN_PACKING
                           ? "building the initial structure ..."
                           : "waiting for the first point ...";
    const struct gb_plot *plot = &panel->plot;
    gb_plot_text(&panel->plot, plot->top + plot->field_rows / 2,
                 plot->left + (plot->field_cols - (int)strlen(text)) / 2,
                 GB_PLOT_INK_TEXT, text);
}

static void reverse(struct legend *legend)
{
    for (int i = 0; i < legend->count / 2; i++) {
        const struct gb_plot_entry entry = legend->entry[i];
        legend->entry[i] = legend->entry[legend->count - 1 - i];
        legend->entry[legend->count - 1 - i] = entry;
    }
}

void gb_view_curve_draw(struct gb_panel_plot *panel, const struct gb_session *session)
{
    const struct ends ends = find_ends(panel, session);
    const double unit_pa = ends.y[1] >= 9.9e9 ? 1e9 : 1e6;
    const double y_ends[2] = {ends.y[0] / unit_pa, ends.y[1] / unit_pa};
    gb_plot_axes(&panel->plot, ends.x, y_ends, panel->log, "density",
                 unit_pa > 1e6 ? "p, GPa" : "p, MPa");
    struct legend legend = {.count = 0};
    if (!panel->hide_earlier) {
        draw_earlier(panel, session, unit_pa, &legend);
    }
    if (session->points == 0 || !reserve(panel, session->points + 1)) {
        draw_waiting(panel, session);
        return;
    }
    for (int branch = last_branch(session); branch >= 0; branch--) {
        draw_branch(panel, session, branch, unit_pa, &legend);
    }
    reverse(&legend); /* drawn last means on top: named first */
    gb_plot_legend(&panel->plot, legend.entry, legend.count);
    if (panel->cursor_on && panel->cursor < session->points) {
        const struct gb_point *point = gb_curve_at(curve_of(session), panel->cursor);
        gb_plot_cursor(&panel->plot, point->density, point->p_pa / unit_pa);
    }
}
