#ifndef GB_DRAW_HIDDEN_H
#define GB_DRAW_HIDDEN_H

#include <stdint.h>

#include "draw/scene.h"

/* Camera of a rendering pass in the form of the shaders' uniform variables. */
struct gb_camera {
    float projection[4];  /* axis x and y, focal length in samples; 1: no perspective */
    float depth_range[2]; /* depth of 0 and of 1 in the depth buffer */
    float rotation[9],
        translation[3]; /* from the scene's coordinates; matrix by columns */
};

/* Occlusion culling: spheres and rods of a scene that lie wholly behind others, which are
 * most of a dense packing.  A picture without them has the same samples.
 *
 * width, height   of the target, samples
 * hidden          scene->count + scene->rods, spheres first; 1: need not be drawn; 0
 *                 also for what extends beyond the target. */
bool gb_hidden_find(const struct gb_scene *scene, const struct gb_camera *camera,
                    int width, int height, uint8_t *hidden, struct gb_error *err);

#endif
