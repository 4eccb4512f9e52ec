#ifndef GB_CLI_BATCH_PROGRESS_H
#define GB_CLI_BATCH_PROGRESS_H

#include <stdbool.h>

#include <glib.h>

#include "io/lock.h"
#include "many/ensemble.h"
#include "many/launch.h"

enum gb_batch_progress_output {
    GB_BATCH_PROGRESS_ALL,
    GB_BATCH_PROGRESS_RUNNING, /* while runs are under way, without first and last line */
    GB_BATCH_PROGRESS_OTHER,   /* only what failed and what is waited for */
    GB_BATCH_PROGRESS_QUIET
};

/* Many runs of one command: workers, progress on stderr, signals. */
struct gb_batch_progress {
    struct gb_launch launch; /* only the first process of several shows progress */
    enum gb_batch_progress_output output;
    const double *cost; /* of each run, for the time left; NULL: all cost the same */
    double cost_total, cost_before, cost_ended;
    size_t total, before, ended, failed; /* runs; before: done by an earlier command */
    double started_s, printed_s;         /* clock of the begin, and of the last line */
    int columns;                         /* occupied by the line that is rewritten */
};

/* Sets launch.  Errors: GB_ERR_INPUT for a --jobs out of range. */
bool gb_batch_progress_init(struct gb_batch_progress *batch, int jobs, bool quiet,
                            struct gb_error *err);

/* The same for all processes of the command together. */
size_t gb_batch_progress_all_workers(const struct gb_batch_progress *batch, int jobs);

/* Does the missing runs.  SIGINT, SIGTERM and SIGHUP stop them (GB_ERR_CANCELLED). */
bool gb_batch_progress_work(struct gb_batch_progress *batch, struct gb_ensemble *ensemble,
                            int jobs, struct gb_error *err);

/* Takes the lock that a process holds while it writes the tables of a directory, once it is
 * free.  Errors: GB_ERR_CANCELLED, GB_ERR_MACHINE. */
bool gb_batch_progress_lock(struct gb_lock *lock, const char *directory, bool quiet,
                            struct gb_error *err);

/* "mu-0.1_seed-3 (process 12 on node3), ..." of the runs that other processes do; g_free. */
char *gb_batch_progress_elsewhere(const struct gb_ensemble *ensemble);

/* As gb_options_fail; after a signal 128 and its number. */
int gb_batch_progress_exit(const struct gb_error *err);

#endif
