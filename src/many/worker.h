#ifndef GB_MANY_WORKER_H
#define GB_MANY_WORKER_H

#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

#include "greenbody/params.h"
#include "many/pool.h"

/* One process of a pool, which does the runs sent to it one after the other.  All zero but
 * fd = -1: no process. */
struct gb_worker {
    pid_t pid; /* 0: none yet */
    int fd;    /* socket: runs to the worker, reports from it; -1: none */
    bool busy, stopped;
    bool writing; /* busy, but its run is loaded and only files are being written */
    size_t ticket;
    double since; /* s, of the monotonic clock */
};

/* Sends a run to worker[index], which is idle; starts its process first where there is
 * none.  worker[count] are all of the pool: a new process closes the sockets of the
 * others.  Errors: GB_ERR_MACHINE (no process, no socket), GB_ERR_INPUT (the name of the
 * directory is too long). */
bool gb_worker_submit(struct gb_worker *worker, size_t count, size_t index,
                      gb_pool_work *work, size_t ticket, const struct gb_params *params,
                      const char *directory, struct gb_error *err);

/* Receives a message of a busy worker whose fd is readable: true for its report, or the end
 * of its process; false for the message that its run is loaded. */
bool gb_worker_receive(struct gb_worker *worker, struct gb_pool_report *report);

/* Asks the run of a busy worker to stop; it still reports.  Its process ends after that. */
void gb_worker_stop(struct gb_worker *worker);

/* Ends the process of an idle worker, if there is one. */
void gb_worker_end(struct gb_worker *worker);

#endif
