#ifndef GB_CLI_BATCH_PROGRESS_H
#define GB_CLI_BATCH_PROGRESS_H

#include <stdbool.h>

#include <glib.h>

#include "many/ensemble.h"
#include "many/mpi_pool.h"

/* Many runs at once, as commands do them: workers, progress on stderr, signals. */
struct gb_batch_progress {
    struct gb_mpi_pool *ranks; /* others started by mpirun or srun; NULL: alone */
    bool quiet, brief;         /* nothing; nothing but progress */
    size_t total, before, ended, failed; /* runs; before: done when it began */
    double started, told_at;
    int shown; /* columns occupied by the rewritten line */
};

/* Joins the processes that mpirun or srun started with this one.  A rank other than the
 * first does runs of this kind, `jobs` at a time (0: one), until the first one ends; then
 * it is over: true with *status.  False: go on, as the first one or alone; crowd->ranks
 * is for gb_mpi_pool_destroy. */
bool gb_batch_progress_serve(struct gb_batch_progress *crowd, int jobs, int *status);

/* The directory that holds the runs: makes it; one that holds a single run is refused. */
bool gb_batch_progress_directory(const char *path, struct gb_error *err);

/* Does what is missing with `jobs` workers, 0 for one per processor, or one beside other
 * ranks, who help.  SIGINT, SIGTERM and
 * SIGHUP stop it in good order (GB_ERR_CANCELLED). */
bool gb_batch_progress_work(struct gb_batch_progress *crowd, struct gb_ensemble *ensemble,
                            int jobs, struct gb_error *err);

/* True when every run that counts was done; else GB_ERR_GUARD (GB_ERR_MACHINE when the
 * machine failed one) with how many failed and what the first one said. */
bool gb_batch_progress_verdict(const struct gb_ensemble *ensemble, const char *where,
                               struct gb_error *err);

/* As gb_options_fail; after a signal 128 and its number. */
int gb_batch_progress_exit(const struct gb_error *err);

#endif
