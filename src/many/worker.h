#ifndef GB_MANY_WORKER_H
#define GB_MANY_WORKER_H

#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

#include "greenbody/params.h"
#include "many/pool.h"

/* One of the processes of a crew: it does the runs it is given, one after the other.  All
 * zero but fd = -1 is a place without a process. */
struct gb_worker {
    pid_t pid; /* 0: none yet */
    int fd;    /* where runs go to and reports come from; -1 */
    bool busy, stopped;
    bool keeping; /* busy, but its run is pressed and only being kept */
    size_t ticket;
    double since; /* s, of the monotonic clock */
};

/* Gives a run to worker[index], which is idle; its process is made first where there is
 * none.  worker[count] are all of the crew: a new process lets go of what belongs to the
 * others.  Errors: GB_ERR_MACHINE (no process, no socket), GB_ERR_INPUT (the name of the
 * directory is too long). */
bool gb_worker_give(struct gb_worker *worker, size_t count, size_t index,
                    gb_pool_work *work, size_t ticket, const struct gb_params *params,
                    const char *directory, struct gb_error *err);

/* The report of a busy worker whose fd has something to read, or the end of its process.
 * False when it was no more than the word that its run is pressed. */
bool gb_worker_take(struct gb_worker *worker, struct gb_pool_report *report);

/* Asks the run of a busy worker to stop; it still reports.  Its process does no other run
 * after that. */
void gb_worker_stop(struct gb_worker *worker);

/* Ends the process of an idle worker, if there is one. */
void gb_worker_end(struct gb_worker *worker);

#endif
