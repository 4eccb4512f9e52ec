#ifndef GB_TUI_PANEL_DENSITY_TABLE_H
#define GB_TUI_PANEL_DENSITY_TABLE_H

#include "tui/session/session.h"
#include "tui/term/paint.h"

/* Densities of all curves on the plot at round pressures, their differences from the
 * present run, and whether these exceed the errors. */

/* Draws the lines from *top, which is limited to the lines that exist.  Returns the
 * number of lines that scroll. */
int gb_density_table_draw(const struct gb_paint *paint, const struct gb_session *session,
                          bool hide_previous, int *top);

/* The whole table with tabs between columns; g_free. */
char *gb_density_table_text(const struct gb_session *session, bool hide_previous);

#endif
