/* Views of the pressure-density curve and of pairs of its quantities.  The first part
 * draws the legs of a loading path: stress paths, deviatoric stress and volume strain
 * against strain.  The second part draws pressure against density or time: branches of
 * the run, previous curves, quick cell, replicas, measured points and what-ifs, then
 * axes and legend. */
#include "tui/view/view_curve.h"

#include <glib.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/units.h"
#include "scene/loading_kind.h"
#include "scene/path/path.h"
#include "tui/app/leg_editor.h"
#include "tui/session/previous.h"
#include "tui/term/paint.h"
#include "tui/view/views.h"

/* Branches of a curve in any pair of quantities: loading, legs of a loading path,
 * unloading. */

enum { VIEW_RATIO_MARK_LOAD = 1 };

static double ratio(const struct gb_point *point)
{
    return point->branch <= 0 && point->pz_pa > 0.0 ? point->px_pa / point->pz_pa
                                                    : (double)NAN;
}

/* Below this fraction of the highest pressure the ratio is only noise. */
static const double noise = 0.01;

void gb_view_curve_ratio(struct gb_panel_plot *panel, const struct gb_session *session)
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

enum {
    VIEW_LEGS_COLOURS = 5,
    VIEW_LEGS_MARK_LOAD = 1,
    VIEW_LEGS_MARK_UNLOAD = 2,
    VIEW_LEGS_MARKS = 7,
    LABEL = 40
};

enum { ENTRIES = GB_PATH_LEGS_MAX + GB_UNLOAD_MAX + 1 };

/* The quantities of a view at a point, and the labels of its axes. */
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

/* The legs of the run on display; none without a loading path. */
static struct gb_path view_legs_path(const struct gb_session *session)
{
    const struct gb_params *params = gb_session_shown(session).params;
    struct gb_path path = {.count = 0};
    if (!gb_loading_kind_follows_path(params) ||
        !gb_path_parse(&path, params->path, params->dimension, NULL)) {
        path.count = 0;
    }
    return path;
}

/* Line, marker and legend of leg n (from 1). */
static struct gb_plot_series view_legs_style(int leg)
{
    return (struct gb_plot_series){.ink =
                                       GB_PLOT_INK_SERIES + (leg - 1) % VIEW_LEGS_COLOURS,
                                   .marker = gb_leg_editor_mark(leg)};
}

/* Name of leg n in the legend: "shear xz". */
static void view_legs_name(const struct gb_path *path, int leg, char *text, size_t size)
{
    char **words = g_strsplit(path->leg[leg - 1].text, " to ", 2);
    g_strlcpy(text, words[0], size);
    g_strfreev(words);
}

/* The number of the leg of a branch, from 1; 0: no leg, or no loading path. */
static int view_legs_number(const struct gb_path *path, int branch)
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

static void view_legs_draw_axes(struct drawing *drawing)
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

/* Is the point in the branch?  The initial state and loading are one branch. */
static bool is_member(const struct gb_point *point, int branch)
{
    const bool load = point->branch <= 0 && point->branch >= GB_BRANCH_LEG;
    return load ? branch == GB_BRANCH_LOAD : point->branch == branch;
}

/* Gathers the points of a branch, from the point at which the branch starts. */
static size_t view_legs_gather(struct drawing *drawing, int branch)
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

static void view_legs_draw_branch(struct drawing *drawing, int branch)
{
    const int leg = view_legs_number(&drawing->path, branch);
    const size_t count = view_legs_gather(drawing, branch);
    struct gb_plot_series series = {.ink = GB_PLOT_INK_SERIES,
                                    .marker = VIEW_LEGS_MARK_LOAD};
    struct gb_plot_entry *entry = &drawing->entry[drawing->entries];
    if (count == 0 || drawing->entries == ENTRIES) {
        return;
    }
    g_strlcpy(entry->name, branch > 0 ? "unloading" : "loading", sizeof entry->name);
    if (leg > 0) {
        series = view_legs_style(leg);
        view_legs_name(&drawing->path, leg, entry->name, sizeof entry->name);
    } else if (branch > 0) {
        series.ink = GB_PLOT_INK_SERIES + 1 + (branch - 1) % VIEW_LEGS_COLOURS;
        series.marker = VIEW_LEGS_MARK_UNLOAD + (branch - 1) % VIEW_LEGS_MARKS;
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
                              .path = view_legs_path(session),
                              .axes = axes};
    const size_t points = drawing.shown.points;
    if (!gb_panel_plot_reserve(panel, points + 1)) {
        return;
    }
    if (axes.x != mean_pressure) {
        drawing.axes.component = gb_path_strained(&drawing.path);
        label_strain(&drawing.axes);
    }
    view_legs_draw_axes(&drawing);
    view_legs_draw_branch(&drawing, GB_BRANCH_LOAD);
    for (int leg = 2; leg <= drawing.path.count; leg++) {
        view_legs_draw_branch(&drawing, GB_BRANCH_LEG - leg);
    }
    for (int branch = 1; branch <= GB_UNLOAD_MAX; branch++) {
        view_legs_draw_branch(&drawing, branch);
    }
    if (drawing.entries > 1) {
        gb_plot_legend(&panel->plot, drawing.entry, drawing.entries);
    }
    if (panel->cursor_on && panel->cursor < points) {
        put(&drawing, 0, gb_curve_at(drawing.shown.curve, panel->cursor));
        gb_plot_cursor(&panel->plot, panel->x[0], panel->y[0]);
    }
}

void gb_view_curve_stress_path(struct gb_panel_plot *panel,
                               const struct gb_session *session)
{
    draw(panel, session, (struct axes){mean_pressure, deviatoric, 2, "p, MPa", "q, MPa"});
}

void gb_view_curve_stress_strain(struct gb_panel_plot *panel,
                                 const struct gb_session *session)
{
    draw(panel, session, (struct axes){strain, deviatoric, 2, "", "q, MPa"});
}

void gb_view_curve_volume_strain(struct gb_panel_plot *panel,
                                 const struct gb_session *session)
{
    draw(panel, session, (struct axes){strain, volume_strain, 2, "", "volume strain, %"});
}

/* The view of the curve: branches of the run, other curves, axes and legend. */

enum {
    MARK_LOAD = 1,
    MARK_UNLOAD = 2,
    MARK_RELAX = 3,
    MARK_HOLD = 4,
    MARKS = 7,
    COLOURS = 5,
    UNLOAD_SPACING = 7
};

enum { INK_RELAX = GB_PLOT_INK_SERIES + 2, INK_HOLD = GB_PLOT_INK_SERIES + 4 };

static bool is_dynamic(const struct gb_session *session)
{
    return gb_loading_kind_of(gb_session_shown(session).params)->given_rate;
}

static const struct gb_point *point_at(const struct gb_view_curve *view, size_t i)
{
    return gb_curve_at(gb_runner_curve(view->session->runner), i);
}

static bool is_stage_of_cycle(int branch)
{
    return branch < GB_BRANCH_HOLD && branch >= GB_BRANCH_LEAST;
}

/* Is the point on the branch?  The initial state of a quasi-static run is part of
 * loading, since it has no stages. */
static bool on_branch(const struct gb_point *point, int branch, bool dynamic)
{
    if (!dynamic && point->branch <= 0 && point->branch >= GB_BRANCH_LEG &&
        !is_stage_of_cycle(point->branch)) {
        return branch == GB_BRANCH_LOAD;
    }
    return point->branch == branch;
}

/* x coordinate of a point: relative density, ns or step. */
static double view_curve_x(const struct gb_view_curve *view, const struct gb_point *point)
{
    return gb_panel_plot_cursor_x(view->panel, view->session, point);
}

static void put_point(const struct gb_view_curve *view, size_t at,
                      const struct gb_point *point)
{
    view->panel->x[at] = view_curve_x(view, point);
    view->panel->y[at] = point->p_pa / view->unit_pa;
}

static bool against_time(const struct gb_view_curve *view)
{
    return view->panel->view->abscissa == GB_VIEW_ELAPSED;
}

/* Gathers the points of a branch in the panel.  A branch starts at the point that it
 * leaves: a stage or a leg at the last point of the previous one, an unloading branch
 * at its point of the loading branch.  Against time, NaN separates it from branches in
 * between. */
static size_t gather(const struct gb_view_curve *view, int branch, double *from_pa)
{
    const bool dynamic = is_dynamic(view->session);
    const bool against_time = view->panel->view->abscissa == GB_VIEW_ELAPSED;
    const struct gb_point *root = NULL;
    size_t n = 0;
    bool gap = false;
    for (size_t i = 0; i < view->session->points; i++) {
        const struct gb_point *point = point_at(view, i);
        const bool member = on_branch(point, branch, dynamic);
        if (member && n == 0 && root != NULL) {
            put_point(view, n++, root);
        } else if (member && gap && against_time) {
            view->panel->x[n] = NAN;
            view->panel->y[n++] = NAN;
        }
        if (member) {
            put_point(view, n++, point);
            *from_pa = point->branch_from_pa;
        }
        gap = !member;
        root = point->branch <= 0 ? point : root;
    }
    return n;
}

/* Colour, marker and legend of a branch. */
static struct gb_plot_series branch_style(int branch, bool dynamic, double from_pa,
                                          char *name, size_t size)
{
    if (branch > 0) {
        char pressure[32];
        gb_units_format_short(from_pa, GB_DIM_PRESSURE, 3, pressure, sizeof pressure);
        snprintf(name, size, "unloading from %s", pressure);
        return (struct gb_plot_series){.ink = GB_PLOT_INK_SERIES + 1 +
                                              (branch - 1) % COLOURS,
                                       .marker = MARK_UNLOAD + (branch - 1) % MARKS,
                                       .spacing = UNLOAD_SPACING};
    }
    const bool stage = dynamic || is_stage_of_cycle(branch);
    g_strlcpy(name, stage ? gb_panel_plot_stage(branch) : "loading", size);
    switch (branch) {
    case GB_BRANCH_RELAX:
        return (struct gb_plot_series){.ink = INK_RELAX, .marker = MARK_RELAX};
    case GB_BRANCH_HOLD:
        return (struct gb_plot_series){.ink = INK_HOLD, .marker = MARK_HOLD};
    case GB_BRANCH_UNLOAD:
    case GB_BRANCH_CONFINED:
    case GB_BRANCH_EJECT:
    case GB_BRANCH_EJECTED:
        return (struct gb_plot_series){.ink =
                                           GB_PLOT_INK_SERIES + GB_BRANCH_HOLD - branch,
                                       .marker = MARK_HOLD + GB_BRANCH_HOLD - branch};
    default:
        return (struct gb_plot_series){.ink = GB_PLOT_INK_SERIES, .marker = MARK_LOAD};
    }
}

/* Writes "dense: loading" for a run named by the user. */
static void name_run(const struct gb_view_curve *view, char *name, size_t size)
{
    const char *given = view->session->run_label.name;
    if (given[0] != '\0') {
        char *whole = g_strdup_printf("%s: %s", given, name);
        gb_paint_fit_copy(name, size, whole);
        g_free(whole);
    }
}

/* Draws a line and adds it to the legend. */
static void view_curve_add(struct gb_view_curve *view,
                           const struct gb_plot_series *series, const char *name)
{
    gb_plot_line(&view->panel->plot, series);
    if (view->entries < GB_VIEW_CURVE_ENTRIES) {
        struct gb_plot_entry *entry = &view->entry[view->entries++];
        entry->ink = series->ink;
        entry->marker = series->marker;
        gb_paint_fit_copy(entry->name, sizeof entry->name, name);
    }
}

static int kind_of(const struct gb_session *session)
{
    return gb_session_shown(session).params->kind;
}

/* Is the quick cell drawn?  A superseded quick curve is hidden with the previous
 * curves.  Against the step number, quick cells of quasi-static runs are hidden,
 * because their strain steps are longer. */
static bool view_curve_quick_shown(const struct gb_view_curve *view)
{
    const struct gb_session *session = view->session;
    return session->quick_cell.points > 0 &&
           (!against_time(view) || gb_loading_kind_at(kind_of(session))->given_rate) &&
           !(view->panel->hide_previous && gb_view_curve_quick_superseded(session));
}

/* Is a curve of another run drawn in colour?  The run then has a single colour. */
static bool view_curve_several(const struct gb_view_curve *view)
{
    const struct gb_session *session = view->session;
    bool several = session->runner != NULL && view_curve_quick_shown(view) &&
                   !gb_view_curve_quick_superseded(session);
    for (int k = 0; k < session->previous_count; k++) {
        const struct gb_previous_curve *previous = &session->previous[k];
        several |= previous->label.colour > 0 &&
                   gb_previous_list_shown(previous, view->panel->hide_previous);
    }
    return several;
}

static void draw_branch(struct gb_view_curve *view, int branch)
{
    double from_pa = 0.0;
    char name[GB_PLOT_NAME];
    const size_t count = gather(view, branch, &from_pa);
    if (count == 0) {
        return;
    }
    struct gb_plot_series series =
        branch_style(branch, is_dynamic(view->session), from_pa, name, sizeof name);
    const int leg = view_legs_number(&view->path, branch);
    if (leg > 0) {
        series = view_legs_style(leg);
        view_legs_name(&view->path, leg, name, sizeof name);
    }
    if (view_curve_several(view)) {
        series.ink = GB_PLOT_INK_SERIES;
    }
    series.x = view->panel->x;
    series.y = view->panel->y;
    series.count = count;
    name_run(view, name, sizeof name);
    view_curve_add(view, &series, name);
}

static int last_branch(const struct gb_view_curve *view)
{
    int last = 0;
    for (size_t i = 0; i < view->session->points; i++) {
        last = MAX(last, point_at(view, i)->branch);
    }
    return last;
}

/* Draws unloading branches first and loading on top.  The legend lists the last line
 * first, so stages are drawn in reverse order of time. */
static void view_curve_branches(struct gb_view_curve *view)
{
    for (int branch = last_branch(view); branch > 0; branch--) {
        draw_branch(view, branch);
    }
    for (int leg = view->path.count; leg > 1; leg--) {
        draw_branch(view, GB_BRANCH_LEG - leg);
    }
    for (int branch = GB_BRANCH_LEAST; branch <= GB_BRANCH_HOLD; branch++) {
        draw_branch(view, branch);
    }
    draw_branch(view, GB_BRANCH_LOAD);
    draw_branch(view, GB_BRANCH_RELAX);
}

enum { MARK_MEASURED = 5, REPLICA_SPACING = 8 };

/* Measurements have markers in the colour of text; other colours are for runs. */
enum { INK_MEASURED = GB_PLOT_INK_TEXT };

/* x coordinates of a previous curve; NULL: it has nanoseconds and the run has steps, or
 * the reverse. */
static const double *view_curve_previous_x(const struct gb_view_curve *view,
                                           const struct gb_previous_curve *previous)
{
    if (!against_time(view)) {
        return previous->density;
    }
    return previous->params.kind == kind_of(view->session) ? previous->elapsed : NULL;
}

/* Previous curves, quick cell, replicas, measured data, what-ifs. */
static void view_curve_previous(struct gb_view_curve *view)
{
    const struct gb_session *session = view->session;
    struct gb_panel_plot *panel = view->panel;
    for (int k = 0; k < session->previous_count; k++) {
        const struct gb_previous_curve *previous = &session->previous[k];
        const double *x = view_curve_previous_x(view, previous);
        if (x == NULL || !gb_previous_list_shown(previous, panel->hide_previous)) {
            continue;
        }
        if (!gb_panel_plot_reserve(panel, previous->count)) {
            return;
        }
        for (size_t i = 0; i < previous->count; i++) {
            panel->y[i] = previous->pressure_pa[i] / view->unit_pa;
        }
        const struct gb_plot_series series = {
            .x = x,
            .y = panel->y,
            .count = previous->count,
            .ink = gb_views_curve_ink(previous->label.colour),
            .marker = previous->label.marker};
        view_curve_add(view, &series, gb_previous_list_name(previous));
    }
}

/* Writes ": mu 0.2" if these parameters differ from those of the run, else "". */
static void write_difference(const struct gb_session *session,
                             const struct gb_params *params, char *text, size_t size)
{
    char difference[GB_PARAMS_DIFF_TEXT];
    text[0] = '\0';
    if (session->runner != NULL &&
        gb_previous_diff_count(params, gb_runner_params(session->runner)) > 0) {
        gb_previous_diff_text(params, gb_runner_params(session->runner), difference,
                              sizeof difference);
        snprintf(text, size, ": %s", difference);
    }
}

/* Draws the quick cell in the next colour until the full cell is started, then dim. */
static void view_curve_quick(struct gb_view_curve *view)
{
    const struct gb_session *session = view->session;
    const struct gb_quick_cell *quick = &session->quick_cell;
    struct gb_panel_plot *panel = view->panel;
    char difference[GB_PARAMS_DIFF_TEXT + 2];
    char name[sizeof difference + 48];
    if (!view_curve_quick_shown(view) || !gb_panel_plot_reserve(panel, quick->points)) {
        return;
    }
    for (size_t i = 0; i < quick->points; i++) {
        const struct gb_point *point = gb_curve_at(gb_runner_curve(quick->runner), i);
        panel->x[i] = view_curve_x(view, point);
        panel->y[i] = point->p_pa / view->unit_pa;
    }
    const bool superseded = gb_view_curve_quick_superseded(session);
    const struct gb_plot_series series = {
        .x = panel->x,
        .y = panel->y,
        .count = quick->points,
        .ink = superseded ? GB_PLOT_INK_DIM : gb_view_curve_quick_ink(session),
        .marker = 'q'};
    write_difference(session, &quick->full_params, difference, sizeof difference);
    snprintf(name, sizeof name, "quick cell, N %lld%s",
             (long long)gb_runner_params(quick->runner)->count, difference);
    view_curve_add(view, &series, name);
}

static const struct gb_runset_view_group *
view_curve_replicas(const struct gb_view_curve *view)
{
    return against_time(view) ? NULL : gb_session_replicas(view->session);
}

/* Shifts the mean of the replicas by a number of standard errors. */
static void shift_mean(const struct gb_view_curve *view, double errors,
                       double x[GB_RUNSET_VIEW_LEVELS], double y[GB_RUNSET_VIEW_LEVELS])
{
    const struct gb_runset_view_group *group = view_curve_replicas(view);
    for (size_t k = 0; k < view->session->replica_band.runset.levels; k++) {
        x[k] = group->mean[k] + (errors != 0.0 ? errors * group->error[k] : 0.0);
        y[k] = view->session->replica_band.runset.level_pa[k] / view->unit_pa;
    }
}

/* Draws the mean of the replicas in a band of two standard errors on both sides. */
static void draw_replicas(struct gb_view_curve *view)
{
    const struct gb_runset_view_group *group = view_curve_replicas(view);
    double low[GB_RUNSET_VIEW_LEVELS], x[GB_RUNSET_VIEW_LEVELS];
    double y[GB_RUNSET_VIEW_LEVELS];
    char difference[GB_PARAMS_DIFF_TEXT + 2];
    char name[sizeof difference + 48];
    if (group == NULL) {
        return;
    }
    const size_t count = view->session->replica_band.runset.levels;
    shift_mean(view, -GB_VIEW_BAND_ERRORS, low, y);
    shift_mean(view, GB_VIEW_BAND_ERRORS, x, y);
    gb_plot_band(&view->panel->plot,
                 &(struct gb_plot_band){
                     .x = {low, x}, .y = {y, y}, .count = count, .ink = GB_PLOT_INK_DIM});
    shift_mean(view, 0.0, x, y);
    const struct gb_plot_series series = {.x = x,
                                          .y = y,
                                          .count = count,
                                          .ink = GB_VIEW_INK_REPLICAS,
                                          .marker = 'R',
                                          .spacing = REPLICA_SPACING};
    write_difference(view->session, &view->session->replica_band.params, difference,
                     sizeof difference);
    snprintf(name, sizeof name, "mean of %zu %s%s%s", group->members,
             group->members == 1 ? "cell" : "cells",
             group->members == 1 ? "" : ", +- 2 errors", difference);
    view_curve_add(view, &series, name);
}

static enum gb_plot_range_of across(const struct gb_view_curve *view)
{
    return against_time(view) ? GB_PLOT_RANGE_TIME : GB_PLOT_RANGE_DENSITY;
}

/* Draws a marker with its standard errors as lines; NaN draws nothing. */
static void draw_measured_point(struct gb_view_curve *view, size_t i)
{
    const struct gb_measured *data = view->session->measured;
    const double x = data->density[i];
    const double y = data->pressure_pa[i] / view->unit_pa;
    const double dx = data->density_error[i];
    const double dy = data->pressure_error_pa[i] / view->unit_pa;
    const struct gb_plot_series across = {.x = (double[]){x - dx, x + dx},
                                          .y = (double[]){y, y},
                                          .count = 2,
                                          .ink = INK_MEASURED};
    const struct gb_plot_series up = {.x = (double[]){x, x},
                                      .y = (double[]){y - dy, y + dy},
                                      .count = 2,
                                      .ink = INK_MEASURED};
    const struct gb_plot_series marker = {.x = &x,
                                          .y = &y,
                                          .count = 1,
                                          .ink = INK_MEASURED,
                                          .marker = MARK_MEASURED,
                                          .points = true};
    gb_plot_line(&view->panel->plot, &across);
    gb_plot_line(&view->panel->plot, &up);
    gb_plot_line(&view->panel->plot, &marker);
}

static void view_curve_measured(struct gb_view_curve *view)
{
    const struct gb_measured *data = gb_session_measured(view->session);
    struct gb_measured_misfit misfit;
    char name[GB_PLOT_NAME] = "measured";
    if (data == NULL || view->panel->view->abscissa != GB_VIEW_DENSITY) {
        return;
    }
    for (size_t i = 0; i < data->count; i++) {
        draw_measured_point(view, i);
    }
    gb_session_misfit(view->session, &misfit);
    if (misfit.reached > 0) {
        snprintf(name, sizeof name, "measured, RMS misfit %.2f %%", 100.0 * misfit.rms);
    }
    const struct gb_plot_series named = {
        .ink = INK_MEASURED, .marker = MARK_MEASURED, .points = true};
    view_curve_add(view, &named, name);
}

/* Draws a letter where a what-if began. */
static void view_curve_what_ifs(struct gb_view_curve *view)
{
    const struct gb_session *session = view->session;
    for (int i = 0; i < session->whatifs; i++) {
        const size_t at = session->whatif_at[i];
        if (at == 0 || at > session->points) {
            continue;
        }
        const struct gb_point *point =
            gb_curve_at(gb_runner_curve(session->runner), at - 1);
        const double x = view_curve_x(view, point);
        const double y = point->p_pa / view->unit_pa;
        gb_plot_line(&view->panel->plot,
                     &(struct gb_plot_series){.x = &x,
                                              .y = &y,
                                              .count = 1,
                                              .ink = GB_PLOT_INK_CURSOR,
                                              .marker = 'f',
                                              .points = true});
    }
}

/* Largest ratio of pressures on a logarithmic axis; smaller pressures come from single
 * contacts. */
static const double log_range = 1e5;

/* Pressure from which an axis is in GPa. */
static const double giga_from_pa = 9.9e9;

double gb_view_curve_unit(double highest_pa)
{
    return highest_pa >= giga_from_pa ? 1e9 : 1e6;
}

const char *gb_view_curve_unit_label(double unit_pa)
{
    return unit_pa > 1e6 ? "p, GPa" : "p, MPa";
}

bool gb_view_curve_quick_superseded(const struct gb_session *session)
{
    return session->runner != NULL && !gb_session_quick_cell_live(&session->quick_cell) &&
           gb_previous_diff_count(&session->quick_cell.full_params,
                                  gb_runner_params(session->runner)) == 0;
}

int gb_view_curve_quick_ink(const struct gb_session *session)
{
    const int colour = gb_previous_list_free_colour(session);
    return colour > 0 ? gb_views_curve_ink(colour) : GB_PLOT_INK_TEXT;
}

/* Range of the data. */
struct ends {
    const struct gb_plot_ranges *typed;
    enum gb_plot_range_of across; /* quantity of the x axis */
    double x[2], y[2], min_positive;
};

/* Extends the ranges by a point.  Points outside a typed range do not extend the other
 * axis. */
static void extend(struct ends *ends, double x, double y)
{
    if (!isfinite(x) || !isfinite(y) ||
        !gb_panel_plot_ranges_inside(ends->typed, ends->across, x) ||
        !gb_panel_plot_ranges_inside(ends->typed, GB_PLOT_RANGE_PRESSURE, y)) {
        return;
    }
    ends->x[0] = fmin(ends->x[0], x);
    ends->x[1] = fmax(ends->x[1], x);
    ends->y[0] = fmin(ends->y[0], y);
    ends->y[1] = fmax(ends->y[1], y);
    if (y > 0.0) {
        ends->min_positive = fmin(ends->min_positive, y);
    }
}

static void extend_by_curve(struct ends *ends, const struct gb_view_curve *view,
                            const struct gb_curve *curve, size_t points)
{
    for (size_t i = 0; i < points; i++) {
        const struct gb_point *point = gb_curve_at(curve, i);
        extend(ends, view_curve_x(view, point), point->p_pa);
    }
}

static void extend_by_overlays(struct ends *ends, const struct gb_view_curve *view)
{
    const struct gb_session *session = view->session;
    const struct gb_measured *data = gb_session_measured(session);
    for (size_t i = 0; data != NULL && !against_time(view) && i < data->count; i++) {
        extend(ends, data->density[i], data->pressure_pa[i]);
    }
    for (int k = 0; k < session->previous_count; k++) {
        const struct gb_previous_curve *previous = &session->previous[k];
        const double *x = gb_previous_list_shown(previous, view->panel->hide_previous)
                              ? view_curve_previous_x(view, previous)
                              : NULL;
        for (size_t i = 0; x != NULL && i < previous->count; i++) {
            extend(ends, x[i], previous->pressure_pa[i]);
        }
    }
    const struct gb_runset_view_group *band = view_curve_replicas(view);
    for (size_t k = 0; band != NULL && k < session->replica_band.runset.levels; k++) {
        extend(ends, band->mean[k], session->replica_band.runset.level_pa[k]);
    }
}

static struct ends find_ends(const struct gb_view_curve *view)
{
    const struct gb_session *session = view->session;
    struct ends ends = {&view->panel->ranges,
                        across(view),
                        {HUGE_VAL, -HUGE_VAL},
                        {HUGE_VAL, -HUGE_VAL},
                        HUGE_VAL};
    if (session->runner != NULL) {
        extend_by_curve(&ends, view, gb_runner_curve(session->runner), session->points);
    }
    if (view_curve_quick_shown(view)) {
        extend_by_curve(&ends, view, gb_runner_curve(session->quick_cell.runner),
                        session->quick_cell.points);
    }
    extend_by_overlays(&ends, view);
    ends.y[0] = view->panel->log && ends.y[1] > 0.0
                    ? fmax(ends.min_positive, ends.y[1] / log_range)
                    : fmin(ends.y[0], 0.0);
    return ends;
}

static void draw_axes(struct gb_view_curve *view)
{
    struct ends ends = find_ends(view);
    const struct gb_plot_ranges *typed = &view->panel->ranges;
    const char *x_label = !against_time(view) ? "relative density"
                          : gb_loading_kind_at(kind_of(view->session))->given_rate
                              ? "t, ns"
                              : "step";
    view->unit_pa = gb_view_curve_unit(ends.y[1]);
    view->panel->unit_pa = view->unit_pa;
    double y_ends[2] = {ends.y[0] / view->unit_pa, ends.y[1] / view->unit_pa};
    gb_panel_plot_ranges_x(typed, across(view), 1.0, &view->panel->plot, ends.x);
    gb_panel_plot_ranges_y(typed, GB_PLOT_RANGE_PRESSURE, view->unit_pa,
                           &view->panel->plot, y_ends);
    gb_plot_axes(&view->panel->plot, ends.x, y_ends,
                 view->panel->log ? GB_PLOT_LOG : GB_PLOT_LINEAR, x_label,
                 gb_view_curve_unit_label(view->unit_pa));
}

/* Writes the text of the empty plot before the first point. */
static void draw_waiting(const struct gb_view_curve *view)
{
    const struct gb_session_shown shown = gb_session_shown(view->session);
    const char *text = shown.curve == NULL ? "not started: r starts it"
                       : shown.state == GB_RUN_PACKING
                           ? "building the initial structure ..."
                           : "waiting for the first point ...";
    struct gb_plot *plot = &view->panel->plot;
    gb_plot_text(plot, plot->top + plot->field_rows / 2,
                 plot->left + (plot->field_cols - (int)strlen(text)) / 2,
                 GB_PLOT_INK_TEXT, text);
}

/* Draws the legend, with the last line first, because it is on top. */
static void draw_legend(struct gb_view_curve *view)
{
    for (int i = 0; i < view->entries / 2; i++) {
        const struct gb_plot_entry entry = view->entry[i];
        view->entry[i] = view->entry[view->entries - 1 - i];
        view->entry[view->entries - 1 - i] = entry;
    }
    gb_plot_legend(&view->panel->plot, view->entry, view->entries);
}

static void draw_cursor(const struct gb_view_curve *view)
{
    const struct gb_session_shown shown = gb_session_shown(view->session);
    struct gb_panel_plot *panel = view->panel;
    if (gb_panel_plot_pressure_shown(panel) && !against_time(view)) {
        const double density = gb_panel_plot_pressure_density(panel, view->session);
        if (isfinite(density)) {
            gb_plot_cursor(&panel->plot, density, panel->at_pa / view->unit_pa);
        }
    } else if (panel->cursor_on && panel->cursor < shown.points) {
        const struct gb_point *point = gb_curve_at(shown.curve, panel->cursor);
        gb_plot_cursor(&panel->plot, view_curve_x(view, point),
                       point->p_pa / view->unit_pa);
    }
}

void gb_view_curve_draw(struct gb_panel_plot *panel, const struct gb_session *session)
{
    struct gb_view_curve view = {
        .panel = panel, .session = session, .path = view_legs_path(session)};
    draw_axes(&view);
    view_curve_previous(&view);
    view_curve_quick(&view);
    draw_replicas(&view);
    view_curve_measured(&view);
    if (session->points > 0 && gb_panel_plot_reserve(panel, 2 * session->points + 1)) {
        view_curve_branches(&view);
        view_curve_what_ifs(&view);
    } else if (session->quick_cell.points == 0) {
        draw_waiting(&view);
        return;
    }
    draw_legend(&view);
    draw_cursor(&view);
}
