#ifndef GB_TUI_VIEW_VIEWS_H
#define GB_TUI_VIEW_VIEWS_H

#include "tui/panel/panels.h"

/* Pressure against density, or against time: earlier runs, unloading branches, the
 * loading branch on top; of dynamic runs the three stages. */
void gb_view_curve_draw(struct gb_panel_plot *panel, const struct gb_session *session);
/* Where a point stands on the x axis of that: density, time or step. */
double gb_view_curve_x(const struct gb_panel_plot *panel,
                       const struct gb_session *session, const struct gb_point *point);

/* Shares of particles by their number of contacts. */
void gb_view_histogram_draw(struct gb_panel_plot *panel,
                            const struct gb_session *session);

/* Mean normal force against the angle to z, as a closed line around the origin. */
void gb_view_rose_draw(struct gb_panel_plot *panel, const struct gb_session *session);

/* Radial distribution function of the packing. */
void gb_view_distances_draw(struct gb_panel_plot *panel,
                            const struct gb_session *session);

/* Lateral over axial pressure against density, P1 Fig. 13. */
void gb_view_ratio_draw(struct gb_panel_plot *panel, const struct gb_session *session);

/* The laws of the edited parameters, and dim those of the run, into panel->target: normal
 * force of two particles (P1 Fig. 1), strength of a bridge (P1 Fig. 2). */
void gb_view_law_force(struct gb_panel_plot *panel, const struct gb_session *session);
void gb_view_law_strength(struct gb_panel_plot *panel, const struct gb_session *session);

/* The law of Hertz or Storakers, where that is the scene's: called by gb_view_law_force.
 */
void gb_view_pair_draw(struct gb_panel_plot *panel, const struct gb_session *session);

/* The packing seen along y: lit spheres, darker with depth; discs in 2D. */
void gb_view_packing_draw(struct gb_panel_plot *panel, const struct gb_session *session);

/* Error against cost of the numerical choices in the chart that was loaded. */
void gb_view_chart_draw(struct gb_panel_plot *panel, const struct gb_session *session);

#endif
