#ifndef GB_MANY_ENSEMBLE_H
#define GB_MANY_ENSEMBLE_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/params.h"
#include "many/pool.h"

/* Many runs, a directory each: replicas (cells that differ by their seed) of one or
 * more scenes.  The results depend on the list alone, not on the number of workers or
 * the order in which they finish. */
struct gb_ensemble_run {
    size_t point; /* which scene */
    size_t replica;
    struct gb_params params;
    char *directory;
    bool submitted, ended; /* to a worker; by it, or by an earlier command */
    bool before;           /* ended by another command, earlier or meanwhile */
    bool elsewhere;        /* another process does it */
    bool named;            /* on_wait was called for it */
    int64_t status_ns;     /* of its status.json when it was first looked at; 0: none */
    struct gb_error error; /* once ended; GB_OK: all stages of loading are done */
    double seconds;
};

struct gb_ensemble {
    struct gb_ensemble_run *run; /* replica 0 of all points, then replica 1, ... */
    size_t points, replicas;
    /* Are the first replicas of a point, all ended, enough?  NULL: all are done.  Called
     * after each run that ends; the answer depends on the first replicas without a gap
     * only, so that it is the same for any number of workers. */
    bool (*converged)(const struct gb_ensemble *ensemble, size_t point, void *data);
    void *data;
    bool leaves; /* runs that other processes do are left to them, not waited for */
    /* Part `part` of `parts`, from 0: runs whose place in the list is that modulo
     * parts; 0 parts: all runs. */
    size_t part, parts;
};

/* Room for points x replicas runs; the caller fills params and directory.
 * gb_ensemble_finish is due.  Errors: GB_ERR_INPUT (more than GB_ENSEMBLE_MOST),
 * GB_ERR_MEMORY. */
enum { GB_ENSEMBLE_MOST = 1000000 };
bool gb_ensemble_init(struct gb_ensemble *ensemble, size_t points, size_t replicas,
                      struct gb_error *err);
void gb_ensemble_finish(struct gb_ensemble *ensemble); /* zeroed is fine */

struct gb_ensemble_run *gb_ensemble_at(const struct gb_ensemble *ensemble, size_t point,
                                       size_t replica);

/* Marks the runs whose directories say that they are done; those that another process
 * does are left to it.  Errors: GB_ERR_INPUT for a directory with a run of other
 * parameters, or with other files: it is left as it is; those of gb_seed_check_cells. */
bool gb_ensemble_find_done(struct gb_ensemble *ensemble, struct gb_error *err);

/* Callbacks of gb_ensemble_work; NULL members are not called. */
struct gb_ensemble_callbacks {
    bool (*cancelled)(void *data); /* polled at least five times a second */
    void (*progress)(const struct gb_ensemble *ensemble,
                     const struct gb_ensemble_run *run,
                     void *data); /* run has ended; NULL: none has since the last call */
    /* Called once for a run of another process that is waited for since a minute, while
     * there is nothing else to do. */
    void (*on_wait)(const struct gb_ensemble_run *run, void *data);
    void *data;
    double patience_s; /* in place of that minute; 0: the minute */
};

/* Does the runs of its part that have not ended.  One that fails is marked; the others
 * continue.  A run belongs to the process that holds the lock of its directory.  Those
 * that another process does, or has done or failed to do since gb_ensemble_find_done,
 * are not done twice.  It ends when they have ended there, and does the ones that were
 * left unfinished; an ensemble that `leaves` ends as soon as it has nothing to do
 * itself.
 *
 * Errors: GB_ERR_CANCELLED (the runs under way have stopped), GB_ERR_MACHINE when no
 * worker can be started at all. */
bool gb_ensemble_work(struct gb_ensemble *ensemble, struct gb_pool *pool,
                      const struct gb_ensemble_callbacks *callbacks,
                      struct gb_error *err);

/* Looks again at the runs that are not known to be done: those that others have done, or
 * that failed with a status, have ended.  Returns the number that other processes do now.
 * Before tables are written. */
size_t gb_ensemble_refresh(struct gb_ensemble *ensemble);

/* Makes a directory for runs.  Errors: GB_ERR_INPUT (it is a single run, or a file),
 * GB_ERR_MACHINE. */
bool gb_ensemble_make_directory(const char *path, struct gb_error *err);

/* Estimated time of the runs that have not ended, s of one core, and their number; NaN
 * where there is no estimate. */
double gb_ensemble_remaining_s(const struct gb_ensemble *ensemble, size_t *runs);

/* True when no run failed; else GB_ERR_GUARD (GB_ERR_MACHINE when the machine failed one)
 * with their number and the message of the first one; they are listed in path. */
bool gb_ensemble_check(const struct gb_ensemble *ensemble, const char *path,
                       struct gb_error *err);

/* Replicas of a point that count: up to the first for which it has converged, else all.
 */
size_t gb_ensemble_used(const struct gb_ensemble *ensemble, size_t point);

#endif
