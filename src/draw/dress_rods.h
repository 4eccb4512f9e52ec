#ifndef GB_DRAW_DRESS_RODS_H
#define GB_DRAW_DRESS_RODS_H

#include "draw/dress.h"

/* The forces of a packing as rods between the centres of particles: as thick as the force
 * is large, coloured by its sign or by whether it acts over a bridge.  A contact across
 * the wall of the periodic cell is two halves. Fills the rods and swatches of a dress
 * whose `hidden` is there. */
bool gb_dress_rods_make(struct gb_dress *dress, const struct gb_state *state,
                        const struct gb_dress_request *request, struct gb_error *err);

#endif
