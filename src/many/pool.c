#include "many/pool.h"

#include <math.h>
#include <poll.h>

#include <glib.h>

#include "base/alloc.h"
#include "base/clock.h"
#include "many/mpi_pool.h"
#include "many/worker.h"

struct gb_pool {
    gb_pool_work *work;
    struct gb_worker *worker;
    struct pollfd *poll; /* of those with a run, and which they are: */
    size_t *polled;
    size_t count;              /* runs pressed at once */
    size_t places;             /* workers: as many again may be keeping theirs */
    size_t busy, keeping;      /* workers with a run; those of them that only keep it */
    struct gb_mpi_pool *ranks; /* NULL: nobody else */
    size_t away;               /* runs that other ranks do */
    double stirred;            /* when a run was given or reported last */
};

/* Nothing wakes a rank when a letter comes: it looks from time to time, ever more seldom
 * the longer nothing happens.  A run of a second waits for a hundredth of it at most to
 * be reported, and looking takes less than that of a processor. */
static const double letters_least_s = 0.02;
static const double letters_most_s = 0.1;
static const double letters_share = 0.02;

bool gb_pool_create(struct gb_pool **out, size_t workers, gb_pool_work *work,
                    struct gb_mpi_pool *ranks, struct gb_error *err)
{
    struct gb_pool *crew = gb_alloc_array(1, sizeof *crew, err);
    if (crew == NULL) {
        return false;
    }
    crew->work = work;
    crew->stirred = gb_clock_s();
    crew->ranks = ranks;
    crew->count = workers;
    crew->places = 2 * workers;
    crew->worker = gb_alloc_array(crew->places, sizeof *crew->worker, err);
    crew->poll = gb_alloc_array(crew->places, sizeof *crew->poll, err);
    crew->polled = gb_alloc_array(crew->places, sizeof *crew->polled, err);
    if (crew->worker == NULL || crew->poll == NULL || crew->polled == NULL) {
        crew->places = 0;
        gb_pool_destroy(crew);
        return false;
    }
    for (size_t i = 0; i < crew->places; i++) {
        crew->worker[i].fd = -1;
    }
    *out = crew;
    return true;
}

double gb_pool_poll_interval(const struct gb_pool *crew)
{
    const double calm = letters_share * (gb_clock_s() - crew->stirred);
    return fmin(fmax(calm, letters_least_s), letters_most_s);
}

/* Runs that may begin here, where those that are only being kept do not count. */
static size_t room_here(const struct gb_pool *crew)
{
    const size_t pressing = crew->busy - crew->keeping;
    const size_t room = crew->count > pressing ? crew->count - pressing : 0;
    return MIN(room, crew->places - crew->busy);
}

size_t gb_pool_idle(const struct gb_pool *crew)
{
    return (crew->count > crew->busy ? crew->count - crew->busy : 0) +
           gb_mpi_pool_idle(crew->ranks);
}

size_t gb_pool_prefetch(const struct gb_pool *crew, size_t waiting)
{
    const bool many = waiting > crew->count + gb_mpi_pool_workers(crew->ranks);
    return room_here(crew) + (many ? gb_mpi_pool_prefetch(crew->ranks) : 0);
}

size_t gb_pool_busy(const struct gb_pool *crew)
{
    return crew->busy + crew->away;
}

static bool give_here(struct gb_pool *crew, size_t ticket, const struct gb_params *params,
                      const char *directory, struct gb_error *err)
{
    size_t idle = 0;
    while (crew->worker[idle].busy) {
        idle++;
    }
    const bool given = gb_worker_give(crew->worker, crew->places, idle, crew->work,
                                      ticket, params, directory, err);
    crew->busy += given;
    return given;
}

bool gb_pool_submit(struct gb_pool *crew, size_t ticket, const struct gb_params *params,
                    const char *directory, struct gb_error *err)
{
    crew->stirred = gb_clock_s();
    const bool idle = crew->busy < crew->count;
    if (idle || (room_here(crew) > 0 && gb_mpi_pool_idle(crew->ranks) == 0)) {
        return give_here(crew, ticket, params, directory, err);
    }
    const bool given = gb_mpi_pool_submit(crew->ranks, ticket, params, directory, err);
    crew->away += given;
    return given;
}

/* What worker i has to say; true for a report. */
static bool hear(struct gb_pool *crew, size_t i, struct gb_pool_report *report)
{
    const bool kept = crew->worker[i].keeping;
    const bool ended = gb_worker_take(&crew->worker[i], report);
    crew->stirred = gb_clock_s();
    crew->busy -= ended;
    crew->keeping -= ended && kept;
    crew->keeping += !ended && !kept;
    return ended;
}

static bool take_here(struct gb_pool *crew, double seconds, struct gb_pool_report *report)
{
    size_t count = 0; /* no more than there are open files, or poll refuses */
    for (size_t i = 0; i < crew->places; i++) {
        if (crew->worker[i].busy) {
            crew->poll[count] = (struct pollfd){crew->worker[i].fd, POLLIN, 0};
            crew->polled[count++] = i;
        }
    }
    if (poll(crew->poll, count, (int)ceil(1e3 * seconds)) <= 0) {
        return false;
    }
    for (size_t k = 0; k < count; k++) {
        if (crew->poll[k].revents != 0) {
            return hear(crew, crew->polled[k], report);
        }
    }
    return false;
}

bool gb_pool_receive(struct gb_pool *crew, double seconds, struct gb_pool_report *report)
{
    const double until = gb_clock_s() + seconds;
    const double stirred = crew->stirred;
    if (crew->ranks == NULL) {
        return take_here(crew, seconds, report);
    }
    do {
        if (gb_mpi_pool_receive(crew->ranks, report)) {
            crew->away--;
            crew->stirred = gb_clock_s();
            return true;
        }
        if (take_here(crew, gb_pool_poll_interval(crew), report)) {
            return true;
        }
    } while (crew->stirred <= stirred && gb_clock_s() < until);
    return false;
}

void gb_pool_stop(struct gb_pool *crew)
{
    gb_mpi_pool_stop(crew->away > 0 ? crew->ranks : NULL);
    for (size_t i = 0; i < crew->places; i++) {
        if (crew->worker[i].busy) {
            gb_worker_stop(&crew->worker[i]);
        }
    }
}

void gb_pool_destroy(struct gb_pool *crew)
{
    struct gb_pool_report report;
    if (crew == NULL) {
        return;
    }
    if (gb_pool_busy(crew) > 0) {
        gb_pool_stop(crew);
    }
    while (gb_pool_busy(crew) > 0) {
        (void)gb_pool_receive(crew, 1.0, &report);
    }
    for (size_t i = 0; i < crew->places; i++) {
        gb_worker_end(&crew->worker[i]);
    }
    gb_alloc_free(crew->worker);
    gb_alloc_free(crew->poll);
    gb_alloc_free(crew->polled);
    gb_alloc_free(crew);
}
