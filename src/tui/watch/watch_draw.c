#include <glib.h>
#include <math.h>
#include <stdio.h>

#include "base/units.h"
#include "greenbody/snapshot.h"
#include "tui/panel/panels.h"
#include "tui/watch/watch.h"

enum {
    NAME_COLS = 14,
    CELL_COLS = 16,
    CELL_COLS_MIN = 7,
    ENTRIES = 64,
    STATE_COL = 2,
    ERROR_COL = 22
};

static void write_pressure(const struct gb_watch *watch, char *text, size_t size)
{
    gb_units_format_short(watch->runset.level_pa[watch->level], GB_DIM_PRESSURE, 3, text,
                          size);
}

/* --- means with bands -------------------------------------------------------------- */

static void find_ends(const struct gb_watch *watch, double x[2], double y[2])
{
    const struct gb_runset_view *runset = &watch->runset;
    x[0] = y[0] = HUGE_VAL;
    x[1] = y[1] = -HUGE_VAL;
    for (size_t g = 0; g < runset->groups; g++) {
        for (size_t k = 0; k < GB_RUNSET_VIEW_LEVELS; k++) {
            const double error = runset->group[g].error[k];
            const double mean = runset->group[g].mean[k];
            const double wide = isfinite(error) ? error : 0.0;
            if (isfinite(mean)) {
                x[0] = fmin(x[0], mean - wide);
                x[1] = fmax(x[1], mean + wide);
                y[0] = fmin(y[0], runset->level_pa[k] / 1e6);
                y[1] = fmax(y[1], runset->level_pa[k] / 1e6);
            }
        }
    }
}

/* The mean plus `off` standard errors. */
static void draw_curve(struct gb_watch *watch, const struct gb_runset_view_group *group,
                       double off, int ink, int marker)
{
    double x[GB_RUNSET_VIEW_LEVELS];
    double y[GB_RUNSET_VIEW_LEVELS];
    for (size_t k = 0; k < GB_RUNSET_VIEW_LEVELS; k++) {
        x[k] = group->mean[k] + (off != 0.0 ? off * group->error[k] : 0.0);
        y[k] = watch->runset.level_pa[k] / 1e6;
    }
    gb_plot_line(&watch->plot, &(struct gb_plot_series){.x = x,
                                                        .y = y,
                                                        .count = GB_RUNSET_VIEW_LEVELS,
                                                        .ink = ink,
                                                        .marker = marker,
                                                        .spacing = 8});
}

static void name_group(const struct gb_runset_view_group *group, char *name, size_t size)
{
    snprintf(name, size, "%.40s%s%zu %s", group->label, *group->label != '\0' ? ", " : "",
             group->members, group->members == 1 ? "cell" : "cells");
}

/* Draws all groups and the legend, with `foot` rows for it below the plot; false when the
 * legend is incomplete or covers a line.  *needed: rows of a complete foot. */
static bool draw_groups(struct gb_watch *watch, const struct gb_paint *paint,
                        const double x[2], const double y[2], int foot, int *needed)
{
    const struct gb_runset_view *runset = &watch->runset;
    struct gb_plot_entry entry[ENTRIES];
    int entries = 0;
    if (!gb_plot_resize(&watch->plot, paint->rect.rows - 1, paint->rect.cols - 2,
                        (enum gb_plot_glyphs)watch->glyphs, NULL)) {
        return true;
    }
    watch->plot.foot = foot;
    gb_plot_axes(&watch->plot, x, y, !watch->linear, "relative density", "p, MPa");
    for (size_t g = 0; g < runset->groups; g++) { /* bands first */
        draw_curve(watch, &runset->group[g], -1.0, GB_PLOT_INK_DIM, 0);
        draw_curve(watch, &runset->group[g], 1.0, GB_PLOT_INK_DIM, 0);
    }
    for (size_t g = 0; g < runset->groups; g++) {
        const int ink = GB_PLOT_INK_SERIES + (int)(g % GB_PLOT_COLOURS);
        const int marker = 1 + (int)(g % 7);
        draw_curve(watch, &runset->group[g], 0.0, ink, marker);
        if (entries < ENTRIES) {
            entry[entries] = (struct gb_plot_entry){.ink = ink, .marker = marker};
            name_group(&runset->group[g], entry[entries].name, GB_PLOT_NAME);
            entries++;
        }
    }
    *needed = gb_plot_legend_foot(&watch->plot, entry, entries);
    return gb_plot_legend(&watch->plot, entry, entries);
}

static void draw_curves(struct gb_watch *watch, const struct gb_paint *paint)
{
    double x[2], y[2];
    int foot = 0;
    find_ends(watch, x, y);
    if (!(x[1] > x[0])) {
        gb_paint_text(paint, 2, 2, GB_STYLE_PLAIN, "no curve has reached 1 MPa yet");
        return;
    }
    if (!draw_groups(watch, paint, x, y, 0, &foot)) { /* no free area inside */
        (void)draw_groups(watch, paint, x, y, foot, &foot);
    }
    gb_paint_plot(paint, 1, 1, &watch->plot);
}

/* --- the map ----------------------------------------------------------------------- */

struct range {
    double min, max;
};

static struct range range_of(const struct gb_watch *watch)
{
    struct range range = {HUGE_VAL, -HUGE_VAL};
    for (size_t g = 0; g < watch->runset.groups; g++) {
        const double mean = watch->runset.group[g].mean[watch->level];
        range.min = fmin(range.min, mean); /* fmin and fmax ignore NaN */
        range.max = fmax(range.max, mean);
    }
    return range;
}

/* "▓▓ 0.5120 +-30": darker is denser; "▓0.512" in narrow columns. */
static void draw_cell(const struct gb_watch *watch, const struct gb_paint *paint, int row,
                      int col, int cols, const struct gb_runset_view_group *group,
                      struct range range)
{
    static const char *const shades[] = {"\u2591", "\u2592", "\u2593", "\u2588"};
    char text[64] = "   ...";
    const double mean = group != NULL ? group->mean[watch->level] : (double)NAN;
    if (isfinite(mean)) {
        const double error = group->error[watch->level];
        const double part =
            range.max > range.min ? (mean - range.min) / (range.max - range.min) : 1.0;
        const char *shade = shades[(int)fmin(3.0, floor(4.0 * part))];
        const bool wide = cols >= CELL_COLS;
        const int n = wide ? snprintf(text, sizeof text, "%s%s %.4f", shade, shade, mean)
                           : snprintf(text, sizeof text, "%s%.3f", shade, mean);
        if (isfinite(error) && wide) {
            snprintf(text + n, sizeof text - (size_t)n, " +-%.0f", 1e4 * error);
        }
    }
    gb_paint_cell(paint, row, col, cols, GB_STYLE_PLAIN, text);
}

static void draw_matrix(const struct gb_watch *watch, const struct gb_paint *paint)
{
    const struct gb_runset_view *runset = &watch->runset;
    const struct gb_runset_view_key *across = &runset->key[0], *down = &runset->key[1];
    const struct range range = range_of(watch);
    const int room = (paint->rect.cols - NAME_COLS - 1) / (int)across->count;
    const int cols = room >= CELL_COLS ? CELL_COLS : MAX(room, CELL_COLS_MIN);
    char text[128];
    snprintf(text, sizeof text, "%s.%s \u2192", across->field->group, across->field->key);
    gb_paint_text(paint, 3, NAME_COLS + 1, GB_STYLE_DIM, text);
    snprintf(text, sizeof text, "%s", down->field->key);
    gb_paint_cell(paint, 4, 1, NAME_COLS - 1, GB_STYLE_DIM, text);
    for (size_t i = 0; i < across->count; i++) {
        gb_paint_cell(paint, 4, NAME_COLS + 1 + (int)i * cols, cols - 1, GB_STYLE_BOLD,
                      across->values[i]);
    }
    for (size_t j = 0; j < down->count; j++) {
        const int row = 5 + (int)j;
        gb_paint_cell(paint, row, 1, NAME_COLS - 1, GB_STYLE_BOLD, down->values[j]);
        for (size_t i = 0; i < across->count; i++) {
            draw_cell(watch, paint, row, NAME_COLS + 1 + (int)i * cols, cols,
                      gb_runset_view_at(runset, i, j), range);
        }
    }
}

/* One row per group, where one key varies or more than two. */
static void draw_list(const struct gb_watch *watch, const struct gb_paint *paint)
{
    const struct range range = range_of(watch);
    for (size_t g = 0; g < watch->runset.groups; g++) {
        const struct gb_runset_view_group *group = &watch->runset.group[g];
        char name[80];
        name_group(group, name, sizeof name);
        draw_cell(watch, paint, 3 + (int)g, 1, CELL_COLS, group, range);
        gb_paint_text(paint, 3 + (int)g, CELL_COLS + 2, GB_STYLE_PLAIN, name);
    }
}

static void draw_map(const struct gb_watch *watch, const struct gb_paint *paint)
{
    char pressure[32];
    write_pressure(watch, pressure, sizeof pressure);
    gb_paint_format(paint, 1, 1, GB_STYLE_PLAIN,
                    "relative density at %s, +- standard error in 0.0001", pressure);
    if (watch->runset.keys == GB_RUNSET_VIEW_VARIED) {
        draw_matrix(watch, paint);
    } else {
        draw_list(watch, paint);
    }
}

/* --- the runs ---------------------------------------------------------------------- */

static void draw_runs(struct gb_watch *watch, const struct gb_paint *paint)
{
    const int page = paint->rect.rows - 1;
    const int last = (int)watch->runset.runs - page;
    watch->top = MAX(MIN(watch->top, last), 0);
    for (int i = 0; i < page && watch->top + i < (int)watch->runset.runs; i++) {
        const struct gb_runset_view_run *run = &watch->runset.run[watch->top + i];
        enum gb_style style = GB_STYLE_PLAIN;
        const char *word = gb_panel_state_word(run->state, &style);
        gb_paint_text(paint, 1 + i, STATE_COL, style, word);
        gb_paint_format(paint, 1 + i, STATE_COL + 12, GB_STYLE_PLAIN, "%4.0f %%",
                        floor(100.0 * run->progress));
        const int col = gb_paint_text(paint, 1 + i, ERROR_COL, GB_STYLE_PLAIN, run->name);
        gb_paint_text(paint, 1 + i, col + 2, GB_STYLE_WARN, run->error);
    }
}

/* --- the fit ----------------------------------------------------------------------- */

static void draw_fit(const struct gb_watch *watch, const struct gb_paint *paint)
{
    struct gb_rect rect = paint->rect;
    rect.col += 1;
    rect.cols -= 2;
    const struct gb_paint inside = gb_paint_at(paint->term, rect);
    int row = 1;
    for (char **line = watch->runset.fit; line != NULL && *line != NULL; line++) {
        const int left = rect.rows - row;
        const int rows = left > 0 ? gb_paint_wrap_rows(&inside, left, *line) : 0;
        gb_paint_wrap(&inside, row, rows, GB_STYLE_PLAIN, *line);
        row += rows;
    }
}

void gb_watch_draw(struct gb_watch *watch, const struct gb_paint *paint)
{
    static const char *const titles[GB_WATCH_VIEWS] = {
        "1 Pressure against relative density: mean and standard error",
        "2 Relative density over the varied parameters", "3 Runs", "4 Fit"};
    gb_paint_title(paint, titles[watch->view], true);
    switch (watch->view) {
    case GB_WATCH_CURVES:
        draw_curves(watch, paint);
        break;
    case GB_WATCH_MAP:
        draw_map(watch, paint);
        break;
    case GB_WATCH_RUNS:
        draw_runs(watch, paint);
        break;
    case GB_WATCH_FIT:
        draw_fit(watch, paint);
        break;
    case GB_WATCH_VIEWS:
        break;
    }
}
