#include "study/chart/chart_text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/number.h"

enum { DESCRIPTION = 160 };

static void add_pressure_heads(GString *text, const struct gb_chart_plan *plan)
{
    for (int k = 0; k < plan->pressures; k++) {
        char head[32];
        snprintf(head, sizeof head, "at %.4g MPa", plan->pressure_pa[k] / 1e6);
        g_string_append_printf(text, "  %-16s", head);
    }
    g_string_append_c(text, '\n');
}

/* Properties of a row, one letter each. */
static void add_marks(GString *text, const struct gb_chart_table *table, size_t i)
{
    const struct gb_chart_row *row = &table->row[i];
    g_string_append_printf(text, "%c%c%c%c ",
                           i == 0   ? 'R'
                           : i == 1 ? 'P'
                                    : ' ',
                           row->pareto ? 'F' : ' ', row->noise_limited ? 'n' : ' ',
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
        char setting[DESCRIPTION];
        add_marks(text, table, i);
        g_string_append_printf(text, "%7.3g  %11.4g  %5d", row->cpu_s, row->evaluations,
                               row->seeds);
        add_errors(text, row, plan->pressures, i == 0);
        g_string_append_printf(text, "  %s\n",
                               gb_chart_describe(&row->setting, setting, sizeof setting));
    }
    g_string_append(
        text, "R reference, P the preset's own, F Pareto-optimal in cost and error,\n"
              "n limited by noise (no error above two standard errors), "
              "* recommended;\n"
              "CPU s and evaluations of one cell\n");
}

static void add_recommended(GString *text, const struct gb_chart_table *table,
                            const struct gb_chart_plan *plan)
{
    char setting[DESCRIPTION], scatter[GB_NUMBER_MAX];
    g_string_append(text, "\nscatter of one cell:");
    for (int k = 0; k < plan->pressures; k++) {
        g_string_append_printf(text, " %s at %.4g MPa%s",
                               gb_number_shown("%.4f", table->scatter[k], scatter),
                               plan->pressure_pa[k] / 1e6,
                               k + 1 < plan->pressures ? "," : "\n");
    }
    const struct gb_chart_row *chosen = gb_chart_table_chosen(table);
    if (chosen) {
        g_string_append_printf(
            text, "cheapest setting with a smaller error: %s (%.3g CPU s)\n",
            gb_chart_describe(&chosen->setting, setting, sizeof setting), chosen->cpu_s);
    } else {
        g_string_append(
            text, "no setting is known to have a smaller error; more seeds reduce the "
                  "uncertainty\n");
    }
}

static void add_advice(GString *text, const struct gb_chart_advice *advice, int pressures)
{
    if (advice->sizes == 0) {
        return;
    }
    g_string_append_printf(text,
                           "\na standard error of %.4g in density needs\n"
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
            size->large_enough ? "" : "  too small: g(L/2) is not 1");
    }
}

GString *gb_chart_text_table(const struct gb_chart_table *table,
                             const struct gb_chart_plan *plan)
{
    GString *text = g_string_new(NULL);
    add_table(text, table, plan);
    return text;
}

GString *gb_chart_text_results(const struct gb_chart_table *table,
                               const struct gb_chart_plan *plan,
                               const struct gb_chart_advice *advice)
{
    GString *text = g_string_new(NULL);
    add_recommended(text, table, plan);
    add_advice(text, advice, plan->pressures);
    return text;
}
