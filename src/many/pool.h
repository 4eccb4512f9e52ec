#ifndef GB_MANY_POOL_H
#define GB_MANY_POOL_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/params.h"

/* How this process was started: alone, or with other processes of the same command by
 * mpirun, srun or a Slurm array.  It is read from the environment; the processes do not
 * communicate. */
struct gb_launch {
    long rank, count; /* among all processes of the command; alone: 0 of 1 */
    long local_count; /* processes on this machine */
    bool launched;    /* started by one of these launchers, even as a single process */
};

struct gb_launch gb_pool_launch(void);

/* Processors for this process, at least 1: its affinity, limited to its fraction of the
 * processors that all local processes have by the Slurm allocation and the quota of the
 * cgroup. */
long gb_pool_cores(const struct gb_launch *launch);

/* Processors allowed by the quota of a cgroup, rounded up; 0: no quota.
 *
 * root   of cgroup v2, such as /sys/fs/cgroup
 * group  of the process, such as /system.slice/job; the groups above it count as well */
long gb_pool_quota(const char *root, const char *group);

/* Worker processes that do one run after the other, so that starting a process and its
 * libraries costs only once.  A worker that crashes or is killed loses only its run,
 * and a new process replaces it.  Libraries without thread support (HDF5) run in one
 * thread.  The caller must not have started threads, because fork copies its state. */
struct gb_pool;

/* Callbacks of a run; NULL members are not called. */
struct gb_pool_callbacks {
    bool (*cancelled)(void *data); /* polled between slices; true ends the run */
    void (*loaded)(void *data);    /* called once, when only files are left to write */
    void *data;
};

/* Does one run in a worker process. */
typedef bool gb_pool_work(const struct gb_params *params, const char *directory,
                          const struct gb_pool_callbacks *callbacks,
                          struct gb_error *err);

/* Result of a run. */
struct gb_pool_report {
    size_t ticket;
    struct gb_error error; /* GB_OK: done; GB_ERR_MACHINE: e.g. the process died */
    double seconds;        /* since it was submitted, s */
};

bool gb_pool_create(struct gb_pool **out, size_t workers, gb_pool_work *work,
                    struct gb_error *err);
/* Stops the active runs and waits for them.  NULL is fine. */
void gb_pool_destroy(struct gb_pool *pool);

/* Number of workers without a run. */
size_t gb_pool_idle(const struct gb_pool *pool);
/* Number of runs that may be submitted although no worker is idle: one for each run
 * that only writes its files. */
size_t gb_pool_prefetch(const struct gb_pool *pool);
/* Number of runs that were submitted and not yet reported. */
size_t gb_pool_busy(const struct gb_pool *pool);

/* Submits a run to an idle worker, or as a prefetch.  Errors: GB_ERR_MACHINE (no
 * process, no socket), GB_ERR_INPUT (the name of the directory is too long). */
bool gb_pool_submit(struct gb_pool *pool, size_t ticket, const struct gb_params *params,
                    const char *directory, struct gb_error *err);

/* Waits up to `seconds` for a report; false if there was none.  A signal, or a worker
 * whose run is loaded, ends the wait early. */
bool gb_pool_receive(struct gb_pool *pool, double seconds, struct gb_pool_report *report);

/* Asks all runs to stop; they still report. */
void gb_pool_stop(struct gb_pool *pool);

#endif
