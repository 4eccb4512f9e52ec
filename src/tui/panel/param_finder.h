#ifndef GB_TUI_PANEL_PARAM_FINDER_H
#define GB_TUI_PANEL_PARAM_FINDER_H

#include "greenbody/params.h"
#include "tui/panel/list_box.h"
#include "tui/term/paint.h"

/* The list of parameters that match what is typed, the nearest first (field_words.h). */

struct gb_param_finder {
    struct gb_list_box list; /* of rows of the field table */
    struct gb_params params; /* whose values are shown */
};

void gb_param_finder_init(struct gb_param_finder *finder, const struct gb_params *params);
void gb_param_finder_finish(struct gb_param_finder *finder); /* zeroed is fine */

/* Typing, arrows and pages; false: another key. */
bool gb_param_finder_handle(struct gb_param_finder *finder,
                            const struct gb_term_event *event);

void gb_param_finder_draw(struct gb_param_finder *finder, const struct gb_paint *paint);

/* Row of the field table of the selected parameter; -1: nothing matches. */
int gb_param_finder_selected(const struct gb_param_finder *finder);

#endif
