#include "figures/figures_compute.h"

#include <math.h>

#include "base/table.h"

/* Columns of the NAME.csv of `greenbody chart --quantity NAME`. */
struct columns {
    const double *reference, *standard, *cost, *value, *error, *error_95, *half_interval,
        *chosen;
};

static bool find(struct columns *columns, const struct gb_table *table,
                 struct gb_error *err)
{
    const struct {
        const char *name;
        const double **column;
    } wanted[] = {
        {"reference", &columns->reference}, {"default", &columns->standard},
        {"cost", &columns->cost},           {"value", &columns->value},
        {"error", &columns->error},         {"error_95", &columns->error_95},
        {"chosen", &columns->chosen},       {"half_interval", &columns->half_interval},
    };
    for (size_t k = 0; k < G_N_ELEMENTS(wanted); k++) {
        *wanted[k].column = gb_table_column(table, wanted[k].name, err);
        if (*wanted[k].column == NULL) {
            return false;
        }
    }
    return true;
}

/* Settings of which `which` (NULL: any) is 1. */
static void draw(struct gb_series *series, const struct columns *c, size_t rows,
                 const double *which, int style, const char *name, const char *label)
{
    double *cost = gb_series_column(series, "%scost", name);
    double *error = gb_series_column(series, "%serror_points", name);
    double *error_95 = gb_series_column(series, "%serror_95_points", name);
    size_t filled = 0;
    for (size_t k = 0; k < rows; k++) {
        if (isfinite(c->error_95[k]) && (which == NULL || which[k] == 1.0)) {
            const double percent = 100.0 / fabs(c->value[k] - c->error[k]);
            cost[filled] = c->cost[k];
            error[filled] = percent * c->error[k];
            error_95[filled++] = percent * c->error_95[k];
        }
    }
    if (filled > 0) {
        gb_series_draw(series, cost, error, error_95, GB_FIGURE_POINTS, style, label)
            ->open = which != NULL;
    }
}

/* Half of the study's interval, as a band around 0 over all costs. */
static void draw_interval(struct gb_series *series, const struct columns *c, size_t rows)
{
    double *cost = gb_series_column(series, "interval_cost");
    double *zero = gb_series_column(series, "interval_middle");
    double *half = gb_series_column(series, "interval_points");
    double ends[2] = {INFINITY, -INFINITY}, value = NAN;
    for (size_t k = 0; k < rows; k++) {
        value = c->reference[k] == 1.0 ? c->value[k] : value;
        ends[0] = fmin(ends[0], c->cost[k]);
        ends[1] = fmax(ends[1], c->cost[k]);
    }
    if (rows < 2 || !isfinite(c->half_interval[0]) || !(ends[1] > ends[0])) {
        return;
    }
    for (int end = 0; end < 2; end++) {
        cost[end] = ends[end];
        zero[end] = 0.0;
        half[end] = 100.0 * c->half_interval[0] / fabs(value);
    }
    gb_series_draw(series, cost, zero, half, GB_FIGURE_FAINT, gb_figure_black(0), NULL);
    gb_series_caption(series, "Band: 95 %% interval that the study reports, %.2g %%.",
                      half[0]);
}

/* Deviation of a quantity from its value with the tightest numerics, against cost. */
bool gb_figures_chart_quantity(struct gb_series *series,
                               const struct gb_figures_input *input, struct gb_error *err)
{
    struct gb_table *table = NULL;
    struct columns c = {0};
    if (input->words[0] == NULL || input->words[1] != NULL) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "chart-quantity: expected one NAME.csv of `greenbody chart "
                            "--quantity NAME`");
    }
    const bool good =
        gb_table_read(&table, input->words[0], "quantity", err) && find(&c, table, err);
    if (good) {
        const size_t rows = gb_table_rows(table);
        gb_series_init(series, MAX(rows, 2));
        gb_series_caption(series,
                          "%s, against the tightest setting, cell by cell; bars: 95 %% "
                          "interval.",
                          rows > 0 ? gb_table_word(table, 0) : "");
        draw_interval(series, &c, rows);
        draw(series, &c, rows, NULL, 0, "", "settings");
        draw(series, &c, rows, c.standard, gb_figure_black(1), "default_", "default");
        draw(series, &c, rows, c.chosen, gb_figure_black(5), "chosen_", "recommended");
    }
    gb_table_destroy(table);
    return good;
}
