#include "figures/figures_compute.h"

#include <math.h>

#include "figures/chart/chart_columns.h"

/* Settings of one relaxer and particle number. */
static void draw_points(struct gb_series *series, const struct gb_chart_columns *chart,
                        size_t first, int style)
{
    char label[GB_CHART_COLUMNS_NAME];
    double *cost = gb_series_column(series, "cpu_%d_s", style + 1);
    double *bound = gb_series_column(series, "bound_%d", style + 1);
    size_t filled = 0;
    for (size_t k = first; k < gb_table_rows(chart->table); k++) {
        if (gb_chart_columns_same_kind(chart, first, k) && isfinite(chart->bound[k])) {
            cost[filled] = chart->cpu_s[k];
            bound[filled++] = 100.0 * chart->bound[k];
        }
    }
    if (filled > 0) {
        gb_chart_columns_name(chart, first, label);
        gb_series_draw(series, cost, bound, NULL, GB_FIGURE_POINTS, style, label);
    }
}

/* Pareto-optimal settings in the order of their cost. */
static void draw_front(struct gb_series *series, const struct gb_chart_columns *chart)
{
    double *cost = gb_series_column(series, "front_cpu_s");
    double *bound = gb_series_column(series, "front_bound");
    size_t filled = 0;
    for (size_t k = 0; k < gb_table_rows(chart->table); k++) {
        if (chart->front[k] != 1.0 || !isfinite(chart->bound[k])) {
            continue;
        }
        size_t at = filled++;
        while (at > 0 && cost[at - 1] > chart->cpu_s[k]) {
            cost[at] = cost[at - 1];
            bound[at] = bound[at - 1];
            at--;
        }
        cost[at] = chart->cpu_s[k];
        bound[at] = 100.0 * chart->bound[k];
    }
    gb_series_draw(series, cost, bound, NULL, GB_FIGURE_FAINT,
                   gb_figure_black(0), NULL);
}

static void draw_chosen(struct gb_series *series, const struct gb_chart_columns *chart)
{
    double *cost = gb_series_column(series, "chosen_cpu_s");
    double *bound = gb_series_column(series, "chosen_bound");
    for (size_t k = 0; k < gb_table_rows(chart->table); k++) {
        if (chart->chosen[k] == 1.0 && isfinite(chart->bound[k])) {
            cost[0] = chart->cpu_s[k];
            bound[0] = 100.0 * chart->bound[k];
            gb_series_draw(series, cost, bound, NULL, GB_FIGURE_POINTS,
                           gb_figure_black(5), "chosen setting")
                ->open = true;
            return;
        }
    }
}

static void fill(struct gb_series *series, const struct gb_chart_columns *chart)
{
    draw_front(series, chart);
    gb_chart_columns_each(series, chart, draw_points);
    draw_chosen(series, chart);
    gb_series_caption(series,
                      "Maximum over the pressures of |error| + standard error. Thin "
                      "line: Pareto-optimal settings.");
}

/* Bound of the density error against the processor time of one cell. */
bool gb_figures_chart(struct gb_series *series, const struct gb_figures_input *input,
                      struct gb_error *err)
{
    struct gb_chart_columns chart = {0};
    const struct gb_chart_columns_request request[] = {{"bound", &chart.bound},
                                                       {"cpu_s", &chart.cpu_s},
                                                       {"front", &chart.front},
                                                       {"chosen", &chart.chosen}};
    const bool good = gb_chart_columns_read(&chart, input, err) &&
                      gb_chart_columns_find(&chart, request, G_N_ELEMENTS(request), err);
    if (good) {
        gb_series_init(series, gb_table_rows(chart.table));
        fill(series, &chart);
    }
    gb_table_destroy(chart.table);
    return good;
}
