#ifndef GB_RUN_COST_H
#define GB_RUN_COST_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "greenbody/params.h"
#include "greenbody/status.h"

/* Rate of a run and its remaining time, from its progress so far.  All times are seconds
 * of work: the caller leaves out pauses. */
enum { GB_PACE_WINDOW = 64 };

struct gb_pace {
    /* the last reports: rates are taken over this sliding window */
    double seconds[GB_PACE_WINDOW];
    double evaluations[GB_PACE_WINDOW];
    int filled, next;
    /* progress per second, recent times weighing more */
    double progress, progress_at, progress_rate;
    double progress_from; /* seconds of the first report of it */
    bool begun;           /* there was one */
    int64_t slice;
};

void gb_cost_pace_init(struct gb_pace *pace);

/* Takes in one report; progress: NaN while it says nothing of the time left. */
void gb_cost_pace_add(struct gb_pace *pace, double seconds, int64_t evaluations,
                      double progress);

/* Force evaluations per second over the window; 0 while unknown. */
double gb_cost_pace_rate(const struct gb_pace *pace);

/* Seconds to the end of loading; negative while unknown. */
double gb_cost_pace_left(const struct gb_pace *pace);

/* Evaluations to allow in the next slice, so that it takes 5 to 20 ms. */
int64_t gb_cost_pace_slice(const struct gb_pace *pace);

/* Time of the last slice, s; full: it used all evaluations that it was allowed. */
void gb_cost_pace_sliced(struct gb_pace *pace, double seconds, bool full);

struct gb_experiment;

/* Estimated cost of a dynamic run, shown before it starts: the slowest rate of P2 takes ten
 * thousand times the work of the fastest.  Counts are doubles: they have no bound. */
struct gb_cost {
    double time_step_s;
    bool step_assumed;                              /* auto: not known before the run */
    double relax_steps, compress_steps, hold_steps; /* of the stages */
    double steps;
    double particle_steps;
    double particle_steps_per_s; /* as given */
    double seconds;
    double points, curve_bytes; /* rows of curve.csv */
};

/* Errors: GB_ERR_INPUT for other kinds than dynamic or a rate that is not positive. */
bool gb_cost_estimate(const struct gb_params *params, double particle_steps_per_s,
                      struct gb_cost *out, struct gb_error *err);

/* Particle-steps per second before anything is measured. */
double gb_cost_rate_assumed(const struct gb_params *params);

/* Speed of an experiment before its first point, one evaluation a step.  A copy of it runs;
 * the experiment stays where it is, so that every point is recorded as it is computed.
 *
 * seconds              that the copy runs, unless it ends before
 * particle_steps_per_s 0: nothing was evaluated
 * ended                the copy came to its end
 * Errors: GB_ERR_MEMORY and others of gb_experiment_resume. */
bool gb_cost_rate_try(struct gb_experiment *experiment, double seconds,
                      double *particle_steps_per_s, bool *ended, struct gb_error *err);

/* Seconds that a quasi-static run will take about, from the seconds that its quick
 * cell took on this machine: good to a factor of two.  NaN for other kinds. */
double gb_cost_from_quick(const struct gb_params *full, const struct gb_params *quick,
                          double quick_s);

/* Seconds that a run will take about on this machine, by what was measured on another:
 * good to a factor of two or three.  NaN for dies. */
double gb_cost_assumed_s(const struct gb_params *params);

/* "9 s", "12 min", "8 h 52 min", "41 days".  Returns buffer. */
char *gb_cost_duration(double seconds, char *buffer, size_t size);

/* The estimate as one line of text.  Returns buffer. */
char *gb_cost_line(const struct gb_cost *cost, char *buffer, size_t size);

/* True for a cost that needs no confirmation (up to an hour); else GB_ERR_INPUT naming the
 * cost and the option --yes. */
bool gb_cost_check_limit(const struct gb_cost *cost, struct gb_error *err);
/* The same for a time alone; NaN (unknown) needs none. */
bool gb_cost_within_limit(double seconds);

/* The quick cell: the same powder and loading in a cell so small, strained in steps so
 * large, that the whole loading curve is computed within about two seconds.  The larger
 * steps raise the density by about 0.01 (four cells of set II, at 100 MPa: 0.010 above the
 * same cells in steps of 0.1 %); the density of one cell of 1000 particles scatters by
 * 0.005. */
enum { GB_QUICK_COUNT = 1000 };

/* Fills quick with the quick twin of checked parameters: no unloading, no stages before
 * and after a dynamic compression, fidelity fast.  False when there is none that would
 * answer in time: a slow dynamic run, or a kind that has no small cell. */
bool gb_cost_quick(const struct gb_params *full, struct gb_params *quick);

/* Whether the scene is itself about as quick as its quick twin. */
bool gb_cost_is_quick(const struct gb_params *full);

#endif
