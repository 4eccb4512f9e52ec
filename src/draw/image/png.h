#ifndef GB_DRAW_IMAGE_PNG_H
#define GB_DRAW_IMAGE_PNG_H

#include <stdbool.h>
#include <stddef.h>

#include "draw/image/image.h"
#include "greenbody/status.h"

/* A text chunk: a PNG keyword (1 to 79 Latin letters) and UTF-8. */
struct gb_png_text {
    const char *key, *value;
};

enum gb_png_alpha { GB_PNG_OPAQUE, GB_PNG_ALPHA };

/* Writes the image as sRGB PNG, atomically.  Errors: as gb_file_replace, GB_ERR_MEMORY. */
bool gb_png_write(const struct gb_image *image, enum gb_png_alpha alpha,
                  const struct gb_png_text *texts, int text_count, const char *path,
                  struct gb_error *err);

/* The value of the text chunk `key` of a PNG file (g_free).  Errors: GB_ERR_INPUT when
 * the file is no PNG or has no such chunk, GB_ERR_MACHINE when it cannot be read. */
bool gb_png_read_text(const char *path, const char *key, char **value,
                      struct gb_error *err);

/* An animated PNG: other programs show its first frame.  Frames
 * after the first hold only the rectangle that has changed. */
struct gb_png_animation;

/* count      number of frames
 * texts      chunks of the file, copied */
bool gb_png_animation_create(struct gb_png_animation **out, int count,
                             enum gb_png_alpha alpha, const struct gb_png_text *texts,
                             int text_count, struct gb_error *err);

void gb_png_animation_destroy(struct gb_png_animation *apng); /* NULL is fine */

/* All frames have one size. */
bool gb_png_animation_add(struct gb_png_animation *apng, const struct gb_image *image,
                          int milliseconds, struct gb_error *err);

/* After the last frame; writes the file atomically. */
bool gb_png_animation_write(struct gb_png_animation *apng, const char *path,
                            struct gb_error *err);

#endif
