#include "many/mpi/mpi_pool.h"

#include <string.h>

#include <glib.h>

#include "base/clock.h"
#include "many/mpi/mpi_message.h"
#include "many/mpi/mpi_protocol.h"
#include "many/mpi/mpi_worker.h"
#include "many/pool.h"

/* A rank silent for longer is lost; a file system that stalls must not look like that. */
static const double lost_after_s = 20.0;
/* The same at the end, when a rank has nothing to do but to send heartbeats. */
static const double lost_at_end_s = 8.0;

/* State of another rank, as known to the first one. */
struct member {
    size_t capacity;
    GArray *tickets; /* size_t: runs submitted and not reported */
    double heard_s;  /* clock of its last message */
    bool lost;
    struct gb_mpi_message_posted *heartbeat; /* last one sent to it; NULL: none */
};

struct gb_mpi_pool {
    int rank, rank_count;
    struct member *member; /* one per rank; only of the first rank, its own unused */
    GPtrArray *posted;     /* runs whose messages are under way */
    double heartbeat_s;    /* clock of the last heartbeats sent */
    bool any_lost, first_lost;
};

bool gb_mpi_pool_create(struct gb_mpi_pool **out, struct gb_error *err)
{
    int rank = 0, rank_count = 1;
    *out = NULL;
    const enum gb_mpi_message_start start = gb_mpi_message_start(&rank, &rank_count, err);
    if (start != GB_MPI_MESSAGE_JOINED) {
        return start == GB_MPI_MESSAGE_ALONE;
    }
    struct gb_mpi_pool *mpi = g_new0(struct gb_mpi_pool, 1);
    mpi->rank = rank;
    mpi->rank_count = rank_count;
    mpi->posted = g_ptr_array_new_with_free_func(g_free);
    mpi->member = g_new0(struct member, (gsize)rank_count);
    for (int r = 0; r < rank_count; r++) {
        mpi->member[r].tickets = g_array_new(FALSE, FALSE, sizeof(size_t));
        mpi->member[r].heard_s = gb_clock_s();
    }
    *out = mpi;
    return true;
}

bool gb_mpi_pool_is_first(const struct gb_mpi_pool *mpi)
{
    return mpi == NULL || mpi->rank == 0;
}

bool gb_mpi_pool_serve(struct gb_mpi_pool *mpi, struct gb_pool *local, size_t workers,
                       bool (*cancelled)(void *data), void *data, struct gb_error *err)
{
    enum gb_mpi_worker_end end = GB_MPI_WORKER_RANK_LOST;
    const bool good = gb_mpi_worker_serve(local, workers, cancelled, data, &end, err);
    mpi->any_lost = end != GB_MPI_WORKER_ALL_ALIVE;
    mpi->first_lost = end == GB_MPI_WORKER_FIRST_LOST;
    return good;
}

bool gb_mpi_pool_first_is_lost(const struct gb_mpi_pool *mpi)
{
    return mpi->first_lost;
}

static void send_members(struct gb_mpi_pool *mpi, enum gb_mpi_tag tag, int content)
{
    for (int r = 1; r < mpi->rank_count; r++) {
        if (!mpi->member[r].lost) {
            gb_mpi_message_send(r, (int)tag, &content, sizeof content);
        }
    }
}

static void free_sent(struct gb_mpi_pool *mpi)
{
    for (guint i = mpi->posted->len; i > 0; i--) {
        if (gb_mpi_message_is_sent(g_ptr_array_index(mpi->posted, i - 1))) {
            g_ptr_array_remove_index_fast(mpi->posted, i - 1);
        }
    }
}

static bool remove_ticket(struct member *member, size_t ticket)
{
    for (guint i = 0; i < member->tickets->len; i++) {
        if (g_array_index(member->tickets, size_t, i) == ticket) {
            g_array_remove_index_fast(member->tickets, i);
            return true;
        }
    }
    return false;
}

/* Receives one message; true when it is the report of a run that is still expected. */
static bool receive_message(struct gb_mpi_pool *mpi,
                            const struct gb_mpi_message_head *head,
                            struct gb_pool_report *report)
{
    struct member *member = &mpi->member[head->rank];
    uint64_t capacity = 0;
    struct gb_mpi_message_process unused;
    member->heard_s = gb_clock_s();
    switch (head->tag) {
    case GB_MPI_TAG_CAPACITY:
        gb_mpi_message_receive(head, &capacity, sizeof capacity);
        member->capacity = capacity;
        return false;
    case GB_MPI_TAG_REPORT:
        gb_mpi_message_receive(head, report, sizeof *report);
        return !member->lost && remove_ticket(member, report->ticket);
    default:
        gb_mpi_message_receive(head, &unused, sizeof unused);
        return false;
    }
}

/* Ends the other ranks; the message says whether a rank was lost. */
static void quit_members(struct gb_mpi_pool *mpi)
{
    struct gb_mpi_message_head head;
    struct gb_pool_report report;
    while (gb_mpi_message_probe(&head)) { /* late heartbeats */
        (void)receive_message(mpi, &head, &report);
    }
    for (int r = 1; r < mpi->rank_count; r++) {
        const struct member *member = &mpi->member[r];
        mpi->any_lost |= member->lost || gb_clock_s() - member->heard_s > lost_at_end_s;
    }
    send_members(mpi, GB_MPI_TAG_QUIT, mpi->any_lost);
}

/* With a lost rank the collective end would wait for ever: the process then exits without
 * it, and messages under way stay allocated, because MPI may still read them. */
void gb_mpi_pool_destroy(struct gb_mpi_pool *mpi)
{
    if (mpi == NULL) {
        return;
    }
    if (mpi->rank == 0) {
        quit_members(mpi);
    }
    if (!mpi->any_lost) {
        free_sent(mpi);
        gb_mpi_message_end();
        g_ptr_array_unref(mpi->posted);
    }
    for (int r = 0; r < mpi->rank_count; r++) {
        g_array_unref(mpi->member[r].tickets);
        if (!mpi->any_lost) {
            g_free(mpi->member[r].heartbeat);
        }
    }
    g_free(mpi->member);
    g_free(mpi);
}

/* Runs that a rank may be given until it has `most` of them. */
static size_t room(const struct member *member, size_t most)
{
    return member->lost || member->tickets->len >= most ? 0 : most - member->tickets->len;
}

size_t gb_mpi_pool_workers(const struct gb_mpi_pool *mpi)
{
    size_t workers = 0;
    for (int r = 1; mpi != NULL && r < mpi->rank_count; r++) {
        workers += mpi->member[r].lost ? 0 : mpi->member[r].capacity;
    }
    return workers;
}

/* Room of all ranks, with up to `runs` for each of their workers. */
static size_t room_of_all(const struct gb_mpi_pool *mpi, size_t runs)
{
    size_t sum = 0;
    for (int r = 1; mpi != NULL && r < mpi->rank_count; r++) {
        sum += room(&mpi->member[r], runs * mpi->member[r].capacity);
    }
    return sum;
}

size_t gb_mpi_pool_idle(const struct gb_mpi_pool *mpi)
{
    return room_of_all(mpi, 1);
}

size_t gb_mpi_pool_prefetch(const struct gb_mpi_pool *mpi)
{
    return room_of_all(mpi, 2);
}

/* The rank of the next run: an idle one, else one without a prefetched run; 0: none. */
static int choose_rank(const struct gb_mpi_pool *mpi)
{
    int prefetching = 0;
    for (int r = 1; r < mpi->rank_count; r++) {
        const struct member *member = &mpi->member[r];
        if (room(member, member->capacity) > 0) {
            return r;
        }
        if (prefetching == 0 && room(member, 2 * member->capacity) > 0) {
            prefetching = r;
        }
    }
    return prefetching;
}

bool gb_mpi_pool_submit(struct gb_mpi_pool *mpi, size_t ticket,
                        const struct gb_params *params, const char *directory,
                        struct gb_error *err)
{
    const int rank = choose_rank(mpi);
    if (rank == 0 || strlen(directory) >= GB_MPI_DIRECTORY_MAX) {
        return gb_error_set(err, GB_ERR_INPUT, "%.300s: no rank takes it", directory);
    }
    struct gb_mpi_run *run = g_new0(struct gb_mpi_run, 1);
    run->ticket = ticket;
    run->params = *params;
    g_strlcpy(run->directory, directory, GB_MPI_DIRECTORY_MAX);
    g_ptr_array_add(mpi->posted,
                    gb_mpi_message_post(rank, GB_MPI_TAG_RUN, run, sizeof *run));
    g_array_append_val(mpi->member[rank].tickets, ticket);
    g_free(run);
    free_sent(mpi);
    return true;
}

/* Never waits: the last heartbeat to a dead rank stays under way. */
static void send_heartbeat(struct member *member, int rank)
{
    const struct gb_mpi_message_process self = gb_mpi_message_self();
    if (member->heartbeat != NULL && !gb_mpi_message_is_sent(member->heartbeat)) {
        return;
    }
    g_free(member->heartbeat);
    member->heartbeat =
        gb_mpi_message_post(rank, GB_MPI_TAG_HEARTBEAT, &self, sizeof self);
}

/* Sends heartbeats and looks for lost ranks, once in a heartbeat's interval. */
static void check_members(struct gb_mpi_pool *mpi)
{
    const double now = gb_clock_s();
    if (now - mpi->heartbeat_s < gb_mpi_heartbeat_s) {
        return;
    }
    /* after a pause of this process itself silence says nothing */
    const bool paused = now - mpi->heartbeat_s >= lost_after_s;
    for (int r = 1; r < mpi->rank_count; r++) {
        struct member *member = &mpi->member[r];
        /* a rank that leaves has no capacity, but may still owe reports */
        const bool expected = member->capacity > 0 || member->tickets->len > 0;
        if (expected && !paused && now - member->heard_s > lost_after_s) {
            member->lost = true;
            mpi->any_lost = true;
        }
        if (!member->lost) {
            send_heartbeat(member, r);
        }
    }
    mpi->heartbeat_s = now;
}

/* Reports a run of a lost rank. */
static bool report_lost(struct gb_mpi_pool *mpi, struct gb_pool_report *report)
{
    for (int r = 1; r < mpi->rank_count; r++) {
        struct member *member = &mpi->member[r];
        if (member->lost && member->tickets->len > 0) {
            *report = (struct gb_pool_report){
                .ticket = g_array_index(member->tickets, size_t, 0), .lost = true};
            g_array_remove_index_fast(member->tickets, 0);
            gb_error_set(&report->error, GB_ERR_MACHINE,
                         "no message for %g s of rank %d, which had this run",
                         lost_after_s, r);
            return true;
        }
    }
    return false;
}

bool gb_mpi_pool_receive(struct gb_mpi_pool *mpi, struct gb_pool_report *report)
{
    struct gb_mpi_message_head head;
    if (mpi == NULL) {
        return false;
    }
    while (gb_mpi_message_probe(&head)) {
        if (receive_message(mpi, &head, report)) {
            return true;
        }
    }
    check_members(mpi);
    return report_lost(mpi, report);
}

void gb_mpi_pool_stop(struct gb_mpi_pool *mpi)
{
    if (mpi != NULL) {
        send_members(mpi, GB_MPI_TAG_STOP, 0);
    }
}
