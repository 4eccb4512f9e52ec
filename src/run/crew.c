#include "run/crew.h"

#include <errno.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "base/alloc.h"
#include "run/ranks.h"

struct worker {
    pid_t pid; /* 0: idle */
    int fd;    /* where its report comes from */
    size_t ticket;
    double since;
};

struct gb_crew {
    gb_crew_work *work;
    struct worker *worker;
    struct pollfd *poll;
    size_t count, busy;
    struct gb_ranks *ranks; /* NULL: nobody else */
    size_t away;            /* runs that other ranks do */
};

/* With other ranks, longest time between two looks for what they send. */
static const double letters_every_s = 0.002;

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
        gb_crew_destroy(crew);
        return false;
    }
    *out = crew;
    return true;
}

size_t gb_crew_idle(const struct gb_crew *crew)
{
    return crew->count - crew->busy + gb_ranks_idle(crew->ranks);
}

size_t gb_crew_busy(const struct gb_crew *crew)
{
    return crew->busy + crew->away;
}

/* SIGTERM stays blocked in a worker's process and is looked for between slices. */
static bool is_asked_to_stop(void *data)
{
    sigset_t pending;
    (void)data;
    return sigpending(&pending) == 0 && sigismember(&pending, SIGTERM) == 1;
}

/* The worker's process; never returns.  The terminal's SIGINT reaches all processes: the
 * first one decides what it means and sends SIGTERM. */
static void labour(gb_crew_work *work, const struct gb_params *params,
                   const char *directory, pid_t parent, int fd)
{
    struct gb_error error = {0};
    signal(SIGINT, SIG_IGN);
    signal(SIGHUP, SIG_IGN);
    (void)prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() == parent) { /* else it died before the line above */
        (void)work(params, directory, is_asked_to_stop, NULL, &error);
        (void)!write(fd, &error, sizeof error); /* below PIPE_BUF: whole or not at all */
    }
    _exit(0);
}

static struct worker *find_idle(struct gb_crew *crew)
{
    struct worker *worker = crew->worker;
    while (worker->pid != 0) {
        worker++;
    }
    return worker;
}

static bool give_here(struct gb_crew *crew, size_t ticket, const struct gb_params *params,
                      const char *directory, struct gb_error *err)
{
    int ends[2];
    sigset_t term, before;
    if (pipe(ends) != 0) {
        return gb_error_set(err, GB_ERR_MACHINE, "no pipe to a worker: %s",
                            strerror(errno));
    }
    struct worker *worker = find_idle(crew);
    const pid_t parent = getpid();
    sigemptyset(&term);
    sigaddset(&term, SIGTERM);
    sigprocmask(SIG_BLOCK, &term, &before); /* before it can be missed */
    const pid_t pid = fork();
    if (pid == 0) {
        close(ends[0]);
        labour(crew->work, params, directory, parent, ends[1]);
    }
    const int why = errno;
    sigprocmask(SIG_SETMASK, &before, NULL);
    close(ends[1]);
    if (pid < 0) {
        close(ends[0]);
        return gb_error_set(err, GB_ERR_MACHINE, "no process for a worker: %s",
                            strerror(why));
    }
    *worker = (struct worker){pid, ends[0], ticket, clock_s()};
    crew->busy++;
    return true;
}

bool gb_crew_give(struct gb_crew *crew, size_t ticket, const struct gb_params *params,
                  const char *directory, struct gb_error *err)
{
    if (crew->busy < crew->count) {
        return give_here(crew, ticket, params, directory, err);
    }
    const bool given = gb_ranks_give(crew->ranks, ticket, params, directory, err);
    crew->away += given;
    return given;
}

static void tell_death(int status, struct gb_error *error)
{
    if (WIFSIGNALED(status)) {
        gb_error_set(error, GB_ERR_MACHINE, "the process of the run was ended by %s",
                     strsignal(WTERMSIG(status)));
    } else {
        gb_error_set(error, GB_ERR_MACHINE, "the process of the run left no report");
    }
}

static void collect(struct gb_crew *crew, struct worker *worker,
                    struct gb_crew_report *report)
{
    ssize_t got = 0;
    int status = 0;
    do {
        got = read(worker->fd, &report->error, sizeof report->error);
    } while (got < 0 && errno == EINTR);
    close(worker->fd);
    while (waitpid(worker->pid, &status, 0) < 0 && errno == EINTR) {
    }
    if (got != (ssize_t)sizeof report->error) {
        tell_death(status, &report->error);
    }
    report->ticket = worker->ticket;
    report->lost = false;
    report->seconds = clock_s() - worker->since;
    *worker = (struct worker){0};
    crew->busy--;
}

static bool take_here(struct gb_crew *crew, double seconds, struct gb_crew_report *report)
{
    for (size_t i = 0; i < crew->count; i++) {
        const struct worker *worker = &crew->worker[i];
        crew->poll[i] = (struct pollfd){worker->pid != 0 ? worker->fd : -1, POLLIN, 0};
    }
    if (poll(crew->poll, crew->count, (int)ceil(1e3 * seconds)) <= 0) {
        return false;
    }
    for (size_t i = 0; i < crew->count; i++) {
        if (crew->poll[i].revents != 0) {
            collect(crew, &crew->worker[i], report);
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
            return true;
        }
        if (take_here(crew, letters_every_s, report)) {
            return true;
        }
    } while (clock_s() < until);
    return false;
}

void gb_crew_stop(struct gb_crew *crew)
{
    gb_ranks_stop(crew->away > 0 ? crew->ranks : NULL);
    for (size_t i = 0; i < crew->count; i++) {
        if (crew->worker[i].pid != 0) {
            kill(crew->worker[i].pid, SIGTERM);
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
    gb_alloc_free(crew->worker);
    gb_alloc_free(crew->poll);
    gb_alloc_free(crew);
}
