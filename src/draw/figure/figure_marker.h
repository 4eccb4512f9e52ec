#ifndef GB_DRAW_FIGURE_FIGURE_MARKER_H
#define GB_DRAW_FIGURE_FIGURE_MARKER_H

#include <cairo.h>

#include "draw/figure/figure.h"

/* Colours and markers of the styles; lengths in points. */

extern const double gb_figure_marker_radius;

/* sRGB, 0 to 1, of a style. */
void gb_figure_marker_colour(int style, double rgb[3]);
void gb_figure_marker_set_colour(cairo_t *cairo, int style, double alpha);

/* Number of earlier styles of the same colour.  Repeated colours have other dashes,
 * markers with a core, and markers along lines. */
int gb_figure_marker_round(int style);
/* Of the marker, 0 to GB_FIGURE_STYLES - 1, also of a black style. */
int gb_figure_marker_shape(int style);

void gb_figure_marker_draw(cairo_t *cairo, const struct gb_figure_curve *curve,
                           const double at[2]);

#endif
