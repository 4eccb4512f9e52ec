#include "many/mpi/mpi_worker.h"

#include <errno.h>
#include <signal.h>
#include <string.h>

#include <glib.h>

#include "base/clock.h"
#include "many/mpi/mpi_message.h"
#include "many/mpi/mpi_protocol.h"
#include "many/pool.h"

/* The first rank may be busy for long, reading the results of a large sweep; on the same
 * machine its process shows whether it lives. */
static const double first_lost_after_s = 600.0;
static const double first_doubtful_after_s = 3.0;

/* Why a rank does no more runs. */
enum stop {
    RUNNING,
    STOPPED_BY_FIRST, /* the first rank stops all runs */
    LEAVING           /* a signal to this rank: others may do its runs */
};

struct rank {
    struct gb_pool *local;
    GQueue *queue; /* struct gb_mpi_run: prefetched, for workers that are busy */
    enum stop stop;
    bool quit;
    int rank_lost;      /* content of the message quit */
    double heard_s;     /* clock of the last message of the first rank */
    double heartbeat_s; /* clock of the last heartbeat sent */
    struct gb_mpi_message_process first;
    GPtrArray *posted; /* messages to the first rank that are under way */
};

/* Without waiting: the first rank may be dead. */
static void send_first(struct rank *rank, enum gb_mpi_tag tag, const void *data,
                       size_t size)
{
    for (guint i = rank->posted->len; i > 0; i--) {
        if (gb_mpi_message_is_sent(g_ptr_array_index(rank->posted, i - 1))) {
            g_ptr_array_remove_index_fast(rank->posted, i - 1);
        }
    }
    g_ptr_array_add(rank->posted, gb_mpi_message_post(0, (int)tag, data, size));
}

static void send_report(struct rank *rank, const struct gb_pool_report *report)
{
    send_first(rank, GB_MPI_TAG_REPORT, report, sizeof *report);
}

static void send_capacity(struct rank *rank, size_t workers)
{
    const uint64_t capacity = workers;
    send_first(rank, GB_MPI_TAG_CAPACITY, &capacity, sizeof capacity);
}

static void send_heartbeat(struct rank *rank)
{
    if (gb_clock_s() - rank->heartbeat_s > gb_mpi_heartbeat_s) {
        rank->heartbeat_s = gb_clock_s();
        const struct gb_mpi_message_process self = gb_mpi_message_self();
        send_first(rank, GB_MPI_TAG_HEARTBEAT, &self, sizeof self);
    }
}

/* Whether the first rank is known to be gone. */
static bool first_is_gone(const struct rank *rank)
{
    const struct gb_mpi_message_process self = gb_mpi_message_self();
    const double silent_s = gb_clock_s() - rank->heard_s;
    if (silent_s <= first_doubtful_after_s || rank->first.pid <= 0) {
        return silent_s > first_lost_after_s;
    }
    return silent_s > first_lost_after_s ||
           (strcmp(self.host, rank->first.host) == 0 &&
            kill((pid_t)rank->first.pid, 0) != 0 && errno == ESRCH);
}

/* Starts a queued run, or returns it to the first rank. */
static void start_run(struct rank *rank, const struct gb_mpi_run *run)
{
    struct gb_pool_report report = {.ticket = run->ticket};
    if (rank->stop != RUNNING) {
        gb_error_set(&report.error, GB_ERR_CANCELLED, "stopped before it began");
        report.lost = rank->stop == LEAVING;
        send_report(rank, &report);
    } else if (!gb_pool_submit(rank->local, run->ticket, &run->params, run->directory,
                               &report.error)) {
        send_report(rank, &report);
    }
}

static void start_runs(struct rank *rank)
{
    while (!g_queue_is_empty(rank->queue) &&
           (rank->stop != RUNNING || gb_pool_prefetch(rank->local, 0) > 0)) {
        struct gb_mpi_run *run = g_queue_pop_head(rank->queue);
        start_run(rank, run);
        g_free(run);
    }
}

static void receive_messages(struct rank *rank)
{
    struct gb_mpi_message_head head;
    while (!rank->quit && gb_mpi_message_probe(&head)) {
        rank->heard_s = gb_clock_s();
        if (head.tag == GB_MPI_TAG_RUN) {
            struct gb_mpi_run *run = g_new0(struct gb_mpi_run, 1);
            gb_mpi_message_receive(&head, run, sizeof *run);
            g_queue_push_tail(rank->queue, run);
            continue;
        }
        if (head.tag == GB_MPI_TAG_HEARTBEAT) {
            gb_mpi_message_receive(&head, &rank->first, sizeof rank->first);
            continue;
        }
        gb_mpi_message_receive(&head, &rank->rank_lost, sizeof rank->rank_lost);
        if (head.tag == GB_MPI_TAG_STOP) {
            rank->stop = STOPPED_BY_FIRST;
        }
        rank->quit = head.tag == GB_MPI_TAG_QUIT;
    }
}

static void leave(struct rank *rank)
{
    rank->stop = rank->stop == RUNNING ? LEAVING : rank->stop;
    send_capacity(rank, 0); /* before runs are returned, or they would be sent again */
}

/* Waits for a report of the local pool, and passes it on. */
static void report_run(struct rank *rank)
{
    struct gb_pool_report report;
    const double seconds = gb_pool_poll_interval(rank->local);
    if (gb_pool_receive(rank->local, seconds, &report)) {
        report.lost = rank->stop == LEAVING && report.error.code == GB_ERR_CANCELLED;
        send_report(rank, &report);
    }
}

/* Starts and reports runs; false when the first rank is gone. */
static bool work(struct rank *rank, bool *stopped)
{
    start_runs(rank);
    if (rank->stop != RUNNING && !*stopped) {
        *stopped = true;
        gb_pool_stop(rank->local);
    }
    report_run(rank);
    send_heartbeat(rank);
    return !first_is_gone(rank);
}

/* Runs under way end as they would have, or are stopped by a signal. */
static void finish_runs(struct gb_pool *local, bool (*cancelled)(void *data), void *data)
{
    struct gb_pool_report report;
    bool stopped = false;
    while (gb_pool_busy(local) > 0) {
        if (!stopped && cancelled(data)) {
            stopped = true;
            gb_pool_stop(local);
        }
        (void)gb_pool_receive(local, gb_pool_poll_interval(local), &report);
    }
}

bool gb_mpi_worker_serve(struct gb_pool *local, size_t workers,
                         bool (*cancelled)(void *data), void *data,
                         enum gb_mpi_worker_end *end, struct gb_error *err)
{
    struct rank rank = {.local = local, .heard_s = gb_clock_s()};
    bool stopped = false, leaving = false, alive = true;
    rank.queue = g_queue_new();
    rank.posted = g_ptr_array_new_with_free_func(g_free);
    send_capacity(&rank, workers);
    receive_messages(&rank);
    while (alive && !rank.quit) {
        if (!leaving && cancelled(data)) {
            leaving = true;
            leave(&rank);
        }
        alive = work(&rank, &stopped);
        receive_messages(&rank);
    }
    g_queue_free_full(rank.queue, g_free);
    if (!rank.quit) { /* MPI may still read what is under way */
        *end = GB_MPI_WORKER_FIRST_LOST;
        finish_runs(local, cancelled, data);
        return gb_error_set(err, GB_ERR_MACHINE, "the first rank is gone");
    }
    g_ptr_array_unref(rank.posted);
    *end = rank.rank_lost == 0 ? GB_MPI_WORKER_ALL_ALIVE : GB_MPI_WORKER_RANK_LOST;
    return !leaving || gb_error_set(err, GB_ERR_CANCELLED, "stopped");
}
