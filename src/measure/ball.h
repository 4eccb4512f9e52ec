#ifndef GB_MEASURE_BALL_H
#define GB_MEASURE_BALL_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/status.h"

/* Exact volumes of spheres cut by spheres and planes, and the densities that P3 takes
 * from them.  Any unit of length.  Sums of positive terms throughout: the relative error
 * is a few units in the last place for any ratio of sizes and for the smallest overlap,
 * as far as the given lengths determine it.  NaN gives NaN. */

double gb_ball_volume(double radius);

/* Volume of the intersection of two spheres: 0 when apart, that of the smaller one when
 * it lies inside the other.
 *
 * a, b       radii, 0 or more
 * distance   of the centres, 0 or more */
double gb_ball_shared_volume(double a, double b, double distance);

/* Part of a sphere between two planes at heights low <= high above its centre, which may
 * be infinite: gb_ball_slab(r, -INFINITY, h) lies below a punch at h. */
double gb_ball_slab(double radius, double low, double high);

/* Solid of spheres within a ball, the sum of gb_ball_shared_volume.  Where spheres are
 * pressed into each other the shared volume counts twice, as in P3: of z contacts of
 * overlap h in units of the diameter, a part 3/4 z h^2 of the solid, 4.5e-6 for 6
 * contacts of 0.1 % (50 MPa) and 4.5e-4 for 1 %.  gb_ball_overlap_volume gives it
 * exactly.
 *
 * position   count x 3
 * radius     count */
double gb_ball_solid_volume(int64_t count, const double *position, const double *radius,
                            const double centre[3], double ball_radius);

/* Density of a whole specimen in a die: solid of all spheres over the cylinder from floor
 * to punch (P3 5).  The loose wall layer makes it lower than that of a ball in the
 * middle. NaN when the height is not positive. */
double gb_ball_density_whole(int64_t count, const double *radius, double die_radius,
                             double height);

/* Density within a ball (P3 5: 54 um wide, in the middle of the specimen).  The
 * caller makes sure that the ball lies clear of walls, floor and punch. */
double gb_ball_density_central(int64_t count, const double *position,
                               const double *radius, const double centre[3],
                               double ball_radius);

/* Volume shared by pairs i < other[k], k in [start[i], start[i + 1]); a volume common to
 * three spheres counts once per pair.
 *
 * start   count + 1 */
double gb_ball_overlap_volume(int64_t count, const double *position, const double *radius,
                              const int64_t *start, const int32_t *other);

/* Relative density of spheres over rings about the z axis: bands of equal height times
 * rings of equal width.  Any unit of length. */
struct gb_density_map {
    int rings, bands;
    double radius;    /* of the outermost ring */
    double low, high; /* heights */
};

/* Volume of a sphere within a cylinder about the z axis, between two heights: the shared
 * areas of its sections, by Gauss' rule of 24 points in the angle asin(z/r) on each of the
 * intervals between the heights at which a section begins to touch the cylinder or leaves
 * it.  Relative error below 1e-6 of the sphere.
 *
 * sphere     radius, 0 or more
 * axis       distance of the sphere's centre from the axis
 * low, high  heights above the sphere's centre, low <= high */
double gb_ball_cylinder(double cylinder, double sphere, double axis, double low,
                        double high);

/* density  rings x bands values, ring by ring: solid over the volume of each.  Where
 *          spheres overlap, their shared volume counts twice.
 * position count x 3, the axis through centre[0], centre[1]
 * radius   count */
void gb_ball_density_map(const struct gb_density_map *map, int64_t count,
                         const double *position, const double *radius,
                         const double centre[2], double *density);

#endif
