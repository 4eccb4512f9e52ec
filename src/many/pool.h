#ifndef GB_MANY_POOL_H
#define GB_MANY_POOL_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/params.h"

/* Workers that do runs at once, each a process that does one run after the other: what
 * starting a process and its libraries costs is paid once.  One that crashes or is killed
 * takes only its run with it, and another takes its place; libraries that know no threads
 * (HDF5) are met by one thread only.  The caller must not have started threads: its state
 * is copied by fork. */
struct gb_pool;
struct gb_mpi_pool;

/* Whom a run answers to; NULL members are nobody. */
struct gb_pool_callbacks {
    bool (*cancelled)(void *data); /* polled between slices: true ends the run */
    void (*loaded)(void *data);    /* called once: only files are left to be written */
    void *data;
};

/* Does one run in a worker's process. */
typedef bool gb_pool_work(const struct gb_params *params, const char *directory,
                          const struct gb_pool_callbacks *boss, struct gb_error *err);

/* What became of a run. */
struct gb_pool_report {
    size_t ticket;
    struct gb_error error; /* GB_OK: done; a process that died is GB_ERR_MACHINE */
    double seconds;        /* since it was given */
    bool lost;             /* not its fault: whoever did it is gone */
};

/* workers here, and those of other ranks if there are any (NULL: none; kept by the
 * caller). */
bool gb_pool_create(struct gb_pool **out, size_t workers, gb_pool_work *work,
                    struct gb_mpi_pool *ranks, struct gb_error *err);
/* Ends what is still running and waits for it.  NULL is fine. */
void gb_pool_destroy(struct gb_pool *crew);

/* How long to wait for a report before looking for what other ranks send, s. */
double gb_pool_poll_interval(const struct gb_pool *crew);

/* Workers without a run. */
size_t gb_pool_idle(const struct gb_pool *crew);
/* Runs that may be given now although nobody is idle, so that nobody waits: beside each
 * one that is only being kept, and for each worker of another rank as the next, as long
 * as more of them wait than there are workers. */
size_t gb_pool_prefetch(const struct gb_pool *crew, size_t waiting);
/* Runs that were given and not yet reported. */
size_t gb_pool_busy(const struct gb_pool *crew);

/* Gives a run to an idle worker, or to whom it may be given ahead.  Errors:
 * GB_ERR_MACHINE (no process, no socket), GB_ERR_INPUT (the name of the directory is too
 * long). */
bool gb_pool_submit(struct gb_pool *crew, size_t ticket, const struct gb_params *params,
                    const char *directory, struct gb_error *err);

/* Waits up to seconds for a report; false when there was none.  A signal, or a worker
 * that only keeps its run from now on, ends the wait early. */
bool gb_pool_receive(struct gb_pool *crew, double seconds, struct gb_pool_report *report);

/* Asks all runs to stop; they still report. */
void gb_pool_stop(struct gb_pool *crew);

#endif
