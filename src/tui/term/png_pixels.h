#ifndef GB_TUI_TERM_PNG_PIXELS_H
#define GB_TUI_TERM_PNG_PIXELS_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/status.h"

/* A PNG file as pixels for the terminal. */
struct gb_png_pixels {
    int wide, high;
    uint8_t *rgb; /* 3 bytes a pixel, row by row from the top; NULL: measured only */
};

/* Width and height.  Errors: GB_ERR_INPUT (no PNG, too large), GB_ERR_MACHINE. */
bool gb_png_pixels_measure(struct gb_png_pixels *out, const char *path,
                           struct gb_error *err);
/* All pixels, on white where they are transparent.  Errors: also GB_ERR_MEMORY. */
bool gb_png_pixels_read(struct gb_png_pixels *out, const char *path,
                        struct gb_error *err);
void gb_png_pixels_finish(struct gb_png_pixels *pixels); /* zeroed is fine */

#endif
