#ifndef GB_MEASURE_DENSITY_MAP_H
#define GB_MEASURE_DENSITY_MAP_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/status.h"

/* Relative density of spheres over rings about the z axis: bands of equal height times
 * rings of equal width.  Any unit of length. */
struct gb_density_map {
    int rings, bands;
    double radius;    /* of the outermost ring */
    double low, high; /* heights */
};

/* Area that a disc of radius a shares with one of radius b at this distance of the
 * centres. */
double gb_density_map_shared_area(double a, double b, double distance);

/* Volume of a sphere within a cylinder about the z axis, between two heights: the shared
 * areas of its sections, by Gauss' rule of 24 points in the angle asin(z/r) on each of the
 * intervals between the heights at which a section begins to touch the cylinder or leaves
 * it.  Relative error below 1e-6 of the sphere.
 *
 * sphere     radius, 0 or more
 * axis       distance of the sphere's centre from the axis
 * low, high  heights above the sphere's centre, low <= high */
double gb_density_map_cylinder(double cylinder, double sphere, double axis, double low,
                               double high);

/* density  rings x bands values, ring by ring: solid over the volume of each.  Where
 *          spheres overlap, their shared volume counts twice.
 * position count x 3, the axis through centre[0], centre[1]
 * radius   count */
void gb_density_map_fill(const struct gb_density_map *map, int64_t count,
                         const double *position, const double *radius,
                         const double centre[2], double *density);

#endif
