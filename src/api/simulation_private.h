#ifndef GB_API_SIMULATION_PRIVATE_H
#define GB_API_SIMULATION_PRIVATE_H

#include <stdatomic.h>
#include <sys/types.h>

#include "api/array_private.h"
#include "greenbody/simulation.h"
#include "run/run_loop.h"

/* How a simulation started. */
enum gb_simulation_origin {
    GB_SIMULATION_NEW,     /* the packing is built by the first advance */
    GB_SIMULATION_RESUMED, /* in its directory */
    GB_SIMULATION_LOADED   /* from a state */
};

/* Additional hooks for the engine thread of the workbench.  Each may be NULL. */
struct gb_simulation_hooks {
    /* Before each slice; may wait (gb_run_loop_exclude) and cancel. */
    void (*between_slices)(void *data);
    void (*on_end)(void *data);                                      /* as in the loop */
    bool (*on_record_error)(void *data, const struct gb_error *err); /* as in the loop */
    void *data;
};

/* Contents of the opaque gb_simulation. */
struct gb_simulation {
    struct gb_params params;
    struct gb_run_loop loop;
    struct gb_curve *curve;
    struct gb_array_source packing; /* of the experiment, for arrays */
    enum gb_simulation_origin origin;
    enum gb_run_outcome outcome; /* the last advance */
    struct gb_record *begin; /* the state of GB_SIMULATION_LOADED, until it is built */
    char *directory;         /* until the recorder exists; NULL: not recorded */
    enum gb_rundir_mode mode;
    char resumed[96];  /* event of the next advance; empty: none */
    double returned_s; /* clock reading when the last advance ended; 0: none yet */
    _Atomic(const char *) reason; /* why it was cancelled; NULL: not cancelled */
    void (*on_point)(void *data, struct gb_simulation *simulation,
                     const struct gb_point *point);
    void *point_data;
    void (*on_event)(void *data, struct gb_simulation *simulation, int64_t step,
                     const char *text);
    void *event_data;
    void (*on_progress)(void *data, struct gb_simulation *simulation, double share);
    void *progress_data;
    double interval, called_s; /* of on_progress: s, clock reading */
    struct gb_simulation_hooks hooks;
    pid_t process;         /* that created it and has its threads and files */
    atomic_bool advancing; /* an advance is under way, in any thread */
};

/* May this process use the simulation now?  Errors: GB_ERR_INPUT in a child of fork
 * and, unless `within` is true, during an advance. */
bool gb_simulation_usable(const struct gb_simulation *simulation, bool within,
                          struct gb_error *err);

/* For the commands of the program: takes params instead of gb_parameters.  Errors: see
 * gb_simulation_create. */
bool gb_simulation_create_from(struct gb_simulation **out, const struct gb_params *params,
                               struct gb_error *err);
/* Continues from a state in memory.  The points up to it begin the curve.  The first
 * advance reads the record, whose members move into the simulation.  Errors: as above. */
bool gb_simulation_create_fork(struct gb_simulation **out, const struct gb_params *params,
                               struct gb_record *record, const struct gb_curve *curve,
                               size_t points, struct gb_error *err);
/* Opens a recorded run in a simulation with the same parameters, as
 * gb_simulation_resume does. */
bool gb_simulation_open(struct gb_simulation *simulation, const char *directory,
                        enum gb_run_recorder_from from, struct gb_error *err);
void gb_simulation_set_hooks(struct gb_simulation *simulation,
                             const struct gb_simulation_hooks *hooks);
/* Builds the packing of a new simulation and creates the recorder in its directory. */
bool gb_simulation_build(struct gb_simulation *simulation, struct gb_error *err);
bool gb_simulation_start_record(struct gb_simulation *simulation, const char *directory,
                                enum gb_rundir_mode mode, struct gb_error *err);
/* Frees packing and recorder, which unlocks the directory; the points remain. */
void gb_simulation_release(struct gb_simulation *simulation);

#endif
