#ifndef GB_DRAW_FIGURE_FIGURE_MARKS_H
#define GB_DRAW_FIGURE_FIGURE_MARKS_H

#include <cairo.h>

#include "draw/figure/figure.h"

/* The ink of curves.  Lengths in points of the page. */

/* Bands, bars, line, steps and marks of a curve inside the frame of the layout. */
void gb_figure_marks_curve(cairo_t *cairo, const struct gb_figure_layout *layout,
                           const struct gb_figure_curve *curve);

/* What stands for a curve beside its name, `width` long with its middle height at y. */
void gb_figure_marks_sample(cairo_t *cairo, const struct gb_figure_curve *curve, double x,
                            double y, double width);

/* Place of point k; false when it cannot be shown. */
bool gb_figure_marks_place(const struct gb_figure_layout *layout,
                           const struct gb_figure_curve *curve, size_t k, double at[2]);

/* sRGB, 0 to 1, of a style. */
void gb_figure_marks_colour(int style, double rgb[3]);

#endif
