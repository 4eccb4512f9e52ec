#ifndef GB_TUI_TERM_TERM_IMAGE_H
#define GB_TUI_TERM_TERM_IMAGE_H

#include <stdbool.h>

#include "greenbody/snapshot.h"
#include "tui/plot/packing_look.h"
#include "tui/term/png_pixels.h"
#include "tui/term/rect.h"
#include "tui/term/term.h"

/* What a pixel image shows: a packing or a picture. */
struct gb_term_picture {
    const struct gb_view_sample *sample; /* NULL: none */
    const struct gb_png_pixels *picture; /* NULL: none */
    const struct gb_packing_look *look;  /* at the packing */
    const struct gb_rect *cells;         /* of the image */
};

/* The pixel image on the screen: drawn after a frame, deleted before a frame without it.
 * At most one per second. */
struct gb_term_image {
    int images;   /* GB_IMAGES_NONE, _SIXEL or _KITTY */
    bool shown;   /* visible now */
    bool waiting; /* a new one is due */
    struct gb_rect rect;
    double density;              /* hash of the packing shown */
    struct gb_packing_look look; /* at it */
    const struct gb_png_pixels *picture; /* the picture shown; NULL: a packing */
    int64_t repaints;
    double last_s; /* clock of the last image, s */
};

void gb_term_image_init(struct gb_term_image *image, int images);

/* Call before a frame.  True: the screen must be repainted to delete the image. */
bool gb_term_image_before(struct gb_term_image *image, struct gb_term *term,
                          const struct gb_term_picture *wanted);
/* Call after a frame: draws the image into the cells if it is new or was deleted. */
void gb_term_image_after(struct gb_term_image *image, struct gb_term *term,
                         const struct gb_term_picture *wanted, double now_s);

/* Whether a pending image may be drawn now. */
bool gb_term_image_due(const struct gb_term_image *image, double now_s);

#endif
