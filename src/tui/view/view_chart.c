#include <glib.h>
#include <math.h>

#include "tui/term/text_fit.h"
#include "tui/view/views.h"

/* Kinds of settings in the order in which they are drawn. */
enum kind { NOISE, SETTING, FRONT, CHOSEN, KINDS };

static const struct gb_plot_entry kinds[KINDS] = {
    [NOISE] = {GB_PLOT_INK_DIM, 8, "error within its noise"},
    [SETTING] = {GB_PLOT_INK_SERIES, 2, "setting"},
    [FRONT] = {GB_PLOT_INK_SERIES + 1, 1, "Pareto-optimal"},
    [CHOSEN] = {GB_PLOT_INK_SERIES + 4, 3, ""}, /* its name */
};

/* Room below the points for the name of the axis, a factor. */
static const double below = 1.5;

static void extend(double ends[2], double value)
{
    if (value > 0.0 && isfinite(value)) {
        ends[0] = fmin(ends[0], value);
        ends[1] = fmax(ends[1], value);
    }
}

static enum kind kind_of(const struct gb_chart_csv *chart, size_t i)
{
    return i == chart->chosen ? CHOSEN
           : chart->front[i]  ? FRONT
           : chart->noise[i]  ? NOISE
                              : SETTING;
}

/* Draws the settings of a kind; returns their number. */
static size_t draw_kind(struct gb_plot *plot, const struct gb_chart_csv *chart,
                        enum kind kind)
{
    size_t drawn = 0;
    for (size_t i = 0; i < chart->count; i++) {
        if (kind_of(chart, i) == kind && chart->error[i] > 0.0) {
            gb_plot_line(plot, &(struct gb_plot_series){.x = &chart->seconds[i],
                                                        .y = &chart->error[i],
                                                        .count = 1,
                                                        .ink = kinds[kind].ink,
                                                        .marker = kinds[kind].marker,
                                                        .points = true});
            drawn++;
        }
    }
    return drawn;
}

/* Settings and their legend. */
static void draw_settings(struct gb_plot *plot, const struct gb_chart_csv *chart)
{
    struct gb_plot_entry entry[KINDS];
    int entries = 0;
    for (enum kind kind = NOISE; kind < KINDS; kind++) {
        if (draw_kind(plot, chart, kind) == 0) {
            continue;
        }
        entry[entries] = kinds[kind];
        if (kind == CHOSEN) {
            gb_text_fit_copy(entry[entries].name, GB_PLOT_NAME, chart->name);
        }
        entries++;
    }
    gb_plot_legend(plot, entry, entries);
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
        gb_plot_text(plot, plot->rows / 2, 2, GB_PLOT_INK_TEXT,
                     "the chart has no finished row yet");
        return;
    }
    plot->log_x = true;
    y_ends[0] /= below;
    gb_plot_axes(plot, x_ends, y_ends, GB_PLOT_LOG, "CPU time per cell, s",
                 "density error bound");
    size_t row = 0;
    if (gb_panel_plot_settings_at(panel, session, &row)) { /* below points and legend */
        gb_plot_cursor(plot, chart->seconds[row], chart->error[row]);
    }
    draw_settings(plot, chart);
}
