#ifndef GB_MANY_MPI_MPI_WORKER_H
#define GB_MANY_MPI_MPI_WORKER_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"

struct gb_pool;

/* How a rank ended, for the shutdown of MPI. */
enum gb_mpi_worker_end {
    GB_MPI_WORKER_ALL_ALIVE, /* the first rank said quit, and no rank was lost */
    GB_MPI_WORKER_RANK_LOST, /* another rank is gone */
    GB_MPI_WORKER_FIRST_LOST /* the first rank is gone; runs under way here have ended */
};

/* The loop of a rank other than the first; see gb_mpi_pool_serve. */
bool gb_mpi_worker_serve(struct gb_pool *local, size_t workers,
                         bool (*cancelled)(void *data), void *data,
                         enum gb_mpi_worker_end *end, struct gb_error *err);

#endif
