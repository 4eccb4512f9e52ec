#ifndef GB_CLI_BATCH_PROGRESS_H
#define GB_CLI_BATCH_PROGRESS_H

#include <stdbool.h>

#include <glib.h>

#include "many/ensemble.h"
#include "many/mpi/mpi_pool.h"

enum gb_batch_progress_output {
    GB_BATCH_PROGRESS_ALL,
    GB_BATCH_PROGRESS_RUNNING, /* while runs are under way, without first and last line */
    GB_BATCH_PROGRESS_QUIET
};

/* Many runs of one command: workers, progress on stderr, signals. */
struct gb_batch_progress {
    struct gb_mpi_pool *mpi; /* ranks started by mpirun or srun; NULL: one process */
    bool launched;           /* by mpirun or srun; also once the first rank is lost */
    enum gb_batch_progress_output output;
    const double *cost; /* of each run, for the time left; NULL: all cost the same */
    double cost_total, cost_before, cost_ended;
    size_t total, before, ended, failed; /* runs; before: done by an earlier command */
    double started_s, printed_s;         /* clock of the begin, and of the last line */
    int columns;                         /* occupied by the line that is rewritten */
};

enum gb_batch_progress_rank {
    GB_BATCH_PROGRESS_FIRST, /* the command continues */
    GB_BATCH_PROGRESS_OTHER  /* the rank has done its runs: the command is over */
};

/* Joins the processes that mpirun or srun started with this one.  A rank other than the
 * first does runs, `jobs` at a time (0: one), until the first one ends it; *status is the
 * exit status then, as after an error.  batch->mpi is for gb_mpi_pool_destroy. */
enum gb_batch_progress_rank gb_batch_progress_join(struct gb_batch_progress *batch,
                                                   int jobs, int *status);

/* Does the missing runs with `jobs` workers, 0 for one per processor, or one for a process
 * that mpirun or srun started.  SIGINT, SIGTERM and SIGHUP stop them (GB_ERR_CANCELLED). */
bool gb_batch_progress_work(struct gb_batch_progress *batch, struct gb_ensemble *ensemble,
                            int jobs, struct gb_error *err);

/* As gb_options_fail; after a signal 128 and its number. */
int gb_batch_progress_exit(const struct gb_error *err);

#endif
