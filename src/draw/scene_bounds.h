#ifndef GB_DRAW_SCENE_BOUNDS_H
#define GB_DRAW_SCENE_BOUNDS_H

#include "draw/scene.h"

/* Sets the bounds of the scene's camera to what is drawn: outlines of the spheres and rods,
 * edges of the box, walls of the die.  Unchanged for an empty scene. */
void gb_scene_bounds_tighten(struct gb_scene *scene);

/* Extends the bounds by a point in eye coordinates; by the arrows of the frame. */
void gb_scene_bounds_include(struct gb_scene *scene, const double eye[3]);
void gb_scene_bounds_include_arrows(struct gb_scene *scene);

#endif
