#ifndef GB_DRAW_RENDERER_H
#define GB_DRAW_RENDERER_H

#include <stdbool.h>

#include "draw/image.h"
#include "draw/scene.h"
#include "greenbody/status.h"

/* Off-screen renderer of scenes: OpenGL 3.3 of the libraries in gl_context.h. */
struct gb_renderer;

/* Errors: GB_ERR_MACHINE when there is no OpenGL 3.3 or its compiler fails. */
bool gb_renderer_open(struct gb_renderer **out, struct gb_error *err);

/* Fills the whole image, whose frame the scene was made for, in tiles: memory beside the
 * image is bounded.  Same scene and library, same bits. */
bool gb_renderer_render(struct gb_renderer *renderer, const struct gb_scene *scene,
                        struct gb_image *image, struct gb_error *err);

void gb_renderer_close(struct gb_renderer *renderer); /* NULL is fine */

#endif
