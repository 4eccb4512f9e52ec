#ifndef GB_TESTS_SMALL_PACKING_H
#define GB_TESTS_SMALL_PACKING_H

#include "draw/packing_image.h"

/* Three particles at known places, and pictures of them that are looked up in the pixels. */

enum { SMALL_PACKING_SIDE = 400 };

/* One sphere in front of another, and one aside; the box is large. */
struct gb_state *small_packing_make(int dimension);

/* A bare picture from the front. */
struct gb_packing_image small_packing_front(void);

struct gb_image *small_packing_paint(const struct gb_packing_image *packing_image,
                                     const struct gb_state *state);

const uint8_t *small_packing_pixel(const struct gb_image *image, double x, double y);

/* The scene and the page of a picture. */
struct gb_scene *small_packing_scene(const struct gb_packing_image *packing_image,
                                     const struct gb_state *state,
                                     struct gb_caption_layout *layout);

/* Where the camera of a picture sees a particle. */
const uint8_t *small_packing_particle(const struct gb_image *image,
                                      const struct gb_packing_image *packing_image,
                                      const struct gb_state *state, int index);

#endif
