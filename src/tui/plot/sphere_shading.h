#ifndef GB_TUI_PLOT_SPHERE_SHADING_H
#define GB_TUI_PLOT_SPHERE_SHADING_H

#include "greenbody/snapshot.h"

/* A packing as a relief of lit spheres, seen along y: what is in front hides what is
 * behind, and what is deeper is darker.  Pure.
 *
 * shade   rows x cols, from the top: 0..1, negative where nothing is
 * Dots are square; the window of the picture is scaled to fit and stands in the middle.
 */
void gb_sphere_shading_render(const struct gb_view_sample *sample, int rows, int cols,
                              float *shade);

#endif
