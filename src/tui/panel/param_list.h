#ifndef GB_TUI_PANEL_PARAM_LIST_H
#define GB_TUI_PANEL_PARAM_LIST_H

#include <stdbool.h>

#include "greenbody/params.h"

enum { GB_PARAM_LIST_MAX = 160 };

/* Which parameters the pane lists, and on which lines: those that mean something to the
 * scene, or all.  Every group has a heading, and a blank line before all but the first.
 */
struct gb_param_list {
    int count;
    int field[GB_PARAM_LIST_MAX]; /* rows of the field table, ascending */
    int line[GB_PARAM_LIST_MAX];
    bool first[GB_PARAM_LIST_MAX]; /* of its group: the heading is one line above */
};

void gb_param_list_init(struct gb_param_list *list, const struct gb_params *params,
                        bool all);

/* Place of a row of the field table in the list; of the last listed one before it (or
 * the first of all) where it is not listed itself. */
int gb_param_list_index(const struct gb_param_list *list, int field);

#endif
