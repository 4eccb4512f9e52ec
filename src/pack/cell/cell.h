#ifndef GB_PACK_CELL_CELL_H
#define GB_PACK_CELL_CELL_H

#include <math.h>
#include <stdbool.h>

#include "base/deformation.h"

/* Periodic box in reduced units; its edge vectors are the columns of the matrix H.  In 2D
 * the scene lies in the x-z plane: axis 1 has edge 1 and is not periodic.
 *
 * Loading keeps H upper triangular: a = (Lx, 0, 0), b = (xy, Ly, 0), c = (xz, yz, Lz), the
 * convention of LAMMPS and OVITO.  Scenes that never shear have tilts of 0.  Small
 * symmetric probe strains fill `below` on a copy of a packing. */
struct gb_cell {
    double edge[3];  /* diagonal of H, d */
    double tilt[3];  /* above it: xy, xz, yz */
    double below[3]; /* below it: yx, zx, zy */
    double shear[3]; /* engineering shear xy, xz, yz since the start, summed over steps */
    bool periodic[3];
};

/* The whole number nearest to x, |x| < 2^51, the even one of two.  The sum has no digits
 * left behind the point; the C library's functions would be called number by number. */
static inline double gb_cell_whole(double x)
{
    const double large = 0x1.8p52;
    return (x + large) - large;
}

/* An element off the diagonal of H is not 0. */
static inline bool gb_cell_tilted(const struct gb_cell *cell)
{
    return fabs(cell->tilt[0]) + fabs(cell->tilt[1]) + fabs(cell->tilt[2]) +
               fabs(cell->below[0]) + fabs(cell->below[1]) + fabs(cell->below[2]) >
           0.0; /* one comparison: it is asked for every pair */
}

void gb_cell_init(struct gb_cell *cell, int dimension, const double edge[3]);
/* H, and its inverse. */
void gb_cell_matrix(const struct gb_cell *cell, double matrix[3][3]);
void gb_cell_inverse(const struct gb_cell *cell, double inverse[3][3]);
/* Coordinates in edge vectors, H^-1 x. */
void gb_cell_fraction(const struct gb_cell *cell, const double x[3], double fraction[3]);
/* Nearest image of the difference r (in place).  In a tilted cell this is certain for
 * distances below half the least distance of faces. */
void gb_cell_nearest(const struct gb_cell *cell, double r[3]);
/* Moves x into [0, 1) of every periodic edge vector (in place); in a tilted cell within
 * rounding. */
void gb_cell_wrap(const struct gb_cell *cell, double x[3]);
double gb_cell_volume(const struct gb_cell *cell);
/* Distance of the two faces that edge vector k leads across: the edge, without tilt. */
double gb_cell_spacing(const struct gb_cell *cell, int k);
/* Least distance of two periodic faces: the shortest periodic edge, without tilt. */
double gb_cell_shortest(const struct gb_cell *cell);

/* H' = F H. */
void gb_cell_deform(struct gb_cell *cell, const struct gb_deformation *deformation);
/* F of the motion from one cell to another of the same packing; a fold in between does not
 * count.  For strains below half an edge. */
struct gb_deformation gb_cell_motion(const struct gb_cell *before,
                                     const struct gb_cell *after);
/* The same lattice of images with tilts of at most half an edge.  True if one changed; the
 * images of pairs are others then. */
bool gb_cell_fold(struct gb_cell *cell);

#endif
