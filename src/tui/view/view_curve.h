#ifndef GB_TUI_VIEW_VIEW_CURVE_H
#define GB_TUI_VIEW_VIEW_CURVE_H

#include "scene/path/path.h"
#include "tui/view/views.h"

/* The mean of replicas: its colour; its band ends at so many standard errors. */
enum {
    GB_VIEW_INK_REPLICAS = GB_PLOT_INK_SERIES + 5,
    GB_VIEW_BAND_ERRORS = 2
};

/* Unit of an axis that ends at a pressure, Pa: 1 MPa, or 1 GPa; its label is "p, MPa". */
double gb_view_curve_unit(double highest_pa);
const char *gb_view_curve_unit_label(double unit_pa);

/* Parts of the view of the pressure curve, drawn from back to front. */

enum {
    GB_VIEW_CURVE_ENTRIES =
        3 + 3 + GB_PATH_LEGS_MAX + GB_UNLOAD_MAX + GB_SESSION_PREVIOUS /* of the legend */
};

/* State of the drawing. */
struct gb_view_curve {
    struct gb_panel_plot *panel;
    const struct gb_session *session;
    double unit_pa;      /* of the pressure axis */
    struct gb_path path; /* legs of the run */
    struct gb_plot_entry entry[GB_VIEW_CURVE_ENTRIES];
    int entries;
};

/* Draws a line and adds it to the legend. */
void gb_view_curve_add(struct gb_view_curve *view, const struct gb_plot_series *series,
                       const char *name);

/* x coordinate of a point: relative density, ns or step. */
double gb_view_curve_x(const struct gb_view_curve *view, const struct gb_point *point);

/* x coordinates of a previous curve; NULL: nanoseconds and steps share no axis. */
const double *gb_view_curve_previous_x(const struct gb_view_curve *view,
                                       const struct gb_previous_curve *previous);
/* Whether the curve of the quick cell is drawn, and whether that of the full cell
 * supersedes it. */
bool gb_view_curve_quick_shown(const struct gb_view_curve *view);
bool gb_view_curve_quick_superseded(const struct gb_session *session);
/* Colour that the quick cell would have as a previous curve; plain where all are taken. */
int gb_view_curve_quick_ink(const struct gb_session *session);
/* Whether a curve of another run is shown in a colour: a run has one colour then. */
bool gb_view_curve_several(const struct gb_view_curve *view);
/* Mean of the replicas; NULL: none. */
const struct gb_runset_view_group *
gb_view_curve_replicas(const struct gb_view_curve *view);

/* view_overlays.c: previous curves, quick cell, replicas, measured data, what-ifs. */
void gb_view_overlays_previous(struct gb_view_curve *view);
void gb_view_overlays_quick(struct gb_view_curve *view);
void gb_view_overlays_replicas(struct gb_view_curve *view);
void gb_view_overlays_measured(struct gb_view_curve *view);
void gb_view_overlays_what_ifs(struct gb_view_curve *view);

/* view_branches.c: loading, unloading, stages of the run. */
void gb_view_branches_draw(struct gb_view_curve *view);

#endif
