#ifndef GB_MANY_ENSEMBLE_H
#define GB_MANY_ENSEMBLE_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/params.h"
#include "many/pool.h"

/* Many runs, a directory each: replicas (cells that differ by their seed) of one or more
 * scenes.  What comes out depends on the list alone, not on how many workers do it or in
 * which order they finish. */
struct gb_ensemble_run {
    size_t point; /* which scene */
    size_t replica;
    struct gb_params params;
    char *directory;
    bool given, ended;     /* to a worker; by it, or before */
    bool before;           /* was done already when the ensemble was started */
    struct gb_error error; /* once ended; GB_OK: done to the end of its programme */
    double seconds;
};

struct gb_ensemble {
    struct gb_ensemble_run *run; /* replica 0 of all points, then replica 1, ... */
    size_t points, replicas;
    /* May the replicas of a point end before the last one?  NULL: no.  Told after each
     * run that ends, it looks only at runs that a smaller replica number cannot precede,
     * so that the answer is the same for any number of workers. */
    bool (*enough)(const struct gb_ensemble *ensemble, size_t point, void *data);
    void *data;
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

/* Marks what its directory says is done.  Errors: GB_ERR_INPUT for a directory that holds
 * a run of other parameters, or something that is no run: it is left as it is. */
bool gb_ensemble_find_done(struct gb_ensemble *ensemble, struct gb_error *err);

/* Who is told about the work, and may end it. */
struct gb_ensemble_callbacks {
    bool (*cancelled)(void *data); /* polled at least five times a second */
    void (*told)(const struct gb_ensemble *ensemble, const struct gb_ensemble_run *run,
                 void *data); /* a run has ended; NULL: nothing new */
    void *data;
};

/* Does what is missing.  A run that fails is marked and costs only itself.
 *
 * Errors: GB_ERR_CANCELLED (what was under way has stopped), GB_ERR_MACHINE when no
 * worker can be started at all. */
bool gb_ensemble_work(struct gb_ensemble *ensemble, struct gb_pool *crew,
                      const struct gb_ensemble_callbacks *watch, struct gb_error *err);

/* How many replicas of a point count: those up to where `enough` was met first, else all.
 */
size_t gb_ensemble_used(const struct gb_ensemble *ensemble, size_t point);

#endif
