#ifndef GB_TUI_TERM_PIXELS_H
#define GB_TUI_TERM_PIXELS_H

#include <stdbool.h>

#include "greenbody/snapshot.h"
#include "tui/term/rect.h"

/* The packing in real pixels, for terminals that show pictures between their characters.
 * The pictures are encoded by libchafa, without which there are none. */

bool gb_pixels_available(void);

/* GB_IMAGES_SIXEL, GB_IMAGES_KITTY or GB_IMAGES_NONE: what the terminal can by its
 * environment; nothing is asked of it. */
int gb_pixels_detect(void);

/* Size of a character cell in pixels. */
struct gb_pixels_cell {
    int width, height;
};

/* The relief of a packing in so many cells, as what is to be sent to the terminal with
 * the cursor in its upper left corner; g_free.  NULL: no memory, or no libchafa. */
char *gb_pixels_encode(int images, const struct gb_view_sample *sample, int rows,
                       int cols, struct gb_pixels_cell cell);

/* What takes all pictures off a terminal of that kind; "" where text does. */
const char *gb_pixels_wipe(int images);

#endif
