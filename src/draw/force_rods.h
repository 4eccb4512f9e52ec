#ifndef GB_DRAW_FORCE_RODS_H
#define GB_DRAW_FORCE_RODS_H

#include "draw/picture_style.h"

/* The forces of a packing as rods between the centres of particles: as thick as the force
 * is large, coloured by its sign or by whether it acts over a bridge.  A contact across
 * the wall of the periodic cell is two halves. Fills the rods and swatches of a dress
 * whose `hidden` is there. */
bool gb_force_rods_make(struct gb_picture_style *dress, const struct gb_state *state,
                        const struct gb_picture_style_request *request,
                        struct gb_error *err);

#endif
