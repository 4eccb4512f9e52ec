#ifndef GB_MANY_POOL_H
#define GB_MANY_POOL_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/params.h"

/* How this process was started: alone, or with others of the same command by mpirun, srun or
 * a Slurm array.  Read from the environment that launchers set; the processes exchange
 * nothing. */
struct gb_launch {
    long rank, count; /* of all processes of the command; alone: 0 of 1 */
    long local_count; /* of those on this machine */
    bool launched;    /* by one of these, also as one process */
};

struct gb_launch gb_pool_launch(void);

/* Processors for this process: its affinity, but no more than its share of what all local
 * processes have together by Slurm's allocation and the quota of the cgroup.  At
 * least 1. */
long gb_pool_cores(const struct gb_launch *launch);

/* Processors that a quota of a cgroup allows, rounded up; 0: no quota.
 *
 * root   of cgroup v2, as /sys/fs/cgroup
 * group  of the process, as /system.slice/job; those above it count as well */
long gb_pool_quota(const char *root, const char *group);

/* Worker processes that do one run after the other, so that starting a process and its
 * libraries costs once.  A worker that crashes or is killed loses only its run, and another
 * process takes its place; libraries without support of threads (HDF5) run in one thread.
 * The caller must not have started threads: its state is copied by fork. */
struct gb_pool;

/* Callbacks of a run; NULL members are not called. */
struct gb_pool_callbacks {
    bool (*cancelled)(void *data); /* polled between slices: true ends the run */
    void (*loaded)(void *data);    /* called once: only files are left to be written */
    void *data;
};

/* Does one run in a worker's process. */
typedef bool gb_pool_work(const struct gb_params *params, const char *directory,
                          const struct gb_pool_callbacks *callbacks,
                          struct gb_error *err);

/* The end of a run. */
struct gb_pool_report {
    size_t ticket;
    struct gb_error error; /* GB_OK: done; a process that died is GB_ERR_MACHINE */
    double seconds;        /* since it was submitted */
};

bool gb_pool_create(struct gb_pool **out, size_t workers, gb_pool_work *work,
                    struct gb_error *err);
/* Stops the runs under way and waits for them.  NULL is fine. */
void gb_pool_destroy(struct gb_pool *pool);

/* Workers without a run. */
size_t gb_pool_idle(const struct gb_pool *pool);
/* Runs that may be submitted although no worker is idle: one for each run that only writes
 * its files. */
size_t gb_pool_prefetch(const struct gb_pool *pool);
/* Runs that were submitted and not yet reported. */
size_t gb_pool_busy(const struct gb_pool *pool);

/* Submits a run to an idle worker, or as a prefetched one.  Errors: GB_ERR_MACHINE (no
 * process, no socket), GB_ERR_INPUT (the name of the directory is too long). */
bool gb_pool_submit(struct gb_pool *pool, size_t ticket, const struct gb_params *params,
                    const char *directory, struct gb_error *err);

/* Waits up to `seconds` for a report; false when there was none.  A signal, or a worker
 * whose run is loaded, ends the wait early. */
bool gb_pool_receive(struct gb_pool *pool, double seconds, struct gb_pool_report *report);

/* Asks all runs to stop; they still report. */
void gb_pool_stop(struct gb_pool *pool);

#endif
