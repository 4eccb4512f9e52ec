#ifndef GB_MANY_MPI_MPI_POOL_H
#define GB_MANY_MPI_MPI_POOL_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/params.h"

struct gb_pool;
struct gb_pool_report;

/* The processes that mpirun or srun started together, on one machine or many: the first
 * rank distributes runs, the others do them.  Nothing is collective but the start, and the
 * end while all ranks are alive: a rank that dies costs the runs that it had. */
struct gb_mpi_pool;

/* Joins the other ranks; *out is NULL for a process that is alone.  Errors: GB_ERR_INPUT
 * for several processes of a build without MPI, GB_ERR_MACHINE. */
bool gb_mpi_pool_create(struct gb_mpi_pool **out, struct gb_error *err);
/* The first rank ends the others; MPI is shut down unless a rank was lost.  NULL is fine. */
void gb_mpi_pool_destroy(struct gb_mpi_pool *mpi);

/* Is this the rank that distributes runs?  True for NULL. */
bool gb_mpi_pool_is_first(const struct gb_mpi_pool *mpi);

/* The work of any other rank: `workers` runs at a time in the local pool, until the first
 * rank says quit or is silent for too long.  Errors: GB_ERR_CANCELLED, GB_ERR_MACHINE (the
 * first rank is gone). */
bool gb_mpi_pool_serve(struct gb_mpi_pool *mpi, struct gb_pool *local, size_t workers,
                       bool (*cancelled)(void *data), void *data, struct gb_error *err);

/* After gb_mpi_pool_serve: it ended because the first rank is gone.  The caller may go on
 * without the others, which see what it does in the directories. */
bool gb_mpi_pool_first_is_lost(const struct gb_mpi_pool *mpi);

/* The rest is for the first rank; for NULL there are no workers.
 *
 * workers   of all other ranks; idle: those without a run
 *
 * prefetch  runs that busy ranks may hold as their next ones, one for each worker
 *
 * submit    errors: GB_ERR_INPUT (a directory whose name is too long), GB_ERR_MEMORY
 *
 * receive   a report that has arrived, without waiting; a rank that was silent for too
 * long is lost, and so are its runs
 *
 * stop      asks all runs to stop */
size_t gb_mpi_pool_workers(const struct gb_mpi_pool *mpi);
size_t gb_mpi_pool_idle(const struct gb_mpi_pool *mpi);
size_t gb_mpi_pool_prefetch(const struct gb_mpi_pool *mpi);
bool gb_mpi_pool_submit(struct gb_mpi_pool *mpi, size_t ticket,
                        const struct gb_params *params, const char *directory,
                        struct gb_error *err);
bool gb_mpi_pool_receive(struct gb_mpi_pool *mpi, struct gb_pool_report *report);
void gb_mpi_pool_stop(struct gb_mpi_pool *mpi);

#endif
