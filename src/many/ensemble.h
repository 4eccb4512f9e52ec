#ifndef GB_MANY_ENSEMBLE_H
#define GB_MANY_ENSEMBLE_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/params.h"
#include "many/pool.h"

/* Many runs, each in its own directory: replicas (cells that differ by their seed) of
 * one or more scenes.  The results depend only on the list, not on the number of
 * workers or the order in which runs finish. */
struct gb_ensemble_run {
    size_t point; /* index of the scene */
    size_t replica;
    struct gb_params params;
    char *directory;
    bool submitted, ended; /* submitted to a worker; ended here or by another command */
    bool before;           /* ended by another command, before or during this one */
    bool elsewhere;        /* another process computes it */
    bool named;            /* on_wait was called for it */
    int64_t status_ns;     /* time of its status.json at the first check; 0: none */
    struct gb_error error; /* result after it ended; GB_OK: all loading is done */
    double seconds;
};

struct gb_ensemble {
    struct gb_ensemble_run *run; /* replica 0 of all points, then replica 1, ... */
    size_t points, replicas;
    /* Are the first replicas of a point that have ended enough?  NULL: do all.  Called
     * after each run that ends.  The answer must depend only on the first replicas
     * without a gap, so that it is the same for any number of workers. */
    bool (*converged)(const struct gb_ensemble *ensemble, size_t point, void *data);
    void *data;
    bool leaves; /* do not wait for runs that other processes compute */
    /* Part `part` (from 0) of `parts`: the runs whose index modulo parts is `part`.
     * parts = 0: all runs. */
    size_t part, parts;
};

/* Allocates points x replicas runs; the caller fills params and directory.
 * gb_ensemble_finish must be called.  Errors: GB_ERR_INPUT (more than
 * GB_ENSEMBLE_MOST), GB_ERR_MEMORY. */
enum { GB_ENSEMBLE_MOST = 1000000 };
bool gb_ensemble_init(struct gb_ensemble *ensemble, size_t points, size_t replicas,
                      struct gb_error *err);
void gb_ensemble_finish(struct gb_ensemble *ensemble); /* zeroed is fine */

struct gb_ensemble_run *gb_ensemble_at(const struct gb_ensemble *ensemble, size_t point,
                                       size_t replica);

/* Marks the runs that are done according to their directories, and those that another
 * process computes.  Errors: GB_ERR_INPUT for a directory with a run of other
 * parameters or with other files, which does not change; errors of gb_seed_check_cells.
 */
bool gb_ensemble_find_done(struct gb_ensemble *ensemble, struct gb_error *err);

/* Callbacks of gb_ensemble_work; NULL members are not called. */
struct gb_ensemble_callbacks {
    bool (*cancelled)(void *data); /* polled at least five times a second */
    void (*progress)(const struct gb_ensemble *ensemble,
                     const struct gb_ensemble_run *run,
                     void *data); /* run: has ended; NULL: none since the last call */
    /* Called once for a run of another process that this process has waited for,
     * without other work, for `patience_s`. */
    void (*on_wait)(const struct gb_ensemble_run *run, void *data);
    void *data;
    double patience_s; /* 0: one minute */
};

/* Computes the runs of its part that have not ended.  A run that fails is marked, and
 * the others continue.  A run belongs to the process that holds the lock of its
 * directory.  Runs that another process computes, or has completed or failed since
 * gb_ensemble_find_done, are not repeated.  The function waits for the runs of other
 * processes and takes over those that are left unfinished; with `leaves` it returns as
 * soon as it has no work of its own.
 *
 * Errors: GB_ERR_CANCELLED (the active runs have stopped), GB_ERR_MACHINE if no worker
 * can be started at all. */
bool gb_ensemble_work(struct gb_ensemble *ensemble, struct gb_pool *pool,
                      const struct gb_ensemble_callbacks *callbacks,
                      struct gb_error *err);

/* Checks again the runs that are not known to be done: those that others have completed
 * or failed have ended.  Returns the number of runs that other processes compute now.
 * Call it before writing tables. */
size_t gb_ensemble_refresh(struct gb_ensemble *ensemble);

/* Creates a directory for runs.  Errors: GB_ERR_INPUT (it is a single run, or a file),
 * GB_ERR_MACHINE. */
bool gb_ensemble_make_directory(const char *path, struct gb_error *err);

/* Estimated time of the runs that have not ended, s of one core, and their number.  NaN
 * without an estimate. */
double gb_ensemble_remaining_s(const struct gb_ensemble *ensemble, size_t *runs);

/* True if no run failed.  Otherwise GB_ERR_GUARD (GB_ERR_MACHINE if the machine caused
 * a failure) with the number of failed runs, the message of the first one, and path,
 * which lists them. */
bool gb_ensemble_check(const struct gb_ensemble *ensemble, const char *path,
                       struct gb_error *err);

/* Number of replicas of a point that are used: up to the first at which it converged,
 * else all. */
size_t gb_ensemble_used(const struct gb_ensemble *ensemble, size_t point);

#endif
