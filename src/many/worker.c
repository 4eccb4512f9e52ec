#include "many/worker.h"

#include <errno.h>
#include <limits.h>
#include <signal.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/alloc.h"
#include "base/clock.h"

/* A run on its way: the parameters and, of any length up to that, the name. */
struct parcel {
    struct gb_params params;
    char directory[PATH_MAX];
};

/* --- the worker's process -------------------------------------------------------- */

/* SIGTERM stays blocked there and is looked for between slices. */
static bool is_asked_to_stop(void *data)
{
    sigset_t pending;
    (void)data;
    return sigpending(&pending) == 0 && sigismember(&pending, SIGTERM) == 1;
}

/* The next run; false when there is none any more, or nobody who would give one. */
static bool await(int fd, struct parcel *parcel)
{
    ssize_t got = 0;
    do {
        got = recv(fd, parcel, sizeof *parcel, 0);
    } while (got < 0 && errno == EINTR);
    return got > (ssize_t)sizeof parcel->params;
}

/* One byte: a report is longer. */
static void tell_pressed(void *data)
{
    const int *fd = data;
    (void)!send(*fd, "", 1, MSG_NOSIGNAL);
}

/* Never returns.  The terminal's SIGINT reaches all processes: the first one decides what
 * it means and sends SIGTERM. */
static void labour(gb_pool_work *work, pid_t parent, int fd)
{
    struct parcel *parcel = gb_alloc_array(1, sizeof *parcel, NULL);
    const struct gb_pool_callbacks boss = {is_asked_to_stop, tell_pressed, &fd};
    signal(SIGINT, SIG_IGN);
    signal(SIGHUP, SIG_IGN);
    (void)prctl(PR_SET_PDEATHSIG, SIGTERM);
    while (parcel != NULL && getppid() == parent && await(fd, parcel)) {
        struct gb_error error = {0};
        (void)work(&parcel->params, parcel->directory, &boss, &error);
        (void)!send(fd, &error, sizeof error, MSG_NOSIGNAL);
    }
    _exit(0);
}

/* --- the crew's ------------------------------------------------------------------ */

static pid_t fork_worker(const struct gb_worker *worker, size_t count, gb_pool_work *work,
                         const int ends[2])
{
    sigset_t term, before;
    const pid_t parent = getpid();
    sigemptyset(&term);
    sigaddset(&term, SIGTERM);
    sigprocmask(SIG_BLOCK, &term, &before); /* before it can be missed */
    const pid_t pid = fork();
    if (pid == 0) {
        close(ends[0]);
        for (size_t i = 0; i < count; i++) { /* else they would not see the crew's end */
            if (worker[i].fd >= 0) {
                close(worker[i].fd);
            }
        }
        labour(work, parent, ends[1]);
    }
    const int why = errno;
    sigprocmask(SIG_SETMASK, &before, NULL);
    errno = why;
    return pid;
}

static bool begin(struct gb_worker *worker, size_t count, size_t index,
                  gb_pool_work *work, struct gb_error *err)
{
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) {
        return gb_error_set(err, GB_ERR_MACHINE, "no socket to a worker: %s",
                            strerror(errno));
    }
    const pid_t pid = fork_worker(worker, count, work, ends);
    const int why = errno;
    close(ends[1]);
    if (pid < 0) {
        close(ends[0]);
        return gb_error_set(err, GB_ERR_MACHINE, "no process for a worker: %s",
                            strerror(why));
    }
    worker[index] = (struct gb_worker){.pid = pid, .fd = ends[0]};
    return true;
}

/* A run goes whole or not at all; false when the process is gone. */
static bool send_run(const struct gb_worker *worker, const struct gb_params *params,
                     const char *directory)
{
    struct iovec part[] = {{(void *)params, sizeof *params},
                           {(void *)directory, strlen(directory) + 1}};
    const struct msghdr message = {.msg_iov = part,
                                   .msg_iovlen = sizeof part / sizeof part[0]};
    ssize_t sent = 0;
    do {
        sent = sendmsg(worker->fd, &message, MSG_NOSIGNAL);
    } while (sent < 0 && errno == EINTR);
    return sent >= 0;
}

bool gb_worker_give(struct gb_worker *worker, size_t count, size_t index,
                    gb_pool_work *work, size_t ticket, const struct gb_params *params,
                    const char *directory, struct gb_error *err)
{
    struct gb_worker *own = &worker[index];
    if (strlen(directory) >= PATH_MAX) {
        return gb_error_set(err, GB_ERR_INPUT, "%.300s: the name is too long", directory);
    }
    bool given = own->pid != 0 && send_run(own, params, directory);
    if (!given) { /* none yet, or it died while it was idle */
        gb_worker_end(own);
        if (!begin(worker, count, index, work, err)) {
            return false;
        }
        given = send_run(own, params, directory);
    }
    if (!given) {
        gb_error_set(err, GB_ERR_MACHINE, "a worker takes no run: %s", strerror(errno));
        gb_worker_end(own);
        return false;
    }
    own->busy = true;
    own->ticket = ticket;
    own->since = gb_clock_s();
    return true;
}

static int await_end(const struct gb_worker *worker)
{
    int status = 0;
    while (waitpid(worker->pid, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
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

bool gb_worker_take(struct gb_worker *worker, struct gb_pool_report *report)
{
    ssize_t got = 0;
    do {
        got = recv(worker->fd, &report->error, sizeof report->error, 0);
    } while (got < 0 && errno == EINTR);
    if (got == 1) {
        worker->keeping = true;
        return false;
    }
    report->ticket = worker->ticket;
    report->lost = false;
    report->seconds = gb_clock_s() - worker->since;
    worker->busy = false;
    worker->keeping = false;
    if (got != (ssize_t)sizeof report->error) {
        close(worker->fd);
        tell_death(await_end(worker), &report->error);
        *worker = (struct gb_worker){.fd = -1};
    } else if (worker->stopped) {
        gb_worker_end(worker);
    }
    return true;
}

void gb_worker_stop(struct gb_worker *worker)
{
    worker->stopped = true;
    kill(worker->pid, SIGTERM);
}

void gb_worker_end(struct gb_worker *worker)
{
    if (worker->pid != 0) {
        close(worker->fd);
        (void)await_end(worker);
    }
    *worker = (struct gb_worker){.fd = -1};
}
