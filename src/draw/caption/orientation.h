#ifndef GB_DRAW_CAPTION_ORIENTATION_H
#define GB_DRAW_CAPTION_ORIENTATION_H

#include "draw/caption/caption_pen.h"
#include "draw/scene.h"
#include "draw/view.h"

/* The axes of the cell as the camera sees them, in a frame: x, y, z, of discs x and z.  An
 * axis along the view is a circle with a dot (towards the viewer) or a cross. */
void gb_orientation_draw_axes(const struct gb_caption_pen *pen,
                              const struct gb_frame *frame, const struct gb_view *view,
                              int dimension);

/* Arrows of pressing, with their word beside the steepest one, clear of the packing
 * (load_label.h).  An arrow along the view is a circle
 * with a dot or a cross, before the word that ends at `corner`.  Returns the width that this
 * takes there, pixels, or 0. */
double gb_orientation_draw_load(const struct gb_caption_pen *pen,
                                const struct gb_scene *scene, const double corner[2]);

#endif
