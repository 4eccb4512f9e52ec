#ifndef GB_RUNNER_VIEW_SAMPLING_H
#define GB_RUNNER_VIEW_SAMPLING_H

#include "greenbody/snapshot.h"
#include "pack/cell/cell.h"
#include "run/experiment.h"

/* Where the particles were: a zeroed one is taken anew. */
struct gb_view_start {
    double *position; /* count x 3 */
    int64_t count;
    struct gb_cell cell;
    double half_width; /* of the widest box of a die so far, while it has its funnel */
    double height;
    bool pressed; /* taken when pressing had begun */
};
void gb_view_sampling_finish(struct gb_view_start *start);

/* What the screen's views of a packing need, taken between two slices: the particles
 * nearest to the front (y = 0), as many as fit, and g(r).  Costs a pass over all
 * particles and their near neighbours; without memory a part of it is missing. */
void gb_view_sampling_take(const struct gb_experiment *experiment,
                           struct gb_view_start *start, struct gb_view_sample *sample);

/* The same of a state.  pressed: pressing has begun. */
void gb_view_sampling_take_state(const struct gb_state *state, bool pressed,
                                 struct gb_view_start *start,
                                 struct gb_view_sample *sample);

#endif
