#ifndef GB_DRAW_TEXT_H
#define GB_DRAW_TEXT_H

#include <cairo.h>
#include <pango/pangocairo.h>
#include <stdbool.h>

#include "greenbody/status.h"

/* Text on a cairo surface.  Texts are Pango markup; malformed markup is shown as
 * plain text. */
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

/* Draws it with the present source colour.  `at` is the point of the text
 * given by align: 0, 0 its top left, 1, 1 its bottom right; rotated anticlockwise by quarter
 * revolutions. */
void gb_text_write(const struct gb_text *text, const char *markup, double size,
                   double width, const double at[2], const double align[2], int quarters);

/* One line of at most `most`: reduced to fit down to the size `least`, then shortened in its
 * middle, which keeps a unit at its end. */
void gb_text_write_line(const struct gb_text *text, const char *markup, double size,
                        double least, double most, const double at[2],
                        const double align[2], int quarters);

/* Mesa, LLVM, fontconfig, GLib and Pango print to stderr; between begin and end it is
 * redirected to /dev/null (not thread-safe).  end takes the descriptor that begin
 * returned. */
int gb_text_mute_begin(void);

void gb_text_mute_end(int saved);

#endif
