#include <math.h>
#include <stdio.h>
#include <string.h>

#include "tui/view/views.h"

/* Longest stable step of each method over the step that it takes, against the pressure of
 * the state; below 1 a disturbance grows. */

enum { METHODS_MOST = 4 };

/* Room on both sides of what is drawn, a factor. */
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

/* Points of a method into the panel's arrays; returns their number. */
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
        entry[k] =
            (struct gb_plot_entry){.ink = GB_PLOT_INK_SERIES + k, .marker = k + 1};
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

static void extend(double ends[2], double value)
{
    ends[0] = fmin(ends[0], value / room);
    ends[1] = fmax(ends[1], value * room);
}

void gb_view_stability_draw(struct gb_panel_plot *panel, const struct gb_session *session)
{
    struct gb_plot *plot = &panel->plot;
    const struct gb_stability_csv *table = session->stability;
    double x_ends[2] = {HUGE_VAL, 0.0}, y_ends[2] = {1.0 / room, room};
    if (!gb_panel_plot_reserve(panel, table->count)) {
        return;
    }
    for (size_t i = 0; i < table->count; i++) {
        if (table->p_mpa[i] > 0.0 && table->margin[i] > 0.0) {
            extend(x_ends, table->p_mpa[i]);
            extend(y_ends, table->margin[i]);
        }
    }
    if (!(x_ends[1] > 0.0)) {
        gb_plot_text(plot, plot->rows / 2, 2, GB_PLOT_INK_TEXT,
                     "no state is measured yet");
        return;
    }
    plot->log_x = true;
    gb_plot_axes(plot, x_ends, y_ends, GB_PLOT_LOG, "p, MPa",
                 "stable step / step taken");
    const double limit[2] = {1.0, 1.0};
    gb_plot_line(plot, &(struct gb_plot_series){
                           .x = x_ends, .y = limit, .count = 2, .ink = GB_PLOT_INK_DIM});
    size_t row = 0;
    if (gb_panel_plot_settings_at(panel, session, &row)) {
        gb_plot_cursor(plot, table->p_mpa[row], table->margin[row]);
    }
    draw_methods(panel, table);
}
