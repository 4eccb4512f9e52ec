#ifndef GB_DRAW_CAPTION_CAPTION_PEN_H
#define GB_DRAW_CAPTION_CAPTION_PEN_H

#include <stdbool.h>
#include <stdint.h>

#include "draw/image/image.h"
#include "draw/image/text.h"
#include "draw/scene.h"

/* Text and lines on an image, in the foreground colour of its background. */
struct gb_caption_pen {
    struct gb_text text;
    cairo_t *cairo;
    double unit;  /* height of a line of text, pixels */
    double least; /* smallest letters, pixels: what does not fit then is cut; 0: any */
    uint8_t foreground[3];
};

/* Until gb_caption_pen_end the image has the byte order of cairo. */
bool gb_caption_pen_begin(struct gb_caption_pen *pen, struct gb_image *image, double unit,
                          enum gb_background background, struct gb_error *err);
/* good: all before succeeded; the result is false otherwise, or when cairo failed. */
bool gb_caption_pen_end(struct gb_caption_pen *pen, struct gb_image *image, bool good,
                        struct gb_error *err);

void gb_caption_pen_set_foreground(const struct gb_caption_pen *pen);

/* One line of plain text at (x, y); align 0, 0.5, 1: x is its left end, middle, right end;
 * y is its middle.  Reduced to fit max_width (> 0), then cut with an ellipsis. */
void gb_caption_pen_line(const struct gb_caption_pen *pen, const char *line, double x,
                         double y, double align, double scale, double max_width);

/* The same with the first of the texts (NULL at the end) that fits without a cut. */
void gb_caption_pen_line_that_fits(const struct gb_caption_pen *pen,
                                   const char *const *texts, double x, double y,
                                   double align, double scale, double max_width);

/* One line of markup around (x, y), rotated by 90 degrees anticlockwise. */
void gb_caption_pen_line_upwards(const struct gb_caption_pen *pen, const char *line,
                                 double x, double y);

#endif
