#ifndef GB_MANY_SWEEP_PARAM_SWEEP_H
#define GB_MANY_SWEEP_PARAM_SWEEP_H

#include <glib.h>
#include <stdbool.h>
#include <stddef.h>

#include "many/ensemble.h"
#include "many/reading.h"
#include "many/sweep/axes.h"

enum { GB_SWEEP_TABLE_PRESSURES = 256 };

/* Pressures at which a sweep is tabulated, ascending. */
struct gb_sweep_table_pressures {
    double pa[GB_SWEEP_TABLE_PRESSURES];
    size_t count;
};

/* "50 MPa;100 MPa;1 GPa" or "50;100 MPa".  Errors: GB_ERR_INPUT. */
bool gb_param_sweep_pressures(struct gb_sweep_table_pressures *at, const char *text,
                              struct gb_error *err);

/* The default: 1, 2, 5, 10, ... MPa up to the end of loading, and the pressures of
 * unloading. */
void gb_param_sweep_default_pressures(struct gb_sweep_table_pressures *at,
                                      const struct gb_params *params);

/* Branches of a curve on which a sweep reads its figures: loading, and unloading from a
 * pressure. */
enum { GB_SWEEP_BRANCHES = 2 };

const char *gb_param_sweep_branch(size_t branch); /* "load", "unload" */

/* The figures of the runs of one point that count, at all pressures. */
struct gb_sweep_readings {
    double *value; /* [branch][pressure][quantity][run]; NaN: not reached, or failed */
    size_t pressures, runs;
};

/* Reads the curves.  A run that cannot be read counts as failed; its error goes to the run.
 * gb_param_sweep_readings_finish is due. */
void gb_param_sweep_readings_init(struct gb_sweep_readings *readings,
                                  struct gb_ensemble *ensemble, size_t point,
                                  const struct gb_sweep_table_pressures *at);

void gb_param_sweep_readings_finish(
    struct gb_sweep_readings *readings); /* zeroed is fine */

/* The values of one figure over the runs. */
const double *gb_param_sweep_readings_at(const struct gb_sweep_readings *readings,
                                         size_t branch, size_t pressure, size_t quantity);

/* Ends the replicas of a point when the standard error of their mean density at a pressure
 * is small enough. */
struct gb_sweep_target {
    double standard_error; /* of the density; 0: all replicas are done */
    double pressure_pa;
    double *density; /* of each run at the pressure, NaN where it failed ... */
    bool *is_read;   /* ... once its curve.csv was read */
};

/* Reads "0.002@100MPa".  Errors: GB_ERR_INPUT. */
bool gb_param_sweep_target(struct gb_sweep_target *target, const char *text,
                           struct gb_error *err);

void gb_param_sweep_target_finish(struct gb_sweep_target *target); /* zeroed is fine */

/* Points whose replicas were all done before the standard error was small enough. */
size_t gb_param_sweep_missed(const struct gb_sweep_target *target,
                             const struct gb_ensemble *ensemble);

/* Number of the runs that count and have not reached what they should: goals of their
 * loading, equilibrium of points. */
size_t gb_param_sweep_shortfalls(const struct gb_ensemble *ensemble);

/* sweep.csv: a row per point of the grid, branch and pressure: the varied values, the
 * number of runs that reached it, mean and standard error of each figure over them.  Branch load is
 * read at the pressure; unload is the end of unloading from it.  A run that cannot be
 * read counts as failed; its error goes to the run.  Caller frees. */
GString *gb_param_sweep_means(struct gb_ensemble *ensemble, const struct gb_axes *axes,
                              const struct gb_sweep_table_pressures *at);

/* runs.csv: a row per run: directory, point, seed, done, failed or missing, why. */
GString *gb_param_sweep_runs(const struct gb_ensemble *ensemble);

/* A grid of parameters with replicas, a directory for each run, and its tables. */
struct gb_param_sweep {
    struct gb_axes axes;
    struct gb_sweep_table_pressures at;
    struct gb_sweep_target target;
    struct gb_ensemble ensemble;
};

/* Makes the list of runs in directory, from axes, target and the scene of params; marks
 * those that are done.  Errors: GB_ERR_INPUT, GB_ERR_MEMORY.  gb_param_sweep_finish is due in
 * any case. */
bool gb_param_sweep_fill(struct gb_param_sweep *sweep, const struct gb_params *params,
                         size_t replicas, const char *directory, struct gb_error *err);
void gb_param_sweep_finish(struct gb_param_sweep *sweep); /* zeroed is fine */

/* Writes sweep.csv and runs.csv, whatever state the runs are in. */
bool gb_param_sweep_write(struct gb_param_sweep *sweep, const char *directory,
                          struct gb_error *err);

/* Writes a further table of the sweep, and frees its text. */
bool gb_param_sweep_put(const char *directory, const char *name, GString *text,
                        struct gb_error *err);

#endif
