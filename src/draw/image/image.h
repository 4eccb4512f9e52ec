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

/* "1600x1200".  Errors: GB_ERR_INPUT saying what is expected. */
bool gb_image_parse_size(const char *text, int *width, int *height, struct gb_error *err);

/* Swaps the byte order of cairo (blue first) and of images (red first). */
void gb_image_swap_red_blue(struct gb_image *image);

/* Pixels of an image that is printed at a width. */
struct gb_image_print {
    int width, height; /* of the shape 4:3 */
    int per_inch;      /* pixels per inch */
};

/* Letters of captions and labels in print, points: journals ask for 7 to 8, and no
 * smaller than 6 anywhere. */
#define GB_IMAGE_PRINT_TEXT 7.4

#define GB_IMAGE_PRINT_TEXT_LEAST 6.0

/* Column widths of journals; 0: it has none of this kind. */
struct gb_image_journal {
    const char *name;
    double single_mm, middle_mm, double_mm; /* one column, one and a half, the page */
    const char *source;                     /* the guide that has them */
};

/* The last row has no name.  Widths are called by the name, "-1.5" or "-2" behind it. */
extern const struct gb_image_journal gb_image_journals[];

/* width      "8cm", "80 mm", "3.3 in", or a column as "elsevier" or "elsevier-2"
 * per_inch   100 to 1200
 * Errors: GB_ERR_INPUT saying what is accepted, also for more pixels than an image has. */
bool gb_image_parse_print(const char *width, int per_inch, struct gb_image_print *size,
                          struct gb_error *err);

/* Pixels of a length in points. */
static inline double gb_image_print_pixels(int per_inch, double points)
{
    return points * per_inch / 72.0;
}

#endif
