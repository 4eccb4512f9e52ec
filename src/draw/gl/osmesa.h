#ifndef GB_DRAW_GL_OSMESA_H
#define GB_DRAW_GL_OSMESA_H

#include <stdbool.h>

#include "draw/image/image.h"
#include "draw/scene.h"
#include "greenbody/status.h"

/* Off-screen renderer of scenes: OSMesa's software OpenGL 3.3. */
struct gb_osmesa;

/* Errors: GB_ERR_MACHINE when there is no OpenGL 3.3 or its compiler fails. */
bool gb_osmesa_open(struct gb_osmesa **out, struct gb_error *err);

/* Fills the whole image, whose frame the scene was made for, in tiles: memory beside the
 * image is bounded.  Same scene, same bits. */
bool gb_osmesa_render(struct gb_osmesa *renderer, const struct gb_scene *scene,
                      struct gb_image *image, struct gb_error *err);

void gb_osmesa_close(struct gb_osmesa *renderer); /* NULL is fine */

#endif
