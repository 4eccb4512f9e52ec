#ifndef GB_RUN_PICTURE_H
#define GB_RUN_PICTURE_H

#include "greenbody/snapshot.h"
#include "run/experiment.h"

/* What the screen's pictures of a packing need, taken between two slices: the particles
 * nearest to the front (y = 0), as many as fit, and g(r).  Costs a pass over all
 * particles and their near neighbours; without memory a part of it is missing. */
void gb_picture_take(const struct gb_experiment *experiment, struct gb_picture *picture);

#endif
