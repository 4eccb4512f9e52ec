#include "figures/chart/chart_columns.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

bool gb_chart_columns_find(const struct gb_chart_columns *chart,
                           const struct gb_chart_columns_request *request, size_t count,
                           struct gb_error *err)
{
    bool good = true;
    for (size_t k = 0; k < count && good; k++) {
        *request[k].column = gb_table_column(chart->table, request[k].name, err);
        good = *request[k].column != NULL;
    }
    return good;
}

bool gb_chart_columns_read(struct gb_chart_columns *chart,
                           const struct gb_figures_input *input, struct gb_error *err)
{
    const char *source = input->words[0];
    if (source == NULL || input->words[1] != NULL) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "figures of a chart take one directory of `greenbody chart`");
    }
    char *path = g_file_test(source, G_FILE_TEST_IS_DIR)
                     ? g_build_filename(source, "chart.csv", NULL)
                     : g_strdup(source);
    const bool good = gb_table_read(&chart->table, path, "relaxer", err);
    g_free(path);
    const struct gb_chart_columns_request request[] = {{"particles", &chart->particles}};
    return good && gb_chart_columns_find(chart, request, G_N_ELEMENTS(request), err);
}

bool gb_chart_columns_same_kind(const struct gb_chart_columns *chart, size_t a, size_t b)
{
    return chart->particles[a] == chart->particles[b] &&
           strcmp(gb_table_word(chart->table, a), gb_table_word(chart->table, b)) == 0;
}

void gb_chart_columns_name(const struct gb_chart_columns *chart, size_t row,
                           char label[GB_CHART_COLUMNS_NAME])
{
    snprintf(label, GB_CHART_COLUMNS_NAME, "%.40s, <i>N</i> = %g",
             gb_table_word(chart->table, row), chart->particles[row]);
}

void gb_chart_columns_each(struct gb_series *series, const struct gb_chart_columns *chart,
                           gb_chart_columns_draw *draw)
{
    int style = 0;
    for (size_t i = 0; i < gb_table_rows(chart->table); i++) {
        bool seen = false;
        for (size_t k = 0; k < i && !seen; k++) {
            seen = gb_chart_columns_same_kind(chart, k, i);
        }
        if (!seen) {
            draw(series, chart, i, style++);
        }
    }
}
