#include "tui/view/view_legs.h"

#include <glib.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "scene/loading_kind.h"
#include "tui/legs/leg_sketch.h"
#include "tui/view/views.h"

enum { VIEW_RATIO_MARK_LOAD = 1 };

static double ratio(const struct gb_point *point)
{
    return point->branch <= 0 && point->pz_pa > 0.0 ? point->px_pa / point->pz_pa
                                                    : (double)NAN;
}

/* Below this fraction of the highest pressure the ratio is noise. */
static const double noise = 0.01;

void gb_view_legs_ratio(struct gb_panel_plot *panel, const struct gb_session *session)
{
    const struct gb_session_shown shown = gb_session_shown(session);
    struct gb_plot *plot = &panel->plot;
    double x_ends[2] = {HUGE_VAL, -HUGE_VAL};
    double y_ends[2] = {0.0, 1.2};
    double max = 0.0;
    size_t count = 0;
    for (size_t i = 0; i < shown.points; i++) {
        max = fmax(max, gb_curve_at(shown.curve, i)->pz_pa);
    }
    if (shown.points < 2 || !gb_panel_plot_reserve(panel, shown.points)) {
        gb_plot_text(plot, plot->rows / 2, 2, GB_PLOT_INK_TEXT, "no points yet");
        return;
    }
    for (size_t i = 0; i < shown.points; i++) {
        const struct gb_point *point = gb_curve_at(shown.curve, i);
        const double value = point->pz_pa > noise * max ? ratio(point) : (double)NAN;
        panel->x[count] = point->density;
        panel->y[count++] = value;
        if (isfinite(value)) {
            x_ends[0] = fmin(x_ends[0], point->density);
            x_ends[1] = fmax(x_ends[1], point->density);
        }
    }
    gb_panel_plot_ranges_x(&panel->ranges, GB_PLOT_RANGE_DENSITY, 1.0, plot, x_ends);
    gb_panel_plot_ranges_y(&panel->ranges, GB_PLOT_RANGE_RATIO, 1.0, plot, y_ends);
    gb_plot_axes(plot, x_ends, y_ends, GB_PLOT_LINEAR, "relative density",
                 "px/pz, loading");
    const double one[2] = {1.0, 1.0};
    const double ends[2] = {plot->x.low, plot->x.high};
    gb_plot_line(plot, &(struct gb_plot_series){
                           .x = ends, .y = one, .count = 2, .ink = GB_PLOT_INK_AXIS});
    gb_plot_line(plot, &(struct gb_plot_series){.x = panel->x,
                                                .y = panel->y,
                                                .count = count,
                                                .ink = GB_PLOT_INK_SERIES,
                                                .marker = VIEW_RATIO_MARK_LOAD});
    if (panel->cursor_on && panel->cursor < shown.points) {
        gb_plot_cursor(plot, panel->x[panel->cursor], panel->y[panel->cursor]);
    }
}

/* Views of the legs: the path in (p, q), q and volume strain against strain. */

enum { COLOURS = 5, MARK_LOAD = 1, MARK_UNLOAD = 2, MARKS = 7, LABEL = 40 };

enum { ENTRIES = GB_PATH_LEGS_MAX + GB_UNLOAD_MAX + 1 };

/* What a view shows of a point, and the labels of its axes. */
struct axes {
    double (*x)(const struct gb_point *point, int component);
    double (*y)(const struct gb_point *point, int component);
    int component; /* of the strain */
    char x_label[LABEL];
    const char *y_label;
};

struct drawing {
    struct gb_panel_plot *panel;
    struct gb_session_shown shown;
    struct gb_path path;
    struct axes axes;
    struct gb_plot_entry entry[ENTRIES];
    int entries;
};

struct gb_path gb_view_legs_path(const struct gb_session *session)
{
    const struct gb_params *params = gb_session_shown(session).params;
    struct gb_path path = {.count = 0};
    if (!gb_loading_kind_follows_path(params) ||
        !gb_path_parse(&path, params->path, params->dimension, NULL)) {
        path.count = 0;
    }
    return path;
}

struct gb_plot_series gb_view_legs_style(int leg)
{
    return (struct gb_plot_series){.ink = GB_PLOT_INK_SERIES + (leg - 1) % COLOURS,
                                   .marker = gb_leg_sketch_mark(leg)};
}

void gb_view_legs_name(const struct gb_path *path, int leg, char *text, size_t size)
{
    char **words = g_strsplit(path->leg[leg - 1].text, " to ", 2);
    g_strlcpy(text, words[0], size);
    g_strfreev(words);
}

int gb_view_legs_number(const struct gb_path *path, int branch)
{
    const int leg = branch < GB_BRANCH_LEG     ? GB_BRANCH_LEG - branch
                    : branch == GB_BRANCH_LOAD ? 1
                                               : 0;
    return leg <= path->count ? leg : 0;
}

/* --- quantities ------------------------------------------------------------------- */

static double mean_pressure(const struct gb_point *point, int component)
{
    (void)component;
    return 1e-6 * (isfinite(point->py_pa)
                       ? (point->px_pa + point->py_pa + point->pz_pa) / 3.0
                       : 0.5 * (point->px_pa + point->pz_pa));
}

static double deviatoric(const struct gb_point *point, int component)
{
    (void)component;
    return 1e-6 * point->q_pa;
}

static double strain(const struct gb_point *point, int component)
{
    return 100.0 * point->strain[component];
}

static double volume_strain(const struct gb_point *point, int component)
{
    (void)component;
    const double y = isfinite(point->strain[1]) ? point->strain[1] : 0.0;
    return 100.0 * (point->strain[0] + y + point->strain[2]);
}

static void label_strain(struct axes *axes)
{
    snprintf(axes->x_label, sizeof axes->x_label,
             axes->component >= 3 ? "shear strain %s, %%" : "axial strain %s, %%",
             gb_path_component_name(axes->component));
}

/* --- drawing ---------------------------------------------------------------------- */

static void put(struct drawing *drawing, size_t at, const struct gb_point *point)
{
    const struct axes *axes = &drawing->axes;
    drawing->panel->x[at] = axes->x(point, axes->component);
    drawing->panel->y[at] = axes->y(point, axes->component);
}

static void draw_axes(struct drawing *drawing)
{
    double x[2] = {HUGE_VAL, -HUGE_VAL}, y[2] = {0.0, 0.0};
    for (size_t i = 0; i < drawing->shown.points; i++) {
        put(drawing, 0, gb_curve_at(drawing->shown.curve, i));
        x[0] = fmin(x[0], drawing->panel->x[0]);
        x[1] = fmax(x[1], drawing->panel->x[0]);
        y[0] = fmin(y[0], drawing->panel->y[0]);
        y[1] = fmax(y[1], drawing->panel->y[0]);
    }
    gb_plot_axes(&drawing->panel->plot, x, y, GB_PLOT_LINEAR, drawing->axes.x_label,
                 drawing->axes.y_label);
}

/* Initial state and loading are one branch. */
static bool is_member(const struct gb_point *point, int branch)
{
    const bool load = point->branch <= 0 && point->branch >= GB_BRANCH_LEG;
    return load ? branch == GB_BRANCH_LOAD : point->branch == branch;
}

/* A branch begins at the point that it leaves. */
static size_t gather(struct drawing *drawing, int branch)
{
    const struct gb_point *root = NULL;
    size_t count = 0;
    for (size_t i = 0; i < drawing->shown.points; i++) {
        const struct gb_point *point = gb_curve_at(drawing->shown.curve, i);
        if (is_member(point, branch)) {
            if (count == 0 && root != NULL) {
                put(drawing, count++, root);
            }
            put(drawing, count++, point);
        }
        root = point->branch <= 0 ? point : root;
    }
    return count;
}

static void draw_branch(struct drawing *drawing, int branch)
{
    const int leg = gb_view_legs_number(&drawing->path, branch);
    const size_t count = gather(drawing, branch);
    struct gb_plot_series series = {.ink = GB_PLOT_INK_SERIES, .marker = MARK_LOAD};
    struct gb_plot_entry *entry = &drawing->entry[drawing->entries];
    if (count == 0 || drawing->entries == ENTRIES) {
        return;
    }
    g_strlcpy(entry->name, branch > 0 ? "unloading" : "loading", sizeof entry->name);
    if (leg > 0) {
        series = gb_view_legs_style(leg);
        gb_view_legs_name(&drawing->path, leg, entry->name, sizeof entry->name);
    } else if (branch > 0) {
        series.ink = GB_PLOT_INK_SERIES + 1 + (branch - 1) % COLOURS;
        series.marker = MARK_UNLOAD + (branch - 1) % MARKS;
    }
    series.x = drawing->panel->x;
    series.y = drawing->panel->y;
    series.count = count;
    gb_plot_line(&drawing->panel->plot, &series);
    entry->ink = series.ink;
    entry->marker = series.marker;
    drawing->entries++;
}

static void draw(struct gb_panel_plot *panel, const struct gb_session *session,
                 struct axes axes)
{
    struct drawing drawing = {.panel = panel,
                              .shown = gb_session_shown(session),
                              .path = gb_view_legs_path(session),
                              .axes = axes};
    const size_t points = drawing.shown.points;
    if (!gb_panel_plot_reserve(panel, points + 1)) {
        return;
    }
    if (axes.x != mean_pressure) {
        drawing.axes.component = gb_path_strained(&drawing.path);
        label_strain(&drawing.axes);
    }
    draw_axes(&drawing);
    draw_branch(&drawing, GB_BRANCH_LOAD);
    for (int leg = 2; leg <= drawing.path.count; leg++) {
        draw_branch(&drawing, GB_BRANCH_LEG - leg);
    }
    for (int branch = 1; branch <= GB_UNLOAD_MAX; branch++) {
        draw_branch(&drawing, branch);
    }
    if (drawing.entries > 1) {
        gb_plot_legend(&panel->plot, drawing.entry, drawing.entries);
    }
    if (panel->cursor_on && panel->cursor < points) {
        put(&drawing, 0, gb_curve_at(drawing.shown.curve, panel->cursor));
        gb_plot_cursor(&panel->plot, panel->x[0], panel->y[0]);
    }
}

void gb_view_legs_stress_path(struct gb_panel_plot *panel,
                              const struct gb_session *session)
{
    draw(panel, session, (struct axes){mean_pressure, deviatoric, 2, "p, MPa", "q, MPa"});
}

void gb_view_legs_stress_strain(struct gb_panel_plot *panel,
                                const struct gb_session *session)
{
    draw(panel, session, (struct axes){strain, deviatoric, 2, "", "q, MPa"});
}

void gb_view_legs_volume_strain(struct gb_panel_plot *panel,
                                const struct gb_session *session)
{
    draw(panel, session, (struct axes){strain, volume_strain, 2, "", "volume strain, %"});
}
