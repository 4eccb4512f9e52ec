#ifndef GB_TUI_PLOT_PACKING_LOOK_H
#define GB_TUI_PLOT_PACKING_LOOK_H

#include <stdbool.h>

#include "greenbody/snapshot.h"

/* How the view of the packing looks at it. */

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
void gb_packing_look_rotate(struct gb_packing_look *look, double azimuth_deg,
                          double elevation_deg);

/* Range of the value of a colour that is not the depth: from its least (0 unless negative) to
 * what 95 % of the particles are below, so that few large ones do not darken the rest. */
struct gb_packing_range {
    double low, high;
    bool beyond; /* some particles are above `high` */
};
struct gb_packing_range gb_packing_look_range(const struct gb_view_sample *sample,
                                              enum gb_packing_colour colour);

/* Values of a colour by particle; NULL for the depth. */
const float *gb_packing_look_values(const struct gb_view_sample *sample,
                                    enum gb_packing_colour colour);

/* "coordination number", "pressure, MPa", ... */
const char *gb_packing_look_name(enum gb_packing_colour colour);

#endif
