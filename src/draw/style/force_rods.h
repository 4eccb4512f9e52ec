#ifndef GB_DRAW_STYLE_FORCE_RODS_H
#define GB_DRAW_STYLE_FORCE_RODS_H

#include "draw/style/picture_style.h"

/* Normal forces as rods between particle centres, and from these to the walls of a die:
 * thickness proportional to the force, colour by its class.  Fills rods and legend of a style
 * with known hidden particles. */
bool gb_force_rods_make(struct gb_picture_style *style, const struct gb_state *state,
                        const struct gb_picture_style_request *request,
                        struct gb_error *err);

/* Radius of a rod, d, of a force over that of the thickest one. */
double gb_force_rods_radius(double ratio);

#endif
