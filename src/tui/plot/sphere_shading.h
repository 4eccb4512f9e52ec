#ifndef GB_TUI_PLOT_SPHERE_SHADING_H
#define GB_TUI_PLOT_SPHERE_SHADING_H

#include "greenbody/snapshot.h"

/* Shaded view of a packing along y: nearer spheres cover farther ones, and brightness
 * falls with depth.  Pure.
 *
 * shade   rows x cols from the top: 0..1, negative for background
 *
 * Dots are square; the picture is scaled to fit and centred. */
void gb_sphere_shading_render(const struct gb_view_sample *sample, int rows, int cols,
                              float *shade);

#endif
