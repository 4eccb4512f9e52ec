#ifndef GB_TUI_PANEL_SPHERE_SHADING_H
#define GB_TUI_PANEL_SPHERE_SHADING_H

#include <stdbool.h>

#include "greenbody/snapshot.h"

enum gb_packing_colour {
    GB_PACKING_COLOUR_DEPTH,
    GB_PACKING_COLOUR_CONTACTS,
    GB_PACKING_COLOUR_PRESSURE,
    GB_PACKING_COLOUR_DISPLACEMENT,
    GB_PACKING_COLOURS
};

struct gb_packing_look {
    enum gb_packing_colour colour;
    double azimuth_deg;   /* of the viewer around z; 0: on -y, as the front */
    double elevation_deg; /* of the viewer above the x-y plane, -90 to 90 */
};

/* Turns the viewer; 2D packings are seen from the front always. */
void gb_sphere_shading_rotate(struct gb_packing_look *look, double azimuth_deg,
                              double elevation_deg);

/* Range of the value of a colour that is not the depth: from its least (0 unless negative) to
 * what 95 % of the particles are below, so that few large ones do not darken the rest. */
struct gb_packing_range {
    double low, high;
    bool beyond; /* some particles are above `high` */
};

struct gb_packing_range gb_sphere_shading_range(const struct gb_view_sample *sample,
                                                enum gb_packing_colour colour);

/* "coordination number", "pressure, MPa", ... */
const char *gb_sphere_shading_name(enum gb_packing_colour colour);

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
