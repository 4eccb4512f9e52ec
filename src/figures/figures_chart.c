/* Figures of the tables of `greenbody chart`: accuracy against cost. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/table.h"
#include "figures/figures.h"

/* Columns of the chart.csv of `greenbody chart`: one row per setting, that is relaxer,
 * particle number and numerical choices.  Errors are fractions of the density. */
struct chart_columns {
    struct gb_table *table;
    const double *particles, *bound, *cpu_s, *front, *chosen;
    /* at one pressure */
    const double *evaluations, *reference, *seeds, *error, *error_se, *scatter;
};

/* A column of the table and its member above. */
struct chart_columns_request {
    const char *name;
    const double **column;
};

/* "relaxer, N = particles" of a row, as Pango markup. */
enum { NAME_LENGTH = 80 };

/* Calls draw with the first row of every kind. */
typedef void chart_draw(struct gb_series *series, const struct chart_columns *chart,
                        size_t first, int style);

static bool find_column(const struct chart_columns *chart,
                        const struct chart_columns_request *request, size_t count,
                        struct gb_error *err)
{
    bool good = true;
    for (size_t k = 0; k < count && good; k++) {
        *request[k].column = gb_table_column(chart->table, request[k].name, err);
        good = *request[k].column != NULL;
    }
    return good;
}

/* Reads the table of the one directory or file in input->words.  Errors: GB_ERR_INPUT. */
static bool read_chart(struct chart_columns *chart, const struct gb_figures_input *input,
                       struct gb_error *err)
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
    const struct chart_columns_request request[] = {{"particles", &chart->particles}};
    return good && find_column(chart, request, G_N_ELEMENTS(request), err);
}

/* Whether two rows have one relaxer and particle number. */
static bool same_kind(const struct chart_columns *chart, size_t a, size_t b)
{
    return chart->particles[a] == chart->particles[b] &&
           strcmp(gb_table_word(chart->table, a), gb_table_word(chart->table, b)) == 0;
}

static void name_row(const struct chart_columns *chart, size_t row,
                     char label[NAME_LENGTH])
{
    snprintf(label, NAME_LENGTH, "%.40s, <i>N</i> = %g", gb_table_word(chart->table, row),
             chart->particles[row]);
}

static void for_each_kind(struct gb_series *series, const struct chart_columns *chart,
                          chart_draw *draw)
{
    int style = 0;
    for (size_t i = 0; i < gb_table_rows(chart->table); i++) {
        bool seen = false;
        for (size_t k = 0; k < i && !seen; k++) {
            seen = same_kind(chart, k, i);
        }
        if (!seen) {
            draw(series, chart, i, style++);
        }
    }
}

/* Settings of one relaxer and particle number. */
static void draw_points(struct gb_series *series, const struct chart_columns *chart,
                        size_t first, int style)
{
    char label[NAME_LENGTH];
    double *cost = gb_series_column(series, "cpu_%d_s", style + 1);
    double *bound = gb_series_column(series, "bound_%d", style + 1);
    size_t filled = 0;
    for (size_t k = first; k < gb_table_rows(chart->table); k++) {
        if (same_kind(chart, first, k) && isfinite(chart->bound[k])) {
            cost[filled] = chart->cpu_s[k];
            bound[filled++] = 100.0 * chart->bound[k];
        }
    }
    if (filled > 0) {
        name_row(chart, first, label);
        gb_series_draw(series, cost, bound, NULL, GB_FIGURE_POINTS, style, label);
    }
}

/* Pareto-optimal settings in the order of their cost. */
static void draw_front(struct gb_series *series, const struct chart_columns *chart)
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
    gb_series_draw(series, cost, bound, NULL, GB_FIGURE_FAINT, gb_figure_black(0), NULL);
}

static void draw_chosen(struct gb_series *series, const struct chart_columns *chart)
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

static void fill_chart(struct gb_series *series, const struct chart_columns *chart)
{
    draw_front(series, chart);
    for_each_kind(series, chart, draw_points);
    draw_chosen(series, chart);
    gb_series_caption(series,
                      "Maximum over the pressures of |error| + standard error. Thin "
                      "line: Pareto-optimal settings.");
}

/* Bound of the density error against the processor time of one cell. */
static bool compute_chart(struct gb_series *series, const struct gb_figures_input *input,
                          struct gb_error *err)
{
    struct chart_columns chart = {0};
    const struct chart_columns_request request[] = {{"bound", &chart.bound},
                                                    {"cpu_s", &chart.cpu_s},
                                                    {"front", &chart.front},
                                                    {"chosen", &chart.chosen}};
    const bool good = read_chart(&chart, input, err) &&
                      find_column(&chart, request, G_N_ELEMENTS(request), err);
    if (good) {
        gb_series_init(series, gb_table_rows(chart.table));
        fill_chart(series, &chart);
    }
    gb_table_destroy(chart.table);
    return good;
}

/* Pressure in the name of an error column, "5MPa"; NULL: another column. */
static const char *pressure_of(const char *column)
{
    static const char *const head = "error_";
    if (!g_str_has_prefix(column, head) || !g_str_has_suffix(column, "MPa")) {
        return NULL;
    }
    const char *text = column + strlen(head);
    return g_ascii_isdigit(*text) ? text : NULL; /* else error_se_... */
}

/* The pressure as the columns write it, 0: the last one; NULL: not in the table. */
static const char *find_pressure(const struct chart_columns *chart, double wanted_pa)
{
    const char *found = NULL, *name;
    for (size_t k = 0; (name = gb_table_name(chart->table, k)) != NULL; k++) {
        const char *text = pressure_of(name);
        const double pa = text ? 1e6 * g_ascii_strtod(text, NULL) : (double)NAN;
        if (text && (wanted_pa == 0.0 || fabs(pa - wanted_pa) <= 1e-5 * wanted_pa)) {
            found = text;
        }
    }
    return found;
}

static bool refuse_pressure(const struct chart_columns *chart, double wanted_pa,
                            struct gb_error *err)
{
    GString *known = g_string_new(NULL);
    const char *name;
    for (size_t k = 0; (name = gb_table_name(chart->table, k)) != NULL; k++) {
        const char *text = pressure_of(name);
        if (text) {
            g_string_append_printf(known, "%s%.*s MPa", known->len > 0 ? ", " : "",
                                   (int)(strlen(text) - strlen("MPa")), text);
        }
    }
    if (known->len == 0) {
        gb_error_set(err, GB_ERR_INPUT,
                     "%s: no error at a pressure; expected a table of `greenbody chart`",
                     gb_table_path(chart->table));
    } else {
        gb_error_set(err, GB_ERR_INPUT, "--pressure %g MPa: the chart has %s",
                     wanted_pa / 1e6, known->str);
    }
    g_string_free(known, TRUE);
    return false;
}

/* Standard deviation between seeds of one cell with the reference's particle number,
 * pooled over all rows with such cells. */
static double pooled_scatter(const struct chart_columns *chart)
{
    const size_t rows = gb_table_rows(chart->table);
    double count = NAN, sum = 0.0, weight = 0.0;
    for (size_t k = 0; k < rows; k++) {
        count = chart->reference[k] == 1.0 ? chart->particles[k] : count;
    }
    for (size_t k = 0; k < rows; k++) {
        if (chart->particles[k] == count && chart->seeds[k] > 1.0 &&
            isfinite(chart->scatter[k])) {
            sum += (chart->seeds[k] - 1.0) * chart->scatter[k] * chart->scatter[k];
            weight += chart->seeds[k] - 1.0;
        }
    }
    return weight > 0.0 ? sqrt(sum / weight) : (double)NAN;
}

/* Band of this deviation around 0 over all costs. */
static void draw_scatter(struct gb_series *series, const struct chart_columns *chart)
{
    double *cost = gb_series_column(series, "scatter_evaluations");
    double *zero = gb_series_column(series, "scatter_middle");
    double *scatter = gb_series_column(series, "scatter_points");
    double ends[2] = {INFINITY, -INFINITY};
    for (size_t k = 0; k < gb_table_rows(chart->table); k++) {
        if (isfinite(chart->error[k])) {
            ends[0] = fmin(ends[0], chart->evaluations[k]);
            ends[1] = fmax(ends[1], chart->evaluations[k]);
        }
    }
    const double deviation = 100.0 * pooled_scatter(chart);
    if (!isfinite(deviation) || !(ends[1] > ends[0])) {
        return;
    }
    for (int end = 0; end < 2; end++) {
        cost[end] = ends[end];
        zero[end] = 0.0;
        scatter[end] = deviation;
    }
    gb_series_draw(series, cost, zero, scatter, GB_FIGURE_FAINT, gb_figure_black(0),
                   NULL);
    gb_series_caption(series,
                      "Band: standard deviation between seeds of one cell, %.2g %%.",
                      deviation);
}

static void draw_errors(struct gb_series *series, const struct chart_columns *chart,
                        size_t first, int style)
{
    char label[NAME_LENGTH];
    double *cost = gb_series_column(series, "evaluations_%d", style + 1);
    double *error = gb_series_column(series, "error_%d_points", style + 1);
    double *error_se = gb_series_column(series, "error_%d_se_points", style + 1);
    size_t filled = 0;
    for (size_t k = first; k < gb_table_rows(chart->table); k++) {
        if (same_kind(chart, first, k) && isfinite(chart->error[k]) &&
            chart->reference[k] != 1.0) {
            cost[filled] = chart->evaluations[k];
            error_se[filled] = 100.0 * chart->error_se[k];
            error[filled++] = 100.0 * chart->error[k];
        }
    }
    if (filled > 0) {
        name_row(chart, first, label);
        gb_series_draw(series, cost, error, error_se, GB_FIGURE_POINTS, style, label);
    }
}

/* Columns at one pressure, "5MPa". */
static bool find_errors(struct chart_columns *chart, const char *pressure,
                        struct gb_error *err)
{
    char *error = g_strconcat("error_", pressure, NULL);
    char *error_se = g_strconcat("error_se_", pressure, NULL);
    char *scatter = g_strconcat("scatter_", pressure, NULL);
    const struct chart_columns_request request[] = {{"evaluations", &chart->evaluations},
                                                    {"reference", &chart->reference},
                                                    {"seeds", &chart->seeds},
                                                    {error, &chart->error},
                                                    {error_se, &chart->error_se},
                                                    {scatter, &chart->scatter}};
    const bool good = find_column(chart, request, G_N_ELEMENTS(request), err);
    g_free(error);
    g_free(error_se);
    g_free(scatter);
    return good;
}

static void fill_errors(struct gb_series *series, const struct chart_columns *chart,
                        double pressure_mpa)
{
    gb_series_caption(
        series,
        "At %g MPa, against the reference with the same seeds; bars: standard "
        "error.",
        pressure_mpa);
    draw_scatter(series, chart);
    for_each_kind(series, chart, draw_errors);
}

/* Density error at one pressure against the force evaluations of one cell. */
static bool compute_chart_error(struct gb_series *series,
                                const struct gb_figures_input *input,
                                struct gb_error *err)
{
    struct chart_columns chart = {0};
    bool good = read_chart(&chart, input, err);
    const char *pressure = good ? find_pressure(&chart, input->pressure_pa) : NULL;
    if (good && !pressure) {
        good = refuse_pressure(&chart, input->pressure_pa, err);
    }
    good = good && find_errors(&chart, pressure, err);
    if (good) {
        gb_series_init(series, gb_table_rows(chart.table));
        fill_errors(series, &chart, g_ascii_strtod(pressure, NULL));
    }
    gb_table_destroy(chart.table);
    return good;
}

/* Columns of the NAME.csv of `greenbody chart --quantity NAME`. */
struct columns {
    const double *reference, *standard, *cost, *value, *error, *error_95, *half_interval,
        *chosen;
};

static bool find_quantity(struct columns *columns, const struct gb_table *table,
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
static void draw_quantity(struct gb_series *series, const struct columns *c, size_t rows,
                          const double *which, int style, const char *name,
                          const char *label)
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
static bool compute_chart_quantity(struct gb_series *series,
                                   const struct gb_figures_input *input,
                                   struct gb_error *err)
{
    struct gb_table *table = NULL;
    struct columns c = {0};
    if (input->words[0] == NULL || input->words[1] != NULL) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "chart-quantity: expected one NAME.csv of `greenbody chart "
                            "--quantity NAME`");
    }
    const bool good = gb_table_read(&table, input->words[0], "quantity", err) &&
                      find_quantity(&c, table, err);
    if (good) {
        const size_t rows = gb_table_rows(table);
        gb_series_init(series, MAX(rows, 2));
        gb_series_caption(series,
                          "%s, against the tightest setting, cell by cell; bars: 95 %% "
                          "interval.",
                          rows > 0 ? gb_table_word(table, 0) : "");
        draw_interval(series, &c, rows);
        draw_quantity(series, &c, rows, NULL, 0, "", "settings");
        draw_quantity(series, &c, rows, c.standard, gb_figure_black(1), "default_",
                      "default");
        draw_quantity(series, &c, rows, c.chosen, gb_figure_black(5), "chosen_",
                      "recommended");
    }
    gb_table_destroy(table);
    return good;
}

const struct gb_figures_row gb_figures_chart_rows[] = {
    {"chart", "accuracy against cost of numerical settings, from greenbody chart", "",
     GB_FIGURES_TABLE,
     .x = {.name = "cpu_s", .label = "processor time of one cell (s)", .log = true},
     .y = {.name = "bound_points",
           .label = "density error (% of theoretical density)",
           .log = true},
     .compute = compute_chart},
    {"chart-error", "density error at one pressure against force evaluations", "",
     GB_FIGURES_TABLE, .options = GB_FIGURES_PRESSURE,
     .x = {.name = "evaluations", .label = "force evaluations of one cell", .log = true},
     .y = {.name = "error_points", .label = "density error (% of theoretical density)"},
     .compute = compute_chart_error},
    {"chart-quantity", "deviation of a reported quantity against cost", "",
     GB_FIGURES_TABLE,
     .x = {.name = "cost", .label = "time of a cell over the default's", .log = true},
     .y = {.name = "error_points", .label = "deviation from the tightest setting (%)"},
     .compute = compute_chart_quantity},
    {0},
};
