#include <glib.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/number.h"
#include "tui/term/paint.h"
#include "tui/view/views.h"

enum { EQUATIONS = 4, SAMPLES = 96, ENTRIES = EQUATIONS + 2 };

/* Least number of lines in the list of fits below the axes, and rows of the plot per
 * line. */
enum { LIST_LEAST = 3, ROWS_PER_LINE = 3 };
enum { MARK_LOAD = 1 };

/* Width of a plot from which the legend has intervals. */
enum { COLUMNS_INTERVALS = 90 };

/* Pressure from which the axis is in GPa. */
static const double giga_from_mpa = 9.9e3;

/* A fit and where it is drawn, MPa. */
struct line {
    const struct gb_equation_fit *fit; /* NULL: the loading branch itself */
    double from, to;
};

/* State of the drawing. */
struct view {
    struct gb_panel_plot *panel;
    const struct gb_compaction_cache *cache;
    double unit_mpa; /* unit of the pressure axis */
    struct gb_plot_entry entry[ENTRIES];
    struct line line[ENTRIES];
    int entries;
    int room; /* lines of the list; it has the loading branch if all fits fit */
};

/* Adds a line with its entry in the legend, in the next colour and marker. */
static void add(struct view *view, const struct line *line, const char *name)
{
    struct gb_plot_entry *entry = &view->entry[view->entries];
    entry->ink = GB_PLOT_INK_SERIES + view->entries % GB_PLOT_COLOURS;
    entry->marker = MARK_LOAD + view->entries;
    gb_paint_fit_copy(entry->name, sizeof entry->name, name);
    view->line[view->entries++] = *line;
}

/* "Kawakita a 0.634, b 0.018", with half intervals where there is room; g_free. */
static char *describe(const struct view *view, size_t index)
{
    const struct gb_compaction_fits *fits = &view->cache->fits;
    GString *text = g_string_new(fits->fit[index].equation->title);
    const bool intervals = view->panel->plot.cols >= COLUMNS_INTERVALS;
    for (size_t k = 0; k < gb_compaction_fits_values(fits, index); k++) {
        const struct gb_compaction_value value = gb_compaction_fits_value(fits, index, k);
        const double half = 0.5 * (value.value.high - value.value.low);
        char number[GB_NUMBER_ERROR_MAX];
        gb_number_error(value.value.value, intervals ? half : (double)NAN, 1,
                        view->panel->utf8 ? "\xc2\xb1" : "+-", number);
        g_string_append_printf(text, " %s %s", value.name, number);
    }
    return g_string_free(text, FALSE);
}

/* The mean yield pressure and its linear range; g_free. */
static char *describe_heckel(const struct view *view)
{
    const struct gb_compaction_fits *fits = &view->cache->fits;
    const double *pressure = view->cache->data.points.pressure;
    return g_strdup_printf("Heckel 1/K %.4g MPa, from %.4g to %.4g MPa",
                           fits->yield.value, pressure[fits->stretch.first],
                           pressure[fits->stretch.first + fits->stretch.count - 1]);
}

/* Is the equation drawn?  Balshin's curve equals Walker's; Heckel's is drawn on its
 * range. */
static bool is_drawn(const struct gb_equation *equation)
{
    return strcmp(equation->name, "balshin") != 0 &&
           strcmp(equation->name, "heckel") != 0;
}

/* Collects the loading branch, the best equations, and Heckel's on its linear range. */
static void collect(struct view *view, const struct gb_session_shown *shown)
{
    const struct gb_compaction_fits *fits = &view->cache->fits;
    const struct gb_equations_points *points = &view->cache->data.points;
    const int rows = view->panel->plot.rows;
    view->room = CLAMP(rows / ROWS_PER_LINE, LIST_LEAST, ENTRIES);
    const int most = MIN(view->room - 1, EQUATIONS);
    add(view, &(struct line){NULL, 0.0, 0.0},
        shown->quick ? "loading, quick cell" : "loading");
    for (size_t i = 0; i < fits->fitted && view->entries <= most; i++) {
        if (is_drawn(fits->fit[i].equation)) {
            char *name = describe(view, i);
            add(view,
                &(struct line){&fits->fit[i].all, points->pressure[0],
                               points->pressure[points->count - 1]},
                name);
            g_free(name);
        }
    }
    if (fits->heckel.equation != NULL) {
        const size_t end = fits->stretch.first + fits->stretch.count;
        char *name = describe_heckel(view);
        add(view,
            &(struct line){&fits->heckel, points->pressure[fits->stretch.first],
                           points->pressure[end - 1]},
            name);
        g_free(name);
    }
}

/* Copies the points of the loading branch to the panel; returns their number. */
static size_t take_loading(struct view *view, const struct gb_session_shown *shown)
{
    struct gb_panel_plot *panel = view->panel;
    size_t count = 0;
    for (size_t i = 0; i < shown->points; i++) {
        const struct gb_point *point = gb_curve_at(shown->curve, i);
        if (point->branch == GB_BRANCH_LOAD) {
            panel->x[count] = point->density;
            panel->y[count++] = 1e-6 * point->p_pa / view->unit_mpa;
        }
    }
    return count;
}

/* Copies points of a fit to the panel; returns their number. */
static size_t take_fit(struct view *view, const struct line *line)
{
    struct gb_panel_plot *panel = view->panel;
    for (int k = 0; k < SAMPLES; k++) {
        const double p =
            line->from * pow(line->to / line->from, (double)k / (SAMPLES - 1));
        panel->x[k] = gb_compaction_fits_at(line->fit, p);
        panel->y[k] = p / view->unit_mpa;
    }
    return SAMPLES;
}

static void draw_line(struct view *view, const struct gb_session_shown *shown, int k)
{
    const struct line *line = &view->line[k];
    const size_t count =
        line->fit != NULL ? take_fit(view, line) : take_loading(view, shown);
    gb_plot_line(&view->panel->plot,
                 &(struct gb_plot_series){.x = view->panel->x,
                                          .y = view->panel->y,
                                          .count = count,
                                          .ink = view->entry[k].ink,
                                          .marker = view->entry[k].marker});
}

/* The first entry of the list, which omits the loading branch if there is no room. */
static int first_listed(const struct view *view)
{
    return view->entries > view->room;
}

static void draw_axes(struct view *view)
{
    struct gb_panel_plot *panel = view->panel;
    const struct gb_equations_points *points = &view->cache->data.points;
    const double highest = points->pressure[points->count - 1];
    const bool giga = highest >= giga_from_mpa;
    view->unit_mpa = giga ? 1e3 : 1.0;
    panel->unit_pa = 1e6 * view->unit_mpa;
    double x_ends[2] = {points->density[0], points->density[points->count - 1]};
    double y_ends[2] = {panel->log ? points->pressure[0] / view->unit_mpa : 0.0,
                        highest / view->unit_mpa};
    panel->plot.foot = view->entries - first_listed(view);
    gb_panel_plot_ranges_x(&panel->ranges, GB_PLOT_RANGE_DENSITY, 1.0, &panel->plot,
                           x_ends);
    gb_panel_plot_ranges_y(&panel->ranges, GB_PLOT_RANGE_PRESSURE, panel->unit_pa,
                           &panel->plot, y_ends);
    gb_plot_axes(&panel->plot, x_ends, y_ends, panel->log ? GB_PLOT_LOG : GB_PLOT_LINEAR,
                 "relative density", giga ? "p, GPa" : "p, MPa");
}

/* Draws the list of fits below the axes, one per line. */
static void draw_list(struct view *view)
{
    struct gb_plot *plot = &view->panel->plot;
    for (int k = first_listed(view); k < view->entries; k++) {
        const struct gb_plot_entry *entry = &view->entry[k];
        const int row = plot->rows - view->entries + k;
        gb_plot_put(plot, row, 0, gb_plot_mark_char(plot, entry->marker), entry->ink);
        gb_plot_text(plot, row, 2, GB_PLOT_INK_TEXT, entry->name);
    }
}

void gb_view_fit_draw(struct gb_panel_plot *panel, const struct gb_session *session)
{
    const struct gb_session_shown shown = gb_session_shown(session);
    struct view view = {.panel = panel, .cache = &panel->fits};
    const bool ended = shown.state >= GB_RUN_DONE;
    if (!gb_panel_plot_reserve(panel, MAX(shown.points, SAMPLES)) ||
        !gb_results_fits_update(&panel->fits, shown.curve, shown.points,
                                ended ? GB_COMPACTION_PROFILE : GB_COMPACTION_LINEAR)) {
        const struct gb_compaction_cache *cache = &panel->fits;
        gb_plot_text(&panel->plot, panel->plot.rows / 2, 2, GB_PLOT_INK_TEXT,
                     cache->reason.code != GB_OK ? cache->reason.text
                     : cache->fits.count > 0     ? cache->fits.fit[0].refusal.text
                                                 : "no memory for the fits");
        return;
    }
    collect(&view, &shown);
    draw_axes(&view);
    for (int k = 0; k < view.entries; k++) {
        draw_line(&view, &shown, k);
    }
    draw_list(&view);
    if (panel->cursor_on && panel->cursor < shown.points) {
        const struct gb_point *point = gb_curve_at(shown.curve, panel->cursor);
        gb_plot_cursor(&panel->plot, point->density, point->p_pa / panel->unit_pa);
    }
}
