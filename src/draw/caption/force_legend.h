#ifndef GB_DRAW_CAPTION_FORCE_LEGEND_H
#define GB_DRAW_CAPTION_FORCE_LEGEND_H

#include "draw/caption/caption_pen.h"
#include "draw/style/picture_style.h"
#include "draw/view.h"

/* Colours of the classes of forces and, below them, rods of round forces as thick as those of
 * the picture (in perspective: of its mid-depth). */

/* Lines of the legend; 0: the style has no forces. */
int gb_force_legend_lines(const struct gb_picture_style *style);

/* scale: pixels per d */
void gb_force_legend_draw(const struct gb_caption_pen *pen, const struct gb_frame *frame,
                          const struct gb_picture_style *style, double scale);

#endif
