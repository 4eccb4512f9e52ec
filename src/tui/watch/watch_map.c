#include <glib.h>
#include <math.h>
#include <stdio.h>

#include "base/number.h"
#include "base/units.h"
#include "tui/watch/watch_views.h"

/* Columns of a cell: with two digits of the error, with one, without it. */
enum { NAME_COLS = 14, CELL_COLS = 20, CELL_COLS_ERROR = 15, CELL_COLS_MIN = 7 };

static void write_pressure(const struct gb_watch *watch, char *text, size_t size)
{
    gb_units_format_short(watch->runset.level_pa[watch->level], GB_DIM_PRESSURE, 3, text,
                          size);
}

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

/* "▓▓ 0.5120 +-0.0030": darker is denser; "▓0.512 +-0.003" and "▓0.512" in narrow columns. */
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
        char number[GB_NUMBER_ERROR_MAX];
        if (error > 0.0 && cols >= CELL_COLS_ERROR) {
            gb_number_error(mean, error, wide ? 2 : 1, " +-", number);
        } else {
            snprintf(number, sizeof number, "%.*f", wide ? 4 : 3, mean);
        }
        snprintf(text, sizeof text, "%s%s%s%.40s", shade, wide ? shade : "",
                 wide ? " " : "", number);
    }
    gb_paint_cell(paint, row, col, cols, GB_STYLE_PLAIN, text);
}

static void draw_matrix(const struct gb_watch *watch, const struct gb_paint *paint)
{
    const struct gb_runset_view *runset = &watch->runset;
    const struct gb_runset_view_key *across = &runset->key[0], *down = &runset->key[1];
    const struct range range = range_of(watch);
    const int room = (paint->rect.cols - NAME_COLS - 1) / (int)across->count;
    const int cols = room >= CELL_COLS         ? CELL_COLS
                     : room >= CELL_COLS_ERROR ? CELL_COLS_ERROR
                                               : MAX(room, CELL_COLS_MIN);
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
        gb_watch_views_group_name(group, name, sizeof name);
        draw_cell(watch, paint, 3 + (int)g, 1, CELL_COLS, group, range);
        gb_paint_text(paint, 3 + (int)g, CELL_COLS + 2, GB_STYLE_PLAIN, name);
    }
}

void gb_watch_map_draw(struct gb_watch *watch, const struct gb_paint *paint)
{
    char pressure[32];
    write_pressure(watch, pressure, sizeof pressure);
    gb_paint_format(paint, 1, 1, GB_STYLE_PLAIN,
                    "relative density at %s, +- standard error", pressure);
    if (watch->runset.keys == GB_RUNSET_VIEW_VARIED) {
        draw_matrix(watch, paint);
    } else {
        draw_list(watch, paint);
    }
}
