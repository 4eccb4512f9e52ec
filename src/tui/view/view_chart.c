#include <glib.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "tui/term/paint.h"
#include "tui/view/views.h"

/* Longest stable step of each method over the step that it uses, against the pressure
 * of the state.  Below 1 a disturbance grows. */

enum { METHODS_MOST = 4 };

/* Factor of room on both sides of the data. */
static const double room = 1.5;

/* The first rows of different methods; returns their number. */
static int find_methods(const struct gb_stability_csv *table, size_t first[METHODS_MOST])
{
    int count = 0;
    for (size_t i = 0; i < table->count && count < METHODS_MOST; i++) {
        int k = 0;
        while (k < count &&
               strcmp(table->row[first[k]].method, table->row[i].method) != 0) {
            k++;
        }
        if (k == count) {
            first[count++] = i;
        }
    }
    return count;
}

/* Copies the points of a method to the panel's arrays; returns their number. */
static size_t collect(struct gb_panel_plot *panel, const struct gb_stability_csv *table,
                      const char *method)
{
    size_t count = 0;
    for (size_t i = 0; i < table->count; i++) {
        if (strcmp(table->row[i].method, method) == 0) {
            panel->x[count] = table->p_mpa[i];
            panel->y[count++] = table->margin[i];
        }
    }
    return count;
}

static void draw_methods(struct gb_panel_plot *panel,
                         const struct gb_stability_csv *table)
{
    struct gb_plot_entry entry[METHODS_MOST];
    size_t first[METHODS_MOST];
    const int methods = find_methods(table, first);
    for (int k = 0; k < methods; k++) {
        const struct gb_stability_csv_row *row = &table->row[first[k]];
        entry[k] = (struct gb_plot_entry){.ink = GB_PLOT_INK_SERIES + k, .marker = k + 1};
        snprintf(entry[k].name, sizeof entry[k].name, "%s%s", row->method,
                 row->in_use ? ", in use" : "");
        gb_plot_line(&panel->plot,
                     &(struct gb_plot_series){.x = panel->x,
                                              .y = panel->y,
                                              .count = collect(panel, table, row->method),
                                              .ink = entry[k].ink,
                                              .marker = entry[k].marker,
                                              .spacing = 1});
    }
    gb_plot_legend(&panel->plot, entry, methods);
}

static void view_stability_extend(double ends[2], double value)
{
    ends[0] = fmin(ends[0], value / room);
    ends[1] = fmax(ends[1], value * room);
}

void gb_view_chart_stability(struct gb_panel_plot *panel,
                             const struct gb_session *session)
{
    struct gb_plot *plot = &panel->plot;
    const struct gb_stability_csv *table = session->stability;
    double x_ends[2] = {HUGE_VAL, 0.0}, y_ends[2] = {1.0 / room, room};
    if (!gb_panel_plot_reserve(panel, table->count)) {
        return;
    }
    for (size_t i = 0; i < table->count; i++) {
        if (table->p_mpa[i] > 0.0 && table->margin[i] > 0.0) {
            view_stability_extend(x_ends, table->p_mpa[i]);
            view_stability_extend(y_ends, table->margin[i]);
        }
    }
    if (!(x_ends[1] > 0.0)) {
        gb_plot_text(plot, plot->rows / 2, 2, GB_PLOT_INK_TEXT,
                     "no state is measured yet");
        return;
    }
    plot->log_x = true;
    gb_plot_axes(plot, x_ends, y_ends, GB_PLOT_LOG, "p, MPa", "stable step / step taken");
    const double limit[2] = {1.0, 1.0};
    gb_plot_line(plot, &(struct gb_plot_series){
                           .x = x_ends, .y = limit, .count = 2, .ink = GB_PLOT_INK_DIM});
    size_t row = 0;
    if (gb_panel_plot_settings_at(panel, session, &row)) {
        gb_plot_cursor(plot, table->p_mpa[row], table->margin[row]);
    }
    draw_methods(panel, table);
}

/* Kinds of settings in drawing order. */
enum kind { NOISE, SETTING, FRONT, CHOSEN, KINDS };

static const struct gb_plot_entry kinds[KINDS] = {
    [NOISE] = {GB_PLOT_INK_DIM, 8, "error within its noise"},
    [SETTING] = {GB_PLOT_INK_SERIES, 2, "setting"},
    [FRONT] = {GB_PLOT_INK_SERIES + 1, 1, "Pareto-optimal"},
    [CHOSEN] = {GB_PLOT_INK_SERIES + 4, 3, ""}, /* its name */
};

/* Factor of room below the points for the name of the axis. */
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

/* Draws settings and their legend. */
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
            gb_paint_fit_copy(entry[entries].name, GB_PLOT_NAME, chart->name);
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
