#ifndef GB_TUI_RUNS_RUNS_PICKER_PRIVATE_H
#define GB_TUI_RUNS_RUNS_PICKER_PRIVATE_H

#include <glib.h>

#include "io/runs/run_list.h"
#include "tui/panel/prompt.h"
#include "tui/term/paint.h"

/* State of the screen: runs_picker.c changes it, runs_picker_draw.c draws it. */
struct gb_runs_picker {
    GPtrArray *(*list)(void);
    GPtrArray *items; /* all runs */
    GArray *shown;    /* of guint: those that match the filter */
    int focus, top, page;
    struct gb_prompt filter;
    bool asks; /* whether to delete the focused one */
    int files; /* of that */
    char note[400];
    enum gb_style note_style;
    bool leave;
    char *chosen; /* directory; NULL: none */
};

/* The focused run; NULL: none matches. */
const struct gb_run_list_item *
gb_runs_picker_focused(const struct gb_runs_picker *picker);
const struct gb_run_list_item *gb_runs_picker_at(const struct gb_runs_picker *picker,
                                                 int index);

void gb_runs_picker_draw(struct gb_runs_picker *picker, const struct gb_term *term);

#endif
