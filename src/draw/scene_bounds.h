#ifndef GB_DRAW_SCENE_BOUNDS_H
#define GB_DRAW_SCENE_BOUNDS_H

#include "draw/scene.h"

/* Sets the bounds of the scene's camera to what is drawn: outlines of the spheres and rods,
 * edges of the box.  Unchanged for an empty scene. */
void gb_scene_bounds_tighten(struct gb_scene *scene);

#endif
