#ifndef GB_DRAW_FIGURE_FIGURE_SURFACE_H
#define GB_DRAW_FIGURE_FIGURE_SURFACE_H

#include <cairo.h>

#include "draw/figure/figure.h"

/* Pixels per point for an image of this size: both sides of the page have their minimum. */
double gb_figure_surface_pixels_per_point(const struct gb_figure *figure, int width,
                                          int height);

/* Height of an image that is `width` pixels wide: in print that of its page, which grows where
 * legend, caption or names would leave too little of it; otherwise `height`. */
int gb_figure_surface_height(const struct gb_figure *figure, int width, int height);

/* Draws a figure onto a surface of which a point is `unit` long; size in points. */
bool gb_figure_surface_draw(cairo_surface_t *surface, const struct gb_figure *figure,
                            const double size[2], double unit,
                            struct gb_figure_layout *layout, struct gb_error *err);

#endif
