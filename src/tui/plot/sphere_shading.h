#ifndef GB_TUI_PLOT_SPHERE_SHADING_H
#define GB_TUI_PLOT_SPHERE_SHADING_H

#include "greenbody/snapshot.h"
#include "tui/plot/packing_look.h"

/* View of a packing without perspective: nearer spheres cover farther ones.  Spheres are lit,
 * darker with depth, or flat in the shade of their value with a dark rim; walls of a die are
 * outlines.  A die of which all particles are there is cut through its axis, so that the
 * half behind it is seen.  Pure.
 *
 * look    NULL: from the front, by depth
 * shade   rows x cols from the top: 0..1, negative for background, and above 1 the outlines
 *
 * Dots are square; the picture is scaled to fit and centred. */
void gb_sphere_shading_render(const struct gb_view_sample *sample,
                              const struct gb_packing_look *look, int rows, int cols,
                              float *shade);

/* Dots of an outline, by its direction on the screen. */
#define GB_SPHERE_SHADING_UPRIGHT 2.0F
#define GB_SPHERE_SHADING_LEVEL   3.0F
#define GB_SPHERE_SHADING_RISING  4.0F /* to the right */
#define GB_SPHERE_SHADING_FALLING 5.0F

#endif
