#ifndef GB_DRAW_SHEET_H
#define GB_DRAW_SHEET_H

#include "draw/picture.h"

/* Several packings in one image, one below the other, each with the rose of its forces
 * beside it if wanted; the roses have one scale. */
bool gb_sheet_write(const struct gb_picture *picture, bool roses,
                    struct gb_state *const *states, size_t count, const char *path,
                    struct gb_error *err);

#endif
