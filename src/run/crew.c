#include "run/crew.h"

#include <math.h>
#include <poll.h>
#include <time.h>

#include "base/alloc.h"
#include "run/ranks.h"
#include "run/worker.h"

struct gb_crew {
    gb_crew_work *work;
    struct gb_worker *worker;
    struct pollfd *poll;
    size_t count, busy;
    struct gb_ranks *ranks; /* NULL: nobody else */
    size_t away;            /* runs that other ranks do */
    double stirred;         /* when a run was given or reported last */
};

/* Nothing wakes a rank when a letter comes: it looks from time to time, ever more seldom
 * the longer nothing happens.  A run of a second waits for a hundredth of it at most to
 * be reported, and looking takes less than that of a processor. */
static const double letters_least_s = 0.002;
static const double letters_most_s = 0.1;
static const double letters_share = 0.02;

static double clock_s(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

bool gb_crew_create(struct gb_crew **out, size_t workers, gb_crew_work *work,
                    struct gb_ranks *ranks, struct gb_error *err)
{
    struct gb_crew *crew = gb_alloc_array(1, sizeof *crew, err);
    if (crew == NULL) {
        return false;
    }
    crew->work = work;
    crew->ranks = ranks;
    crew->count = workers;
    crew->worker = gb_alloc_array(workers, sizeof *crew->worker, err);
    crew->poll = crew->worker ? gb_alloc_array(workers, sizeof *crew->poll, err) : NULL;
    if (crew->poll == NULL) {
        crew->count = 0;
        gb_crew_destroy(crew);
        return false;
    }
    for (size_t i = 0; i < workers; i++) {
        crew->worker[i].fd = -1;
    }
    *out = crew;
    return true;
}

double gb_crew_patience(const struct gb_crew *crew)
{
    const double calm = letters_share * (clock_s() - crew->stirred);
    return fmin(fmax(calm, letters_least_s), letters_most_s);
}

size_t gb_crew_idle(const struct gb_crew *crew)
{
    return crew->count - crew->busy + gb_ranks_idle(crew->ranks);
}

size_t gb_crew_busy(const struct gb_crew *crew)
{
    return crew->busy + crew->away;
}

static bool give_here(struct gb_crew *crew, size_t ticket, const struct gb_params *params,
                      const char *directory, struct gb_error *err)
{
    size_t idle = 0;
    while (crew->worker[idle].busy) {
        idle++;
    }
    const bool given = gb_worker_give(crew->worker, crew->count, idle, crew->work, ticket,
                                      params, directory, err);
    crew->busy += given;
    return given;
}

bool gb_crew_give(struct gb_crew *crew, size_t ticket, const struct gb_params *params,
                  const char *directory, struct gb_error *err)
{
    crew->stirred = clock_s();
    if (crew->busy < crew->count) {
        return give_here(crew, ticket, params, directory, err);
    }
    const bool given = gb_ranks_give(crew->ranks, ticket, params, directory, err);
    crew->away += given;
    return given;
}

static bool take_here(struct gb_crew *crew, double seconds, struct gb_crew_report *report)
{
    for (size_t i = 0; i < crew->count; i++) {
        const struct gb_worker *worker = &crew->worker[i];
        crew->poll[i] = (struct pollfd){worker->busy ? worker->fd : -1, POLLIN, 0};
    }
    if (poll(crew->poll, crew->count, (int)ceil(1e3 * seconds)) <= 0) {
        return false;
    }
    for (size_t i = 0; i < crew->count; i++) {
        if (crew->poll[i].revents != 0) {
            gb_worker_take(&crew->worker[i], report);
            crew->busy--;
            crew->stirred = clock_s();
            return true;
        }
    }
    return false;
}

bool gb_crew_take(struct gb_crew *crew, double seconds, struct gb_crew_report *report)
{
    const double until = clock_s() + seconds;
    if (crew->ranks == NULL) {
        return take_here(crew, seconds, report);
    }
    do {
        if (gb_ranks_take(crew->ranks, report)) {
            crew->away--;
            crew->stirred = clock_s();
            return true;
        }
        if (take_here(crew, gb_crew_patience(crew), report)) {
            return true;
        }
    } while (clock_s() < until);
    return false;
}

void gb_crew_stop(struct gb_crew *crew)
{
    gb_ranks_stop(crew->away > 0 ? crew->ranks : NULL);
    for (size_t i = 0; i < crew->count; i++) {
        if (crew->worker[i].busy) {
            gb_worker_stop(&crew->worker[i]);
        }
    }
}

void gb_crew_destroy(struct gb_crew *crew)
{
    struct gb_crew_report report;
    if (crew == NULL) {
        return;
    }
    if (gb_crew_busy(crew) > 0) {
        gb_crew_stop(crew);
    }
    while (gb_crew_busy(crew) > 0) {
        (void)gb_crew_take(crew, 1.0, &report);
    }
    for (size_t i = 0; i < crew->count; i++) {
        gb_worker_end(&crew->worker[i]);
    }
    gb_alloc_free(crew->worker);
    gb_alloc_free(crew->poll);
    gb_alloc_free(crew);
}
