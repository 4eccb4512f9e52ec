#ifndef GREENBODY_SNAPSHOT_H
#define GREENBODY_SNAPSHOT_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/curve.h"
#include "greenbody/stage.h"
#include "greenbody/status.h"
#include "greenbody/view_sample.h"

#ifdef __cplusplus
extern "C" {
#endif

/* State of a run. */
enum gb_run_state {
    GB_RUN_PACKING, /* building the initial structure */
    GB_RUN_RUNNING,
    GB_RUN_PAUSED,
    GB_RUN_DONE,
    GB_RUN_STOPPED, /* on request or by a guard; results are kept */
    GB_RUN_FAILED
};

/* Bins of the histogram of contacts and of the force rose. */
enum { GB_SNAPSHOT_HISTOGRAM = 16, GB_SNAPSHOT_ROSE = 18 };

/* State of a run for the screen: plain data without pointers.  The engine thread passes
 * whole copies through a lock-free triple buffer. */
struct gb_snapshot {
    enum gb_run_state state;
    struct gb_point now; /* last relaxed state, also between recorded points */
    bool now_valid;
    struct gb_stage_report stage; /* GB_STAGE_NONE: not a die */
    /* fraction of particles with 0, 1, ... contacts */
    double histogram[GB_SNAPSHOT_HISTOGRAM];
    double rose[GB_SNAPSHOT_ROSE]; /* mean f_n (E d^2) in 5 degree bins of angle to z;
                                      NaN: empty */
    int64_t evaluations;           /* of the whole run */
    double evaluations_per_s;
    double particle_evaluations_per_s;
    double progress;              /* 0..1, of the loading */
    double seconds, seconds_left; /* seconds_left < 0: unknown */
    double live_residual;         /* of the current relaxation */
    double time_step_s;           /* last one of a dynamic run; else 0 */
    int64_t events;               /* number of events so far */
    char event[GB_EVENT_TEXT];    /* the last one */
    struct gb_error error;        /* why it failed or stopped, or goals that it missed */
};

#ifdef __cplusplus
}
#endif

#endif
