#include <glib.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/units.h"
#include "scene/loading_kind.h"
#include "tui/view/views.h"

/* Decades of pressure that a logarithmic axis shows at most: below are the first
 * contacts, which say nothing. */
static const double decades_max = 1e5;

enum {
    MARK_LOAD = 1,
    MARK_UNLOAD = 2,
    MARK_RELAX = 3,
    MARK_HOLD = 4,
    MARK_MEASURED = 5,
    UNLOAD_SPACING = 7
};

enum {
    INK_RELAX = GB_PLOT_INK_SERIES + 2,
    INK_HOLD = GB_PLOT_INK_SERIES + 4,
    INK_QUICK = GB_PLOT_INK_SERIES + 1,
    INK_MEASURED = GB_PLOT_INK_SERIES + 3,
    INK_BAND = GB_PLOT_INK_SERIES + 5
};

enum { STAGES = 3, ENTRIES = STAGES + 3 + GB_UNLOAD_MAX + GB_SESSION_PREVIOUS };

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
    double x[2], y[2], min_positive;
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
        ends->min_positive = fmin(ends->min_positive, y);
    }
}

static const struct gb_curve *curve_of(const struct gb_session *session)
{
    return session->runner == NULL ? NULL : gb_runner_curve(session->runner);
}

static int kind_of(const struct gb_session *session)
{
    return gb_session_shown(session).params->kind;
}

double gb_view_curve_x(const struct gb_panel_plot *panel,
                       const struct gb_session *session, const struct gb_point *point)
{
    return panel->view == GB_VIEW_TIME
               ? gb_previous_curve_elapsed(kind_of(session), point)
               : point->density;
}

/* NULL: nanoseconds and steps share no axis. */
static const double *previous_x(const struct gb_panel_plot *panel,
                                const struct gb_session *session,
                                const struct gb_previous_curve *previous)
{
    if (panel->view != GB_VIEW_TIME) {
        return previous->density;
    }
    return previous->params.kind == kind_of(session) ? previous->elapsed : NULL;
}

/* The full run of the same scene makes the quick curve one of those that can be hidden.
 * Against time it has no place: its steps are longer. */
static bool quick_cell_superseded(const struct gb_session *session)
{
    return session->runner != NULL && !gb_quick_cell_live(&session->quick_cell) &&
           gb_params_diff_count(&session->quick_cell.full_params,
                                gb_runner_params(session->runner)) == 0;
}

static bool quick_cell_shown(const struct gb_panel_plot *panel,
                             const struct gb_session *session)
{
    return session->quick_cell.points > 0 &&
           (panel->view != GB_VIEW_TIME ||
            gb_loading_kind_at(kind_of(session))->given_rate) &&
           !(panel->hide_previous && quick_cell_superseded(session));
}

static const struct gb_runset_view_group *shown_band(const struct gb_panel_plot *panel,
                                                     const struct gb_session *session)
{
    return panel->view == GB_VIEW_CURVE ? gb_replica_band_group(&session->band) : NULL;
}

static struct ends find_ends(const struct gb_panel_plot *panel,
                             const struct gb_session *session)
{
    struct ends ends = {{HUGE_VAL, -HUGE_VAL}, {HUGE_VAL, -HUGE_VAL}, HUGE_VAL};
    for (size_t i = 0; i < session->points; i++) {
        const struct gb_point *point = gb_curve_at(curve_of(session), i);
        extend(&ends, gb_view_curve_x(panel, session, point), point->p_pa);
    }
    const struct gb_quick_cell *quick_cell = &session->quick_cell;
    for (size_t i = 0; quick_cell_shown(panel, session) && i < quick_cell->points; i++) {
        const struct gb_point *point =
            gb_curve_at(gb_runner_curve(quick_cell->runner), i);
        extend(&ends, gb_view_curve_x(panel, session, point), point->p_pa);
    }
    const struct gb_measured *data = session->measured;
    for (size_t i = 0; data != NULL && panel->view == GB_VIEW_CURVE && i < data->count;
         i++) {
        extend(&ends, data->density[i], data->pressure_pa[i]);
    }
    for (int k = 0; !panel->hide_previous && k < session->previous_count; k++) {
        const struct gb_previous_curve *previous = &session->previous[k];
        const double *x = previous_x(panel, session, previous);
        for (size_t i = 0; x != NULL && i < previous->count; i++) {
            extend(&ends, x[i], previous->pressure_pa[i]);
        }
    }
    const struct gb_runset_view_group *band = shown_band(panel, session);
    for (size_t k = 0; band != NULL && k < GB_RUNSET_VIEW_LEVELS; k++) {
        extend(&ends, band->mean[k], session->band.runset.level_pa[k]);
    }
    if (panel->log && ends.y[1] > 0.0) {
        ends.y[0] = fmax(ends.min_positive, ends.y[1] / decades_max);
    } else {
        ends.y[0] = fmin(ends.y[0], 0.0);
    }
    return ends;
}

static void draw_previous(struct gb_panel_plot *panel, const struct gb_session *session,
                          double unit_pa, struct legend *legend)
{
    for (int k = 0; k < session->previous_count; k++) {
        const struct gb_previous_curve *previous = &session->previous[k];
        const double *x = previous_x(panel, session, previous);
        if (x == NULL) {
            continue;
        }
        if (!gb_panel_plot_reserve(panel, previous->count)) {
            return;
        }
        for (size_t i = 0; i < previous->count; i++) {
            panel->y[i] = previous->pressure_pa[i] / unit_pa;
        }
        const struct gb_plot_series series = {.x = x,
                                              .y = panel->y,
                                              .count = previous->count,
                                              .ink = GB_PLOT_INK_DIM,
                                              .marker = previous->letter};
        gb_plot_line(&panel->plot, &series);
        add_entry(legend, &series, previous->difference);
    }
}

/* Bright while it is the newest answer, dim once the full cell is on its way. */
static void draw_quick_cell(struct gb_panel_plot *panel, const struct gb_session *session,
                            double unit_pa, struct legend *legend)
{
    const struct gb_quick_cell *quick_cell = &session->quick_cell;
    if (!quick_cell_shown(panel, session) ||
        !gb_panel_plot_reserve(panel, quick_cell->points)) {
        return;
    }
    for (size_t i = 0; i < quick_cell->points; i++) {
        const struct gb_point *point =
            gb_curve_at(gb_runner_curve(quick_cell->runner), i);
        panel->x[i] = gb_view_curve_x(panel, session, point);
        panel->y[i] = point->p_pa / unit_pa;
    }
    const struct gb_plot_series series = {
        .x = panel->x,
        .y = panel->y,
        .count = quick_cell->points,
        .ink = quick_cell_superseded(session) ? GB_PLOT_INK_DIM : INK_QUICK,
        .marker = 'q'};
    char name[GB_PLOT_NAME];
    char difference[GB_PARAMS_DIFF_TEXT] = "";
    if (session->runner != NULL && !quick_cell_superseded(session)) {
        gb_params_diff_describe(&quick_cell->full_params,
                                gb_runner_params(session->runner), difference,
                                sizeof difference);
    }
    snprintf(name, sizeof name, "quick cell, N %lld%s%.40s",
             (long long)gb_runner_params(quick_cell->runner)->count,
             difference[0] != '\0' ? ": " : "", difference);
    gb_plot_line(&panel->plot, &series);
    add_entry(legend, &series, name);
}

/* A quasi-static run has no stages: its first, relaxed state is a part of loading. */
static bool point_on_branch(const struct gb_point *point, int branch, int kind)
{
    if (!gb_loading_kind_at(kind)->given_rate && point->branch <= 0) {
        return branch == GB_BRANCH_LOAD;
    }
    return point->branch == branch;
}

/* Points of a branch.  It begins at the point it left: a stage at the last one of the
 * stage before, an unloading branch at the one on the loading branch.  Against time there
 * is a gap where other branches were in between. */
static size_t gather(struct gb_panel_plot *panel, const struct gb_session *session,
                     int branch, double unit_pa, double *from_pa)
{
    size_t n = 0;
    const struct gb_point *root = NULL;
    bool gap = false;
    for (size_t i = 0; i < session->points; i++) {
        const struct gb_point *point = gb_curve_at(curve_of(session), i);
        const bool on_branch = point_on_branch(point, branch, kind_of(session));
        if (on_branch && n == 0 && root != NULL) {
            panel->x[n] = gb_view_curve_x(panel, session, root);
            panel->y[n++] = root->p_pa / unit_pa;
        } else if (on_branch && gap && panel->view == GB_VIEW_TIME) {
            panel->x[n] = NAN;
            panel->y[n++] = NAN;
        }
        if (on_branch) {
            panel->x[n] = gb_view_curve_x(panel, session, point);
            panel->y[n++] = point->p_pa / unit_pa;
            *from_pa = point->branch_from_pa;
        }
        gap = !on_branch;
        root = point->branch <= 0 ? point : root;
    }
    return n;
}

/* What tells a branch from the others: name, colour, marker. */
static struct gb_plot_series branch_style(int branch, int kind, double from_pa,
                                          char *name, size_t size)
{
    if (branch > 0) {
        char pressure[32];
        gb_units_format_short(from_pa, GB_DIM_PRESSURE, 3, pressure, sizeof pressure);
        snprintf(name, size, "unload from %s", pressure);
        return (struct gb_plot_series){.ink = GB_PLOT_INK_SERIES + 1 + (branch - 1) % 5,
                                       .marker = MARK_UNLOAD + (branch - 1) % 7,
                                       .spacing = UNLOAD_SPACING};
    }
    g_strlcpy(name,
              gb_loading_kind_at(kind)->given_rate ? gb_panel_plot_stage(branch) : "load",
              size);
    switch (branch) {
    case GB_BRANCH_RELAX:
        return (struct gb_plot_series){.ink = INK_RELAX, .marker = MARK_RELAX};
    case GB_BRANCH_HOLD:
        return (struct gb_plot_series){.ink = INK_HOLD, .marker = MARK_HOLD};
    default:
        return (struct gb_plot_series){.ink = GB_PLOT_INK_SERIES, .marker = MARK_LOAD};
    }
}

static void draw_branch(struct gb_panel_plot *panel, const struct gb_session *session,
                        int branch, double unit_pa, struct legend *legend)
{
    double from_pa = 0.0;
    char name[64];
    const size_t count = gather(panel, session, branch, unit_pa, &from_pa);
    if (count == 0) {
        return;
    }
    struct gb_plot_series series =
        branch_style(branch, kind_of(session), from_pa, name, sizeof name);
    series.x = panel->x;
    series.y = panel->y;
    series.count = count;
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

/* The unloading branches below, the loading one on top; the stages so that the legend,
 * which names the last first, has them in the order of time. */
static void draw_branches(struct gb_panel_plot *panel, const struct gb_session *session,
                          double unit_pa, struct legend *legend)
{
    for (int branch = last_branch(session); branch > 0; branch--) {
        draw_branch(panel, session, branch, unit_pa, legend);
    }
    draw_branch(panel, session, GB_BRANCH_HOLD, unit_pa, legend);
    draw_branch(panel, session, GB_BRANCH_LOAD, unit_pa, legend);
    draw_branch(panel, session, GB_BRANCH_RELAX, unit_pa, legend);
}

/* What stands in the empty field before there is a point. */
static void draw_waiting(struct gb_panel_plot *panel, const struct gb_session *session)
{
    const struct gb_session_shown shown = gb_session_shown(session);
    const char *text = shown.curve == NULL ? "not started: r starts it"
                       : shown.state == GB_RUN_PACKING
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

static const char *x_label(const struct gb_panel_plot *panel,
                           const struct gb_session *session)
{
    return panel->view != GB_VIEW_TIME                        ? "density"
           : gb_loading_kind_at(kind_of(session))->given_rate ? "t, ns"
                                                              : "step";
}

/* The experiment: a mark for each point, a line as long as its error is on each side. */
static void draw_measured(struct gb_panel_plot *panel, const struct gb_session *session,
                          double unit_pa, struct legend *legend)
{
    const struct gb_measured *data = session->measured;
    if (data == NULL || panel->view != GB_VIEW_CURVE) {
        return;
    }
    struct gb_plot_series series = {
        .count = 2, .ink = INK_MEASURED, .marker = MARK_MEASURED, .points = true};
    for (size_t i = 0; i < data->count; i++) {
        const double x = data->density[i], y = data->pressure_pa[i] / unit_pa;
        const double dx = data->density_error[i];
        const double dy = data->pressure_error_pa[i] / unit_pa;
        const struct gb_plot_series wide = {.x = (double[]){x - dx, x + dx},
                                            .y = (double[]){y, y},
                                            .count = 2,
                                            .ink = INK_MEASURED};
        const struct gb_plot_series high = {.x = (double[]){x, x},
                                            .y = (double[]){y - dy, y + dy},
                                            .count = 2,
                                            .ink = INK_MEASURED};
        gb_plot_line(&panel->plot, &wide); /* NaN draws nothing */
        gb_plot_line(&panel->plot, &high);
        series.x = &x;
        series.y = &y;
        series.count = 1;
        gb_plot_line(&panel->plot, &series);
    }
    char name[GB_PLOT_NAME];
    struct gb_measured_misfit misfit;
    gb_session_misfit(session, &misfit);
    if (misfit.reached > 0) {
        snprintf(name, sizeof name, "experiment, misfit %.2f points", 100.0 * misfit.rms);
    } else {
        snprintf(name, sizeof name, "experiment");
    }
    add_entry(legend, &series, name);
}

/* `off` standard errors beside the mean of the cells. */
static void draw_beside(struct gb_panel_plot *panel, const struct gb_session *session,
                        double unit_pa, double off, struct gb_plot_series *series)
{
    const struct gb_runset_view_group *group = shown_band(panel, session);
    double x[GB_RUNSET_VIEW_LEVELS];
    double y[GB_RUNSET_VIEW_LEVELS];
    for (size_t k = 0; k < GB_RUNSET_VIEW_LEVELS; k++) {
        x[k] = group->mean[k] + (off != 0.0 ? off * group->error[k] : 0.0);
        y[k] = session->band.runset.level_pa[k] / unit_pa;
    }
    series->x = x;
    series->y = y;
    series->count = GB_RUNSET_VIEW_LEVELS;
    gb_plot_line(&panel->plot, series);
}

/* Mean of more cells and its standard error on both sides. */
static void draw_band(struct gb_panel_plot *panel, const struct gb_session *session,
                      double unit_pa, struct legend *legend)
{
    const struct gb_replica_band *band = &session->band;
    const struct gb_runset_view_group *group = shown_band(panel, session);
    char difference[GB_PARAMS_DIFF_TEXT] = "";
    char name[GB_PLOT_NAME];
    if (group == NULL) {
        return;
    }
    struct gb_plot_series edge = {.ink = GB_PLOT_INK_DIM};
    struct gb_plot_series mean = {.ink = INK_BAND, .marker = 'R', .spacing = 8};
    draw_beside(panel, session, unit_pa, -1.0, &edge);
    draw_beside(panel, session, unit_pa, 1.0, &edge);
    draw_beside(panel, session, unit_pa, 0.0, &mean);
    if (session->runner != NULL &&
        gb_params_diff_count(&band->params, gb_runner_params(session->runner)) > 0) {
        gb_params_diff_describe(&band->params, gb_runner_params(session->runner),
                                difference, sizeof difference);
    }
    snprintf(name, sizeof name, "mean of %zu %s%s%.40s", group->members,
             group->members == 1 ? "cell" : "cells", *difference ? ": " : "", difference);
    add_entry(legend, &mean, name);
}

/* A letter where the run went on with other values. */
static void draw_forks(struct gb_panel_plot *panel, const struct gb_session *session,
                       double unit_pa)
{
    for (int i = 0; i < session->forks; i++) {
        const size_t at = session->fork_at[i];
        if (at == 0 || at > session->points) {
            continue;
        }
        const struct gb_point *point = gb_curve_at(curve_of(session), at - 1);
        const double x = gb_view_curve_x(panel, session, point);
        const double y = point->p_pa / unit_pa;
        gb_plot_line(&panel->plot, &(struct gb_plot_series){.x = &x,
                                                            .y = &y,
                                                            .count = 1,
                                                            .ink = GB_PLOT_INK_CURSOR,
                                                            .marker = 'f',
                                                            .points = true});
    }
}

static void draw_cursor(struct gb_panel_plot *panel, const struct gb_session *session,
                        double unit_pa)
{
    const struct gb_session_shown shown = gb_session_shown(session);
    if (panel->cursor_on && panel->cursor < shown.points) {
        const struct gb_point *point = gb_curve_at(shown.curve, panel->cursor);
        gb_plot_cursor(&panel->plot, gb_view_curve_x(panel, session, point),
                       point->p_pa / unit_pa);
    }
}

void gb_view_curve_draw(struct gb_panel_plot *panel, const struct gb_session *session)
{
    const struct ends ends = find_ends(panel, session);
    const double unit_pa = ends.y[1] >= 9.9e9 ? 1e9 : 1e6;
    panel->unit_pa = unit_pa;
    const double y_ends[2] = {ends.y[0] / unit_pa, ends.y[1] / unit_pa};
    gb_plot_axes(&panel->plot, ends.x, y_ends, panel->log, x_label(panel, session),
                 unit_pa > 1e6 ? "p, GPa" : "p, MPa");
    struct legend legend = {.count = 0};
    if (!panel->hide_previous) {
        draw_previous(panel, session, unit_pa, &legend);
    }
    draw_quick_cell(panel, session, unit_pa, &legend);
    draw_band(panel, session, unit_pa, &legend);
    draw_measured(panel, session, unit_pa, &legend);
    if (session->points > 0 && gb_panel_plot_reserve(panel, 2 * session->points + 1)) {
        draw_branches(panel, session, unit_pa, &legend);
        draw_forks(panel, session, unit_pa);
    } else if (session->quick_cell.points == 0) {
        draw_waiting(panel, session);
        return;
    }
    reverse(&legend); /* drawn last means on top: named first */
    gb_plot_legend(&panel->plot, legend.entry, legend.count);
    draw_cursor(panel, session, unit_pa);
}
