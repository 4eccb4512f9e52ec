#include <glib.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "base/number.h"
#include "base/units.h"
#include "scene/loading_kind.h"
#include "scene/path/path.h"
#include "tui/panel/panels.h"
#include "tui/session/pressure_rows.h"
#include "tui/term/paint.h"
#include "tui/view/views.h"

/* The pane of the plot: typed ranges of the axes, the cursor over points, pressures or
 * settings, and drawing the present view. */

/* Names of quantities for typed ranges. */
static const struct {
    const char *name;
    enum gb_dimension dimension;
    double least; /* lowest valid value */
} quantity[GB_PLOT_RANGES] = {
    [GB_PLOT_RANGE_PRESSURE] = {"p", GB_DIM_PRESSURE, 0.0},
    [GB_PLOT_RANGE_DENSITY] = {"rho", GB_DIM_NONE, 0.0},
    [GB_PLOT_RANGE_TIME] = {"t", GB_DIM_NONE, 0.0},
    [GB_PLOT_RANGE_RATIO] = {"ratio", GB_DIM_NONE, 0.0},
    [GB_PLOT_RANGE_DIFFERENCE] = {"drho", GB_DIM_NONE, -1.0},
};

static const char accepted[] = "as p=10 MPa:500 MPa rho=0.3:0.6; p, rho, t, ratio, drho";

static int find(const char *name, size_t length)
{
    int of = 0;
    while (of < GB_PLOT_RANGES && (strlen(quantity[of].name) != length ||
                                   strncmp(quantity[of].name, name, length) != 0)) {
        of++;
    }
    return of;
}

/* Reads an end of a range.  An end without a unit has the unit of the other end. */
static bool parse_end(int of, const char *text, const char *other, double *value,
                      struct gb_error *err)
{
    char *end = NULL;
    char *unit = NULL;
    g_ascii_strtod(text, &end);
    g_ascii_strtod(other, &unit);
    char *whole = g_strconcat(text, end != text && *end == '\0' ? unit : "", NULL);
    struct gb_error reason = {0};
    const bool good = gb_units_parse(whole, quantity[of].dimension, value, &reason);
    g_free(whole);
    return good ||
           gb_error_set(err, GB_ERR_INPUT, "%s: %s", quantity[of].name, reason.text);
}

/* Reads "10 MPa:500 MPa". */
static bool parse_range(struct gb_plot_range *range, int of, const char *text,
                        struct gb_error *err)
{
    char **ends = g_strsplit(text, ":", -1);
    bool good = g_strv_length(ends) == 2;
    if (good) {
        g_strstrip(ends[0]);
        g_strstrip(ends[1]);
        good = parse_end(of, ends[0], ends[1], &range->low, err) &&
               parse_end(of, ends[1], ends[0], &range->high, err);
    } else {
        gb_error_set(err, GB_ERR_INPUT, "%s=%s: two values are needed, %s",
                     quantity[of].name, text, accepted);
    }
    if (good && !(range->low < range->high && range->low >= quantity[of].least)) {
        good = gb_error_set(
            err, GB_ERR_INPUT, "%s=%s: the first value must be below the second%s",
            quantity[of].name, text, quantity[of].least < 0.0 ? "" : " and not negative");
    }
    range->typed = good;
    g_strfreev(ends);
    return good;
}

/* The name before an equal sign, without blanks between them. */
static const char *name_before(const char *text, const char *equal, size_t *length)
{
    while (equal > text && equal[-1] == ' ') {
        equal--;
    }
    const char *end = equal;
    while (equal > text && g_ascii_isalnum(equal[-1])) {
        equal--;
    }
    *length = (size_t)(end - equal);
    return equal;
}

/* Reads one "name=low:high" at *at and moves *at to the next one. */
static bool parse_next(struct gb_plot_ranges *ranges, const char **at,
                       struct gb_error *err)
{
    const char *equal = strchr(*at, '=');
    size_t length = 0;
    const char *name = equal != NULL ? name_before(*at, equal, &length) : *at;
    const int of = find(name, length);
    if (equal == NULL || name != *at || of == GB_PLOT_RANGES) {
        return gb_error_set(err, GB_ERR_INPUT, "%.60s: expected ranges %s", *at,
                            accepted);
    }
    const char *next = strchr(equal + 1, '=');
    const char *end = next != NULL ? name_before(equal + 1, next, &length)
                                   : equal + 1 + strlen(equal + 1);
    char *value = g_strndup(equal + 1, (size_t)(end - equal - 1));
    g_strdelimit(value, ",;", ' ');
    const bool good = parse_range(&ranges->of[of], of, g_strstrip(value), err);
    g_free(value);
    *at = end;
    return good;
}

bool gb_panel_plot_ranges_parse(struct gb_plot_ranges *ranges, const char *text,
                                struct gb_error *err)
{
    struct gb_plot_ranges fresh = {.of = {{.typed = false}}};
    char *copy = g_strstrip(g_strdup(text));
    const char *at = copy;
    bool good = true;
    while (good && *at != '\0') {
        good = parse_next(&fresh, &at, err);
    }
    g_free(copy);
    if (good) {
        *ranges = fresh;
    }
    return good;
}

void gb_panel_plot_ranges_write(const struct gb_plot_ranges *ranges, char *text,
                                size_t size)
{
    size_t n = 0;
    text[0] = '\0';
    for (int of = 0; of < GB_PLOT_RANGES && n < size; of++) {
        const struct gb_plot_range *range = &ranges->of[of];
        if (range->typed) {
            char low[48], high[48];
            gb_units_format(range->low, quantity[of].dimension, low, sizeof low);
            gb_units_format(range->high, quantity[of].dimension, high, sizeof high);
            n += (size_t)snprintf(text + n, size - n, "%s%s=%s:%s", n > 0 ? " " : "",
                                  quantity[of].name, low, high);
        }
    }
}

bool gb_panel_plot_ranges_any(const struct gb_plot_ranges *ranges)
{
    bool any = false;
    for (int of = 0; of < GB_PLOT_RANGES; of++) {
        any = any || ranges->of[of].typed;
    }
    return any;
}

bool gb_panel_plot_ranges_inside(const struct gb_plot_ranges *ranges,
                                 enum gb_plot_range_of of, double value)
{
    const struct gb_plot_range *range = &ranges->of[of];
    return !range->typed || (value >= range->low && value <= range->high);
}

static bool apply(const struct gb_plot_range *range, double unit, double ends[2])
{
    if (range->typed) {
        ends[0] = range->low / unit;
        ends[1] = range->high / unit;
    }
    return range->typed;
}

void gb_panel_plot_ranges_x(const struct gb_plot_ranges *ranges, enum gb_plot_range_of of,
                            double unit, struct gb_plot *plot, double ends[2])
{
    plot->exact_x = apply(&ranges->of[of], unit, ends);
}

void gb_panel_plot_ranges_y(const struct gb_plot_ranges *ranges, enum gb_plot_range_of of,
                            double unit, struct gb_plot *plot, double ends[2])
{
    plot->exact_y = apply(&ranges->of[of], unit, ends);
}

/* The cursor along the points of the curve, and its line of values. */

enum { PAGE_POINTS = 10 };

static bool has_cursor(const struct gb_panel_plot *panel)
{
    return panel->view->abscissa != GB_VIEW_NO_CURSOR;
}

double gb_panel_plot_cursor_x(const struct gb_panel_plot *panel,
                              const struct gb_session *session,
                              const struct gb_point *point)
{
    return panel->view->abscissa == GB_VIEW_ELAPSED
               ? gb_previous_curve_elapsed(gb_session_shown(session).params->kind, point)
               : point->density;
}

/* The first movement puts the cursor on the newest point. */
static void panel_plot_cursor_move(struct gb_panel_plot *panel,
                                   const struct gb_session *session, long long by)
{
    const size_t points = gb_session_shown(session).points;
    if (points == 0 || !has_cursor(panel)) {
        return;
    }
    const long long last = (long long)points - 1;
    const long long to = panel->cursor_on ? (long long)panel->cursor + by : last;
    panel->cursor_on = true;
    panel->cursor = (size_t)CLAMP(to, 0, last);
}

enum { PAGE_SETTINGS = 10, DESCRIPTION = 160 };

/* Rows over which the cursor moves. */
struct rows {
    size_t known;        /* number of rows */
    const size_t *order; /* their order; NULL: unchanged */
    size_t first;        /* row of the first movement */
};

static struct rows rows_of(const struct gb_panel_plot *panel,
                           const struct gb_session *session)
{
    const struct gb_chart_csv *chart = session->chart;
    const struct gb_stability_csv *stability = session->stability;
    if (panel->view->need == GB_VIEW_NEEDS_STABILITY) {
        return stability == NULL ? (struct rows){0}
                                 : (struct rows){stability->count, NULL,
                                                 gb_job_stability_weakest(stability)};
    }
    return chart == NULL ? (struct rows){0}
                         : (struct rows){chart->known, chart->by_cost, chart->chosen};
}

static size_t row_at(const struct rows *rows, long long rank)
{
    return rows->order != NULL ? rows->order[rank] : (size_t)rank;
}

static void go_to(struct gb_panel_plot *panel, const struct rows *rows, long long rank)
{
    panel->setting = row_at(rows, CLAMP(rank, 0, (long long)rows->known - 1));
    panel->setting_on = panel->view;
}

/* Position of a row in the order; 0 for an unknown row. */
static long long rank_of(const struct rows *rows, size_t row)
{
    for (size_t k = 0; k < rows->known; k++) {
        if (row_at(rows, (long long)k) == row) {
            return (long long)k;
        }
    }
    return 0;
}

/* Moves the cursor.  The first movement goes to the recommended setting of a chart or
 * its cheapest one, or to the weakest state of the method in use. */
static void move(struct gb_panel_plot *panel, const struct rows *rows, long long by)
{
    const bool on = panel->setting_on == panel->view;
    go_to(panel, rows, rank_of(rows, on ? panel->setting : rows->first) + (on ? by : 0));
}

/* The same over the settings of a chart: panel_plot.c. */
static void panel_plot_settings_navigate(struct gb_panel_plot *panel,
                                         const struct gb_session *session,
                                         enum gb_action action)
{
    const struct rows rows = rows_of(panel, session);
    static const int steps[] = {
        [GB_ACTION_LEFT] = -1,
        [GB_ACTION_UP] = -1,
        [GB_ACTION_RIGHT] = 1,
        [GB_ACTION_DOWN] = 1,
        [GB_ACTION_PAGE_UP] = -PAGE_SETTINGS,
        [GB_ACTION_PAGE_DOWN] = PAGE_SETTINGS,
    };
    if (action == GB_ACTION_BACK) {
        panel->setting_on = NULL;
    } else if (rows.known > 0) {
        if (action == GB_ACTION_HOME || action == GB_ACTION_END) {
            go_to(panel, &rows, action == GB_ACTION_HOME ? 0 : (long long)rows.known - 1);
        } else if ((size_t)action < G_N_ELEMENTS(steps) && steps[action] != 0) {
            move(panel, &rows, steps[action]);
        }
    }
}

void gb_panel_plot_cursor_navigate(struct gb_panel_plot *panel,
                                   const struct gb_session *session,
                                   enum gb_action action)
{
    if (panel->view->abscissa == GB_VIEW_SETTINGS) {
        panel_plot_settings_navigate(panel, session, action);
        return;
    }
    panel->at_pa = 0.0;
    switch (action) {
    case GB_ACTION_LEFT:
    case GB_ACTION_UP:
        panel_plot_cursor_move(panel, session, -1);
        break;
    case GB_ACTION_RIGHT:
    case GB_ACTION_DOWN:
        panel_plot_cursor_move(panel, session, 1);
        break;
    case GB_ACTION_PAGE_UP:
        panel_plot_cursor_move(panel, session, -PAGE_POINTS);
        break;
    case GB_ACTION_PAGE_DOWN:
        panel_plot_cursor_move(panel, session, PAGE_POINTS);
        break;
    case GB_ACTION_HOME:
        panel->cursor_on = gb_session_shown(session).points > 0;
        panel->cursor = 0;
        break;
    case GB_ACTION_END:
        panel->cursor_on = false;
        panel_plot_cursor_move(panel, session, 0);
        break;
    case GB_ACTION_BACK:
        panel->cursor_on = false;
        break;
    case GB_ACTION_NONE:
    case GB_ACTION_ENTER:
        break;
    }
}

/* Distance in cells between a point of the curve and a cell; only horizontal if the y
 * axis is not the pressure. */
static double distance_to(const struct gb_panel_plot *panel,
                          const struct gb_session *session, const struct gb_point *point,
                          int row, int col)
{
    const struct gb_plot *plot = &panel->plot;
    const double x = gb_panel_plot_cursor_x(panel, session, point);
    const double across =
        gb_plot_axis_position(&plot->x, x) * plot->field_cols - 0.5 - col;
    if (!(panel->view->options & GB_VIEW_PRESSURE_AXIS) || !(panel->unit_pa > 0.0)) {
        return fabs(across);
    }
    const double y = gb_plot_axis_position(&plot->y, point->p_pa / panel->unit_pa);
    return hypot(across, 2.0 * ((1.0 - y) * plot->field_rows - 0.5 - row));
}

void gb_panel_plot_cursor_click(struct gb_panel_plot *panel,
                                const struct gb_session *session, int row, int col)
{
    const struct gb_session_shown shown = gb_session_shown(session);
    const int down = row - 1 - panel->plot.top; /* the plot starts at 1, 1 */
    const int right = col - 1 - panel->plot.left;
    double nearest = HUGE_VAL;
    if (!has_cursor(panel) || panel->view->abscissa >= GB_VIEW_OWN ||
        panel->plot.field_cols <= 0) {
        return;
    }
    for (size_t i = 0; i < shown.points; i++) {
        const double distance =
            distance_to(panel, session, gb_curve_at(shown.curve, i), down, right);
        if (distance < nearest) { /* never for NaN */
            nearest = distance;
            panel->cursor = i;
            panel->cursor_on = true;
            panel->at_pa = 0.0;
        }
    }
}

/* Writes "compress, 10.5 ns" or "unload:100MPa". */
static void write_point_label(const struct gb_session *session,
                              const struct gb_point *point, char *text, size_t size)
{
    const struct gb_params *params = gb_session_shown(session).params;
    if (gb_loading_kind_of(params)->given_rate) {
        snprintf(text, size, "%s, %.5g ns", gb_panel_plot_stage(point->branch),
                 gb_previous_curve_elapsed(params->kind, point));
    } else {
        gb_curve_branch_name(point, text, size);
    }
}

/* "alumina.csv: 9 of 12 points reached; relative density at equal pressure: RMS misfit
 * 0.73 % of theoretical density, mean -0.30 %, 0.8 standard errors" */
static bool describe_misfit(const struct gb_session *session, struct gb_message *message)
{
    struct gb_measured_misfit misfit;
    if (session->measured == NULL) {
        return false;
    }
    char *name = g_path_get_basename(session->measured->path);
    gb_session_misfit(session, &misfit);
    char file[64];
    if (gb_session_measured(session) == NULL) {
        snprintf(message->text, sizeof message->text,
                 "%s: loaded for a scene in %dD, not compared with this one in %dD",
                 gb_paint_fit_copy(file, sizeof file, name), session->measured_dimension,
                 gb_session_shown(session).params->dimension);
        g_free(name);
        return true;
    }
    int n = snprintf(message->text, sizeof message->text, "%s: %zu of %zu points reached",
                     gb_paint_fit_copy(file, sizeof file, name), misfit.reached,
                     session->measured->count);
    if (misfit.reached > 0) {
        n += snprintf(message->text + n, sizeof message->text - (size_t)n,
                      "; at equal pressure: RMS misfit %.2f %% of theoretical density, "
                      "mean %+.2f %%",
                      100.0 * misfit.rms, 100.0 * misfit.mean);
    }
    if (isfinite(misfit.weighted)) {
        snprintf(message->text + n, sizeof message->text - (size_t)n,
                 ", %.2g standard errors", misfit.weighted);
    }
    message->style = GB_STYLE_PLAIN;
    g_free(name);
    return true;
}

/* "point 12 of 60, leg 2: density 0.4120  p 50 MPa  q 12.3 MPa  strain % x 1.20 ..." */
static void describe_leg(const struct gb_panel_plot *panel, size_t points,
                         const struct gb_point *point, struct gb_message *message)
{
    char p[32], q[32];
    const size_t size = sizeof message->text;
    int n = snprintf(message->text, size,
                     "point %zu of %zu, leg %.0f: density %.5f  p %s  q %s  strain %%",
                     panel->cursor + 1, points, point->leg, point->density,
                     gb_units_format_short(point->p_pa, GB_DIM_PRESSURE, 5, p, sizeof p),
                     gb_units_format_short(point->q_pa, GB_DIM_PRESSURE, 4, q, sizeof q));
    for (int k = 0; k < GB_PATH_COMPONENTS; k++) {
        if (isfinite(point->strain[k]) && (k < 3 || point->strain[k] != 0.0)) {
            n += snprintf(message->text + n, size - (size_t)n, " %s %.2f",
                          gb_path_component_name(k), 100.0 * point->strain[k]);
        }
    }
}

static void describe_point(const struct gb_panel_plot *panel,
                           const struct gb_session *session, struct gb_message *message)
{
    const struct gb_session_shown shown = gb_session_shown(session);
    const struct gb_point *point = gb_curve_at(shown.curve, panel->cursor);
    char label[64];
    char p[32];
    char px[32];
    char pz[32];
    write_point_label(session, point, label, sizeof label);
    message->style = GB_STYLE_PLAIN;
    if (isfinite(point->leg)) {
        describe_leg(panel, shown.points, point, message);
        return;
    }
    snprintf(message->text, sizeof message->text,
             "point %zu of %zu (%s)  rel. density %.5f  p %s  px %s  pz %s  "
             "coordination %.3f  bridged %.1f %%",
             panel->cursor + 1, shown.points, label, point->density,
             gb_units_format_short(point->p_pa, GB_DIM_PRESSURE, 5, p, sizeof p),
             gb_units_format_short(point->px_pa, GB_DIM_PRESSURE, 5, px, sizeof px),
             gb_units_format_short(point->pz_pa, GB_DIM_PRESSURE, 5, pz, sizeof pz),
             point->coordination, 100.0 * point->bridged);
}

bool gb_panel_plot_cursor_shown(const struct gb_panel_plot *panel,
                                const struct gb_session *session)
{
    return gb_panel_plot_pressure_shown(panel) ||
           (panel->cursor_on && panel->cursor < gb_session_shown(session).points &&
            has_cursor(panel));
}

static void write_value(GString *text, const struct gb_pressure_row *row,
                        struct gb_pressure_value value)
{
    char number[GB_NUMBER_ERROR_MAX];
    const char *separator = text->str[text->len - 1] == ':' ? "" : ",";
    if (isnan(value.density)) {
        g_string_append_printf(text, "%s %s -", separator, row->brief);
    } else if (isnan(value.error)) {
        g_string_append_printf(text, "%s %s %.4f", separator, row->brief, value.density);
    } else {
        g_string_append_printf(
            text, "%s %s %s", separator, row->brief,
            gb_number_error(value.density, value.error, 2, " +- ", number));
    }
}

/* "density at 100 MPa: run 0.4062 +- 0.0064, a 0.3962 +- 0.0064, measured 0.410" */
static void panel_plot_pressure_describe(const struct gb_panel_plot *panel,
                                         const struct gb_session *session,
                                         struct gb_message *message)
{
    struct gb_pressure_rows rows;
    char pressure[32];
    GString *text = g_string_new(NULL);
    gb_units_format_short(panel->at_pa, GB_DIM_PRESSURE, 6, pressure, sizeof pressure);
    g_string_printf(text, "density at %s:", pressure);
    gb_pressure_rows_list(&rows, session, panel->hide_previous);
    for (int i = 0; i < rows.count; i++) {
        write_value(text, &rows.row[i],
                    gb_pressure_rows_at(session, &rows.row[i], panel->at_pa));
    }
    snprintf(message->text, sizeof message->text, "%s", text->str);
    message->style = GB_STYLE_PLAIN;
    g_string_free(text, TRUE);
}

static void describe_stability(const struct gb_stability_csv *table, size_t i,
                               struct gb_message *message)
{
    const struct gb_stability_csv_row *row = &table->row[i];
    message->style = row->stable ? GB_STYLE_PLAIN : GB_STYLE_WARN;
    snprintf(message->text, sizeof message->text,
             "%s at %.4g MPa, density %.4f: stable to %.3g, takes %s%.3g, %.2f times: "
             "%s%s; Enter applies",
             row->method, table->p_mpa[i], row->density, row->measured,
             table->in_time ? "" : "up to ", row->used, table->margin[i],
             row->stable ? "stable" : "unstable", row->in_use ? ", in use" : "");
}

static void panel_plot_settings_describe(const struct gb_panel_plot *panel,
                                         const struct gb_session *session,
                                         struct gb_message *message)
{
    const struct gb_chart_csv *chart = session->chart;
    char text[DESCRIPTION];
    size_t row = 0;
    message->style = GB_STYLE_PLAIN;
    if (!gb_panel_plot_settings_at(panel, session, &row)) {
        message->style = GB_STYLE_DIM;
        snprintf(message->text, sizeof message->text, "%s; v and V change the view",
                 panel->view->hint);
        return;
    }
    if (panel->view->need == GB_VIEW_NEEDS_STABILITY) {
        describe_stability(session->stability, row, message);
        return;
    }
    snprintf(message->text, sizeof message->text,
             "%.3g CPU s a cell, error below %.2g%s%s; Enter applies %s",
             chart->seconds[row], chart->error[row], chart->noise[row] ? " (noise)" : "",
             row == chart->chosen ? ", recommended"
             : chart->front[row]  ? ", Pareto-optimal"
                                  : "",
             gb_chart_describe(&chart->setting[row], text, sizeof text));
}

void gb_panel_plot_cursor_describe(const struct gb_panel_plot *panel,
                                   const struct gb_session *session,
                                   struct gb_message *message)
{
    const struct gb_plot_view *view = panel->view;
    message->style = GB_STYLE_DIM;
    if (view->abscissa == GB_VIEW_SETTINGS) {
        panel_plot_settings_describe(panel, session, message);
    } else if (gb_panel_plot_pressure_shown(panel)) {
        panel_plot_pressure_describe(panel, session, message);
    } else if (gb_panel_plot_cursor_shown(panel, session)) {
        describe_point(panel, session, message);
    } else if (!(view->options & GB_VIEW_PRESSURE_AXIS) ||
               !describe_misfit(session, message)) {
        snprintf(message->text, sizeof message->text, "%s; v and V change the view",
                 view->hint);
    }
}

/* The cursor at a typed pressure. */

/* The first point of loading at or above the pressure; if there is none, the last one. */
static size_t point_at(const struct gb_session_shown *shown, double pressure_pa)
{
    for (size_t i = 0; i < shown->points; i++) {
        const struct gb_point *point = gb_curve_at(shown->curve, i);
        if (point->branch <= 0 && point->p_pa >= pressure_pa) {
            return i;
        }
    }
    return shown->points - 1;
}

void gb_panel_plot_pressure_set(struct gb_panel_plot *panel,
                                const struct gb_session *session, double pressure_pa)
{
    const struct gb_session_shown shown = gb_session_shown(session);
    if (!(panel->view->options & (GB_VIEW_PRESSURE_AXIS | GB_VIEW_PRESSURE_ACROSS))) {
        panel->view = gb_views_at(0);
    }
    panel->at_pa = pressure_pa;
    panel->cursor_on = shown.points > 0;
    panel->cursor = shown.points > 0 ? point_at(&shown, pressure_pa) : 0;
}

bool gb_panel_plot_pressure_shown(const struct gb_panel_plot *panel)
{
    return panel->at_pa > 0.0 &&
           panel->view->options & (GB_VIEW_PRESSURE_AXIS | GB_VIEW_PRESSURE_ACROSS);
}

double gb_panel_plot_pressure_density(const struct gb_panel_plot *panel,
                                      const struct gb_session *session)
{
    struct gb_pressure_rows rows;
    double density = NAN;
    gb_pressure_rows_list(&rows, session, panel->hide_previous);
    for (int i = 0; i < rows.count && isnan(density); i++) {
        density = gb_pressure_rows_at(session, &rows.row[i], panel->at_pa).density;
    }
    return density;
}

/* The cursor over the settings of a chart, along their cost, and over the rows of the
 * stability, along the run. */

bool gb_panel_plot_settings_at(const struct gb_panel_plot *panel,
                               const struct gb_session *session, size_t *row)
{
    const struct rows rows = rows_of(panel, session);
    *row = panel->setting;
    for (size_t k = 0; k < rows.known && panel->setting_on == panel->view; k++) {
        if (row_at(&rows, (long long)k) == *row) {
            return panel->view->abscissa == GB_VIEW_SETTINGS;
        }
    }
    return false;
}

/* Size of the pane from which contact laws are drawn below the curve, and their
 * fraction. */
enum { INSET_FROM_ROWS = 30, INSET_COLS = 50, INSET_SHARE = 3 };

void gb_panel_plot_init(struct gb_panel_plot *panel, const struct gb_term *term,
                        int graph)
{
    *panel = (struct gb_panel_plot){.view = gb_views_at(0)};
    gb_plot_init(&panel->plot);
    for (int i = 0; i < GB_PANEL_INSETS; i++) {
        gb_plot_init(&panel->inset[i]);
    }
    panel->shades = gb_term_shaded(term);
    panel->utf8 = gb_term_utf8(term);
    panel->pixels = gb_term_images(term) != GB_IMAGES_NONE;
    panel->glyphs = gb_term_braille(term) ? GB_PLOT_BRAILLE
                    : panel->utf8         ? GB_PLOT_BLOCK
                                          : GB_PLOT_ASCII;
    if (graph != GB_GRAPH_AUTO && panel->utf8) {
        panel->glyphs = graph == GB_GRAPH_BRAILLE ? GB_PLOT_BRAILLE
                        : graph == GB_GRAPH_BLOCK ? GB_PLOT_BLOCK
                                                  : GB_PLOT_ASCII;
    }
}

void gb_panel_plot_finish(struct gb_panel_plot *panel)
{
    gb_plot_finish(&panel->plot);
    for (int i = 0; i < GB_PANEL_INSETS; i++) {
        gb_plot_finish(&panel->inset[i]);
    }
    gb_results_fits_finish(&panel->fits);
    gb_alloc_free(panel->x);
    gb_alloc_free(panel->y);
}

bool gb_panel_plot_reserve(struct gb_panel_plot *panel, size_t count)
{
    if (count <= panel->capacity) {
        return true;
    }
    const size_t capacity = 2 * count + 64;
    double *x = gb_alloc_array(capacity, sizeof *x, NULL);
    double *y = x == NULL ? NULL : gb_alloc_array(capacity, sizeof *y, NULL);
    if (y == NULL) {
        gb_alloc_free(x);
        return false;
    }
    gb_alloc_free(panel->x);
    gb_alloc_free(panel->y);
    panel->x = x;
    panel->y = y;
    panel->capacity = capacity;
    return true;
}

const char *gb_panel_plot_stage(int branch)
{
    static const char *const names[] = {
        [-GB_BRANCH_LOAD] = "compress",      [-GB_BRANCH_RELAX] = "relax",
        [-GB_BRANCH_HOLD] = "hold",          [-GB_BRANCH_UNLOAD] = "unloading",
        [-GB_BRANCH_CONFINED] = "punch off", [-GB_BRANCH_EJECT] = "ejection",
        [-GB_BRANCH_EJECTED] = "ejected"};
    return names[branch < 0 && branch >= GB_BRANCH_LEAST ? -branch : 0];
}

void gb_panel_plot_step_view(struct gb_panel_plot *panel, int step)
{
    panel->view = gb_views_step(panel->view, step, &panel->edited);
}

static void write_title(const struct gb_panel_plot *panel,
                        const struct gb_session *session, char *title, size_t size)
{
    const struct gb_plot_view *view = panel->view;
    const struct gb_session_shown shown = gb_session_shown(session);
    const bool across = view->options & GB_VIEW_PRESSURE_ACROSS;
    const bool pressure = across || view->options & GB_VIEW_PRESSURE_AXIS;
    const bool dynamic = gb_loading_kind_of(shown.params)->given_rate;
    snprintf(title, size, "%s %s%s%s%s%s", view->key,
             view->title_by_step != NULL && !dynamic ? view->title_by_step : view->title,
             pressure && panel->log ? " (log)" : "",
             gb_panel_plot_ranges_any(&panel->ranges) ? ", Z" : "",
             shown.quick && !pressure ? ", quick cell" : "",
             session->frozen ? ", view frozen" : "");
}

/* Writes text in the middle of an empty plot; a newline ends a line. */
static void write_missing(struct gb_plot *plot, const char *missing)
{
    char **lines = g_strsplit(missing, "\n", -1);
    const int first = plot->rows / 2 - (int)g_strv_length(lines) / 2;
    for (int i = 0; lines[i] != NULL; i++) {
        gb_plot_text(plot, first + i, 2, GB_PLOT_INK_TEXT, lines[i]);
    }
    g_strfreev(lines);
}

/* False: out of memory. */
static bool draw_view(struct gb_panel_plot *panel, struct gb_plot *plot,
                      const struct gb_paint *paint, const struct gb_session *session,
                      const struct gb_plot_view *view)
{
    const char *missing = gb_views_missing(view, session, &panel->edited);
    if (!gb_plot_resize(plot, paint->rect.rows - 1, paint->rect.cols - 2, panel->glyphs,
                        NULL)) {
        gb_paint_text(paint, 1, 1, GB_STYLE_BAD, "no memory for the plot");
        return false;
    }
    panel->target = plot;
    if (missing != NULL) {
        write_missing(plot, missing);
    } else {
        view->draw(panel, session);
    }
    gb_paint_plot(paint, 1, 1, plot);
    return true;
}

/* Rows for the insets below the curve: a third, if that is enough. */
static int inset_rows(const struct gb_panel_plot *panel, const struct gb_rect *rect)
{
    return panel->view == gb_views_at(0) && rect->rows >= INSET_FROM_ROWS &&
                   rect->cols >= INSET_COLS
               ? rect->rows / INSET_SHARE
               : 0;
}

static void draw_insets(struct gb_panel_plot *panel, const struct gb_paint *paint,
                        const struct gb_session *session, int rows)
{
    const int count = MIN(paint->rect.cols / INSET_COLS, GB_PANEL_INSETS);
    int drawn = 0;
    for (size_t i = 0; i < gb_views_count() && drawn < count; i++) {
        const struct gb_plot_view *view = gb_views_at(i);
        if (!(view->options & GB_VIEW_INSET)) {
            continue;
        }
        const int from = drawn * paint->rect.cols / count;
        const int to = (drawn + 1) * paint->rect.cols / count;
        const struct gb_rect rect = {paint->rect.row + paint->rect.rows - rows,
                                     paint->rect.col + from, rows, to - from};
        const struct gb_paint part = gb_paint_at(paint->term, rect);
        char title[96];
        snprintf(title, sizeof title, "%s %s", view->key, view->title);
        gb_paint_title(&part, title, GB_PAINT_UNFOCUSED);
        draw_view(panel, &panel->inset[drawn++], &part, session, view);
    }
}

void gb_panel_plot_draw(struct gb_panel_plot *panel, const struct gb_paint *paint,
                        const struct gb_session *session, enum gb_paint_focus focus)
{
    char title[96];
    struct gb_paint upper = *paint;
    const int rows = inset_rows(panel, &paint->rect);
    upper.rect.rows -= rows;
    panel->field = (struct gb_rect){upper.rect.row + 1, upper.rect.col + 1,
                                    upper.rect.rows - 3, upper.rect.cols - 2};
    write_title(panel, session, title, sizeof title);
    gb_paint_title(&upper, title, focus);
    if (draw_view(panel, &panel->plot, &upper, session, panel->view) && rows > 0) {
        draw_insets(panel, paint, session, rows);
    }
}
