#ifndef GB_DRAW_IMAGE_CONTACT_SHEET_H
#define GB_DRAW_IMAGE_CONTACT_SHEET_H

#include "draw/packing_image.h"

/* Several packings in one image, one below the other, each with the rose of its forces
 * beside it if wanted; the roses have one scale. */
bool gb_contact_sheet_write(const struct gb_packing_image *picture, bool roses,
                            struct gb_state *const *states, size_t count,
                            const char *path, struct gb_error *err);

#endif
