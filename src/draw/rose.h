#ifndef GB_DRAW_ROSE_H
#define GB_DRAW_ROSE_H

#include <stdbool.h>

#include "draw/scene.h"
#include "measure/harmonics.h"

/* The rose of forces as a closed surface: its radius in each direction is the mean
 * normal force of the contacts along it, over the mean of all.  Without anisotropy it is
 * a sphere of radius 1; the rings have that radius.  Of a packing in 2D it is a figure in
 * the plane of x and z, seen along y, with one ring. */

/* Fits the contacts of a packing.  Errors: those of gb_harmonics_fit. */
bool gb_rose_of_state(struct gb_harmonics *rose, const struct gb_state *state,
                      struct gb_error *err);

/* Half the edge of the box around a rose; the colour scale runs from 0 to it. */
double gb_rose_reach(const struct gb_harmonics *rose);

bool gb_rose_scene(struct gb_scene **out, const struct gb_harmonics *rose, double reach,
                   const struct gb_viewpoint *viewpoint, const struct gb_frame *frame,
                   enum gb_background background, struct gb_error *err);

#endif
