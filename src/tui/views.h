#ifndef GB_TUI_VIEWS_H
#define GB_TUI_VIEWS_H

#include "tui/panels.h"

/* Pressure against density, or against time: earlier runs, unloading branches, the
 * loading branch on top; of dynamic runs the three stages. */
void gb_view_curve_draw(struct gb_panel_plot *panel, const struct gb_session *session);

/* Shares of particles by their number of contacts. */
void gb_view_histogram_draw(struct gb_panel_plot *panel,
                            const struct gb_session *session);

/* Mean normal force against the angle to z, as a closed line around the origin. */
void gb_view_rose_draw(struct gb_panel_plot *panel, const struct gb_session *session);

#endif
