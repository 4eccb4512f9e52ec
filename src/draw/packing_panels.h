#ifndef GB_DRAW_PACKING_PANELS_H
#define GB_DRAW_PACKING_PANELS_H

#include "draw/packing_image.h"

enum { GB_PACKING_PANELS_ROWS = 6 }; /* most packings of one image */

/* Panels of one image. */
enum gb_packing_panels_content {
    GB_PACKING_PANELS_PACKING,
    GB_PACKING_PANELS_WITH_ROSE, /* its rose of forces right of each packing */
};

/* Renders packings one below the other into one PNG; all roses have one scale.  Errors:
 * those of gb_packing_image_write; GB_ERR_INPUT for a rose of a packing in tension. */
bool gb_packing_panels_write(const struct gb_packing_image *packing_image,
                             enum gb_packing_panels_content content,
                             struct gb_state *const *states, size_t count,
                             const char *path, struct gb_error *err);

#endif
