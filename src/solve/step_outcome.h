#ifndef GB_SOLVE_STEP_OUTCOME_H
#define GB_SOLVE_STEP_OUTCOME_H

/* How a slice of work of a loading mode (solve/loading/loading.h) ended, from the integrator up
 * to the run loop. */
enum gb_step_outcome {
    GB_STEP_MORE,   /* the slice is used up, no new point */
    GB_STEP_POINT,  /* time to record: forces, positions and histories belong together */
    GB_STEP_DONE,   /* the loading has ended */
    GB_STEP_STOPPED /* a guard stopped it (err); the packing is in the last good state */
};

#endif
