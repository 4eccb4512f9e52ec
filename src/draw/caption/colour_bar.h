#ifndef GB_DRAW_CAPTION_COLOUR_BAR_H
#define GB_DRAW_CAPTION_COLOUR_BAR_H

#include "draw/caption/caption_pen.h"
#include "draw/style/picture_style.h"
#include "draw/view.h"

/* Colour bar with its labels and title beside a packing; none for a scale without title. */
void gb_colour_bar_draw(const struct gb_caption_pen *pen, const struct gb_frame *bar,
                        const struct gb_picture_style_scale *scale);

#endif
