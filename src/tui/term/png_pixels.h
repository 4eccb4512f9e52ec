#ifndef GB_TUI_TERM_PNG_PIXELS_H
#define GB_TUI_TERM_PNG_PIXELS_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/status.h"

/* A PNG file as pixels for the terminal. */
struct gb_png_pixels {
    int wide, high;
    double per_inch; /* pixels in print, where the file notes it; 0: it does not, or was read
                        with its pixels */
    uint8_t *rgb; /* 3 bytes a pixel, row by row from the top; NULL: measured only */
};

/* Width, height and density in print.  Errors: GB_ERR_INPUT (no PNG, too large), GB_ERR_MACHINE. */
bool gb_png_pixels_measure(struct gb_png_pixels *out, const char *path,
                           struct gb_error *err);
/* All pixels, on white where they are transparent.  Errors: also GB_ERR_MEMORY. */
bool gb_png_pixels_read(struct gb_png_pixels *out, const char *path,
                        struct gb_error *err);
void gb_png_pixels_finish(struct gb_png_pixels *pixels); /* zeroed is fine */

#endif
