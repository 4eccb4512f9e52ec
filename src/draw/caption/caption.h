#ifndef GB_DRAW_CAPTION_CAPTION_H
#define GB_DRAW_CAPTION_CAPTION_H

#include <stdbool.h>

#include "draw/caption/caption_layout.h"
#include "draw/image/image.h"
#include "draw/scene.h"
#include "greenbody/status.h"
#include "io/state/state.h"

/* Largest of 1, 2, 5 x 10^k m that is at most `max_m`; label: its text. */
double gb_caption_bar_length(double max_m, char *label, size_t size);

bool gb_caption_draw(struct gb_image *image, const struct gb_caption_layout *layout,
                     const struct gb_scene *scene, const struct gb_picture_style *style,
                     const struct gb_state *state, struct gb_error *err);

/* Texts around a rose of forces in a box with half the edge `reach`; mean_n: mean force, N. */
bool gb_caption_draw_rose(struct gb_image *image, const struct gb_caption_layout *layout,
                          const struct gb_scene *scene, double reach, double mean_n,
                          struct gb_error *err);

#endif
