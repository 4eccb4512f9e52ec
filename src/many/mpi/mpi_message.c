#include "many/mpi/mpi_message.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <glib.h>

#include "base/built_with.h"

struct gb_mpi_message_process gb_mpi_message_self(void)
{
    struct gb_mpi_message_process self = {.pid = getpid()};
    if (gethostname(self.host, sizeof self.host - 1) != 0) {
        self.pid = 0;
    }
    return self;
}

#if GB_WITH_MPI

#include <mpi.h>

struct gb_mpi_message_posted {
    MPI_Request request;
    max_align_t data[];
};

/* Environment of processes that Open MPI, PMIx or PMI launched. */
static bool is_launched(void)
{
    return getenv("OMPI_COMM_WORLD_SIZE") != NULL || getenv("PMIX_RANK") != NULL ||
           getenv("PMI_RANK") != NULL;
}

enum gb_mpi_message_start gb_mpi_message_start(int *rank, int *rank_count,
                                               struct gb_error *err)
{
    if (!is_launched()) {
        return GB_MPI_MESSAGE_ALONE;
    }
    if (MPI_Init(NULL, NULL) != MPI_SUCCESS) {
        gb_error_set(err, GB_ERR_MACHINE, "MPI does not start");
        return GB_MPI_MESSAGE_FAILED;
    }
    MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
    MPI_Comm_rank(MPI_COMM_WORLD, rank);
    MPI_Comm_size(MPI_COMM_WORLD, rank_count);
    return GB_MPI_MESSAGE_JOINED;
}

void gb_mpi_message_end(void)
{
    MPI_Finalize();
}

bool gb_mpi_message_probe(struct gb_mpi_message_head *head)
{
    MPI_Status status;
    int there = 0;
    if (MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &status) !=
            MPI_SUCCESS ||
        there == 0) {
        return false;
    }
    *head = (struct gb_mpi_message_head){status.MPI_SOURCE, status.MPI_TAG};
    return true;
}

void gb_mpi_message_receive(const struct gb_mpi_message_head *head, void *data,
                            size_t size)
{
    MPI_Recv(data, (int)size, MPI_BYTE, head->rank, head->tag, MPI_COMM_WORLD,
             MPI_STATUS_IGNORE);
}

void gb_mpi_message_send(int rank, int tag, const void *data, size_t size)
{
    MPI_Send(data, (int)size, MPI_BYTE, rank, tag, MPI_COMM_WORLD);
}

struct gb_mpi_message_posted *gb_mpi_message_post(int rank, int tag, const void *data,
                                                  size_t size)
{
    struct gb_mpi_message_posted *posted = g_malloc0(sizeof *posted + size);
    memcpy(posted->data, data, size);
    MPI_Isend(posted->data, (int)size, MPI_BYTE, rank, tag, MPI_COMM_WORLD,
              &posted->request);
    return posted;
}

bool gb_mpi_message_is_sent(struct gb_mpi_message_posted *posted)
{
    int sent = 0;
    return MPI_Test(&posted->request, &sent, MPI_STATUS_IGNORE) == MPI_SUCCESS &&
           sent != 0;
}

#else

enum gb_mpi_message_start gb_mpi_message_start(int *rank, int *rank_count,
                                               struct gb_error *err)
{
    const char *size = getenv("OMPI_COMM_WORLD_SIZE");
    size = size != NULL ? size : getenv("PMI_SIZE");
    *rank = 0;
    *rank_count = 1;
    if (size == NULL || strcmp(size, "1") == 0) {
        return GB_MPI_MESSAGE_ALONE;
    }
    gb_error_set(err, GB_ERR_INPUT,
                 "started %s times by mpirun or srun, but built without Open MPI; "
                 "accepted one process",
                 size);
    return GB_MPI_MESSAGE_FAILED;
}

/* Never called: a process without MPI is alone. */
void gb_mpi_message_end(void)
{
}

bool gb_mpi_message_probe(struct gb_mpi_message_head *head)
{
    (void)head;
    return false;
}

void gb_mpi_message_receive(const struct gb_mpi_message_head *head, void *data,
                            size_t size)
{
    (void)head;
    memset(data, 0, size);
}

void gb_mpi_message_send(int rank, int tag, const void *data, size_t size)
{
    (void)rank;
    (void)tag;
    (void)data;
    (void)size;
}

struct gb_mpi_message_posted *gb_mpi_message_post(int rank, int tag, const void *data,
                                                  size_t size)
{
    gb_mpi_message_send(rank, tag, data, size);
    return NULL;
}

bool gb_mpi_message_is_sent(struct gb_mpi_message_posted *posted)
{
    (void)posted;
    return true;
}

#endif
