#ifndef GB_DRAW_FIGURE_FIGURE_DRAW_H
#define GB_DRAW_FIGURE_FIGURE_DRAW_H

#include "draw/figure/figure_page.h"

/* Draws an arranged page: curves, axes, inset, labels and texts. */
void gb_figure_draw_page(const struct gb_figure_page *page);

#endif
