#include <glib.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "scene/tolerances.h"
#include "tui/view/views.h"

/* Averages against density, and the values of the last state below the axes. */

/* Lines: density, moduli, axial constants, progress. */
enum { CURVES = 3, LINES_MAX = 5, LINE_SIZE = 96 };

/* A column and its symbol. */
struct quantity {
    const char *column, *symbol;
};

struct drawing {
    struct gb_panel_plot *panel;
    const struct gb_session *session;
    const GArray *states;
    const struct quantity *quantity; /* CURVES */
    double *x, *y[CURVES];
    size_t count;
    char line[LINES_MAX][LINE_SIZE];
    int lines;
};

static const struct quantity averages[CURVES] = {
    {"E_GPa", "E"}, {"K_GPa", "K"}, {"G_GPa", "G"}};
/* 2D has no averages over directions: its constants are drawn. */
static const struct quantity constants[CURVES] = {
    {"axial_C33_GPa", "C33"}, {"axial_C11_GPa", "C11"}, {"axial_C44_GPa", "C44"}};

static double value_at(const struct drawing *drawing, size_t state, const char *column)
{
    return gb_moduli_table_mean(
        &g_array_index(drawing->states, struct gb_moduli_state, state),
        gb_moduli_table_find(column));
}

static double last(const struct drawing *drawing, const char *column)
{
    return value_at(drawing, drawing->count - 1, column);
}

G_GNUC_PRINTF(2, 3)
static void add_line(struct drawing *drawing, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    vsnprintf(drawing->line[drawing->lines++], LINE_SIZE, format, list);
    va_end(list);
}

/* "measuring: 1 of 3 states: ..." */
static void add_progress(struct drawing *drawing)
{
    const struct gb_session *session = drawing->session;
    if (!gb_job_moduli_measures(&session->moduli, &session->child)) {
        return;
    }
    if (session->moduli.waits_for != NULL) {
        add_line(drawing, "measuring: the run stores its state");
    } else if (session->child.progress[0] == '\0') {
        add_line(drawing, "measuring the first state; Y stops");
    } else {
        add_line(drawing, "measuring: %.70s", session->child.progress);
    }
}

static void add_numbers(struct drawing *drawing)
{
    const double range = last(drawing, "elastic_range");
    const double c12 = last(drawing, "axial_C12_GPa");
    add_line(drawing, "density %.4f, p %.4g MPa (z %.4g)", last(drawing, "density"),
             last(drawing, "p_MPa"), last(drawing, "pz_MPa"));
    if (isfinite(last(drawing, "nu"))) {
        add_line(drawing, "nu %.3f; probe %.0e, elastic to %s%.1e", last(drawing, "nu"),
                 last(drawing, "probe_strain"), range >= GB_PROBE_RANGE_MAX ? ">" : "",
                 range);
        add_line(drawing, "C11 %.3g C33 %.3g C44 %.3g C12 %.3g C13 %.3g",
                 last(drawing, "axial_C11_GPa"), last(drawing, "axial_C33_GPa"),
                 last(drawing, "axial_C44_GPa"), c12, last(drawing, "axial_C13_GPa"));
    } else {
        add_line(drawing, "C13 %.3g GPa; probe %.0e, elastic to %s%.1e",
                 last(drawing, "axial_C13_GPa"), last(drawing, "probe_strain"),
                 range >= GB_PROBE_RANGE_MAX ? ">" : "", range);
    }
}

static bool take_values(struct drawing *drawing)
{
    struct gb_panel_plot *panel = drawing->panel;
    const size_t count = drawing->count;
    if (!gb_panel_plot_reserve(panel, CURVES * count)) {
        return false;
    }
    drawing->x = panel->x;
    for (int k = 0; k < CURVES; k++) {
        drawing->y[k] = panel->y + (size_t)k * count;
        for (size_t i = 0; i < count; i++) {
            drawing->x[i] = value_at(drawing, i, "density");
            drawing->y[k][i] = value_at(drawing, i, drawing->quantity[k].column);
        }
    }
    return true;
}

static void draw_axes(struct drawing *drawing)
{
    struct gb_plot *plot = &drawing->panel->plot;
    double x[2] = {HUGE_VAL, -HUGE_VAL}, y[2] = {0.0, 0.0};
    for (size_t i = 0; i < drawing->count; i++) {
        x[0] = fmin(x[0], drawing->x[i]);
        x[1] = fmax(x[1], drawing->x[i]);
        for (int k = 0; k < CURVES; k++) {
            y[1] = fmax(y[1], drawing->y[k][i]);
        }
    }
    if (!(x[1] > x[0])) { /* only one state */
        x[0] -= 0.01;
        x[1] += 0.01;
    }
    plot->foot = drawing->lines + 1;
    gb_plot_axes(plot, x, y, GB_PLOT_LINEAR, "relative density", "modulus, GPa");
}

/* "o E 8.13  s K 4.59  t G 3.38 GPa" with the markers of the curves. */
static void draw_legend(struct drawing *drawing, int row)
{
    struct gb_plot *plot = &drawing->panel->plot;
    char text[32];
    int col = 0;
    for (int k = 0; k < CURVES; k++) {
        snprintf(text, sizeof text, "%s %.4g%s", drawing->quantity[k].symbol,
                 drawing->y[k][drawing->count - 1], k == CURVES - 1 ? " GPa" : "");
        gb_plot_put(plot, row, col, gb_plot_mark_char(plot, k + 1),
                    GB_PLOT_INK_SERIES + k);
        gb_plot_text(plot, row, col + 2, GB_PLOT_INK_TEXT, text);
        col += (int)strlen(text) + 4;
    }
}

static void draw_curves(struct drawing *drawing)
{
    struct gb_plot *plot = &drawing->panel->plot;
    draw_axes(drawing);
    for (int k = 0; k < CURVES; k++) {
        gb_plot_line(plot, &(struct gb_plot_series){.x = drawing->x,
                                                    .y = drawing->y[k],
                                                    .count = drawing->count,
                                                    .ink = GB_PLOT_INK_SERIES + k});
        gb_plot_line(plot, &(struct gb_plot_series){.x = drawing->x,
                                                    .y = drawing->y[k],
                                                    .count = drawing->count,
                                                    .ink = GB_PLOT_INK_SERIES + k,
                                                    .marker = k + 1,
                                                    .spacing = 1,
                                                    .points = true});
    }
    draw_legend(drawing, plot->rows - plot->foot);
}

void gb_view_moduli_draw(struct gb_panel_plot *panel, const struct gb_session *session)
{
    struct gb_plot *plot = &panel->plot;
    struct drawing drawing = {.panel = panel, .session = session};
    drawing.states = session->moduli.states;
    drawing.count = drawing.states != NULL ? drawing.states->len : 0;
    if (drawing.count == 0) {
        add_progress(&drawing);
        gb_plot_text(plot, plot->rows / 2, 2, GB_PLOT_INK_TEXT,
                     drawing.lines > 0 ? drawing.line[0]
                                       : "no moduli yet: Y measures the stored states");
        return;
    }
    drawing.quantity = isfinite(last(&drawing, "K_GPa")) ? averages : constants;
    add_numbers(&drawing);
    add_progress(&drawing);
    if (!take_values(&drawing)) {
        gb_plot_text(plot, plot->rows / 2, 2, GB_PLOT_INK_TEXT,
                     "no memory for the curves");
        return;
    }
    draw_curves(&drawing);
    for (int k = 0; k < drawing.lines; k++) {
        gb_plot_text(plot, plot->rows - drawing.lines + k, 0, GB_PLOT_INK_TEXT,
                     drawing.line[k]);
    }
}
