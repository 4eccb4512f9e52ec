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
    double azimuth_deg;   /* angle of the viewer around z; 0: on -y, the front */
    double elevation_deg; /* angle of the viewer above the x-y plane, -90 to 90 */
};

/* Turns the viewer; 2D packings are always seen from the front. */
void gb_sphere_shading_rotate(struct gb_packing_look *look, double azimuth_deg,
                              double elevation_deg);

/* Range of the values of a colour: from the least value (0 unless negative) to the
 * value that 95 % of the particles do not exceed, so that a few large values do not
 * darken the rest. */
struct gb_packing_range {
    double low, high;
    bool beyond; /* some particles are above `high` */
};

struct gb_packing_range gb_sphere_shading_range(const struct gb_view_sample *sample,
                                                enum gb_packing_colour colour);

/* "coordination number", "pressure, MPa", ... */
const char *gb_sphere_shading_name(enum gb_packing_colour colour);

/* Draws a packing without perspective; nearer spheres cover farther ones.  Spheres are
 * lit and darker with depth, or flat in the shade of their value with a dark rim.
 * Walls of a die are outlines.  A die with all of its particles is cut through its
 * axis, so that the half behind it is visible.
 *
 * look    NULL: from the front, by depth
 * shade   rows x cols from the top: 0..1, negative for background, above 1 for outlines
 *
 * Dots are square; the picture is scaled to fit and centred. */
void gb_sphere_shading_render(const struct gb_view_sample *sample,
                              const struct gb_packing_look *look, int rows, int cols,
                              float *shade);

/* Values of the dots of an outline, by its direction on the screen. */
#define GB_SPHERE_SHADING_UPRIGHT 2.0F
#define GB_SPHERE_SHADING_LEVEL   3.0F
#define GB_SPHERE_SHADING_RISING  4.0F /* to the right */
#define GB_SPHERE_SHADING_FALLING 5.0F

#endif
