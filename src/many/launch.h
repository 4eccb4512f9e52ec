#ifndef GB_MANY_LAUNCH_H
#define GB_MANY_LAUNCH_H

#include <stdbool.h>

/* How this process was started: alone, or with others of the same command by mpirun, srun or
 * a Slurm array.  Read from the environment that launchers set; the processes exchange
 * nothing. */
struct gb_launch {
    long rank, count; /* of all processes of the command; alone: 0 of 1 */
    long local_count; /* of those on this machine */
    bool launched;    /* by one of these, also as one process */
};

struct gb_launch gb_launch_read(void);

/* Processors for this process: those of its affinity, but no more than its share of what the
 * local processes have together, by Slurm's allocation and the quota of the cgroup.  At
 * least 1. */
long gb_launch_cores(const struct gb_launch *launch);

/* Processors that a quota of a cgroup allows, rounded up; 0: no quota.
 *
 * root   of cgroup v2, as /sys/fs/cgroup
 * group  of the process, as /system.slice/job; those above it count as well */
long gb_launch_quota(const char *root, const char *group);

#endif
