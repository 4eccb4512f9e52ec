#include "cli/chart_plot.h"

#include <langinfo.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "solve/relax/relax.h"
#include "tui/plot/plot.h"

enum { ROWS = 18, COLUMNS = 78 };

/* Points (log10 of cost, error) of one relaxer, or, for NULL, of the Pareto front, sorted
 * by cost.  Returns their number. */
static size_t collect(const struct gb_chart_table *table, const char *relaxer, double *x,
                      double *y)
{
    size_t count = 0;
    for (size_t i = 1; i < table->rows; i++) {
        const struct gb_chart_row *row = &table->row[i];
        const bool shown =
            relaxer ? strcmp(row->setting.relaxer, relaxer) == 0 : row->pareto;
        if (!shown || !(row->bound > 0.0) || row->cpu_s <= 0.0 ||
            row->setting.count != table->row[0].setting.count) {
            continue;
        }
        size_t at = count++;
        for (; at > 0 && x[at - 1] > log10(row->cpu_s); at--) {
            x[at] = x[at - 1];
            y[at] = y[at - 1];
        }
        x[at] = log10(row->cpu_s);
        y[at] = row->bound;
    }
    return count;
}

static double smallest_scatter(const struct gb_chart_table *table, int pressures)
{
    double smallest = INFINITY;
    for (int k = 0; k < pressures; k++) {
        smallest = fmin(smallest, table->scatter[k]);
    }
    return isfinite(table->allowed) ? table->allowed : smallest;
}

static void draw(struct gb_plot *plot, const struct gb_chart_table *table, double level,
                 double *x, double *y)
{
    static const char *const dynamic = "verlet"; /* no relaxer */
    struct gb_plot_entry entry[8];
    int entries = 0;
    const size_t pareto = collect(table, NULL, x, y);
    gb_plot_line(plot, &(struct gb_plot_series){
                           .x = x, .y = y, .count = pareto, .ink = GB_PLOT_INK_SERIES});
    const double ends[2] = {plot->x.low, plot->x.high}, same[2] = {level, level};
    gb_plot_line(plot, &(struct gb_plot_series){
                           .x = ends, .y = same, .count = 2, .ink = GB_PLOT_INK_DIM});
    for (int m = 0; m < 6; m++) {
        const struct gb_relaxer *const method = gb_relax_table()[m];
        const char *name = method ? method->name : dynamic;
        const size_t count = collect(table, name, x, y);
        gb_plot_line(plot, &(struct gb_plot_series){.x = x,
                                                    .y = y,
                                                    .count = count,
                                                    .ink = GB_PLOT_INK_SERIES + m,
                                                    .marker = m + 1,
                                                    .spacing = 1,
                                                    .points = true});
        if (count > 0) {
            entry[entries] = (struct gb_plot_entry){GB_PLOT_INK_SERIES + m, m + 1, ""};
            snprintf(entry[entries++].name, GB_PLOT_NAME, "%s", name);
        }
        if (!method) {
            break;
        }
    }
    gb_plot_legend(plot, entry, entries);
}

GString *gb_chart_plot(const struct gb_chart_table *table,
                       const struct gb_chart_plan *plan)
{
    GString *text = g_string_new(NULL);
    double *x = g_new(double, 2 * table->rows), *y = x + table->rows;
    const double level = smallest_scatter(table, plan->pressures);
    double x_ends[2] = {INFINITY, -INFINITY}, y_ends[2] = {level, level};
    size_t count = 0;
    for (size_t i = 1; i < table->rows; i++) {
        const struct gb_chart_row *row = &table->row[i];
        if (row->bound > 0.0 && row->cpu_s > 0.0) {
            x_ends[0] = fmin(x_ends[0], log10(row->cpu_s));
            x_ends[1] = fmax(x_ends[1], log10(row->cpu_s));
            y_ends[0] = fmin(y_ends[0], row->bound);
            y_ends[1] = fmax(y_ends[1], row->bound);
            count++;
        }
    }
    struct gb_plot plot;
    gb_plot_init(&plot);
    const bool unicode = strcmp(nl_langinfo(CODESET), "UTF-8") == 0;
    if (count > 1 && isfinite(level) &&
        gb_plot_resize(&plot, ROWS, COLUMNS, unicode ? GB_PLOT_BRAILLE : GB_PLOT_ASCII,
                       NULL)) {
        gb_plot_axes(&plot, x_ends, y_ends, GB_PLOT_LOG, "log10 of CPU seconds",
                     "|error| + standard error");
        draw(&plot, table, level, x, y);
        char *dump = gb_plot_dump(&plot);
        g_string_append_printf(text, "\n%s", dump);
        g_string_append(text,
                        isfinite(table->allowed)
                            ? "horizontal line: error limit\n"
                            : "horizontal line: scatter between seeds, the smallest of "
                              "all pressures\n");
        g_free(dump);
    }
    gb_plot_finish(&plot);
    g_free(x);
    return text;
}
