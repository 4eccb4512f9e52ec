/* Figures of the tables of `greenbody card`, `yield`, `strength` and `moduli`. */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/table.h"
#include "figures/figures.h"
#include "measure/average.h"
#include "measure/cap.h"
#include "measure/yield_point.h"
#include "scene/field/keep_points.h"
#include "study/strength.h"

/* A table of the directory of `greenbody yield` or `greenbody strength`, which is the one
 * word of the input.
 *
 * columns  `count` names; their numbers go to column
 * Errors: GB_ERR_INPUT (not one word, no such file or column), as gb_table_read. */
static bool read_compacts(struct gb_table **table, const struct gb_figures_input *input,
                          const char *command, const char *file, const char *words,
                          struct gb_error *err)
{
    if (input->words[0] == NULL || input->words[1] != NULL) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "the figure takes one directory of `greenbody %s`", command);
    }
    char *path = g_build_filename(input->words[0], file, NULL);
    const bool good = gb_table_read(table, path, words, err);
    g_free(path);
    return good;
}

static bool find_columns(const struct gb_table *table, const char *const *names,
                         size_t count, const double **column, struct gb_error *err)
{
    for (size_t k = 0; k < count; k++) {
        column[k] = gb_table_column(table, names[k], err);
        if (column[k] == NULL) {
            return false;
        }
    }
    return true;
}

static bool is_among(const double *value, size_t count, double wanted)
{
    for (size_t k = 0; k < count; k++) {
        if (value[k] == wanted) {
            return true;
        }
    }
    return false;
}

/* The different values of a column in the order of the table, NaN left out; at most `most`.
 *
 * where  NULL: of all rows; else of those in which this column is `equal`
 * Returns how many there are. */
static size_t distinct_values(const struct gb_table *table, const double *column,
                              const double *where, double equal, double *value,
                              size_t most)
{
    size_t count = 0;
    for (size_t i = 0; i < gb_table_rows(table) && count < most; i++) {
        if (isfinite(column[i]) && (where == NULL || where[i] == equal) &&
            !is_among(value, count, column[i])) {
            value[count++] = column[i];
        }
    }
    return count;
}

enum { SURFACE_POINTS = 200 };

/* The tables of the directory of `greenbody card`. */
struct tables {
    struct gb_table *card, *points, *uniaxial;
};

static bool read_table(struct gb_table **table, const struct gb_figures_input *input,
                       const char *file, const char *words, struct gb_error *err)
{
    if (input->words[0] == NULL || input->words[1] != NULL) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "figures of a card take one directory of `greenbody card`");
    }
    char *path = g_build_filename(input->words[0], file, NULL);
    const bool good = gb_table_read(table, path, words, err);
    g_free(path);
    return good;
}

static bool read_cap(struct gb_cap *cap, const struct gb_table *card, size_t row,
                     struct gb_error *err)
{
    static const char *const names[] = {"d_MPa", "beta_deg", "R", "p_a_MPa",
                                        "transition"};
    double value[G_N_ELEMENTS(names)];
    for (size_t n = 0; n < G_N_ELEMENTS(names); n++) {
        const double *column = gb_table_column(card, names[n], err);
        if (column == NULL) {
            return false;
        }
        value[n] = column[row];
    }
    *cap = (struct gb_cap){.d = value[0],
                           .beta = value[1] * M_PI / 180.0,
                           .r = value[2],
                           .p_a = value[3],
                           .a = value[4]};
    return true;
}

/* From the lowest p of the points, or the apex, to p_b; MPa. */
static void draw_surface(struct gb_series *series, const struct gb_cap *cap, double low,
                         double density, int style)
{
    char label[64];
    double *p = gb_series_column(series, "p_%d_MPa", style + 1);
    double *q = gb_series_column(series, "q_%d_MPa", style + 1);
    const double from = fmax(low, gb_cap_apex(cap)), to = gb_cap_end(cap);
    for (int i = 0; i < SURFACE_POINTS; i++) {
        /* dense near p_b, where the cap is steep */
        const double share = sin(M_PI_2 * i / (SURFACE_POINTS - 1));
        p[i] = from + (to - from) * share;
        q[i] = fmax(0.0, gb_cap_height(cap, p[i]));
    }
    g_snprintf(label, sizeof label, "<i>ρ</i> = %.3f", density);
    gb_series_draw(series, p, q, NULL, GB_FIGURE_LINE, style, label);
}

/* Points of one density, |q|; returns their lowest p. */
static double draw_points(struct gb_series *series, const struct gb_table *points,
                          const double *const column[4], double density, int style)
{
    double *p = gb_series_column(series, "point_p_%d_MPa", style + 1);
    double *q = gb_series_column(series, "point_q_%d_MPa", style + 1);
    double *q_error = gb_series_column(series, "point_q_%d_error", style + 1);
    double low = INFINITY;
    size_t filled = 0;
    for (size_t i = 0; i < gb_table_rows(points); i++) {
        if (fabs(column[0][i] - density) < 0.005) {
            p[filled] = column[1][i];
            q[filled] = fabs(column[2][i]);
            q_error[filled++] = column[3][i];
            low = fmin(low, column[1][i]);
        }
    }
    gb_series_draw(series, p, q, q_error, GB_FIGURE_POINTS, style, NULL);
    return low;
}

static bool draw_card(struct gb_series *series, const struct tables *tables,
                      struct gb_error *err)
{
    static const char *const names[4] = {"density", "p_MPa", "q_MPa", "q_MPa_error"};
    const double *column[4];
    const double *density = gb_table_column(tables->card, "density", err);
    for (int n = 0; n < 4; n++) {
        column[n] = gb_table_column(tables->points, names[n], err);
        if (density == NULL || column[n] == NULL) {
            return false;
        }
    }
    gb_series_init(series, MAX((size_t)SURFACE_POINTS, gb_table_rows(tables->points)));
    for (size_t k = 0; k < gb_table_rows(tables->card); k++) {
        struct gb_cap cap;
        if (!read_cap(&cap, tables->card, k, err)) {
            return false;
        }
        const double low =
            draw_points(series, tables->points, column, density[k], (int)k);
        draw_surface(series, &cap, isfinite(low) ? low : 0.0, density[k], (int)k);
    }
    gb_series_caption(series, "Points: means over the cells, bars one standard error; "
                              "extension as |<i>q</i>|. Lines: the fitted surface.");
    return true;
}

/* Fitted surfaces over the yield points in the (p, q) plane. */
static bool compute_card(struct gb_series *series, const struct gb_figures_input *input,
                         struct gb_error *err)
{
    struct tables tables = {.card = NULL};
    const bool good = read_table(&tables.card, input, "card.csv", NULL, err) &&
                      read_table(&tables.points, input, "card_points.csv", "side", err) &&
                      draw_card(series, &tables, err);
    gb_table_destroy(tables.card);
    gb_table_destroy(tables.points);
    return good;
}

static bool draw_compared(struct gb_series *series, const struct gb_table *table,
                          const char *const names[3], const char *label, int style,
                          struct gb_error *err)
{
    const double *density = gb_table_column(table, "density", err);
    const double *value = gb_table_column(table, names[0], err);
    const double *low = gb_table_column(table, names[1], err);
    const double *high = gb_table_column(table, names[2], err);
    if (!density || !value || !low || !high) {
        return false;
    }
    double *x = gb_series_column(series, "density_%d", style + 1);
    double *y = gb_series_column(series, "%s", names[0]);
    double *half = gb_series_column(series, "%s_half", names[0]);
    for (size_t i = 0; i < gb_table_rows(table); i++) {
        x[i] = density[i];
        y[i] = value[i];
        half[i] = 0.5 * (high[i] - low[i]);
    }
    gb_series_draw(series, x, y, half, GB_FIGURE_LINE, style, label);
    return true;
}

/* p_x/p_z along uniaxial pressing: simulated, and predicted by the card. */
static bool compute_card_uniaxial(struct gb_series *series,
                                  const struct gb_figures_input *input,
                                  struct gb_error *err)
{
    static const char *const simulated[3] = {"ratio", "ratio_low", "ratio_high"};
    static const char *const card[3] = {"card_ratio", "card_ratio_low",
                                        "card_ratio_high"};
    struct tables tables = {.card = NULL};
    bool good = read_table(&tables.uniaxial, input, "card_uniaxial.csv", NULL, err);
    if (good) {
        gb_series_init(series, gb_table_rows(tables.uniaxial));
        good = draw_compared(series, tables.uniaxial, simulated, "simulated", 0, err) &&
               draw_compared(series, tables.uniaxial, card, "card", 1, err);
        gb_series_caption(series,
                          "Bands: 95 %% intervals. The stress ratio was not fitted to.");
    }
    gb_table_destroy(tables.uniaxial);
    return good;
}

/* The yield surfaces of `greenbody yield` in the (p, q) plane: points, fitted ellipses,
 * and at each point the direction of plastic flow beside the normal of the ellipse.
 * Stresses in MPa. */

enum { SURFACES = 16, ELLIPSE_POINTS = 181, OFFSETS = 16 };

/* Length of the arrows over the largest half axis. */
static const double arrow_share = 0.22;

enum { DENSITY, OFFSET, P, P_ERROR, Q, Q_ERROR, FLOW_VOLUME, FLOW_SHEAR, COLUMNS };

static const char *const names[COLUMNS] = {"density",     "offset_percent", "p_MPa",
                                           "p_error_MPa", "q_MPa",          "q_error_MPa",
                                           "flow_volume", "flow_shear"};

struct surfaces {
    const struct gb_table *points, *fit;
    const double *column[COLUMNS];
    double density[SURFACES], offset; /* offset: per cent */
    size_t count;
    double arrow; /* length, MPa */
};

/* The offset that was asked for: half and double of it stand beside it. */
static double chosen_offset(const struct surfaces *surfaces)
{
    double offset[OFFSETS];
    const size_t count = distinct_values(surfaces->points, surfaces->column[OFFSET], NULL,
                                         0.0, offset, OFFSETS);
    return count > 0 ? offset[count / 2] : (double)NAN;
}

/* A quantity of yield_fit.csv at the chosen offset; NaN: none. */
static double fitted(const struct surfaces *surfaces, const double *const column[3],
                     double density, const char *quantity)
{
    for (size_t i = 0; i < gb_table_rows(surfaces->fit); i++) {
        if (strcmp(gb_table_word(surfaces->fit, i), quantity) == 0 &&
            column[0][i] == density && column[1][i] == surfaces->offset) {
            return column[2][i];
        }
    }
    return NAN;
}

static bool read_ellipse(struct gb_ellipse *ellipse, const struct surfaces *surfaces,
                         double density, struct gb_error *err)
{
    static const char *const wanted[3] = {"density", "offset_percent", "value"};
    const double *column[3];
    if (!find_columns(surfaces->fit, wanted, 3, column, err)) {
        return false;
    }
    *ellipse =
        (struct gb_ellipse){.centre_p = fitted(surfaces, column, density, "centre_p"),
                            .centre_q = fitted(surfaces, column, density, "centre_q"),
                            .half_p = fitted(surfaces, column, density, "half_axis_p"),
                            .half_q = fitted(surfaces, column, density, "half_axis_q")};
    return true;
}

static void draw_ellipse(struct gb_series *series, const struct gb_ellipse *ellipse,
                         double density, int style)
{
    char label[64];
    double *p = gb_series_column(series, "ellipse_p_%d_MPa", style + 1);
    double *q = gb_series_column(series, "ellipse_q_%d_MPa", style + 1);
    for (int i = 0; i < ELLIPSE_POINTS; i++) {
        const double angle = 2.0 * M_PI * i / (ELLIPSE_POINTS - 1);
        p[i] = ellipse->centre_p + ellipse->half_p * cos(angle);
        q[i] = ellipse->centre_q + ellipse->half_q * sin(angle);
    }
    g_snprintf(label, sizeof label, "<i>ρ</i> = %.3g", density);
    gb_series_draw(series, p, q, NULL, GB_FIGURE_LINE, style, label);
}

/* Pairs of points with gaps behind them, from a point on along (p, q). */
static void add_arrow(double *const at[2], size_t row, const double from[2],
                      const double along[2], double length)
{
    const double size = hypot(along[0], along[1]);
    for (int k = 0; k < 2; k++) {
        at[k][row] = from[k];
        at[k][row + 1] = from[k] + length * along[k] / size;
    }
}

/* Points of one density with flow and normal; returns how many. */
static size_t draw_yield_points(struct gb_series *series, const struct surfaces *surfaces,
                                const struct gb_ellipse *ellipse, double density,
                                int style)
{
    const double *const *column = surfaces->column;
    double *p = gb_series_column(series, "p_%d_MPa", style + 1);
    double *p_error = gb_series_column(series, "p_error_%d_MPa", style + 1);
    double *q = gb_series_column(series, "q_%d_MPa", style + 1);
    double *q_error = gb_series_column(series, "q_error_%d_MPa", style + 1);
    double *flow[2] = {gb_series_column(series, "flow_p_%d_MPa", style + 1),
                       gb_series_column(series, "flow_q_%d_MPa", style + 1)};
    double *normal[2] = {gb_series_column(series, "normal_p_%d_MPa", style + 1),
                         gb_series_column(series, "normal_q_%d_MPa", style + 1)};
    size_t filled = 0;
    for (size_t i = 0; i < gb_table_rows(surfaces->points); i++) {
        if (column[DENSITY][i] != density || column[OFFSET][i] != surfaces->offset) {
            continue;
        }
        const double at[2] = {column[P][i], column[Q][i]};
        const double angle = gb_yield_point_ellipse_normal(ellipse, at[0], at[1]);
        p[filled] = at[0];
        q[filled] = at[1];
        p_error[filled] = column[P_ERROR][i];
        q_error[filled] = column[Q_ERROR][i];
        add_arrow(flow, 3 * filled, at,
                  (double[2]){column[FLOW_VOLUME][i], column[FLOW_SHEAR][i]},
                  surfaces->arrow);
        add_arrow(normal, 3 * filled, at, (double[2]){cos(angle), sin(angle)},
                  surfaces->arrow);
        filled++;
    }
    gb_series_draw(series, normal[0], normal[1], NULL, GB_FIGURE_FAINT, style, NULL);
    gb_series_draw(series, flow[0], flow[1], NULL, GB_FIGURE_ARROWS, style, NULL);
    struct gb_series_curve *points =
        gb_series_draw(series, p, q, q_error, GB_FIGURE_POINTS, style, NULL);
    points->x_error = points->error - 2;
    return filled;
}

static bool draw_yield(struct gb_series *series, struct surfaces *surfaces,
                       struct gb_error *err)
{
    struct gb_ellipse ellipse[SURFACES];
    surfaces->offset = chosen_offset(surfaces);
    surfaces->count = distinct_values(surfaces->points, surfaces->column[DENSITY],
                                      surfaces->column[OFFSET], surfaces->offset,
                                      surfaces->density, SURFACES);
    for (size_t k = 0; k < surfaces->count; k++) {
        if (!read_ellipse(&ellipse[k], surfaces, surfaces->density[k], err)) {
            return false;
        }
        surfaces->arrow = fmax(surfaces->arrow,
                               arrow_share * fmax(ellipse[k].half_p, ellipse[k].half_q));
    }
    gb_series_init(series,
                   MAX((size_t)ELLIPSE_POINTS, 3 * gb_table_rows(surfaces->points)));
    series->equal_scales = true;
    for (size_t k = 0; k < surfaces->count; k++) {
        draw_ellipse(series, &ellipse[k], surfaces->density[k], (int)k);
        draw_yield_points(series, surfaces, &ellipse[k], surfaces->density[k], (int)k);
    }
    gb_series_caption(
        series,
        "Points: means over the cells, bars one standard error; lines: "
        "fitted ellipses. Arrows: plastic flow (<i>dv</i>, <i>dw</i>); pale "
        "lines: normals of the ellipse. Offset %g %%.",
        surfaces->offset);
    return true;
}

static bool compute_yield(struct gb_series *series, const struct gb_figures_input *input,
                          struct gb_error *err)
{
    struct gb_table *points = NULL, *fit = NULL;
    struct surfaces surfaces = {.arrow = 0.0};
    bool good = read_compacts(&points, input, "yield", "yield.csv", NULL, err) &&
                read_compacts(&fit, input, "yield", "yield_fit.csv", "quantity", err) &&
                find_columns(points, names, COLUMNS, surfaces.column, err);
    if (good) {
        surfaces.points = points;
        surfaces.fit = fit;
        good = draw_yield(series, &surfaces, err);
    }
    gb_table_destroy(points);
    gb_table_destroy(fit);
    return good;
}

/* Strength of compacts against the pressure of pressing, from the directories of
 * `greenbody strength`; against the density after unloading where a compact was pressed to
 * a density. */

enum { DIRECTORIES = 8 };

enum { PRESSURE, STRENGTH_DENSITY, STRENGTH, ERROR, STRENGTH_COLUMNS };

static const char *const strength_names[STRENGTH_COLUMNS] = {
    "pressure_MPa", "density", "strength_MPa", "strength_error_MPa"};

struct strength_tables {
    struct gb_table *table[DIRECTORIES];
    const double *column[DIRECTORIES][STRENGTH_COLUMNS];
    size_t count;
};

static bool read_tables(struct strength_tables *tables,
                        const struct gb_figures_input *input, struct gb_error *err)
{
    for (; input->words[tables->count] != NULL; tables->count++) {
        char *const word[] = {input->words[tables->count], NULL};
        const struct gb_figures_input one = {.words = word};
        if (tables->count == DIRECTORIES) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "strength: must be between 1 and %d directories",
                                DIRECTORIES);
        }
        struct gb_table **table = &tables->table[tables->count];
        if (!read_compacts(table, &one, "strength", "strength.csv", "test", err) ||
            !find_columns(*table, strength_names, STRENGTH_COLUMNS,
                          tables->column[tables->count], err)) {
            return false;
        }
    }
    return tables->count > 0 ||
           gb_error_set(err, GB_ERR_INPUT,
                        "strength: takes directories of `greenbody strength`");
}

static void free_tables(struct strength_tables *tables)
{
    for (size_t k = 0; k < DIRECTORIES; k++) {
        gb_table_destroy(tables->table[k]);
    }
}

/* All compacts were pressed to pressures. */
static bool have_pressures(const struct strength_tables *tables)
{
    for (size_t k = 0; k < tables->count; k++) {
        for (size_t i = 0; i < gb_table_rows(tables->table[k]); i++) {
            if (!isfinite(tables->column[k][PRESSURE][i])) {
                return false;
            }
        }
    }
    return true;
}

/* "tension", or "directory: tension" where there are several; g_free. */
static char *label_of(const struct strength_tables *tables, char *const *words, size_t k,
                      const char *test)
{
    if (tables->count == 1) {
        return g_strdup(test);
    }
    char *name = g_path_get_basename(words[k]);
    char *label = g_markup_printf_escaped("%s: %s", name, test);
    g_free(name);
    return label;
}

/* Rows of a test in rising x. */
static void draw_test(struct gb_series *series, const struct strength_tables *tables,
                      char *const *words, size_t k, int test, int along)
{
    const struct gb_table *table = tables->table[k];
    const int style = (int)k * GB_STRENGTH_TESTS + test;
    const char *name = gb_strength_tests[test].name;
    char *label = label_of(tables, words, k, name);
    double *x = gb_series_column(series, "%s_%d", strength_names[along], style + 1);
    double *y = gb_series_column(series, "%s_%d_MPa", name, (int)k + 1);
    double *error = gb_series_column(series, "%s_error_%d_MPa", name, (int)k + 1);
    size_t filled = 0;
    for (size_t i = 0; i < gb_table_rows(table); i++) {
        if (strcmp(gb_table_word(table, i), name) != 0) {
            continue;
        }
        size_t at = filled++;
        for (; at > 0 && x[at - 1] > tables->column[k][along][i]; at--) {
            x[at] = x[at - 1];
            y[at] = y[at - 1];
            error[at] = error[at - 1];
        }
        x[at] = tables->column[k][along][i];
        y[at] = tables->column[k][STRENGTH][i];
        error[at] = tables->column[k][ERROR][i];
    }
    gb_series_draw(series, x, y, error, GB_FIGURE_BOTH, style, label);
    g_free(label);
}

static void draw_strength(struct gb_series *series, const struct strength_tables *tables,
                          char *const *words)
{
    const bool by_pressure = have_pressures(tables);
    size_t rows = 0;
    for (size_t k = 0; k < tables->count; k++) {
        rows = MAX(rows, gb_table_rows(tables->table[k]));
    }
    gb_series_init(series, rows);
    gb_series_axes(series, by_pressure ? "pressure_MPa" : "density",
                   by_pressure ? "pressure of pressing <i>p</i> (MPa)"
                               : "relative density after unloading <i>ρ</i>",
                   NULL, NULL);
    series->y.low = 0.0;
    for (size_t k = 0; k < tables->count; k++) {
        for (int test = 0; test < GB_STRENGTH_TESTS; test++) {
            draw_test(series, tables, words, k, test,
                      by_pressure ? PRESSURE : STRENGTH_DENSITY);
        }
    }
    gb_series_caption(series, "Largest stress of each test after unloading; means over "
                              "the cells, bars one standard error.");
}

static bool compute_strength(struct gb_series *series,
                             const struct gb_figures_input *input, struct gb_error *err)
{
    struct strength_tables tables = {.count = 0};
    const bool good = read_tables(&tables, input, err);
    if (good) {
        draw_strength(series, &tables, input->words);
    }
    free_tables(&tables);
    return good;
}

/* Stress against strain of the tests of `greenbody strength`: each cell, and the mean as
 * far as all cells go. */

enum { CELLS = 64, MARKS = 64 };

enum { CURVE_PRESSURE, PRESSED_DENSITY, CELL, STRAIN, STRESS, CURVE_COLUMNS };

static const char *const curve_names[CURVE_COLUMNS] = {
    "pressure_MPa", "pressed_density", "cell", "strain_percent", "stress_MPa"};

/* The compact whose tests are drawn: the column that curve_names it and its value there. */
struct chosen {
    const struct gb_table *table;
    const double *column[CURVE_COLUMNS];
    int by; /* CURVE_PRESSURE or PRESSED_DENSITY */
    double value;
};

/* The compact of --at; errors: GB_ERR_INPUT. */
static bool read_at(struct chosen *chosen, const char *at, double *wanted,
                    struct gb_error *err)
{
    struct gb_keep_points points;
    struct gb_error why = {0};
    if (!gb_keep_points_parse(at, &points, &why) || points.count != 1) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--at %.100s: expected one compact, as '100 MPa' or 'density "
                            "= 0.5'",
                            at);
    }
    chosen->by = points.point[0].by_density ? PRESSED_DENSITY : CURVE_PRESSURE;
    *wanted = points.point[0].value * (points.point[0].by_density ? 1.0 : 1e-6);
    return true;
}

/* Takes the value nearest to the wanted one if it is that, or the largest; lists all. */
static bool take_value(struct chosen *chosen, double wanted, GString *all)
{
    double value[MARKS];
    bool found = false;
    const size_t count = distinct_values(chosen->table, chosen->column[chosen->by], NULL,
                                         0.0, value, MARKS);
    for (size_t k = 0; k < count; k++) {
        g_string_append_printf(all, "%s%g", k > 0 ? ", " : "", value[k]);
        if (isfinite(wanted) ? fabs(value[k] - wanted) <= 1e-6 * wanted
                             : !found || value[k] > chosen->value) {
            chosen->value = value[k];
            found = true;
        }
    }
    return found;
}

/* The compact of --at, or that of the largest pressure, or of the largest density. */
static bool choose(struct chosen *chosen, const char *at, struct gb_error *err)
{
    double wanted = NAN;
    chosen->by = CURVE_PRESSURE;
    if (at != NULL && !read_at(chosen, at, &wanted, err)) {
        return false;
    }
    GString *all = g_string_new(NULL);
    bool found = take_value(chosen, wanted, all);
    if (!found && at == NULL) {
        chosen->by = PRESSED_DENSITY;
        found = take_value(chosen, wanted, all);
    }
    if (!found) {
        gb_error_set(err, GB_ERR_INPUT, "%.300s: no compact of %s %g; expected %s",
                     gb_table_path(chosen->table), curve_names[chosen->by], wanted,
                     all->len > 0 ? all->str : "none of these");
    }
    g_string_free(all, TRUE);
    return found;
}

static bool is_row(const struct chosen *chosen, size_t row, const char *test, double cell)
{
    return chosen->column[chosen->by][row] == chosen->value &&
           chosen->column[CELL][row] == cell &&
           strcmp(gb_table_word(chosen->table, row), test) == 0;
}

/* One cell as columns; a strain that does not grow leaves its row out. */
static void draw_cell(struct gb_series *series, const struct chosen *chosen,
                      const char *test, double cell, int style,
                      struct gb_average_curve *curve)
{
    double *x = gb_series_column(series, "%s_%g_strain_percent", test, cell);
    double *y = gb_series_column(series, "%s_%g_MPa", test, cell);
    size_t filled = 0;
    for (size_t i = 0; i < gb_table_rows(chosen->table); i++) {
        if (is_row(chosen, i, test, cell) &&
            (filled == 0 || chosen->column[STRAIN][i] > x[filled - 1])) {
            x[filled] = chosen->column[STRAIN][i];
            y[filled++] = chosen->column[STRESS][i];
        }
    }
    gb_series_draw(series, x, y, NULL, GB_FIGURE_FAINT, style, NULL);
    *curve = (struct gb_average_curve){x, y, filled};
}

static bool draw_mean(struct gb_series *series, const struct gb_average_curve *curves,
                      size_t count, const char *test, int style, struct gb_error *err)
{
    double *grid = NULL;
    size_t size = 0;
    if (!gb_average_grid(curves, count, series->rows, &grid, &size, err)) {
        return false;
    }
    double *rows = g_new(double, count *size);
    double *x = gb_series_column(series, "%s_strain_percent", test);
    double *y = gb_series_column(series, "%s_MPa", test);
    double *error = gb_series_column(series, "%s_error_MPa", test);
    bool good = true;
    for (size_t c = 0; c < count && good; c++) {
        good = gb_average_resample(&curves[c], grid, size, rows + c * size, err);
    }
    if (good) {
        memcpy(x, grid, size * sizeof *x);
        gb_average_rows(rows, count, size, GB_AVERAGE_ALL, y, error);
        gb_series_draw(series, x, y, error, GB_FIGURE_LINE, style, test);
    }
    g_free(rows);
    gb_alloc_free(grid);
    return good;
}

static bool draw_curves_of_test(struct gb_series *series, const struct chosen *chosen,
                                int style, struct gb_error *err)
{
    double cell[CELLS];
    struct gb_average_curve curves[CELLS];
    const char *test = gb_strength_tests[style].name;
    const size_t count =
        distinct_values(chosen->table, chosen->column[CELL], chosen->column[chosen->by],
                        chosen->value, cell, CELLS);
    size_t drawn = 0;
    for (size_t c = 0; c < count; c++) {
        draw_cell(series, chosen, test, cell[c], style, &curves[drawn]);
        drawn += curves[drawn].count > 0;
    }
    return drawn == 0 || draw_mean(series, curves, drawn, test, style, err);
}

static bool draw_strength_curves(struct gb_series *series, const struct chosen *chosen,
                                 struct gb_error *err)
{
    gb_series_init(series, gb_table_rows(chosen->table));
    for (int test = 0; test < GB_STRENGTH_TESTS; test++) {
        if (!draw_curves_of_test(series, chosen, test, err)) {
            return false;
        }
    }
    gb_series_caption(series,
                      chosen->by == CURVE_PRESSURE ? "Pressed to %g MPa."
                                                   : "Pressed to the "
                                                     "density %g.",
                      chosen->value);
    gb_series_caption(series, "Pale: each cell; lines: their mean where all cells are, "
                              "with one standard error.");
    return true;
}

static bool compute_strength_curves(struct gb_series *series,
                                    const struct gb_figures_input *input,
                                    struct gb_error *err)
{
    struct gb_table *table = NULL;
    struct chosen chosen = {.value = NAN};
    bool good =
        read_compacts(&table, input, "strength", "strength_curves.csv", "test", err) &&
        find_columns(table, curve_names, CURVE_COLUMNS, chosen.column, err);
    chosen.table = table;
    good = good && choose(&chosen, input->at, err) &&
           draw_strength_curves(series, &chosen, err);
    gb_table_destroy(table);
    return good;
}

/* Tables that differ by styles: of five curves, seven styles. */
enum { TABLES_MAX = 2, CURVES_MAX = 5 };

/* A column of moduli.csv and its label; name NULL: the end. */
struct quantity {
    const char *column, *label;
    bool below; /* in the panel below */
};

/* A table and what it is called in the legend. */
struct source {
    struct gb_table *table;
    char *name; /* NULL: the only one */
};

static void finish(struct source source[TABLES_MAX])
{
    for (int k = 0; k < TABLES_MAX; k++) {
        gb_table_destroy(source[k].table);
        g_free(source[k].name);
    }
}

/* A folder of `greenbody moduli --out`, a run directory, or the table itself. */
static bool read_source(struct source *source, const char *word, bool alone,
                        struct gb_error *err)
{
    const bool folder = g_file_test(word, G_FILE_TEST_IS_DIR);
    char *path = folder ? g_build_filename(word, "moduli.csv", NULL) : g_strdup(word);
    bool good = true;
    if (folder && !g_file_test(path, G_FILE_TEST_EXISTS)) {
        good =
            gb_error_set(err, GB_ERR_INPUT,
                         "%.300s: no moduli.csv; greenbody moduli --out writes it", word);
    }
    good = good && gb_table_read(&source->table, path, NULL, err);
    if (good && gb_table_rows(source->table) == 0) {
        good = gb_error_set(err, GB_ERR_INPUT, "%.300s: no states", path);
    }
    if (good && !alone) {
        char *base = g_path_get_basename(word);
        source->name = g_markup_escape_text(base, -1);
        g_free(base);
    }
    g_free(path);
    return good;
}

static bool read_sources(struct source source[TABLES_MAX],
                         const struct gb_figures_input *input, struct gb_error *err)
{
    const guint count = g_strv_length((char **)input->words);
    if (count < 1 || count > TABLES_MAX) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "figures of moduli take 1 to %d folders with moduli.csv",
                            TABLES_MAX);
    }
    for (guint k = 0; k < count; k++) {
        if (!read_source(&source[k], input->words[k], count == 1, err)) {
            return false;
        }
    }
    return true;
}

static const double *find_error(const struct gb_table *table, const char *column)
{
    char *name = g_strdup_printf("error_%s", column);
    const double *found = gb_table_column(table, name, NULL);
    g_free(name);
    return found;
}

/* A column of the table as one of the series, NaN where there are no errors. */
static const double *copy(struct gb_series *series, const struct gb_table *table,
                          const double *column, const char *name, int number)
{
    double *to = gb_series_column(series, "%s_%d", name, number);
    for (size_t k = 0; k < gb_table_rows(table) && column != NULL; k++) {
        to[k] = column[k];
    }
    return to;
}

static bool has_values(const struct gb_table *table, const double *column)
{
    bool some = false;
    for (size_t k = 0; k < gb_table_rows(table); k++) {
        some = some || isfinite(column[k]);
    }
    return some;
}

/* Curves of one table; *drawn counts them. */
static bool draw_source(struct gb_series *series, const struct source *source, int number,
                        const struct quantity *quantity, int *drawn, struct gb_error *err)
{
    const struct gb_table *table = source->table;
    const double *density = gb_table_column(table, "density", err);
    if (density == NULL) {
        return false;
    }
    const double *x = copy(series, table, density, "density", number);
    (void)copy(series, table, find_error(table, "density"), "error_density", number);
    for (int k = 0; quantity[k].column != NULL; k++) {
        const double *column = gb_table_column(table, quantity[k].column, err);
        if (column == NULL) {
            return false;
        }
        if (!has_values(table, column)) {
            continue;
        }
        char *error = g_strdup_printf("error_%s", quantity[k].column);
        char *label = source->name != NULL
                          ? g_strdup_printf("%s, %s", quantity[k].label, source->name)
                          : g_strdup(quantity[k].label);
        const double *y = copy(series, table, column, quantity[k].column, number);
        const double *y_error =
            copy(series, table, find_error(table, quantity[k].column), error, number);
        struct gb_series_curve *curve =
            gb_series_draw(series, x, y, y_error, GB_FIGURE_BOTH, *drawn,
                           quantity[k].below ? NULL : label);
        curve->x_error = curve->x + 1;
        curve->below = quantity[k].below;
        curve->open = number > 1;
        curve->rows = gb_table_rows(table);
        (*drawn)++;
        g_free(error);
        g_free(label);
    }
    return true;
}

static bool draw_moduli(struct gb_series *series, const struct gb_figures_input *input,
                        const struct quantity *quantity, struct gb_error *err)
{
    struct source source[TABLES_MAX] = {{NULL, NULL}};
    size_t rows = 0;
    int drawn = 0;
    bool good = read_sources(source, input, err);
    for (int k = 0; k < TABLES_MAX && good && source[k].table != NULL; k++) {
        rows = MAX(rows, gb_table_rows(source[k].table));
    }
    if (good) {
        gb_series_init(series, rows);
    }
    for (int k = 0; k < TABLES_MAX && good && source[k].table != NULL; k++) {
        good = draw_source(series, &source[k], k + 1, quantity, &drawn, err);
    }
    if (good && drawn == 0) {
        good = gb_error_set(err, GB_ERR_INPUT,
                            "%.300s: planes have no averages over directions: the figure "
                            "moduli-axial draws their constants",
                            gb_table_path(source[0].table));
    }
    finish(source);
    return good;
}

/* Averages of Hill over the density, and below Poisson's ratio. */
static bool compute_moduli(struct gb_series *series, const struct gb_figures_input *input,
                           struct gb_error *err)
{
    static const struct quantity averages[] = {
        {"E_GPa", "Young's modulus <i>E</i>", false},
        {"K_GPa", "bulk modulus <i>K</i>", false},
        {"G_GPa", "shear modulus <i>G</i>", false},
        {"nu", "", true},
        {NULL, NULL, false}};
    if (!draw_moduli(series, input, averages, err)) {
        return false;
    }
    series->below_y.label = "<i>ν</i>";
    series->below_y.name = "nu";
    gb_series_caption(series, "Averages of Hill; bars: one standard error.");
    return true;
}

/* The five constants of an axis along z over the density. */
static bool compute_moduli_axial(struct gb_series *series,
                                 const struct gb_figures_input *input,
                                 struct gb_error *err)
{
    static const struct quantity constants[] = {
        {"axial_C33_GPa", "<i>C</i><sub>33</sub>", false},
        {"axial_C11_GPa", "<i>C</i><sub>11</sub>", false},
        {"axial_C44_GPa", "<i>C</i><sub>44</sub>", false},
        {"axial_C13_GPa", "<i>C</i><sub>13</sub>", false},
        {"axial_C12_GPa", "<i>C</i><sub>12</sub>", false},
        {NULL, NULL, false}};
    if (!draw_moduli(series, input, constants, err)) {
        return false;
    }
    gb_series_caption(series, "Axis along <i>z</i>; bars: one standard error.");
    return true;
}

#define MODULUS_AXIS                                                                     \
    {                                                                                    \
        .name = "modulus_GPa", .label = "elastic modulus (GPa)"                          \
    }

const struct gb_figures_row gb_figures_compacts_rows[] = {
    {"card", "yield points and fitted Drucker-Prager cap, from greenbody card", "",
     GB_FIGURES_TABLE, .x = {.name = "p_MPa", .label = "mean pressure <i>p</i> (MPa)"},
     .y = {.name = "q_MPa", .label = "deviatoric stress <i>q</i> (MPa)"},
     .compute = compute_card},
    {"card-uniaxial", "lateral-to-axial stress ratio, simulated and of the card", "",
     GB_FIGURES_TABLE, .x = GB_FIGURES_DENSITY_AXIS,
     .y = {.name = "ratio",
           .label = "lateral-to-axial stress ratio <i>p<sub>x</sub></i> / "
                    "<i>p<sub>z</sub></i>"},
     .compute = compute_card_uniaxial},
    {"yield", "yield points, fitted ellipse and plastic flow, from greenbody yield", "",
     GB_FIGURES_TABLE, .x = {.name = "p_MPa", .label = "mean pressure <i>p</i> (MPa)"},
     .y = {.name = "q_MPa", .label = "deviatoric stress <i>q</i> (MPa)"},
     .compute = compute_yield},
    {"strength", "strength after unloading against pressing, from greenbody strength", "",
     GB_FIGURES_TABLE, .y = {.name = "strength_MPa", .label = "strength <i>σ</i> (MPa)"},
     .compute = compute_strength},
    {"strength-curves", "stress against strain of the tests of greenbody strength", "",
     GB_FIGURES_TABLE, .options = GB_FIGURES_AT,
     .x = {.name = "strain_percent", .label = "strain <i>ε</i> (%)"},
     .y = {.name = "stress_MPa", .label = "stress <i>σ</i> (MPa)"},
     .compute = compute_strength_curves},
    {"moduli", "Young's, bulk, shear modulus and Poisson's ratio, of greenbody moduli",
     "", GB_FIGURES_TABLE, .x = GB_FIGURES_DENSITY_AXIS, .y = MODULUS_AXIS,
     .compute = compute_moduli},
    {"moduli-axial", "elastic constants of the axis z against density", "",
     GB_FIGURES_TABLE, .x = GB_FIGURES_DENSITY_AXIS, .y = MODULUS_AXIS,
     .compute = compute_moduli_axial},
    {0},
};
