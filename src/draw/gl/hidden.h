#ifndef GB_DRAW_GL_HIDDEN_H
#define GB_DRAW_GL_HIDDEN_H

#include <stdint.h>

#include "draw/gl/camera.h"
#include "draw/scene.h"

/* Which spheres and rods of a scene stand wholly behind others: most of a dense packing.
 * Leaving them out changes no sample of the picture.
 *
 * width, height   of the target, samples
 * hidden          scene->count + scene->rods, spheres first; 1: need not be drawn.  What
 *                 reaches beyond the target counts as seen. */
bool gb_hidden_find(const struct gb_scene *scene, const struct gb_camera *camera,
                    int width, int height, uint8_t *hidden, struct gb_error *err);

#endif
