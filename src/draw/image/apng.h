#ifndef GB_DRAW_IMAGE_APNG_H
#define GB_DRAW_IMAGE_APNG_H

#include "draw/image/image.h"
#include "draw/image/png.h"

/* A PNG that moves: browsers and viewers play it, others show its first frame.  Frames
 * after the first hold only the rectangle that has changed. */
struct gb_apng;

/* count      frames that will come
 * texts      chunks of the file, copied */
bool gb_apng_create(struct gb_apng **out, int count, bool opaque,
                    const struct gb_png_text *texts, int text_count,
                    struct gb_error *err);
void gb_apng_destroy(struct gb_apng *apng); /* NULL is fine */

/* All of one size; shown for so many milliseconds. */
bool gb_apng_add(struct gb_apng *apng, const struct gb_image *image, int milliseconds,
                 struct gb_error *err);

/* After the last frame; puts the file in place as a whole. */
bool gb_apng_write(struct gb_apng *apng, const char *path, struct gb_error *err);

#endif
