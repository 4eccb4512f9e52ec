#ifndef GB_DRAW_FIGURE_FIGURE_NAMES_H
#define GB_DRAW_FIGURE_FIGURE_NAMES_H

#include "draw/figure/figure_page.h"

/* Name of an axis with the power of ten of its tick labels; g_free. */
char *gb_figure_names_of(const char *label, const struct gb_figure_axis_scale *scale);

enum gb_figure_names_direction { GB_FIGURE_NAMES_ALONG_X, GB_FIGURE_NAMES_ALONG_Y };

/* Draws a name along an axis around its middle, moved to lie within the page, reduced where it
 * is longer, and shortened in its middle where that is not enough.  `across`: the coordinate
 * across the axis of the text's edge: 0 its upper, 1 its lower one. */
void gb_figure_names_draw(const struct gb_figure_page *page, const char *name,
                          enum gb_figure_names_direction direction, double middle,
                          double across, double edge);

/* Length of the page along y that its names take at the smallest letters. */
double gb_figure_names_height(const struct gb_figure_page *page);

#endif
