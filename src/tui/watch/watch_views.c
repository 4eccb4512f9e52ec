#include "tui/watch/watch_views.h"

#include <glib.h>
#include <stdio.h>
#include <string.h>

#include "tui/term/text_fit.h"

static const struct gb_watch_view views[] = {
    {"Pressure against relative density: mean and standard error",
     "L log or linear  b glyphs", GB_WATCH_VIEW_ALWAYS, gb_watch_curves_draw},
    {"Relative density over the varied parameters", "Left and Right pressure",
     GB_WATCH_VIEW_ALWAYS, gb_watch_map_draw},
    {"Runs", "Up and Down scroll", GB_WATCH_VIEW_ALWAYS, gb_watch_runs_draw},
    {"Fit", "", GB_WATCH_VIEW_CALIBRATION, gb_watch_fit_draw},
};

int gb_watch_views_count(const struct gb_watch *watch)
{
    int count = 0;
    for (size_t i = 0; i < G_N_ELEMENTS(views); i++) {
        count += views[i].shown == GB_WATCH_VIEW_ALWAYS || watch->runset.fit != NULL;
    }
    return count;
}

const struct gb_watch_view *gb_watch_views_at(int index)
{
    return &views[index];
}

int gb_watch_views_first(const struct gb_watch *watch)
{
    const int last = gb_watch_views_count(watch) - 1;
    return views[last].shown == GB_WATCH_VIEW_CALIBRATION ? last : 0;
}

void gb_watch_views_group_name(const struct gb_runset_view_group *group, char *name,
                               size_t size)
{
    char cells[40];
    snprintf(cells, sizeof cells, "%s%zu %s", *group->label != '\0' ? ", " : "",
             group->members, group->members == 1 ? "cell" : "cells");
    gb_text_fit_copy(name, size - strlen(cells), group->label);
    strcat(name, cells);
}
