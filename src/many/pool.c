#include "many/pool.h"

#include <math.h>
#include <poll.h>

#include <glib.h>

#include "base/alloc.h"
#include "base/clock.h"
#include "many/mpi/mpi_pool.h"
#include "many/worker.h"

struct gb_pool {
    gb_pool_work *work;
    struct gb_worker *worker;
    struct pollfd *poll;     /* of workers with a run, ... */
    size_t *polled;          /* ... and their indices */
    size_t count;            /* runs that load at once */
    size_t slots;            /* workers: as many again may be writing their files */
    size_t busy, writing;    /* workers with a run; those of them that only write files */
    struct gb_mpi_pool *mpi; /* NULL: no other ranks */
    size_t remote;           /* runs at other ranks */
    double active_s;         /* clock of the last run submitted or reported */
};

/* MPI has no event to wait for: messages are polled, at an interval that grows with the
 * time since the last activity.  A run of a second is reported within 2 % of its time, and
 * polling takes less than that of a processor. */
static const double interval_min_s = 0.02;
static const double interval_max_s = 0.1;
static const double interval_ratio = 0.02;

bool gb_pool_create(struct gb_pool **out, size_t workers, gb_pool_work *work,
                    struct gb_mpi_pool *mpi, struct gb_error *err)
{
    struct gb_pool *pool = gb_alloc_array(1, sizeof *pool, err);
    if (pool == NULL) {
        return false;
    }
    pool->work = work;
    pool->active_s = gb_clock_s();
    pool->mpi = mpi;
    pool->count = workers;
    pool->slots = 2 * workers;
    pool->worker = gb_alloc_array(pool->slots, sizeof *pool->worker, err);
    pool->poll = gb_alloc_array(pool->slots, sizeof *pool->poll, err);
    pool->polled = gb_alloc_array(pool->slots, sizeof *pool->polled, err);
    if (pool->worker == NULL || pool->poll == NULL || pool->polled == NULL) {
        pool->slots = 0;
        gb_pool_destroy(pool);
        return false;
    }
    for (size_t i = 0; i < pool->slots; i++) {
        pool->worker[i].fd = -1;
    }
    *out = pool;
    return true;
}

double gb_pool_poll_interval(const struct gb_pool *pool)
{
    const double idle_s = gb_clock_s() - pool->active_s;
    return fmin(fmax(interval_ratio * idle_s, interval_min_s), interval_max_s);
}

/* Runs that may begin in this process's workers; those that only write do not count. */
static size_t local_room(const struct gb_pool *pool)
{
    const size_t loading = pool->busy - pool->writing;
    const size_t room = pool->count > loading ? pool->count - loading : 0;
    return MIN(room, pool->slots - pool->busy);
}

size_t gb_pool_idle(const struct gb_pool *pool)
{
    return (pool->count > pool->busy ? pool->count - pool->busy : 0) +
           gb_mpi_pool_idle(pool->mpi);
}

size_t gb_pool_prefetch(const struct gb_pool *pool, size_t waiting)
{
    const bool many = waiting > pool->count + gb_mpi_pool_workers(pool->mpi);
    return local_room(pool) + (many ? gb_mpi_pool_prefetch(pool->mpi) : 0);
}

size_t gb_pool_busy(const struct gb_pool *pool)
{
    return pool->busy + pool->remote;
}

static bool submit_local(struct gb_pool *pool, size_t ticket,
                         const struct gb_params *params, const char *directory,
                         struct gb_error *err)
{
    size_t idle = 0;
    while (pool->worker[idle].busy) {
        idle++;
    }
    const bool given = gb_worker_submit(pool->worker, pool->slots, idle, pool->work,
                                        ticket, params, directory, err);
    pool->busy += given;
    return given;
}

bool gb_pool_submit(struct gb_pool *pool, size_t ticket, const struct gb_params *params,
                    const char *directory, struct gb_error *err)
{
    pool->active_s = gb_clock_s();
    const bool idle = pool->busy < pool->count;
    if (idle || (local_room(pool) > 0 && gb_mpi_pool_idle(pool->mpi) == 0)) {
        return submit_local(pool, ticket, params, directory, err);
    }
    const bool given = gb_mpi_pool_submit(pool->mpi, ticket, params, directory, err);
    pool->remote += given;
    return given;
}

/* The message of worker i; true for a report. */
static bool read_worker(struct gb_pool *pool, size_t i, struct gb_pool_report *report)
{
    const bool wrote = pool->worker[i].writing;
    const bool ended = gb_worker_receive(&pool->worker[i], report);
    pool->active_s = gb_clock_s();
    pool->busy -= ended;
    pool->writing -= ended && wrote;
    pool->writing += !ended && !wrote;
    return ended;
}

static bool receive_local(struct gb_pool *pool, double seconds,
                          struct gb_pool_report *report)
{
    size_t count = 0; /* no more than there are open files, or poll refuses */
    for (size_t i = 0; i < pool->slots; i++) {
        if (pool->worker[i].busy) {
            pool->poll[count] = (struct pollfd){pool->worker[i].fd, POLLIN, 0};
            pool->polled[count++] = i;
        }
    }
    if (poll(pool->poll, count, (int)ceil(1e3 * seconds)) <= 0) {
        return false;
    }
    for (size_t k = 0; k < count; k++) {
        if (pool->poll[k].revents != 0) {
            return read_worker(pool, pool->polled[k], report);
        }
    }
    return false;
}

bool gb_pool_receive(struct gb_pool *pool, double seconds, struct gb_pool_report *report)
{
    const double until = gb_clock_s() + seconds;
    const double active = pool->active_s;
    if (pool->mpi == NULL) {
        return receive_local(pool, seconds, report);
    }
    do {
        if (gb_mpi_pool_receive(pool->mpi, report)) {
            pool->remote--;
            pool->active_s = gb_clock_s();
            return true;
        }
        if (receive_local(pool, gb_pool_poll_interval(pool), report)) {
            return true;
        }
    } while (pool->active_s <= active && gb_clock_s() < until);
    return false;
}

void gb_pool_stop(struct gb_pool *pool)
{
    gb_mpi_pool_stop(pool->remote > 0 ? pool->mpi : NULL);
    for (size_t i = 0; i < pool->slots; i++) {
        if (pool->worker[i].busy) {
            gb_worker_stop(&pool->worker[i]);
        }
    }
}

void gb_pool_destroy(struct gb_pool *pool)
{
    struct gb_pool_report report;
    if (pool == NULL) {
        return;
    }
    if (gb_pool_busy(pool) > 0) {
        gb_pool_stop(pool);
    }
    while (gb_pool_busy(pool) > 0) {
        (void)gb_pool_receive(pool, 1.0, &report);
    }
    for (size_t i = 0; i < pool->slots; i++) {
        gb_worker_end(&pool->worker[i]);
    }
    gb_alloc_free(pool->worker);
    gb_alloc_free(pool->poll);
    gb_alloc_free(pool->polled);
    gb_alloc_free(pool);
}
