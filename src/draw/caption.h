#ifndef GB_DRAW_CAPTION_H
#define GB_DRAW_CAPTION_H

#include <stdbool.h>

#include "draw/image/image.h"
#include "draw/scene.h"
#include "greenbody/status.h"
#include "io/state.h"

/* Text, colour bar and scale bar around the packing. */
struct gb_caption_layout {
    struct gb_frame scene; /* room for the packing */
    struct gb_frame bar;   /* colour bar; width 0: image too small for words */
    double unit;           /* height of a line of text, pixels */
};

/* Pure: sizes -> rectangles. */
void gb_caption_place(int width, int height, bool words,
                      struct gb_caption_layout *layout);

/* Longest of 1, 2, 5 x 10^k nm (or um, mm) that is at most `most` metres; label is its
 * text. */
double gb_caption_bar_length(double most, char *label, size_t size);

bool gb_caption_draw(struct gb_image *image, const struct gb_caption_layout *layout,
                     const struct gb_scene *scene, const struct gb_picture_style *dress,
                     const struct gb_state *state, struct gb_error *err);

/* Words around a rose of forces whose box has half the edge `reach`. */
bool gb_caption_draw_rose(struct gb_image *image, const struct gb_caption_layout *layout,
                          const struct gb_scene *scene, double reach, double mean_n,
                          struct gb_error *err);

#endif
