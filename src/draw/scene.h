#ifndef GB_DRAW_SCENE_H
#define GB_DRAW_SCENE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "draw/view.h"
#include "greenbody/status.h"
#include "run/state.h"

enum gb_ground { GB_GROUND_WHITE, GB_GROUND_DARK, GB_GROUND_TRANSPARENT };

/* What there is to see, in eye coordinates; no GL, no files. */
struct gb_scene {
    struct gb_view view;
    size_t count;
    float *sphere;   /* count x 4: x, y, depth, radius */
    uint8_t *colour; /* count x 4: sRGB and 255 */
    int edge_count;
    float edge[12][6]; /* both ends of the box edges */
    float diameter;    /* 1 d, the length of the shading */
    float light[3];    /* towards the key light, eye coordinates */
    enum gb_ground ground;
    float depth_cue;    /* share of the ground's colour at the far end */
    float shadow_share; /* 0: no shadows */
};

/* Spheres coloured by coordination number in their periodic box, seen so that the box
 * fills the frame.  2D packings are always seen along y without perspective. */
bool gb_scene_create(struct gb_scene **out, const struct gb_state *state,
                     const struct gb_look *look, const struct gb_frame *frame,
                     enum gb_ground ground, struct gb_error *err);
void gb_scene_destroy(struct gb_scene *scene); /* NULL is fine */

/* sRGB of the ground, and of text and lines upon it. */
void gb_scene_ground(enum gb_ground ground, uint8_t rgb[3]);
void gb_scene_ink(enum gb_ground ground, uint8_t rgb[3]);

#endif
