#ifndef GB_DRAW_FIGURE_FIGURE_ANNOTATIONS_H
#define GB_DRAW_FIGURE_FIGURE_ANNOTATIONS_H

#include "draw/figure/figure_page.h"

/* How far the texts at points reach over the frame of the page, points of the page: above and
 * below. */
void gb_figure_annotations_overrun(const struct gb_figure_page *page, double overrun[2]);

void gb_figure_annotations_draw(const struct gb_figure_page *page);

#endif
