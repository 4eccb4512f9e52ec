#ifndef GB_DRAW_IMAGE_TEXT_H
#define GB_DRAW_IMAGE_TEXT_H

#include <cairo.h>
#include <pango/pangocairo.h>
#include <stdbool.h>

#include "greenbody/status.h"

/* Words on a cairo surface.  Texts are Pango markup; one that is not well formed is shown
 * as it stands. */
struct gb_text {
    PangoLayout *layout;
    cairo_t *cairo; /* not owned */
};

/* Errors: GB_ERR_MACHINE when this machine has no font at all. */
bool gb_text_init(struct gb_text *text, cairo_t *cairo, struct gb_error *err);
void gb_text_finish(struct gb_text *text); /* zeroed is fine */

/* Extent of a text of the given font size, in user units; wraps at width (0: never). */
void gb_text_measure(const struct gb_text *text, const char *markup, double size,
                     double width, double *wide, double *high);

/* Draws it with the present source colour.  (x, y) is the place of the point of the text
 * that align says: 0, 0 its top left, 1, 1 its bottom right; turned anticlockwise by
 * quarter turns. */
void gb_text_write(const struct gb_text *text, const char *markup, double size,
                   double width, const double at[2], const double align[2], int quarters);

#endif
