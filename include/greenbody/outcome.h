#ifndef GREENBODY_OUTCOME_H
#define GREENBODY_OUTCOME_H

#ifdef __cplusplus
extern "C" {
#endif

/* How an advance of a run has ended. */
enum gb_run_outcome {
    GB_RUN_OUTCOME_NONE,      /* not at the end of the run */
    GB_RUN_OUTCOME_DONE,      /* the loading program has ended */
    GB_RUN_OUTCOME_STOPPED,   /* by a guard, or not converged; results kept */
    GB_RUN_OUTCOME_CANCELLED, /* on request; results kept */
    GB_RUN_OUTCOME_FAILED     /* no memory, bad input, or a directory not writable */
};

#ifdef __cplusplus
}
#endif

#endif
