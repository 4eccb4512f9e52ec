#include "cli/figures_chart.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/table.h"

/* What the figure needs of chart.csv. */
struct chart {
    struct gb_table *table;
    const double *particles, *bound, *cost, *front, *chosen;
};

static bool read_chart(struct chart *chart, const char *place, struct gb_error *err)
{
    const struct {
        const char *name;
        const double **column;
    } columns[] = {{"particles", &chart->particles},
                   {"bound", &chart->bound},
                   {"cpu_s", &chart->cost},
                   {"front", &chart->front},
                   {"chosen", &chart->chosen}};
    char *path = g_file_test(place, G_FILE_TEST_IS_DIR)
                     ? g_build_filename(place, "chart.csv", NULL)
                     : g_strdup(place);
    bool good = gb_table_read(&chart->table, path, "relaxer", err);
    for (size_t k = 0; k < G_N_ELEMENTS(columns) && good; k++) {
        *columns[k].column = gb_table_column(chart->table, columns[k].name, err);
        good = *columns[k].column != NULL;
    }
    g_free(path);
    return good;
}

/* Whether row k is of the same relaxer and cell as row i. */
static bool is_kind(const struct chart *chart, size_t i, size_t k)
{
    return chart->particles[i] == chart->particles[k] &&
           strcmp(gb_table_word(chart->table, i), gb_table_word(chart->table, k)) == 0;
}

/* Rows of one relaxer and cell as points. */
static void draw_kind(struct gb_series *series, const struct chart *chart, size_t first,
                      int style)
{
    char label[80];
    double *cost = gb_series_column(series, "cpu_%d_s", style + 1);
    double *bound = gb_series_column(series, "bound_%d", style + 1);
    size_t filled = 0;
    for (size_t k = first; k < gb_table_rows(chart->table); k++) {
        if (is_kind(chart, first, k) && isfinite(chart->bound[k])) {
            cost[filled] = chart->cost[k];
            bound[filled++] = 100.0 * chart->bound[k];
        }
    }
    snprintf(label, sizeof label, "%.40s, <i>N</i> = %g",
             gb_table_word(chart->table, first), chart->particles[first]);
    if (filled > 0) {
        gb_series_draw(series, cost, bound, NULL, GB_FIGURE_POINTS, style, label);
    }
}

/* Choices that nothing beats, by rising cost. */
static void draw_front(struct gb_series *series, const struct chart *chart)
{
    double *cost = gb_series_column(series, "front_cpu_s");
    double *bound = gb_series_column(series, "front_bound");
    size_t filled = 0;
    for (size_t k = 0; k < gb_table_rows(chart->table); k++) {
        if (chart->front[k] != 1.0 || !isfinite(chart->bound[k])) {
            continue;
        }
        size_t at = filled++;
        while (at > 0 && cost[at - 1] > chart->cost[k]) {
            cost[at] = cost[at - 1];
            bound[at] = bound[at - 1];
            at--;
        }
        cost[at] = chart->cost[k];
        bound[at] = 100.0 * chart->bound[k];
    }
    gb_series_draw(series, cost, bound, NULL, GB_FIGURE_FAINT, 3, NULL);
}

static void draw_chosen(struct gb_series *series, const struct chart *chart)
{
    double *cost = gb_series_column(series, "chosen_cpu_s");
    double *bound = gb_series_column(series, "chosen_bound");
    for (size_t k = 0; k < gb_table_rows(chart->table); k++) {
        if (chart->chosen[k] == 1.0 && isfinite(chart->bound[k])) {
            cost[0] = chart->cost[k];
            bound[0] = 100.0 * chart->bound[k];
            gb_series_draw(series, cost, bound, NULL, GB_FIGURE_POINTS, 6, "chosen")
                ->open = true;
            return;
        }
    }
}

static void fill(struct gb_series *series, const struct chart *chart)
{
    int style = 0;
    gb_series_axes(series, "cpu_s", "processor time of one cell (s)", "bound_points",
                   "error of the density (points)");
    series->x.log = series->y.log = true;
    draw_front(series, chart);
    for (size_t i = 0; i < series->rows; i++) {
        bool seen = false;
        for (size_t k = 0; k < i && !seen; k++) {
            seen = is_kind(chart, k, i);
        }
        if (!seen) {
            draw_kind(series, chart, i, style++);
        }
    }
    draw_chosen(series, chart);
    gb_series_say(series, "Largest |error| and standard error over the pressures. Thin "
                          "line: nothing costs less and errs less.");
}

bool gb_figures_chart(struct gb_series *series, const struct gb_figures_input *input,
                      struct gb_error *err)
{
    struct chart chart = {0};
    if (input->words[0] == NULL || input->words[1] != NULL) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "the figure chart takes one directory of `greenbody chart`");
    }
    const bool good = read_chart(&chart, input->words[0], err);
    if (good) {
        gb_series_init(series, gb_table_rows(chart.table));
        fill(series, &chart);
    }
    gb_table_destroy(chart.table);
    return good;
}
