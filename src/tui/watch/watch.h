#ifndef GB_TUI_WATCH_WATCH_H
#define GB_TUI_WATCH_WATCH_H

#include "greenbody/status.h"
#include "tui/term/paint.h"
#include "tui/term/settings.h"
#include "tui/watch/runset_view.h"

/* The screen of many runs, read-only: curves as means with bands, a map over two varied
 * keys at a pressure, the runs, the fit of a calibration. */
struct gb_watch {
    struct gb_runset_view runset;
    struct gb_error error; /* error of the last reading */
    bool leave;
    int view;     /* row of watch.c */
    size_t level; /* pressure of the map */
    bool linear;  /* linear pressure axis */
    int top;      /* first run listed */
    int glyphs;   /* enum gb_plot_glyphs */
    struct gb_plot plot;
};

/* Shows a directory until the user quits; returns the exit status. */
int gb_watch_run(const char *directory, const struct gb_settings *settings,
                 struct gb_error *err);

#endif
