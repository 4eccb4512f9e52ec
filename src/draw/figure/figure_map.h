#ifndef GB_DRAW_FIGURE_FIGURE_MAP_H
#define GB_DRAW_FIGURE_FIGURE_MAP_H

#include "draw/figure/figure_page.h"

/* Width that the colour bar of a figure's map takes right of the frame; 0 without a map. */
double gb_figure_map_bar_width(const struct gb_figure *figure);

/* Cells and colour bar; nothing without a map. */
void gb_figure_map_draw(const struct gb_figure_page *page);

#endif
