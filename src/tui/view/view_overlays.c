#include <math.h>
#include <stdio.h>

#include "tui/session/overlay/previous_list.h"
#include "tui/view/view_curve.h"

enum { MARK_MEASURED = 5, REPLICA_SPACING = 8 };

/* Measurements have markers in the colour of texts; colours are those of runs. */
enum { INK_MEASURED = GB_PLOT_INK_TEXT };

void gb_view_overlays_previous(struct gb_view_curve *view)
{
    const struct gb_session *session = view->session;
    struct gb_panel_plot *panel = view->panel;
    for (int k = 0; k < session->previous_count; k++) {
        const struct gb_previous_curve *previous = &session->previous[k];
        const double *x = gb_view_curve_previous_x(view, previous);
        if (x == NULL || !gb_previous_list_shown(previous, panel->hide_previous)) {
            continue;
        }
        if (!gb_panel_plot_reserve(panel, previous->count)) {
            return;
        }
        for (size_t i = 0; i < previous->count; i++) {
            panel->y[i] = previous->pressure_pa[i] / view->unit_pa;
        }
        const struct gb_plot_series series = {.x = x,
                                              .y = panel->y,
                                              .count = previous->count,
                                              .ink = gb_views_curve_ink(
                                                  previous->label.colour),
                                              .marker = previous->label.marker};
        gb_view_curve_add(view, &series, gb_previous_list_name(previous));
    }
}

/* ": mu 0.2" where these parameters differ from those of the run, else "". */
static void write_difference(const struct gb_session *session,
                             const struct gb_params *params, char *text, size_t size)
{
    char difference[GB_PARAMS_DIFF_TEXT];
    text[0] = '\0';
    if (session->runner != NULL &&
        gb_params_diff_count(params, gb_runner_params(session->runner)) > 0) {
        gb_params_diff_describe(params, gb_runner_params(session->runner), difference,
                                sizeof difference);
        snprintf(text, size, ": %s", difference);
    }
}

/* In the next colour until the full cell is started, then dim. */
void gb_view_overlays_quick(struct gb_view_curve *view)
{
    const struct gb_session *session = view->session;
    const struct gb_quick_cell *quick = &session->quick_cell;
    struct gb_panel_plot *panel = view->panel;
    char difference[GB_PARAMS_DIFF_TEXT + 2];
    char name[sizeof difference + 48];
    if (!gb_view_curve_quick_shown(view) ||
        !gb_panel_plot_reserve(panel, quick->points)) {
        return;
    }
    for (size_t i = 0; i < quick->points; i++) {
        const struct gb_point *point = gb_curve_at(gb_runner_curve(quick->runner), i);
        panel->x[i] = gb_view_curve_x(view, point);
        panel->y[i] = point->p_pa / view->unit_pa;
    }
    const bool superseded = gb_view_curve_quick_superseded(session);
    const struct gb_plot_series series = {.x = panel->x,
                                          .y = panel->y,
                                          .count = quick->points,
                                          .ink = superseded ? GB_PLOT_INK_DIM
                                                            : gb_view_curve_quick_ink(
                                                                  session),
                                          .marker = 'q'};
    write_difference(session, &quick->full_params, difference, sizeof difference);
    snprintf(name, sizeof name, "quick cell, N %lld%s",
             (long long)gb_runner_params(quick->runner)->count, difference);
    gb_view_curve_add(view, &series, name);
}

/* The mean of the replicas plus standard errors. */
static void shift_mean(const struct gb_view_curve *view, double errors,
                       double x[GB_RUNSET_VIEW_LEVELS], double y[GB_RUNSET_VIEW_LEVELS])
{
    const struct gb_runset_view_group *group = gb_view_curve_replicas(view);
    for (size_t k = 0; k < view->session->replica_band.runset.levels; k++) {
        x[k] = group->mean[k] + (errors != 0.0 ? errors * group->error[k] : 0.0);
        y[k] = view->session->replica_band.runset.level_pa[k] / view->unit_pa;
    }
}

/* Mean of the replicas, in a band of two standard errors on both sides. */
void gb_view_overlays_replicas(struct gb_view_curve *view)
{
    const struct gb_runset_view_group *group = gb_view_curve_replicas(view);
    double low[GB_RUNSET_VIEW_LEVELS], x[GB_RUNSET_VIEW_LEVELS];
    double y[GB_RUNSET_VIEW_LEVELS];
    char difference[GB_PARAMS_DIFF_TEXT + 2];
    char name[sizeof difference + 48];
    if (group == NULL) {
        return;
    }
    const size_t count = view->session->replica_band.runset.levels;
    shift_mean(view, -GB_VIEW_BAND_ERRORS, low, y);
    shift_mean(view, GB_VIEW_BAND_ERRORS, x, y);
    gb_plot_band(&view->panel->plot, &(struct gb_plot_band){.x = {low, x},
                                                            .y = {y, y},
                                                            .count = count,
                                                            .ink = GB_PLOT_INK_DIM});
    shift_mean(view, 0.0, x, y);
    const struct gb_plot_series series = {.x = x,
                                          .y = y,
                                          .count = count,
                                          .ink = GB_VIEW_INK_REPLICAS,
                                          .marker = 'R',
                                          .spacing = REPLICA_SPACING};
    write_difference(view->session, &view->session->replica_band.params, difference,
                     sizeof difference);
    snprintf(name, sizeof name, "mean of %zu %s%s%s", group->members,
             group->members == 1 ? "cell" : "cells",
             group->members == 1 ? "" : ", +- 2 errors", difference);
    gb_view_curve_add(view, &series, name);
}

/* A marker and its standard errors as lines; NaN draws nothing. */
static void draw_measured_point(struct gb_view_curve *view, size_t i)
{
    const struct gb_measured *data = view->session->measured;
    const double x = data->density[i];
    const double y = data->pressure_pa[i] / view->unit_pa;
    const double dx = data->density_error[i];
    const double dy = data->pressure_error_pa[i] / view->unit_pa;
    const struct gb_plot_series across = {.x = (double[]){x - dx, x + dx},
                                          .y = (double[]){y, y},
                                          .count = 2,
                                          .ink = INK_MEASURED};
    const struct gb_plot_series up = {.x = (double[]){x, x},
                                      .y = (double[]){y - dy, y + dy},
                                      .count = 2,
                                      .ink = INK_MEASURED};
    const struct gb_plot_series marker = {.x = &x,
                                          .y = &y,
                                          .count = 1,
                                          .ink = INK_MEASURED,
                                          .marker = MARK_MEASURED,
                                          .points = true};
    gb_plot_line(&view->panel->plot, &across);
    gb_plot_line(&view->panel->plot, &up);
    gb_plot_line(&view->panel->plot, &marker);
}

void gb_view_overlays_measured(struct gb_view_curve *view)
{
    const struct gb_measured *data = gb_session_measured(view->session);
    struct gb_measured_misfit misfit;
    char name[GB_PLOT_NAME] = "measured";
    if (data == NULL || view->panel->view->abscissa != GB_VIEW_DENSITY) {
        return;
    }
    for (size_t i = 0; i < data->count; i++) {
        draw_measured_point(view, i);
    }
    gb_session_misfit(view->session, &misfit);
    if (misfit.reached > 0) {
        snprintf(name, sizeof name, "measured, RMS misfit %.2f %%", 100.0 * misfit.rms);
    }
    const struct gb_plot_series named = {
        .ink = INK_MEASURED, .marker = MARK_MEASURED, .points = true};
    gb_view_curve_add(view, &named, name);
}

/* A letter where a what-if began. */
void gb_view_overlays_what_ifs(struct gb_view_curve *view)
{
    const struct gb_session *session = view->session;
    for (int i = 0; i < session->whatifs; i++) {
        const size_t at = session->whatif_at[i];
        if (at == 0 || at > session->points) {
            continue;
        }
        const struct gb_point *point =
            gb_curve_at(gb_runner_curve(session->runner), at - 1);
        const double x = gb_view_curve_x(view, point);
        const double y = point->p_pa / view->unit_pa;
        gb_plot_line(&view->panel->plot,
                     &(struct gb_plot_series){.x = &x,
                                              .y = &y,
                                              .count = 1,
                                              .ink = GB_PLOT_INK_CURSOR,
                                              .marker = 'f',
                                              .points = true});
    }
}
