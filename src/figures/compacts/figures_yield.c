#include "figures/compacts/compact_table.h"
#include "figures/figures_compute.h"

#include <math.h>
#include <string.h>

#include "measure/fit/ellipse.h"

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
    const size_t count = gb_compact_table_distinct(
        surfaces->points, surfaces->column[OFFSET], NULL, 0.0, offset, OFFSETS);
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
    if (!gb_compact_table_columns(surfaces->fit, wanted, 3, column, err)) {
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
    g_snprintf(label, sizeof label, "<i>\xcf\x81</i> = %.3g", density);
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
static size_t draw_points(struct gb_series *series, const struct surfaces *surfaces,
                          const struct gb_ellipse *ellipse, double density, int style)
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
        const double angle = gb_ellipse_normal(ellipse, at[0], at[1]);
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

static bool draw(struct gb_series *series, struct surfaces *surfaces,
                 struct gb_error *err)
{
    struct gb_ellipse ellipse[SURFACES];
    surfaces->offset = chosen_offset(surfaces);
    surfaces->count = gb_compact_table_distinct(
        surfaces->points, surfaces->column[DENSITY], surfaces->column[OFFSET],
        surfaces->offset, surfaces->density, SURFACES);
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
        draw_points(series, surfaces, &ellipse[k], surfaces->density[k], (int)k);
    }
    gb_series_caption(
        series,
        "Points: means over the cells, bars one standard error; lines: "
        "fitted ellipses. Arrows: plastic flow (<i>dv</i>, <i>dw</i>); pale "
        "lines: normals of the ellipse. Offset %g %%.",
        surfaces->offset);
    return true;
}

bool gb_figures_yield(struct gb_series *series, const struct gb_figures_input *input,
                      struct gb_error *err)
{
    struct gb_table *points = NULL, *fit = NULL;
    struct surfaces surfaces = {.arrow = 0.0};
    bool good =
        gb_compact_table_read(&points, input, "yield", "yield.csv", NULL, err) &&
        gb_compact_table_read(&fit, input, "yield", "yield_fit.csv", "quantity", err) &&
        gb_compact_table_columns(points, names, COLUMNS, surfaces.column, err);
    if (good) {
        surfaces.points = points;
        surfaces.fit = fit;
        good = draw(series, &surfaces, err);
    }
    gb_table_destroy(points);
    gb_table_destroy(fit);
    return good;
}
