#include "tui/session/overlay/chart_csv.h"

#include <glib.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/alloc.h"
#include "base/table.h"

/* A column; NULL if missing, err has the name. */
static bool find_columns(const struct gb_table *table, const char *const *names,
                         const double **column, size_t count, struct gb_error *err)
{
    for (size_t i = 0; i < count; i++) {
        column[i] = gb_table_column(table, names[i], err);
        if (column[i] == NULL) {
            return false;
        }
    }
    return true;
}

static void write_name(struct gb_chart_csv *chart, const struct gb_table *table,
                       size_t row)
{
    const double *step = gb_table_column(table, "step", NULL);
    const double *tolerance = gb_table_column(table, "tolerance", NULL);
    snprintf(chart->name, sizeof chart->name, "%.24s, step %.3g %%, tolerance %.3g",
             gb_table_word(table, row), step != NULL ? 100.0 * step[row] : (double)NAN,
             tolerance != NULL ? tolerance[row] : (double)NAN);
}

static double value_at(const struct gb_table *table, const char *name, size_t row)
{
    const double *column = gb_table_column(table, name, NULL);
    return column != NULL ? column[row] : (double)NAN;
}

static struct gb_chart_setting setting_of(const struct gb_table *table, size_t row)
{
    const double particles = value_at(table, "particles", row);
    struct gb_chart_setting setting = {
        .count = particles >= 1.0 && particles < 1e12 ? (int64_t)particles : 0,
        .strain_step = value_at(table, "step", row),
        .tolerance = value_at(table, "tolerance", row),
        .cutoff = value_at(table, "cutoff_d", row),
        .single = value_at(table, "bits", row) == 32.0,
        .time_step = value_at(table, "time_step_T", row),
        .step_error = value_at(table, "step_error", row),
    };
    g_strlcpy(setting.relaxer, setting.count > 0 ? gb_table_word(table, row) : "",
              sizeof setting.relaxer);
    return setting;
}

static bool allocate(struct gb_chart_csv *chart, size_t rows, struct gb_error *err)
{
    chart->setting = gb_alloc_array(rows + 1, sizeof *chart->setting, err);
    chart->seconds = gb_alloc_array(rows + 1, sizeof(double), err);
    chart->error = gb_alloc_array(rows + 1, sizeof(double), err);
    chart->front = gb_alloc_array(rows + 1, sizeof(bool), err);
    chart->noise = gb_alloc_array(rows + 1, sizeof(bool), err);
    chart->by_cost = gb_alloc_array(rows + 1, sizeof(size_t), err);
    return chart->setting != NULL && chart->seconds != NULL && chart->error != NULL &&
           chart->front != NULL && chart->noise != NULL && chart->by_cost != NULL;
}

bool gb_chart_csv_is_known(const struct gb_chart_csv *chart, size_t i)
{
    return chart->error[i] > 0.0 && chart->seconds[i] > 0.0;
}

static void sort_by_cost(struct gb_chart_csv *chart)
{
    for (size_t i = 0; i < chart->count; i++) {
        if (!gb_chart_csv_is_known(chart, i)) {
            continue;
        }
        size_t at = chart->known++;
        while (at > 0 && chart->seconds[chart->by_cost[at - 1]] > chart->seconds[i]) {
            chart->by_cost[at] = chart->by_cost[at - 1];
            at--;
        }
        chart->by_cost[at] = i;
    }
}

static bool fill(struct gb_chart_csv *chart, const struct gb_table *table,
                 struct gb_error *err)
{
    enum { SECONDS, ERROR, FRONT, CHOSEN, COLUMNS };
    static const char *const names[COLUMNS] = {"cpu_s", "bound", "front", "chosen"};
    const double *column[COLUMNS];
    const size_t rows = gb_table_rows(table);
    if (!find_columns(table, names, column, COLUMNS, err) ||
        !allocate(chart, rows, err)) {
        return false;
    }
    chart->count = rows;
    chart->chosen = rows;
    chart->reference_s = NAN;
    for (size_t i = 0; i < rows; i++) {
        chart->setting[i] = setting_of(table, i);
        chart->seconds[i] = column[SECONDS][i];
        chart->error[i] = column[ERROR][i];
        chart->front[i] = column[FRONT][i] > 0.0;
        chart->noise[i] = value_at(table, "noise_limited", i) > 0.0;
        if (value_at(table, "reference", i) > 0.0) {
            chart->reference_s = chart->seconds[i];
        }
        if (column[CHOSEN][i] > 0.0) {
            chart->chosen = i;
            write_name(chart, table, i);
        }
    }
    sort_by_cost(chart);
    return true;
}

void gb_chart_csv_apply(const struct gb_chart_csv *chart, size_t i,
                        struct gb_params *params)
{
    struct gb_chart_setting setting = chart->setting[i];
    if (setting.count == chart->setting[0].count) {
        setting.count = params->count;
    }
    gb_chart_apply(params, &setting);
}

bool gb_chart_csv_read(struct gb_chart_csv **out, const char *path, struct gb_error *err)
{
    struct gb_table *table = NULL;
    if (!gb_table_read(&table, path, "relaxer", err)) {
        return false;
    }
    struct gb_chart_csv *chart = gb_alloc_array(1, sizeof *chart, err);
    const bool good = chart != NULL && fill(chart, table, err);
    gb_table_destroy(table);
    if (!good) {
        gb_chart_csv_destroy(chart);
        return false;
    }
    *out = chart;
    return true;
}

void gb_chart_csv_destroy(struct gb_chart_csv *chart)
{
    if (chart != NULL) {
        gb_alloc_free(chart->setting);
        gb_alloc_free(chart->by_cost);
        gb_alloc_free(chart->seconds);
        gb_alloc_free(chart->error);
        gb_alloc_free(chart->front);
        gb_alloc_free(chart->noise);
        gb_alloc_free(chart);
    }
}
