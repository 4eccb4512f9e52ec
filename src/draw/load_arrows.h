#ifndef GB_DRAW_LOAD_ARROWS_H
#define GB_DRAW_LOAD_ARROWS_H

#include "draw/scene.h"

/* Arrows of pressing of a scene, inwards over the faces of its axes that are pressed; none
 * where all are, and none in a die without its punch.  Those of the frame (scene.h) lie at the
 * box of the viewpoint's extent where it has one. */
void gb_load_arrows_set(struct gb_scene *scene, const struct gb_state *state,
                        const struct gb_viewpoint *viewpoint);

#endif
