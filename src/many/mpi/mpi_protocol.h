#ifndef GB_MANY_MPI_MPI_PROTOCOL_H
#define GB_MANY_MPI_MPI_PROTOCOL_H

#include <stdint.h>

#include "greenbody/params.h"

/* Messages of the MPI pool: between mpi_pool.c (the first rank) and mpi_worker.c (the
 * others).  Everything is sent as bytes: all ranks run the same executable. */
enum gb_mpi_tag {
    GB_MPI_TAG_CAPACITY = 1, /* uint64_t: how many runs the rank does at once */
    GB_MPI_TAG_RUN,          /* struct gb_mpi_run */
    GB_MPI_TAG_REPORT,       /* struct gb_pool_report */
    GB_MPI_TAG_HEARTBEAT,    /* struct gb_mpi_message_process: the sender */
    GB_MPI_TAG_STOP,         /* int, unused: all runs shall stop */
    GB_MPI_TAG_QUIT          /* int: 1 when a rank was lost, and MPI must not be ended */
};

enum { GB_MPI_DIRECTORY_MAX = 4096 };

/* A run on its way to a rank. */
struct gb_mpi_run {
    uint64_t ticket;
    struct gb_params params;
    char directory[GB_MPI_DIRECTORY_MAX];
};

/* Interval of heartbeats in both directions, s. */
static const double gb_mpi_heartbeat_s = 1.0;

#endif
