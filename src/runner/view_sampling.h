#ifndef GB_RUNNER_VIEW_SAMPLING_H
#define GB_RUNNER_VIEW_SAMPLING_H

#include "greenbody/snapshot.h"
#include "pack/cell/cell.h"
#include "run/experiment.h"

/* Reference positions for displacements.  A zeroed struct is filled at the next sample.
 */
struct gb_view_start {
    double *position; /* count x 3 */
    int64_t count;
    struct gb_cell cell;
    double half_width; /* of the widest die box while there is a funnel */
    double height;
    bool pressed; /* taken after pressing began */
};
void gb_view_sampling_finish(struct gb_view_start *start);

/* Takes a view sample between two slices: the particles nearest to the front (y = 0),
 * as many as fit, and g(r).  Costs a pass over all particles and their near neighbours.
 * If memory is short, a part of it is missing. */
void gb_view_sampling_take(const struct gb_experiment *experiment,
                           struct gb_view_start *start, struct gb_view_sample *sample);

/* Takes the sample from a state. pressed: pressing has begun. */
void gb_view_sampling_take_state(const struct gb_state *state, bool pressed,
                                 struct gb_view_start *start,
                                 struct gb_view_sample *sample);

#endif
