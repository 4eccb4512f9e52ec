#include "tui/session/overlay/chart_csv.h"

#include <glib.h>
#include <math.h>
#include <stdio.h>

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

static bool fill(struct gb_chart_csv *chart, const struct gb_table *table,
                 struct gb_error *err)
{
    enum { SECONDS, ERROR, FRONT, CHOSEN, COLUMNS };
    static const char *const names[COLUMNS] = {"cpu_s", "bound", "front", "chosen"};
    const double *column[COLUMNS];
    const double *noise = gb_table_column(table, "noise_limited", NULL);
    const size_t rows = gb_table_rows(table);
    if (!find_columns(table, names, column, COLUMNS, err)) {
        return false;
    }
    chart->seconds = gb_alloc_array(rows + 1, sizeof(double), err);
    chart->error = gb_alloc_array(rows + 1, sizeof(double), err);
    chart->front = gb_alloc_array(rows + 1, sizeof(bool), err);
    chart->noise = gb_alloc_array(rows + 1, sizeof(bool), err);
    if (chart->seconds == NULL || chart->error == NULL || chart->front == NULL ||
        chart->noise == NULL) {
        return false;
    }
    chart->count = rows;
    chart->chosen = rows;
    for (size_t i = 0; i < rows; i++) {
        chart->seconds[i] = column[SECONDS][i];
        chart->error[i] = column[ERROR][i];
        chart->front[i] = column[FRONT][i] > 0.0;
        chart->noise[i] = noise != NULL && noise[i] > 0.0;
        if (column[CHOSEN][i] > 0.0) {
            chart->chosen = i;
            write_name(chart, table, i);
        }
    }
    return true;
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
        gb_alloc_free(chart->seconds);
        gb_alloc_free(chart->error);
        gb_alloc_free(chart->front);
        gb_alloc_free(chart->noise);
        gb_alloc_free(chart);
    }
}
