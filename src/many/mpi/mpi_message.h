#ifndef GB_MANY_MPI_MPI_MESSAGE_H
#define GB_MANY_MPI_MPI_MESSAGE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "greenbody/status.h"

/* Messages between the processes (ranks) that mpirun or srun started.  The only file that
 * calls MPI: point to point only, the end excepted, so that a rank that dies stops no
 * other. */

enum gb_mpi_message_start {
    GB_MPI_MESSAGE_ALONE, /* one process, no MPI */
    GB_MPI_MESSAGE_JOINED,
    GB_MPI_MESSAGE_FAILED /* an error is set */
};

/* Starts MPI where a launcher started this process.  Errors: GB_ERR_MACHINE, and
 * GB_ERR_INPUT for several processes of a build without MPI. */
enum gb_mpi_message_start gb_mpi_message_start(int *rank, int *rank_count,
                                               struct gb_error *err);
/* Collective: waits for all ranks, for ever when one has died. */
void gb_mpi_message_end(void);

enum { GB_MPI_MESSAGE_HOST_MAX = 256 };

/* A process of a machine: others on it can see whether it exists. */
struct gb_mpi_message_process {
    int64_t pid; /* 0: unknown */
    char host[GB_MPI_MESSAGE_HOST_MAX];
};
struct gb_mpi_message_process gb_mpi_message_self(void);

struct gb_mpi_message_head {
    int rank; /* sender */
    int tag;
};

/* Is there a message of any sender and tag? */
bool gb_mpi_message_probe(struct gb_mpi_message_head *head);
/* Receives the message that was probed. */
void gb_mpi_message_receive(const struct gb_mpi_message_head *head, void *data,
                            size_t size);

/* Sends and waits until data may be used again: to ranks that live. */
void gb_mpi_message_send(int rank, int tag, const void *data, size_t size);

/* Sends a copy without waiting: a dead rank never receives it, and a rank that waited for
 * it would do so for ever.  To be freed with g_free
 * once gb_mpi_message_is_sent. */
struct gb_mpi_message_posted;
struct gb_mpi_message_posted *gb_mpi_message_post(int rank, int tag, const void *data,
                                                  size_t size);
bool gb_mpi_message_is_sent(struct gb_mpi_message_posted *posted);

#endif
