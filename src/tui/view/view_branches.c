#include <math.h>
#include <stdio.h>

#include <glib.h>

#include "base/units.h"
#include "scene/loading_kind.h"
#include "tui/term/text_fit.h"
#include "tui/view/view_curve.h"
#include "tui/view/view_legs.h"

/* Branches of the run's curve: loading, unloading, and the stages of a dynamic run. */

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

/* A quasi-static run has no stages: its initial state is part of loading. */
static bool on_branch(const struct gb_point *point, int branch, bool dynamic)
{
    if (!dynamic && point->branch <= 0 && point->branch >= GB_BRANCH_LEG &&
        !is_stage_of_cycle(point->branch)) {
        return branch == GB_BRANCH_LOAD;
    }
    return point->branch == branch;
}

static void put_point(const struct gb_view_curve *view, size_t at,
                      const struct gb_point *point)
{
    view->panel->x[at] = gb_view_curve_x(view, point);
    view->panel->y[at] = point->p_pa / view->unit_pa;
}

/* Collects the points of a branch in the panel.  A branch starts at the point that it
 * leaves: a stage or a leg at the last point of the one before, an unloading branch at its point
 * of the loading branch.  Against time, NaN separates it from branches in between. */
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

/* "dense: loading" of a run that the user has named. */
static void name_run(const struct gb_view_curve *view, char *name, size_t size)
{
    const char *given = view->session->run_label.name;
    if (given[0] != '\0') {
        char *whole = g_strdup_printf("%s: %s", given, name);
        gb_text_fit_copy(name, size, whole);
        g_free(whole);
    }
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
    const int leg = gb_view_legs_number(&view->path, branch);
    if (leg > 0) {
        series = gb_view_legs_style(leg);
        gb_view_legs_name(&view->path, leg, name, sizeof name);
    }
    if (gb_view_curve_several(view)) {
        series.ink = GB_PLOT_INK_SERIES;
    }
    series.x = view->panel->x;
    series.y = view->panel->y;
    series.count = count;
    name_run(view, name, sizeof name);
    gb_view_curve_add(view, &series, name);
}

static int last_branch(const struct gb_view_curve *view)
{
    int last = 0;
    for (size_t i = 0; i < view->session->points; i++) {
        last = MAX(last, point_at(view, i)->branch);
    }
    return last;
}

/* Unloading branches are drawn first, loading on top.  The legend lists the last line
 * first: stages are drawn in reverse order of time. */
void gb_view_branches_draw(struct gb_view_curve *view)
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
