#include "cli/chart_page.h"

#include <langinfo.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "solve/relax.h"
#include "tui/plot/plot.h"

enum { DESCRIPTION = 160, ROWS = 18, COLUMNS = 78 };

static void add_pressure_heads(GString *text, const struct gb_chart_plan *plan)
{
    for (int k = 0; k < plan->pressures; k++) {
        char head[32];
        snprintf(head, sizeof head, "at %.4g MPa", plan->pressure_pa[k] / 1e6);
        g_string_append_printf(text, "  %-16s", head);
    }
    g_string_append_c(text, '\n');
}

/* What is special about a row, one letter each. */
static void add_marks(GString *text, const struct gb_chart_table *table, size_t i)
{
    const struct gb_chart_row *row = &table->row[i];
    g_string_append_printf(text, "%c%c%c%c ",
                           i == 0   ? 'R'
                           : i == 1 ? 'P'
                                    : ' ',
                           row->front ? 'F' : ' ', row->noise_limited ? 'n' : ' ',
                           row->chosen ? '*' : ' ');
}

static void add_errors(GString *text, const struct gb_chart_row *row, int pressures,
                       bool reference)
{
    for (int k = 0; k < pressures; k++) {
        char cell[48] = "";
        if (reference && isfinite(row->density[k])) {
            snprintf(cell, sizeof cell, "density %.4f", row->density[k]);
        } else if (row->failed > 0) {
            snprintf(cell, sizeof cell, "%d of %d failed", row->failed, row->seeds);
        } else if (isfinite(row->error[k]) && isfinite(row->error_se[k])) {
            snprintf(cell, sizeof cell, "%+.4f ± %.4f", row->error[k], row->error_se[k]);
        } else if (row->seeds < 2) {
            snprintf(cell, sizeof cell, "needs 2 seeds");
        } else {
            snprintf(cell, sizeof cell, "not reached");
        }
        const int wide = (int)(strlen(cell) - (size_t)g_utf8_strlen(cell, -1));
        g_string_append_printf(text, "  %-*s", 16 + wide, cell);
    }
}

static void add_table(GString *text, const struct gb_chart_table *table,
                      const struct gb_chart_plan *plan)
{
    g_string_append(text, "       CPU s  evaluations  seeds");
    add_pressure_heads(text, plan);
    for (size_t i = 0; i < table->rows; i++) {
        const struct gb_chart_row *row = &table->row[i];
        if (row->seeds == 0) {
            continue;
        }
        char choice[DESCRIPTION];
        add_marks(text, table, i);
        g_string_append_printf(text, "%7.3g  %11.4g  %5d", row->cpu_s, row->evaluations,
                               row->seeds);
        add_errors(text, row, plan->pressures, i == 0);
        g_string_append_printf(text, "  %s\n",
                               gb_chart_describe(&row->choice, choice, sizeof choice));
    }
    g_string_append(text,
                    "R reference, P the preset's own, F on the front (nothing costs less "
                    "and errs less),\nn limited by noise (no error above two standard "
                    "errors), * chosen; CPU s and evaluations of one cell\n");
}

/* Points of one relaxer (NULL: of the front, sorted by cost) for the picture. */
static size_t collect(const struct gb_chart_table *table, const char *relaxer, double *x,
                      double *y)
{
    size_t count = 0;
    for (size_t i = 1; i < table->rows; i++) {
        const struct gb_chart_row *row = &table->row[i];
        const bool wanted =
            relaxer ? strcmp(row->choice.relaxer, relaxer) == 0 : row->front;
        if (!wanted || !(row->bound > 0.0) || row->cpu_s <= 0.0 ||
            row->choice.count != table->row[0].choice.count) {
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

static double least_scatter(const struct gb_chart_table *table, int pressures)
{
    double least = INFINITY;
    for (int k = 0; k < pressures; k++) {
        least = fmin(least, table->scatter[k]);
    }
    return isfinite(table->allowed) ? table->allowed : least;
}

static void draw(struct gb_plot *plot, const struct gb_chart_table *table, double level,
                 double *x, double *y)
{
    static const char *const extra = "verlet";
    struct gb_plot_entry entry[8];
    int entries = 0;
    const size_t front = collect(table, NULL, x, y);
    gb_plot_line(plot, &(struct gb_plot_series){
                           .x = x, .y = y, .count = front, .ink = GB_PLOT_INK_SERIES});
    const double ends[2] = {plot->x.low, plot->x.high}, same[2] = {level, level};
    gb_plot_line(plot, &(struct gb_plot_series){
                           .x = ends, .y = same, .count = 2, .ink = GB_PLOT_INK_DIM});
    for (int m = 0; m < 6; m++) {
        const struct gb_relaxer *const method = gb_relax_table()[m];
        const char *name = method ? method->name : extra;
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

static void add_picture(GString *text, const struct gb_chart_table *table,
                        const struct gb_chart_plan *plan)
{
    double *x = g_new(double, 2 * table->rows), *y = x + table->rows;
    const double level = least_scatter(table, plan->pressures);
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
        gb_plot_axes(&plot, x_ends, y_ends, true, "log10 of CPU seconds",
                     "|error| + standard error");
        draw(&plot, table, level, x, y);
        char *picture = gb_plot_dump(&plot);
        g_string_append_printf(text, "\n%s", picture);
        g_string_append(text, isfinite(table->allowed)
                                  ? "level line: the error allowed\n"
                                  : "level line: scatter between seeds, at the pressure "
                                    "where it is least\n");
        g_free(picture);
    }
    gb_plot_finish(&plot);
    g_free(x);
}

static void add_choice(GString *text, const struct gb_chart_table *table,
                       const struct gb_chart_plan *plan)
{
    char choice[DESCRIPTION];
    g_string_append(text, "\nscatter of one cell:");
    for (int k = 0; k < plan->pressures; k++) {
        g_string_append_printf(text, " %.4f at %.4g MPa%s", table->scatter[k],
                               plan->pressure_pa[k] / 1e6,
                               k + 1 < plan->pressures ? "," : "\n");
    }
    const struct gb_chart_row *chosen = gb_chart_table_chosen(table);
    if (chosen) {
        g_string_append_printf(text, "cheapest choice that errs less: %s (%.3g CPU s)\n",
                               gb_chart_describe(&chosen->choice, choice, sizeof choice),
                               chosen->cpu_s);
    } else {
        g_string_append(text, "no choice is known to err less; more seeds would tell\n");
    }
}

static void add_advice(GString *text, const struct gb_chart_advice *advice, int pressures)
{
    if (advice->sizes == 0) {
        return;
    }
    g_string_append_printf(text,
                           "\na standard error of %.4g in density takes\n"
                           "particles  half edge  g(r) there, ripple  scatter  cells  "
                           "CPU s\n",
                           advice->standard_error);
    for (int i = 0; i < advice->sizes; i++) {
        const struct gb_chart_size *size = &advice->size[i];
        double scatter = NAN;
        for (int k = 0; k < pressures; k++) {
            scatter = fmax(scatter, size->scatter[k]);
        }
        g_string_append_printf(
            text, "%9lld  %7.3g d      %.3f    %.3f  %7.4f  %5.0f  %5.3g%s\n",
            (long long)size->count, size->half_edge, size->g_end, size->ripple, scatter,
            size->cells, size->cells * size->cpu_s,
            size->wide ? "" : "  too small: g(L/2) is not 1");
    }
}

GString *gb_chart_page(const struct gb_chart_table *table,
                       const struct gb_chart_plan *plan,
                       const struct gb_chart_advice *advice)
{
    GString *text = g_string_new(NULL);
    add_table(text, table, plan);
    add_picture(text, table, plan);
    add_choice(text, table, plan);
    add_advice(text, advice, plan->pressures);
    return text;
}
