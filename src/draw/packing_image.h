#ifndef GB_DRAW_PACKING_IMAGE_H
#define GB_DRAW_PACKING_IMAGE_H

#include <stdbool.h>

#include "draw/caption.h"
#include "draw/image.h"
#include "draw/renderer.h"
#include "draw/scene.h"
#include "draw/view.h"
#include "greenbody/status.h"
#include "io/state.h"

/* Image of a packing: its settings, and the steps to a PNG (layout, scene, rendering,
 * caption, file). */
struct gb_packing_image {
    int width, height; /* of the page; the largest ones of a side that is cropped */
    int per_inch;      /* pixels in print; 0: none (draw/image.h) */
    enum gb_caption_crop crop;
    struct gb_viewpoint viewpoint;
    enum gb_background background;
    bool annotated; /* title, colour bar, scale bar, density and pressure */
    struct gb_picture_style_request style;
    struct gb_renderer *renderer; /* shared by many images; NULL: one per image */
    const char *preset; /* text of preset.ini, a chunk of the file; NULL: none */
};

/* 1600 x 1200 pixels without a crop, white, view from a corner, annotated. */
void gb_packing_image_init(struct gb_packing_image *packing_image);

/* Page around a packing, and the scale of the scene's camera for it. */
void gb_packing_image_arrange(const struct gb_packing_image *packing_image,
                              const struct gb_picture_style *style,
                              struct gb_scene *scene, struct gb_caption_layout *layout);

/* Mesa and fontconfig print to stderr; it is redirected meanwhile (not thread-safe). */
bool gb_packing_image_render(struct gb_image **out,
                             const struct gb_packing_image *packing_image,
                             const struct gb_state *state, struct gb_error *err);

/* Renders and writes, with version, title, seed, point and preset as text chunks. */
bool gb_packing_image_write(const struct gb_packing_image *packing_image,
                            const struct gb_state *state, const char *path,
                            struct gb_error *err);

/* Writes a rendered image with the same chunks. */
bool gb_packing_image_save(const struct gb_image *image,
                           const struct gb_packing_image *packing_image,
                           const struct gb_state *state, const char *path,
                           struct gb_error *err);

/* Whether the PNG needs an alpha channel: for a transparent background. */
enum gb_image_alpha gb_packing_image_alpha(const struct gb_packing_image *packing_image);

/* Text chunks; they point into the struct and to its arguments. */
struct gb_packing_image_texts {
    struct gb_image_text text[8];
    int count;
    char seed[24], point[96], density[32], pressure[48];
};
void gb_packing_image_describe(struct gb_packing_image_texts *texts,
                               const struct gb_state *state, const char *preset);

enum { GB_PACKING_IMAGE_ROWS = 6 }; /* most packings of one image */

/* Panels of one image. */
enum gb_packing_image_panels {
    GB_PACKING_IMAGE_ALONE,
    GB_PACKING_IMAGE_WITH_ROSE, /* its rose of forces right of each packing */
};

/* Renders packings one below the other into one PNG; all roses have one scale.  Errors:
 * those of gb_packing_image_write; GB_ERR_INPUT for a rose of a packing in tension. */
bool gb_packing_image_write_panels(const struct gb_packing_image *packing_image,
                                   enum gb_packing_image_panels content,
                                   struct gb_state *const *states, size_t count,
                                   const char *path, struct gb_error *err);

#endif
