#include "many/pool.h"

#include <math.h>
#include <poll.h>

#include <glib.h>

#include "base/alloc.h"
#include "many/worker.h"

struct gb_pool {
    gb_pool_work *work;
    struct gb_worker *worker;
    struct pollfd *poll;  /* of workers with a run, ... */
    size_t *polled;       /* ... and their indices */
    size_t count;         /* runs that load at once */
    size_t slots;         /* workers: as many again may be writing their files */
    size_t busy, writing; /* workers with a run; those of them that only write files */
};

bool gb_pool_create(struct gb_pool **out, size_t workers, gb_pool_work *work,
                    struct gb_error *err)
{
    struct gb_pool *pool = gb_alloc_array(1, sizeof *pool, err);
    if (pool == NULL) {
        return false;
    }
    pool->work = work;
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

size_t gb_pool_idle(const struct gb_pool *pool)
{
    return pool->count > pool->busy ? pool->count - pool->busy : 0;
}

size_t gb_pool_prefetch(const struct gb_pool *pool)
{
    const size_t loading = pool->busy - pool->writing;
    const size_t room = pool->count > loading ? pool->count - loading : 0;
    return MIN(room, pool->slots - pool->busy);
}

size_t gb_pool_busy(const struct gb_pool *pool)
{
    return pool->busy;
}

bool gb_pool_submit(struct gb_pool *pool, size_t ticket, const struct gb_params *params,
                    const char *directory, struct gb_error *err)
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

/* The message of worker i; true for a report. */
static bool read_worker(struct gb_pool *pool, size_t i, struct gb_pool_report *report)
{
    const bool wrote = pool->worker[i].writing;
    const bool ended = gb_worker_receive(&pool->worker[i], report);
    pool->busy -= ended;
    pool->writing -= ended && wrote;
    pool->writing += !ended && !wrote;
    return ended;
}

bool gb_pool_receive(struct gb_pool *pool, double seconds, struct gb_pool_report *report)
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

void gb_pool_stop(struct gb_pool *pool)
{
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
    if (pool->busy > 0) {
        gb_pool_stop(pool);
    }
    while (pool->busy > 0) {
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
