#ifndef GB_DRAW_IMAGE_IMAGE_H
#define GB_DRAW_IMAGE_IMAGE_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/status.h"

enum { GB_IMAGE_MIN = 16, GB_IMAGE_MAX = 16384 }; /* pixels a side */

/* Pixels from the top left; sRGB, colours already multiplied by their alpha. */
struct gb_image {
    int width, height;
    int per_inch;  /* pixels in print, a note in the file; 0: none */
    uint8_t *rgba; /* width x height x 4 */
};

/* Errors: GB_ERR_INPUT for a side out of range, GB_ERR_MEMORY. */
bool gb_image_create(struct gb_image **out, int width, int height, struct gb_error *err);
void gb_image_destroy(struct gb_image *image); /* NULL is fine */

/* "1600x1200".  Errors: GB_ERR_INPUT saying what is accepted. */
bool gb_image_parse_size(const char *text, int *width, int *height, struct gb_error *err);

/* Swaps the byte order of cairo (blue first) and of images (red first). */
void gb_image_swap_red_blue(struct gb_image *image);

#endif
