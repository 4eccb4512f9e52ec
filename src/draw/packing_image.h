#ifndef GB_DRAW_PACKING_IMAGE_H
#define GB_DRAW_PACKING_IMAGE_H

#include <stdbool.h>

#include "draw/image/image.h"
#include "draw/image/png.h"
#include "draw/osmesa.h"
#include "draw/scene.h"
#include "draw/view.h"
#include "greenbody/status.h"
#include "io/state.h"

/* From a packing to a PNG: layout, scene, paint, caption, file. */
struct gb_packing_image {
    int width, height;
    struct gb_look look;
    enum gb_ground ground;
    bool words; /* title, colour bar, scale bar, density and pressure */
    struct gb_picture_style_request dress;
    struct gb_osmesa *painter; /* used again for many pictures; NULL: one's own */
    const char *preset;        /* whole text of the preset, for the file; NULL: unknown */
};

/* 1600 x 1200 on white from above the side, with words. */
void gb_packing_image_init(struct gb_packing_image *picture);

/* The libraries below have a voice of their own: stderr leads nowhere meanwhile.  Not for
 * a process in which another thread has something to say there. */
bool gb_packing_image_paint(struct gb_image **out, const struct gb_packing_image *picture,
                            const struct gb_state *state, struct gb_error *err);

/* Paints and writes, with version, title, seed, point and preset as text chunks. */
bool gb_packing_image_write(const struct gb_packing_image *picture,
                            const struct gb_state *state, const char *path,
                            struct gb_error *err);

/* Writes an image of a picture's looks, with the same chunks. */
bool gb_packing_image_save(const struct gb_image *image,
                           const struct gb_packing_image *picture,
                           const struct gb_state *state, const char *path,
                           struct gb_error *err);

/* Text chunks of a picture; the strings live in the struct and in its arguments. */
struct gb_packing_image_texts {
    struct gb_png_text text[8];
    int count;
    char seed[24], point[96], density[32], pressure[48];
};
void gb_packing_image_describe(struct gb_packing_image_texts *texts,
                               const struct gb_state *state, const char *preset);

#endif
