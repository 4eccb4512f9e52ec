#ifndef GB_DRAW_FIGURE_CURVE_H
#define GB_DRAW_FIGURE_CURVE_H

#include <cairo.h>

#include "draw/figure.h"

/* sRGB, 0 to 1, of a style. */
void gb_figure_curve_colour(int style, double rgb[3]);

/* Number of earlier styles of the same colour.  Repeated colours have other dashes,
 * markers with a core, and markers along lines. */
int gb_figure_curve_round(int style);

/* Of the marker, 0 to GB_FIGURE_STYLES - 1, also of a black style. */
int gb_figure_curve_shape(int style);

/* Curves of a figure; lengths in points. */

/* Bands, bars, line, steps and markers of a curve. */
void gb_figure_curve_draw(cairo_t *cairo, const struct gb_figure_layout *layout,
                          const struct gb_figure_curve *curve);

/* Sample of a curve for the legend, from x over `width`, centred at y. */
void gb_figure_curve_sample(cairo_t *cairo, const struct gb_figure_curve *curve, double x,
                            double y, double width);

/* Position of point k; false for a gap. */
bool gb_figure_curve_position(const struct gb_figure_layout *layout,
                              const struct gb_figure_curve *curve, size_t k,
                              double at[2]);

#endif
