#ifndef GB_MANY_MPI_POOL_H
#define GB_MANY_MPI_POOL_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/params.h"

struct gb_pool;
struct gb_pool_report;

/* The processes that mpirun or srun started together, on one machine or many: the first
 * hands out runs, the others do them.  Nothing is collective but the start, and the end
 * if all are still there: a rank that dies costs what it was doing.  Built without Open
 * MPI a process is always alone. */
struct gb_mpi_pool;

/* Joins the others, if there are any: else *out is NULL and all is well.  Errors:
 * GB_ERR_INPUT when there are others and this build cannot reach them, GB_ERR_MACHINE. */
bool gb_mpi_pool_create(struct gb_mpi_pool **out, struct gb_error *err);
/* Tells the others to end, or takes leave.  NULL is fine. */
void gb_mpi_pool_destroy(struct gb_mpi_pool *ranks);

/* Is this the one that hands out?  True for NULL. */
bool gb_mpi_pool_is_first(const struct gb_mpi_pool *ranks);

/* What a rank other than the first does: runs of `workers` at a time with its crew, until
 * told to end or nothing is heard of the first one.  Errors: GB_ERR_CANCELLED,
 * GB_ERR_MACHINE (the first one is gone). */
bool gb_mpi_pool_serve(struct gb_mpi_pool *ranks, struct gb_pool *crew, size_t workers,
                       bool (*cancelled)(void *data), void *data, struct gb_error *err);

/* The rest is for the first one; NULL has nobody.
 *
 * workers  of the others; idle: those of them without a run
 *
 * ahead  runs that they may have in hand while they are busy, one for each worker
 *
 * give  errors: GB_ERR_INPUT (a directory whose name is too long), GB_ERR_MEMORY
 *
 * take  a report that has come, without waiting; a rank that was not heard of for long is
 * lost, and so are its runs
 *
 * stop  asks all runs to stop */
size_t gb_mpi_pool_workers(const struct gb_mpi_pool *ranks);
size_t gb_mpi_pool_idle(const struct gb_mpi_pool *ranks);
size_t gb_mpi_pool_prefetch(const struct gb_mpi_pool *ranks);
bool gb_mpi_pool_submit(struct gb_mpi_pool *ranks, size_t ticket,
                        const struct gb_params *params, const char *directory,
                        struct gb_error *err);
bool gb_mpi_pool_receive(struct gb_mpi_pool *ranks, struct gb_pool_report *report);
void gb_mpi_pool_stop(struct gb_mpi_pool *ranks);

#endif
