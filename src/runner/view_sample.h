#ifndef GB_RUNNER_VIEW_SAMPLE_H
#define GB_RUNNER_VIEW_SAMPLE_H

#include "greenbody/snapshot.h"
#include "run/experiment.h"

/* What the screen's views of a packing need, taken between two slices: the particles
 * nearest to the front (y = 0), as many as fit, and g(r).  Costs a pass over all
 * particles and their near neighbours; without memory a part of it is missing. */
void gb_view_sample_take(const struct gb_experiment *experiment,
                         struct gb_view_sample *sample);

#endif
