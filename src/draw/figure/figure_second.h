#ifndef GB_DRAW_FIGURE_FIGURE_SECOND_H
#define GB_DRAW_FIGURE_FIGURE_SECOND_H

#include "draw/figure/figure_page.h"

/* Axes on the top and on the right, whose values are those of the lower and of the left axis
 * times a factor. */

/* Height above the frame, and width right of it, that they take; 0 without them. */
double gb_figure_second_height(const struct gb_figure *figure);
double gb_figure_second_width(const struct gb_figure_page *page);

/* Ticks, tick labels and names; nothing without them. */
void gb_figure_second_draw(const struct gb_figure_page *page);

#endif
