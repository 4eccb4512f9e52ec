#include "figures/figures_chart.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/table.h"

/* What a figure needs of chart.csv. */
struct chart {
    struct gb_table *table;
    const double *particles, *bound, *cost, *front, *chosen;
    /* at one pressure */
    const double *evaluations, *reference, *seeds, *error, *error_se, *scatter;
};

/* A column that a figure needs, and where it goes. */
struct wanted {
    const char *name;
    const double **column;
};

static bool find_columns(const struct chart *chart, const struct wanted *wanted,
                         size_t count, struct gb_error *err)
{
    bool good = true;
    for (size_t k = 0; k < count && good; k++) {
        *wanted[k].column = gb_table_column(chart->table, wanted[k].name, err);
        good = *wanted[k].column != NULL;
    }
    return good;
}

/* The table of the one place that the words name. */
static bool open_chart(struct chart *chart, const struct gb_figures_input *input,
                       struct gb_error *err)
{
    const char *place = input->words[0];
    if (place == NULL || input->words[1] != NULL) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "the figure chart, or chart-error, takes one directory of "
                            "`greenbody chart`");
    }
    char *path = g_file_test(place, G_FILE_TEST_IS_DIR)
                     ? g_build_filename(place, "chart.csv", NULL)
                     : g_strdup(place);
    const bool good = gb_table_read(&chart->table, path, "relaxer", err);
    g_free(path);
    const struct wanted wanted[] = {{"particles", &chart->particles}};
    return good && find_columns(chart, wanted, G_N_ELEMENTS(wanted), err);
}

/* Pressure of a column of errors, as the table spells it; NULL: it is another column. */
static const char *pressure_of(const char *column)
{
    static const char *const head = "error_";
    if (!g_str_has_prefix(column, head) || !g_str_has_suffix(column, "MPa")) {
        return NULL;
    }
    const char *text = column + strlen(head);
    return g_ascii_isdigit(*text) ? text : NULL; /* or the standard error */
}

/* Name of the column of errors at a pressure, 0: at the last one; NULL: there is none. */
static const char *find_pressure(const struct chart *chart, double target_pa)
{
    const char *found = NULL, *name;
    for (size_t k = 0; (name = gb_table_name(chart->table, k)) != NULL; k++) {
        const char *text = pressure_of(name);
        const double pa = text ? 1e6 * g_ascii_strtod(text, NULL) : (double)NAN;
        if (text && (target_pa == 0.0 || fabs(pa - target_pa) <= 1e-5 * target_pa)) {
            found = text;
        }
    }
    return found;
}

static bool refuse_pressure(const struct chart *chart, double target_pa,
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
                     "%s: no error at a pressure; accepted a table of `greenbody chart`",
                     gb_table_path(chart->table));
    } else {
        gb_error_set(err, GB_ERR_INPUT,
                     "--pressure %g MPa: accepted those of the chart: %s",
                     target_pa / 1e6, known->str);
    }
    g_string_free(known, TRUE);
    return false;
}

/* Whether row k is of the same relaxer and cell as row i. */
static bool is_kind(const struct chart *chart, size_t i, size_t k)
{
    return chart->particles[i] == chart->particles[k] &&
           strcmp(gb_table_word(chart->table, i), gb_table_word(chart->table, k)) == 0;
}

/* Name of the relaxer and cell of row i. */
enum { KIND_NAME = 80 };
static void name_kind(const struct chart *chart, size_t i, char label[KIND_NAME])
{
    snprintf(label, KIND_NAME, "%.40s, <i>N</i> = %g", gb_table_word(chart->table, i),
             chart->particles[i]);
}

/* Rows of one relaxer and cell as points. */
static void draw_kind(struct gb_series *series, const struct chart *chart, size_t first,
                      int style)
{
    char label[KIND_NAME];
    double *cost = gb_series_column(series, "cpu_%d_s", style + 1);
    double *bound = gb_series_column(series, "bound_%d", style + 1);
    size_t filled = 0;
    for (size_t k = first; k < gb_table_rows(chart->table); k++) {
        if (is_kind(chart, first, k) && isfinite(chart->bound[k])) {
            cost[filled] = chart->cost[k];
            bound[filled++] = 100.0 * chart->bound[k];
        }
    }
    if (filled > 0) {
        name_kind(chart, first, label);
        gb_series_draw(series, cost, bound, NULL, GB_FIGURE_POINTS, style, label);
    }
}

typedef void draw_of_kind(struct gb_series *series, const struct chart *chart,
                          size_t first, int style);

/* Every relaxer and cell in turn. */
static void draw_kinds(struct gb_series *series, const struct chart *chart,
                       draw_of_kind *draw)
{
    int style = 0;
    for (size_t i = 0; i < gb_table_rows(chart->table); i++) {
        bool seen = false;
        for (size_t k = 0; k < i && !seen; k++) {
            seen = is_kind(chart, k, i);
        }
        if (!seen) {
            draw(series, chart, i, style++);
        }
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
    gb_series_axes(series, "cpu_s", "processor time of one cell (s)", "bound_points",
                   "error of the density (points)");
    series->x.log = series->y.log = true;
    draw_front(series, chart);
    draw_kinds(series, chart, draw_kind);
    draw_chosen(series, chart);
    gb_series_say(series, "Largest |error| and standard error over the pressures. Thin "
                          "line: nothing costs less and errs less.");
}

bool gb_figures_chart(struct gb_series *series, const struct gb_figures_input *input,
                      struct gb_error *err)
{
    struct chart chart = {0};
    const struct wanted wanted[] = {{"bound", &chart.bound},
                                    {"cpu_s", &chart.cost},
                                    {"front", &chart.front},
                                    {"chosen", &chart.chosen}};
    const bool good = open_chart(&chart, input, err) &&
                      find_columns(&chart, wanted, G_N_ELEMENTS(wanted), err);
    if (good) {
        gb_series_init(series, gb_table_rows(chart.table));
        fill(series, &chart);
    }
    gb_table_destroy(chart.table);
    return good;
}

/* Of one cell of the reference's size, from all rows with such cells. */
static double pooled_scatter(const struct chart *chart)
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

/* What one cell scatters by, above and below no error, over all costs. */
static void draw_scatter(struct gb_series *series, const struct chart *chart)
{
    double *cost = gb_series_column(series, "scatter_evaluations");
    double *middle = gb_series_column(series, "scatter_middle");
    double *scatter = gb_series_column(series, "scatter_points");
    double ends[2] = {INFINITY, -INFINITY};
    for (size_t k = 0; k < gb_table_rows(chart->table); k++) {
        if (isfinite(chart->error[k])) {
            ends[0] = fmin(ends[0], chart->evaluations[k]);
            ends[1] = fmax(ends[1], chart->evaluations[k]);
        }
    }
    const double width = 100.0 * pooled_scatter(chart);
    if (!isfinite(width) || !(ends[1] > ends[0])) {
        return;
    }
    for (int end = 0; end < 2; end++) {
        cost[end] = ends[end];
        middle[end] = 0.0;
        scatter[end] = width;
    }
    gb_series_draw(series, cost, middle, scatter, GB_FIGURE_FAINT, 3, NULL);
    gb_series_say(series, "Band: scatter of one cell, %.2g points.", width);
}

static void draw_errors(struct gb_series *series, const struct chart *chart, size_t first,
                        int style)
{
    char label[KIND_NAME];
    double *cost = gb_series_column(series, "evaluations_%d", style + 1);
    double *error = gb_series_column(series, "error_%d_points", style + 1);
    double *error_se = gb_series_column(series, "error_%d_se_points", style + 1);
    size_t filled = 0;
    for (size_t k = first; k < gb_table_rows(chart->table); k++) {
        if (is_kind(chart, first, k) && isfinite(chart->error[k]) &&
            chart->reference[k] != 1.0) {
            cost[filled] = chart->evaluations[k];
            error_se[filled] = 100.0 * chart->error_se[k];
            error[filled++] = 100.0 * chart->error[k];
        }
    }
    if (filled > 0) {
        name_kind(chart, first, label);
        gb_series_draw(series, cost, error, error_se, GB_FIGURE_POINTS, style, label);
    }
}

/* The columns at one pressure, as the table spells it. */
static bool find_errors(struct chart *chart, const char *pressure, struct gb_error *err)
{
    char *error = g_strconcat("error_", pressure, NULL);
    char *error_se = g_strconcat("error_se_", pressure, NULL);
    char *scatter = g_strconcat("scatter_", pressure, NULL);
    const struct wanted wanted[] = {{"evaluations", &chart->evaluations},
                                    {"reference", &chart->reference},
                                    {"seeds", &chart->seeds},
                                    {error, &chart->error},
                                    {error_se, &chart->error_se},
                                    {scatter, &chart->scatter}};
    const bool good = find_columns(chart, wanted, G_N_ELEMENTS(wanted), err);
    g_free(error);
    g_free(error_se);
    g_free(scatter);
    return good;
}

static void fill_errors(struct gb_series *series, const struct chart *chart,
                        double pressure_mpa)
{
    gb_series_axes(series, "evaluations", "force evaluations of one cell", "error_points",
                   "error of the density (points)");
    series->x.log = true;
    gb_series_say(series,
                  "At %g MPa, against the reference with the same seeds; bars: standard "
                  "error.",
                  pressure_mpa);
    draw_scatter(series, chart);
    draw_kinds(series, chart, draw_errors);
}

bool gb_figures_chart_error(struct gb_series *series,
                            const struct gb_figures_input *input, struct gb_error *err)
{
    struct chart chart = {0};
    bool good = open_chart(&chart, input, err);
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
