#ifndef GB_DRAW_ROSE_H
#define GB_DRAW_ROSE_H

#include <stdbool.h>
#include <stddef.h>

#include "draw/scene.h"
#include "greenbody/status.h"

/* A function of direction that is even (equal along u and -u), as the mean force over the
 * direction of the contact: the even spherical harmonics of orders 0, 2 and 4, written as
 * a form of degree 4 in the components of the direction. */
enum { GB_ROSE_TERMS = 15 };

struct gb_rose {
    double term[GB_ROSE_TERMS];
    double mean; /* over all values, not over directions */
    size_t count;
    int dimension; /* 2: of the plane y = 0 */
};

/* Least squares over count values; axis: count x 3, of any length above 0.  In 2D
 * (dimension 2) terms with y are left out.  Errors: GB_ERR_INPUT with fewer values than
 * terms or axes that do not determine all terms, GB_ERR_MEMORY. */
bool gb_rose_fit(struct gb_rose *rose, int dimension, const double *axis,
                 const double *value, size_t count, struct gb_error *err);

/* The fitted function in a direction of any length above 0. */
double gb_rose_at(const struct gb_rose *rose, const double direction[3]);

/* The rose of forces as a closed surface: its radius in each direction is the mean
 * normal force of the contacts along it, over the mean of all.  Without anisotropy it is
 * a sphere of radius 1; the rings have that radius.  Of a packing in 2D it is a figure in
 * the plane of x and z, seen along y, with one ring. */

/* Fits the contacts of a packing.  Errors: see gb_rose_fit. */
bool gb_rose_of_state(struct gb_rose *rose, const struct gb_state *state,
                      struct gb_error *err);

/* Half the edge of the box around a rose; the colour scale runs from 0 to it. */
double gb_rose_reach(const struct gb_rose *rose);

bool gb_rose_scene(struct gb_scene **out, const struct gb_rose *rose, double reach,
                   const struct gb_viewpoint *viewpoint, const struct gb_frame *frame,
                   enum gb_background background, struct gb_error *err);

#endif
