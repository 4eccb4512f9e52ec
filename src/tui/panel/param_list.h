#ifndef GB_TUI_PANEL_PARAM_LIST_H
#define GB_TUI_PANEL_PARAM_LIST_H

#include <stdbool.h>

#include "greenbody/params.h"

enum { GB_PARAM_LIST_MAX = 160 };

/* The parameters that the pane lists, and their lines: those with an effect on the scene,
 * or all.  Every group has a heading, with a blank line before all but the first. */
struct gb_param_list {
    int count;
    int field[GB_PARAM_LIST_MAX]; /* rows of the field table, ascending */
    int line[GB_PARAM_LIST_MAX];
    bool first[GB_PARAM_LIST_MAX]; /* of its group: the heading is one line above */
};

void gb_param_list_init(struct gb_param_list *list, const struct gb_params *params,
                        bool all);

/* Index in the list of a row of the field table; for a row that is not listed, of the
 * last listed one before it, or 0. */
int gb_param_list_index(const struct gb_param_list *list, int field);

#endif
