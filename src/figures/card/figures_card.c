#include "figures/figures_compute.h"

#include <math.h>

#include "base/table.h"
#include "measure/cap/cap.h"

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
    g_snprintf(label, sizeof label, "<i>\xcf\x81</i> = %.3f", density);
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
bool gb_figures_card(struct gb_series *series, const struct gb_figures_input *input,
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
bool gb_figures_card_uniaxial(struct gb_series *series,
                              const struct gb_figures_input *input, struct gb_error *err)
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
