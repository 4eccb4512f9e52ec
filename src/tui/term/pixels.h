#ifndef GB_TUI_TERM_PIXELS_H
#define GB_TUI_TERM_PIXELS_H

#include <stdbool.h>

#include "greenbody/snapshot.h"
#include "tui/plot/packing_look.h"
#include "tui/term/png_pixels.h"
#include "tui/term/rect.h"

/* The packing, or a picture, as a pixel image for terminals with an image protocol, encoded
 * by libchafa; without libchafa there are no images. */

bool gb_pixels_available(void);

/* GB_IMAGES_SIXEL, GB_IMAGES_KITTY or GB_IMAGES_NONE, from the environment; the terminal
 * is not queried. */
int gb_pixels_detect(void);

/* Size of a character cell in pixels. */
struct gb_pixels_cell {
    int width, height;
};

/* The shaded view of a packing as an escape sequence, sent with the cursor at the upper
 * left cell; g_free.  NULL: out of memory, or no libchafa. */
char *gb_pixels_encode(int images, const struct gb_view_sample *sample,
                       const struct gb_packing_look *look, int rows, int cols,
                       struct gb_pixels_cell cell);

/* The same of a picture, over all of the cells. */
char *gb_pixels_encode_picture(int images, const struct gb_png_pixels *picture, int rows,
                               int cols, struct gb_pixels_cell cell);

/* Sequence that deletes all images of the terminal; "" where text overwrites them. */
const char *gb_pixels_wipe(int images);

#endif
