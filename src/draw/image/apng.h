#ifndef GB_DRAW_IMAGE_APNG_H
#define GB_DRAW_IMAGE_APNG_H

#include "draw/image/image.h"
#include "draw/image/png.h"

/* An animated PNG: other programs show its first frame.  Frames
 * after the first hold only the rectangle that has changed. */
struct gb_apng;

/* count      number of frames
 * texts      chunks of the file, copied */
bool gb_apng_create(struct gb_apng **out, int count, enum gb_png_alpha alpha,
                    const struct gb_png_text *texts, int text_count,
                    struct gb_error *err);
void gb_apng_destroy(struct gb_apng *apng); /* NULL is fine */

/* All frames have one size. */
bool gb_apng_add(struct gb_apng *apng, const struct gb_image *image, int milliseconds,
                 struct gb_error *err);

/* After the last frame; writes the file atomically. */
bool gb_apng_write(struct gb_apng *apng, const char *path, struct gb_error *err);

#endif
