#ifndef GB_TUI_PANEL_LISTING_H
#define GB_TUI_PANEL_LISTING_H

#include <stdbool.h>

#include "greenbody/params.h"

enum { GB_LISTING_MOST = 160 };

/* Which parameters the pane lists, and on which lines: those that mean something to the
 * scene, or all.  Every group has a heading, and a blank line before all but the first.
 */
struct gb_listing {
    int count;
    int field[GB_LISTING_MOST]; /* rows of the field table, ascending */
    int line[GB_LISTING_MOST];
    bool first[GB_LISTING_MOST]; /* of its group: the heading is one line above */
};

void gb_listing_init(struct gb_listing *listing, const struct gb_params *params,
                     bool all);

/* Place of a row of the field table in the list; of the last listed one before it (or
 * the first of all) where it is not listed itself. */
int gb_listing_place(const struct gb_listing *listing, int field);

#endif
