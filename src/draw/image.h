#ifndef GB_DRAW_IMAGE_H
#define GB_DRAW_IMAGE_H

#include <stdbool.h>
#include <stddef.h>
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

/* The last row has no name.  Widths are called by the name followed by "-1.5" or "-2". */
extern const struct gb_image_journal gb_image_journals[];

/* width      "8cm", "80 mm", "3.3 in", or a column as "elsevier" or "elsevier-2"
 * per_inch   100 to 1200
 * Errors: GB_ERR_INPUT with the expected values, also for more pixels than an image has. */
bool gb_image_parse_print(const char *width, int per_inch, struct gb_image_print *size,
                          struct gb_error *err);

/* Pixels of a length in points. */
static inline double gb_image_print_pixels(int per_inch, double points)
{
    return points * per_inch / 72.0;
}

/* Highest coordination number with a colour of its own, shared by larger ones. */
enum { GB_IMAGE_MAP_CONTACTS = 12, GB_IMAGE_MAP_ANCHORS = 17 };

/* A scale of colours, sRGB, with equal steps for the eye (CIELAB).  All but viridis (van der
 * Walt and Smith 2015, CC0) are straight or curved paths in CIELAB with even lightness. */
struct gb_image_map {
    const char *name, *doc;
    bool diverging; /* two arms from a light middle */
    double
        start; /* share where values begin: a nearly black end would hide the shading */
    uint8_t anchor[GB_IMAGE_MAP_ANCHORS][3]; /* at 0, 1/16, ..., 1 */
};

/* The last row has no name; the first one is the default. */
const struct gb_image_map *gb_image_maps(void);

/* NULL: no scale of this name. */
const struct gb_image_map *gb_image_find(const char *name);

/* Colour of a value; map NULL: the default; x is limited to [0, 1]. */
void gb_image_map_colour(const struct gb_image_map *map, double x, uint8_t rgb[3]);

/* Viridis from end to end; x is limited to [0, 1]. */
void gb_image_viridis(double x, uint8_t rgb[3]);

/* A text chunk: a PNG keyword (1 to 79 Latin letters) and UTF-8. */
struct gb_image_text {
    const char *key, *value;
};

enum gb_image_alpha { GB_IMAGE_OPAQUE, GB_IMAGE_ALPHA };

/* Writes the image as sRGB PNG, atomically.  Errors: as gb_file_replace, GB_ERR_MEMORY. */
bool gb_image_write(const struct gb_image *image, enum gb_image_alpha alpha,
                    const struct gb_image_text *texts, int text_count, const char *path,
                    struct gb_error *err);

/* The value of the text chunk `key` of a PNG file (g_free).  Errors: GB_ERR_INPUT when
 * the file is no PNG or has no such chunk, GB_ERR_MACHINE when it cannot be read. */
bool gb_image_read_text(const char *path, const char *key, char **value,
                        struct gb_error *err);

/* An animated PNG: other programs show its first frame.  Later frames hold only the
 * rectangle that has changed. */
struct gb_image_animation;

/* count      number of frames
 * texts      chunks of the file, copied */
bool gb_image_animation_create(struct gb_image_animation **out, int count,
                               enum gb_image_alpha alpha,
                               const struct gb_image_text *texts, int text_count,
                               struct gb_error *err);

void gb_image_animation_destroy(struct gb_image_animation *apng); /* NULL is fine */

/* All frames have one size. */
bool gb_image_animation_add(struct gb_image_animation *apng, const struct gb_image *image,
                            int milliseconds, struct gb_error *err);

/* After the last frame; writes the file atomically. */
bool gb_image_animation_write(struct gb_image_animation *apng, const char *path,
                              struct gb_error *err);

#endif
