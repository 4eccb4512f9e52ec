#ifndef GB_RUN_EXPERIMENT_PRIVATE_H
#define GB_RUN_EXPERIMENT_PRIVATE_H

#include "run/experiment.h"
#include "solve/event_queue.h"
#include "solve/loading/loading.h"

/* Members of gb_experiment, for experiment.c (owner), checkpoint.c (records) and
 * change.c. */
struct gb_experiment {
    struct gb_params params;
    struct gb_model *model; /* owned; another one after a change */
    struct gb_loading *loading;
    double elastic_start;  /* elastic energy at the start; only in scenes with energies */
    int64_t step;          /* points recorded */
    int64_t unrelaxed;     /* of them above the tolerance */
    bool over, stopped;    /* nothing follows; a guard ended it */
    struct gb_point point; /* the last recorded one */
    struct gb_point shown; /* of the packing as it is: after an unloading branch, where
                            * that branch began */
    struct gb_event_queue events;
};

#endif
