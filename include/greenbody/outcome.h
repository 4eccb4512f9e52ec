#ifndef GREENBODY_OUTCOME_H
#define GREENBODY_OUTCOME_H

#ifdef __cplusplus
extern "C" {
#endif

/* How an advance of a run ended. */
enum gb_run_outcome {
    GB_RUN_OUTCOME_NONE,      /* the run has not ended */
    GB_RUN_OUTCOME_DONE,      /* the loading is complete */
    GB_RUN_OUTCOME_STOPPED,   /* by a guard, or not converged; results are kept */
    GB_RUN_OUTCOME_CANCELLED, /* on request; results are kept */
    GB_RUN_OUTCOME_FAILED     /* out of memory, bad input, or no permission to write */
};

#ifdef __cplusplus
}
#endif

#endif
