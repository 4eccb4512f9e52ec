#ifndef GB_API_SIMULATION_PRIVATE_H
#define GB_API_SIMULATION_PRIVATE_H

#include <stdatomic.h>

#include "api/array_private.h"
#include "greenbody/simulation.h"
#include "run/run_loop.h"

/* Where a simulation begins. */
enum gb_simulation_origin {
    GB_SIMULATION_NEW,     /* the packing is built by the first advance */
    GB_SIMULATION_RESUMED, /* in its directory */
    GB_SIMULATION_LOADED   /* from a state */
};

/* The inside of gb_simulation. */
struct gb_simulation {
    struct gb_params params;
    struct gb_run_loop loop;
    struct gb_curve *curve;
    struct gb_array_source packing; /* of the experiment, for arrays */
    enum gb_simulation_origin origin;
    enum gb_run_outcome outcome; /* of the last advance */
    char *directory;             /* of the records, before the recorder; NULL: none */
    enum gb_rundir_mode mode;
    char resumed[96];  /* event of the next advance; empty: none */
    double returned_s; /* clock reading when the last advance ended; 0: none yet */
    _Atomic(const char *) reason; /* of cancelling; NULL: not cancelled */
    void (*on_point)(void *data, struct gb_simulation *simulation,
                     const struct gb_point *point);
    void *point_data;
    void (*on_event)(void *data, struct gb_simulation *simulation, int64_t step,
                     const char *text);
    void *event_data;
    void (*on_progress)(void *data, struct gb_simulation *simulation, double share);
    void *progress_data;
    double interval, called_s; /* of on_progress: s, clock reading */
};

/* For the commands of the program: parameters as the engine has them.  Errors as of
 * gb_simulation_create. */
bool gb_simulation_create_from(struct gb_simulation **out, const struct gb_params *params,
                               struct gb_error *err);
/* Builds the packing of a new simulation, and the recorder where it is to be recorded. */
bool gb_simulation_build(struct gb_simulation *simulation, struct gb_error *err);
bool gb_simulation_start_record(struct gb_simulation *simulation, struct gb_error *err);

#endif
