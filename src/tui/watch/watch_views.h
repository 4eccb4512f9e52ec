#ifndef GB_TUI_WATCH_WATCH_VIEWS_H
#define GB_TUI_WATCH_WATCH_VIEWS_H

#include "tui/watch/watch.h"

/* One row per view of the screen of many runs: digit, title and footer follow from it.  A new
 * view is a file watch_NAME.c, a row in watch_views.c and a line in meson.build.  Views of
 * calibrations are the last rows. */
struct gb_watch_view {
    const char *title; /* without the digit */
    const char *hint;  /* footer: keys of the view; "" without */
    enum { GB_WATCH_VIEW_ALWAYS, GB_WATCH_VIEW_CALIBRATION } shown;
    void (*draw)(struct gb_watch *watch, const struct gb_paint *paint);
};

/* Number of views that a directory has, and the row of one. */
int gb_watch_views_count(const struct gb_watch *watch);
const struct gb_watch_view *gb_watch_views_at(int index);

/* The view shown first: the fit of a calibration, otherwise the curves. */
int gb_watch_views_first(const struct gb_watch *watch);

/* Label of a group with its number of cells. */
void gb_watch_views_group_name(const struct gb_runset_view_group *group, char *name,
                               size_t size);

/* Drawing functions, each in the file of its name. */
void gb_watch_curves_draw(struct gb_watch *watch, const struct gb_paint *paint);
void gb_watch_map_draw(struct gb_watch *watch, const struct gb_paint *paint);
void gb_watch_runs_draw(struct gb_watch *watch, const struct gb_paint *paint);
void gb_watch_fit_draw(struct gb_watch *watch, const struct gb_paint *paint);

#endif
