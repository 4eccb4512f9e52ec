#ifndef GB_TUI_VIEW_VIEW_CURVE_H
#define GB_TUI_VIEW_VIEW_CURVE_H

#include "scene/path/path.h"
#include "tui/view/views.h"

/* Mean of the replicas: its colour, and the half width of its band in standard errors. */
enum { GB_VIEW_INK_REPLICAS = GB_PLOT_INK_SERIES + 5, GB_VIEW_BAND_ERRORS = 2 };

/* Unit (Pa) of an axis up to this pressure: 1 MPa or 1 GPa; its label is "p, MPa". */
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
    double unit_pa;      /* unit of the pressure axis */
    struct gb_path path; /* legs of the run */
    struct gb_plot_entry entry[GB_VIEW_CURVE_ENTRIES];
    int entries;
};

bool gb_view_curve_quick_superseded(const struct gb_session *session);
/* Colour that the quick cell would have as a previous curve; plain if all are used. */
int gb_view_curve_quick_ink(const struct gb_session *session);

#endif
