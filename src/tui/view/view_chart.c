#include <math.h>
#include <stdio.h>

#include "tui/view/views.h"

enum {
    INK_ALL = GB_PLOT_INK_SERIES,
    INK_FRONT = GB_PLOT_INK_SERIES + 1,
    INK_CHOSEN = GB_PLOT_INK_SERIES + 4
};
enum { MARK_ALL = 2, MARK_FRONT = 1, MARK_CHOSEN = 3 };

static void extend(double ends[2], double value)
{
    if (value > 0.0 && isfinite(value)) {
        ends[0] = fmin(ends[0], value);
        ends[1] = fmax(ends[1], value);
    }
}

static void draw_point(struct gb_plot *plot, double x, double y, int ink, int marker)
{
    const struct gb_plot_series point = {
        .x = &x, .y = &y, .count = 1, .ink = ink, .marker = marker, .points = true};
    gb_plot_line(plot, &point);
}

static void draw_settings(struct gb_plot *plot, const struct gb_chart_csv *chart)
{
    for (size_t i = 0; i < chart->count; i++) {
        if (i == chart->chosen) {
            continue;
        }
        draw_point(plot, chart->seconds[i], chart->error[i],
                   chart->front[i] ? INK_FRONT : INK_ALL,
                   chart->front[i] ? MARK_FRONT : MARK_ALL);
    }
    if (chart->chosen < chart->count) {
        draw_point(plot, chart->seconds[chart->chosen], chart->error[chart->chosen],
                   INK_CHOSEN, MARK_CHOSEN);
    }
}

void gb_view_chart_draw(struct gb_panel_plot *panel, const struct gb_session *session)
{
    struct gb_plot *plot = &panel->plot;
    const struct gb_chart_csv *chart = session->chart;
    double x_ends[2] = {HUGE_VAL, 0.0};
    double y_ends[2] = {HUGE_VAL, 0.0};
    for (size_t i = 0; chart != NULL && i < chart->count; i++) {
        if (chart->error[i] > 0.0) {
            extend(x_ends, chart->seconds[i]);
            extend(y_ends, chart->error[i]);
        }
    }
    if (!(x_ends[1] > 0.0)) {
        gb_plot_text(plot, plot->rows / 2 - 1, 2, GB_PLOT_INK_TEXT,
                     chart == NULL ? "no chart yet: e loads a chart.csv,"
                                   : "the chart has no finished row yet:");
        gb_plot_text(plot, plot->rows / 2, 2, GB_PLOT_INK_TEXT,
                     "greenbody chart PRESET --out DIR measures one");
        return;
    }
    plot->log_x = true;
    gb_plot_axes(plot, x_ends, y_ends, GB_PLOT_LOG, "CPU time per cell, s",
                 "density error bound");
    draw_settings(plot, chart);
    struct gb_plot_entry entry[3] = {{INK_ALL, MARK_ALL, "setting"},
                                     {INK_FRONT, MARK_FRONT, "Pareto-optimal"},
                                     {INK_CHOSEN, MARK_CHOSEN, ""}};
    snprintf(entry[2].name, sizeof entry[2].name, "%s", chart->name);
    gb_plot_legend(plot, entry, chart->chosen < chart->count ? 3 : 2);
}
