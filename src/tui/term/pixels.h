#ifndef GB_TUI_TERM_PIXELS_H
#define GB_TUI_TERM_PIXELS_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/snapshot.h"
#include "greenbody/status.h"
#include "tui/panel/sphere_shading.h"
#include "tui/term/term.h"

/* A packing or a picture as a pixel image for terminals with an image protocol, encoded
 * by libchafa.  Without libchafa there are no images. */

/* A PNG file as pixels for the terminal. */
struct gb_png_pixels {
    int wide, high;
    double
        per_inch; /* pixels in print, where the file notes it; 0: it does not, or was read
                        with its pixels */
    uint8_t *rgb; /* 3 bytes a pixel, row by row from the top; NULL: measured only */
};

/* Reads width, height and density in print.  Errors: GB_ERR_INPUT (not a PNG, too
 * large), GB_ERR_MACHINE. */
bool gb_pixels_png_measure(struct gb_png_pixels *out, const char *path,
                           struct gb_error *err);

/* Reads all pixels, with transparent ones on white.  Errors: also GB_ERR_MEMORY. */
bool gb_pixels_png_read(struct gb_png_pixels *out, const char *path,
                        struct gb_error *err);

void gb_pixels_png_finish(struct gb_png_pixels *pixels); /* zeroed is fine */

/* Contents of a pixel image: a packing or a picture. */
struct gb_term_picture {
    const struct gb_view_sample *sample; /* NULL: none */
    const struct gb_png_pixels *picture; /* NULL: none */
    const struct gb_packing_look *look;  /* how the packing is shown */
    const struct gb_rect *cells;         /* cells of the image */
};

/* The pixel image on the screen.  It is drawn after a frame, and deleted before a frame
 * without an image.  At most one per second. */
struct gb_term_image {
    int images;   /* GB_IMAGES_NONE, _SIXEL or _KITTY */
    bool shown;   /* visible now */
    bool waiting; /* a new image is due */
    struct gb_rect rect;
    double density;                      /* hash of the packing shown */
    struct gb_packing_look look;         /* how it was shown */
    const struct gb_png_pixels *picture; /* the picture shown; NULL: a packing */
    int64_t repaints;
    double last_s; /* clock of the last image, s */
};

void gb_pixels_image_init(struct gb_term_image *image, int images);

/* Call before a frame.  True: the screen must be repainted to delete the image. */
bool gb_pixels_image_before(struct gb_term_image *image, struct gb_term *term,
                            const struct gb_term_picture *wanted);

/* Call after a frame: draws the image into the cells if it is new or was deleted. */
void gb_pixels_image_after(struct gb_term_image *image, struct gb_term *term,
                           const struct gb_term_picture *wanted, double now_s);

/* May a pending image be drawn now? */
bool gb_pixels_image_due(const struct gb_term_image *image, double now_s);

bool gb_pixels_available(void);

/* GB_IMAGES_SIXEL, GB_IMAGES_KITTY or GB_IMAGES_NONE, from the environment; the
 * terminal is not asked. */
int gb_pixels_detect(void);

/* Size of a character cell in pixels. */
struct gb_pixels_cell {
    int width, height;
};

#endif
