#include <glib.h>
#include <math.h>
#include <stdio.h>

#include "base/units.h"
#include "tui/session/pressure_rows.h"
#include "tui/session/previous.h"
#include "tui/term/paint.h"
#include "tui/view/view_curve.h"

/* Density of each curve minus the density of the run, at equal pressure.  Bands are
 * twice the standard deviation expected for a difference. */

enum {
    SAMPLES = 96,
    MARK_MEASURED = 5,
    BANDS = 2,
    ENTRIES = GB_PRESSURE_ROWS + BANDS,
    REPLICA_SPACING = 8
};

/* Pressures below this fraction of the highest one are not drawn on a logarithmic axis,
 * because single contacts carry them. */
static const double log_range = 1e3;
/* Bands closer than this are merged. */
static const double same_band = 1e-5;

/* A curve minus the run. */
struct difference {
    struct gb_pressure_row row;
    int ink, marker;
    double value[SAMPLES], error[SAMPLES]; /* error: of the curve only */
};

struct view {
    struct gb_panel_plot *panel;
    const struct gb_session *session;
    struct gb_pressure_row run;
    double pressure_pa[SAMPLES];
    struct difference curve[GB_PRESSURE_ROWS];
    int curves;
    double band[BANDS]; /* half widths */
    int bands;
    double unit_pa;
    struct gb_plot_entry entry[ENTRIES];
    int entries;
};

static void add_entry(struct view *view, int ink, int marker, const char *name)
{
    if (view->entries < ENTRIES) {
        struct gb_plot_entry *entry = &view->entry[view->entries++];
        entry->ink = ink;
        entry->marker = marker;
        gb_paint_fit_copy(entry->name, sizeof entry->name, name);
    }
}

/* Highest pressure of loading of the run. */
static double highest_pa(const struct gb_session *session)
{
    const struct gb_curve *curve = gb_runner_curve(session->runner);
    double highest = 0.0;
    for (size_t i = 0; i < session->points; i++) {
        const struct gb_point *point = gb_curve_at(curve, i);
        if (point->branch <= 0 && point->p_pa > highest) {
            highest = point->p_pa;
        }
    }
    return highest;
}

/* Pressures of the samples, inside the typed range. */
static bool take_pressures(struct view *view)
{
    const struct gb_plot_range *typed = &view->panel->ranges.of[GB_PLOT_RANGE_PRESSURE];
    double high = highest_pa(view->session);
    double low = high / log_range;
    if (typed->typed) {
        low = fmax(low, typed->low);
        high = fmin(high, typed->high);
    }
    for (int k = 0; k < SAMPLES; k++) {
        const double share = (double)k / (SAMPLES - 1);
        view->pressure_pa[k] =
            view->panel->log ? low * pow(high / low, share) : low + share * (high - low);
    }
    return high > low && low > 0.0;
}

static void style(const struct view *view, struct difference *curve)
{
    const struct gb_session *session = view->session;
    switch (curve->row.kind) {
    case GB_PRESSURE_ROW_QUICK:
        curve->ink = gb_view_curve_quick_superseded(session)
                         ? GB_PLOT_INK_DIM
                         : gb_view_curve_quick_ink(session);
        curve->marker = 'q';
        break;
    case GB_PRESSURE_ROW_REPLICAS:
        curve->ink = GB_VIEW_INK_REPLICAS;
        curve->marker = 'R';
        break;
    case GB_PRESSURE_ROW_MEASURED:
        curve->ink = GB_PLOT_INK_TEXT;
        curve->marker = MARK_MEASURED;
        break;
    case GB_PRESSURE_ROW_RUN:
    case GB_PRESSURE_ROW_PREVIOUS: {
        const struct gb_curve_label *label =
            &session->previous[curve->row.previous].label;
        curve->ink = gb_views_curve_ink(label->colour);
        curve->marker = label->marker;
        break;
    }
    }
}

/* Adds the half width of the band of a curve, unless another curve has the same. */
static void add_band(struct view *view, const struct difference *curve, double error)
{
    const struct gb_pressure_value base = {0.0, error};
    const struct gb_pressure_value value = {0.0, curve->error[SAMPLES / 2]};
    const double half = gb_pressure_rows_limit(&curve->row, value, &view->run, base);
    bool known = !isfinite(half) || view->bands == BANDS ||
                 curve->row.kind != GB_PRESSURE_ROW_PREVIOUS;
    for (int i = 0; i < view->bands; i++) {
        known = known || fabs(view->band[i] - half) < same_band;
    }
    if (!known) {
        view->band[view->bands++] = half;
    }
}

static void collect(struct view *view)
{
    struct gb_pressure_rows rows;
    double base[SAMPLES];
    double error = NAN;
    gb_pressure_rows_list(&rows, view->session, view->panel->hide_previous);
    for (int k = 0; k < SAMPLES; k++) {
        const struct gb_pressure_value value =
            gb_pressure_rows_at(view->session, &view->run, view->pressure_pa[k]);
        base[k] = value.density;
        error = value.error;
    }
    for (int i = 0; i < rows.count; i++) {
        struct difference *curve = &view->curve[view->curves];
        if (rows.row[i].kind == GB_PRESSURE_ROW_RUN) {
            continue;
        }
        curve->row = rows.row[i];
        style(view, curve);
        for (int k = 0; k < SAMPLES; k++) {
            const struct gb_pressure_value value =
                gb_pressure_rows_at(view->session, &curve->row, view->pressure_pa[k]);
            curve->value[k] = value.density - base[k];
            curve->error[k] = value.error;
        }
        add_band(view, curve, error);
        view->curves++;
    }
}

static void extend(double ends[2], double value)
{
    if (isfinite(value)) {
        ends[0] = fmin(ends[0], value);
        ends[1] = fmax(ends[1], value);
    }
}

static void draw_axes(struct view *view)
{
    struct gb_panel_plot *panel = view->panel;
    double y[2] = {0.0, 0.0};
    for (int i = 0; i < view->curves; i++) {
        for (int k = 0; k < SAMPLES; k++) {
            extend(y, view->curve[i].value[k]);
        }
    }
    for (int i = 0; i < view->bands; i++) {
        extend(y, 1.1 * view->band[i]);
        extend(y, -1.1 * view->band[i]);
    }
    view->unit_pa = gb_view_curve_unit(view->pressure_pa[SAMPLES - 1]);
    panel->unit_pa = view->unit_pa;
    double x[2] = {view->pressure_pa[0] / view->unit_pa,
                   view->pressure_pa[SAMPLES - 1] / view->unit_pa};
    if (!panel->log) {
        x[0] = 0.0;
    }
    panel->plot.log_x = panel->log;
    gb_panel_plot_ranges_x(&panel->ranges, GB_PLOT_RANGE_PRESSURE, view->unit_pa,
                           &panel->plot, x);
    gb_panel_plot_ranges_y(&panel->ranges, GB_PLOT_RANGE_DIFFERENCE, 1.0, &panel->plot,
                           y);
    gb_plot_axes(&panel->plot, x, y, GB_PLOT_LINEAR,
                 gb_view_curve_unit_label(view->unit_pa), "density - run");
}

/* Draws a level from the first pressure to the last. */
static void draw_level(const struct view *view, double level, int ink)
{
    const struct gb_plot_axis *axis = &view->panel->plot.x;
    const double x[2] = {axis->low, axis->high};
    const double y[2] = {level, level};
    gb_plot_line(&view->panel->plot,
                 &(struct gb_plot_series){.x = x, .y = y, .count = 2, .ink = ink});
}

/* Shifts a curve by `errors` of its standard errors. */
static void shift(const struct view *view, const struct difference *curve, double errors,
                  double x[SAMPLES], double y[SAMPLES])
{
    for (int k = 0; k < SAMPLES; k++) {
        x[k] = view->pressure_pa[k] / view->unit_pa;
        y[k] = curve->value[k] + (errors != 0.0 ? errors * curve->error[k] : 0.0);
    }
}

static void draw_band(const struct view *view, const struct difference *curve)
{
    double x[SAMPLES], low[SAMPLES], high[SAMPLES];
    shift(view, curve, -GB_VIEW_BAND_ERRORS, x, low);
    shift(view, curve, GB_VIEW_BAND_ERRORS, x, high);
    gb_plot_band(&view->panel->plot, &(struct gb_plot_band){.x = {x, x},
                                                            .y = {low, high},
                                                            .count = SAMPLES,
                                                            .ink = GB_PLOT_INK_DIM});
}

/* Draws measured points at their pressures, with their errors. */
static void draw_measured(const struct view *view)
{
    const struct gb_measured *data = view->session->measured;
    for (size_t i = 0; i < data->count; i++) {
        const struct gb_pressure_value run =
            gb_pressure_rows_at(view->session, &view->run, data->pressure_pa[i]);
        const double x = data->pressure_pa[i] / view->unit_pa;
        const double y = data->density[i] - run.density;
        const double dy = data->density_error[i];
        gb_plot_line(&view->panel->plot,
                     &(struct gb_plot_series){.x = (double[]){x, x},
                                              .y = (double[]){y - dy, y + dy},
                                              .count = 2,
                                              .ink = GB_PLOT_INK_TEXT});
        gb_plot_line(&view->panel->plot, &(struct gb_plot_series){.x = &x,
                                                                  .y = &y,
                                                                  .count = 1,
                                                                  .ink = GB_PLOT_INK_TEXT,
                                                                  .marker = MARK_MEASURED,
                                                                  .points = true});
    }
}

static void draw_curve(const struct view *view, const struct difference *curve)
{
    double x[SAMPLES], y[SAMPLES];
    struct gb_plot_series series = {
        .x = x, .y = y, .count = SAMPLES, .ink = curve->ink, .marker = curve->marker};
    if (curve->row.kind == GB_PRESSURE_ROW_MEASURED) {
        draw_measured(view);
        return;
    }
    if (curve->row.kind == GB_PRESSURE_ROW_REPLICAS) {
        draw_band(view, curve);
        series.spacing = REPLICA_SPACING;
    }
    shift(view, curve, 0.0, x, y);
    gb_plot_line(&view->panel->plot, &series);
}

/* "+0.0103! mu 0.2" for each curve, then the bands and the pressure. */
static void draw_legend(struct view *view)
{
    char text[GB_PLOT_NAME + 32], difference[24], pressure[32];
    const double at_pa = gb_pressure_rows_usual(view->session, view->panel->at_pa);
    const struct gb_pressure_value run =
        gb_pressure_rows_at(view->session, &view->run, at_pa);
    for (int i = 0; i < view->curves; i++) {
        const struct difference *curve = &view->curve[i];
        gb_pressure_rows_write_difference(
            &curve->row, gb_pressure_rows_at(view->session, &curve->row, at_pa),
            &view->run, run, difference, sizeof difference);
        const bool marked = curve->row.name[0] == curve->marker; /* "a mu 0.2" */
        snprintf(text, sizeof text, "%s %s", difference,
                 curve->row.name + (marked ? 2 : 0));
        add_entry(view, curve->ink, curve->marker, text);
    }
    gb_units_format_short(at_pa, GB_DIM_PRESSURE, 4, pressure, sizeof pressure);
    snprintf(text, sizeof text, "at %s; ~ within, ! beyond", pressure);
    add_entry(view, GB_PLOT_INK_TEXT, 0, text);
    for (int i = 0; i < view->bands; i++) {
        snprintf(text, sizeof text, "band: +- %.4f (2 sd)", view->band[i]);
        add_entry(view, GB_PLOT_INK_DIM, 0, text);
    }
    gb_plot_legend(&view->panel->plot, view->entry, view->entries);
}

static void draw_text(struct gb_plot *plot, const char *text)
{
    gb_plot_text(plot, plot->rows / 2, 2, GB_PLOT_INK_TEXT, text);
}

static void draw_all(struct view *view)
{
    struct gb_panel_plot *panel = view->panel;
    draw_axes(view);
    draw_level(view, 0.0, GB_PLOT_INK_AXIS);
    for (int i = 0; i < view->bands; i++) {
        draw_level(view, view->band[i], GB_PLOT_INK_DIM);
        draw_level(view, -view->band[i], GB_PLOT_INK_DIM);
    }
    for (int i = view->curves - 1; i >= 0; i--) {
        draw_curve(view, &view->curve[i]);
    }
    draw_legend(view);
    if (gb_panel_plot_pressure_shown(panel)) {
        gb_plot_cursor(&panel->plot, panel->at_pa / view->unit_pa, 0.0);
    }
}

void gb_view_difference_draw(struct gb_panel_plot *panel,
                             const struct gb_session *session)
{
    if (session->runner == NULL || session->points < 2) {
        draw_text(&panel->plot, "no run to compare with: r starts one");
        return;
    }
    struct view *view = g_new0(struct view, 1);
    view->panel = panel;
    view->session = session;
    view->run = gb_pressure_rows_run(session);
    const bool compressed = take_pressures(view);
    if (compressed) {
        collect(view);
    }
    if (!compressed) {
        draw_text(&panel->plot, "the run has no points of loading here");
    } else if (view->curves == 0) {
        draw_text(&panel->plot, "no other curve: change a value, R or e");
    } else {
        draw_all(view);
    }
    g_free(view);
}
