#ifndef GB_TUI_TERM_TERM_IMAGE_H
#define GB_TUI_TERM_TERM_IMAGE_H

#include <stdbool.h>

#include "greenbody/snapshot.h"
#include "tui/term/rect.h"
#include "tui/term/term.h"

/* The picture that lies on the screen between the characters: drawn behind a frame, taken
 * away before one that does not have it.  At most one a second. */
struct gb_term_image {
    int images;   /* GB_IMAGES_NONE, _SIXEL or _KITTY */
    bool shown;   /* it lies there now */
    bool waiting; /* another one is to be drawn when its time has come */
    struct gb_rect rect;
    double density; /* of the packing shown, which tells it from the next */
    int64_t repaints;
    double last_s; /* clock of the last one */
};

void gb_term_image_init(struct gb_term_image *image, int images);

/* Before a frame; picture: what is to lie there, NULL: nothing.  True: the screen must be
 * painted anew to lose the picture. */
bool gb_term_image_before(struct gb_term_image *image, struct gb_term *term,
                          const struct gb_view_sample *sample);
/* Behind it: draws the picture into those cells when it is another, or was wiped. */
void gb_term_image_after(struct gb_term_image *image, struct gb_term *term,
                         const struct gb_view_sample *sample, const struct gb_rect *cells,
                         double now_s);

/* Whether a picture that waits may be drawn now. */
bool gb_term_image_due(const struct gb_term_image *image, double now_s);

#endif
