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

/* Message to a worker: parameters, and the name of the directory at its own length. */
struct run_message {
    struct gb_params params;
    char directory[PATH_MAX];
};

/* --- in the worker's process ----------------------------------------------------- */

/* SIGTERM stays blocked; it is polled between two slices. */
static bool is_cancelled(void *data)
{
    sigset_t pending;
    (void)data;
    return sigpending(&pending) == 0 && sigismember(&pending, SIGTERM) == 1;
}

/* Waits for the next run; false when the pool has closed the socket. */
static bool receive_run(int fd, struct run_message *message)
{
    ssize_t got = 0;
    do {
        got = recv(fd, message, sizeof *message, 0);
    } while (got < 0 && errno == EINTR);
    return got > (ssize_t)sizeof message->params;
}

/* A message of one byte: a report is longer. */
static void send_loaded(void *data)
{
    const int *fd = data;
    (void)!send(*fd, "", 1, MSG_NOSIGNAL);
}

/* The worker's loop; never returns.  The terminal sends SIGINT to all processes: workers
 * ignore it, the parent handles it and sends SIGTERM. */
static void serve(gb_pool_work *work, pid_t parent, int fd)
{
    struct run_message *message = gb_alloc_array(1, sizeof *message, NULL);
    const struct gb_pool_callbacks callbacks = {is_cancelled, send_loaded, &fd};
    signal(SIGINT, SIG_IGN);
    signal(SIGHUP, SIG_IGN);
    (void)prctl(PR_SET_PDEATHSIG, SIGTERM);
    while (message != NULL && getppid() == parent && receive_run(fd, message)) {
        struct gb_error error = {0};
        (void)work(&message->params, message->directory, &callbacks, &error);
        (void)!send(fd, &error, sizeof error, MSG_NOSIGNAL);
    }
    _exit(0);
}

/* --- in the pool's process ------------------------------------------------------- */

static pid_t fork_worker(const struct gb_worker *worker, size_t count, gb_pool_work *work,
                         const int ends[2])
{
    sigset_t term, before;
    const pid_t parent = getpid();
    sigemptyset(&term);
    sigaddset(&term, SIGTERM);
    sigprocmask(SIG_BLOCK, &term, &before); /* before the fork: none is lost */
    const pid_t pid = fork();
    if (pid == 0) {
        close(ends[0]);
        /* an inherited socket would hide the end of the pool from the other workers */
        for (size_t i = 0; i < count; i++) {
            if (worker[i].fd >= 0) {
                close(worker[i].fd);
            }
        }
        serve(work, parent, ends[1]);
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

/* Sends a run as one message; false when the process is gone. */
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

bool gb_worker_submit(struct gb_worker *worker, size_t count, size_t index,
                      gb_pool_work *work, size_t ticket, const struct gb_params *params,
                      const char *directory, struct gb_error *err)
{
    struct gb_worker *own = &worker[index];
    if (strlen(directory) >= PATH_MAX) {
        return gb_error_set(err, GB_ERR_INPUT, "%.300s: the name is too long", directory);
    }
    bool sent = own->pid != 0 && send_run(own, params, directory);
    if (!sent) { /* no process yet, or it died while it was idle */
        gb_worker_end(own);
        if (!begin(worker, count, index, work, err)) {
            return false;
        }
        sent = send_run(own, params, directory);
    }
    if (!sent) {
        gb_error_set(err, GB_ERR_MACHINE, "no run can be sent to a worker: %s",
                     strerror(errno));
        gb_worker_end(own);
        return false;
    }
    own->busy = true;
    own->ticket = ticket;
    own->since = gb_clock_s();
    return true;
}

static int wait_for_exit(const struct gb_worker *worker)
{
    int status = 0;
    while (waitpid(worker->pid, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
}

static void set_exit_error(int status, struct gb_error *error)
{
    if (WIFSIGNALED(status)) {
        gb_error_set(error, GB_ERR_MACHINE, "the process of the run was ended by %s",
                     strsignal(WTERMSIG(status)));
    } else {
        gb_error_set(error, GB_ERR_MACHINE, "the process of the run left no report");
    }
}

bool gb_worker_receive(struct gb_worker *worker, struct gb_pool_report *report)
{
    ssize_t got = 0;
    do {
        got = recv(worker->fd, &report->error, sizeof report->error, 0);
    } while (got < 0 && errno == EINTR);
    if (got == 1) {
        worker->writing = true;
        return false;
    }
    report->ticket = worker->ticket;
    report->seconds = gb_clock_s() - worker->since;
    worker->busy = false;
    worker->writing = false;
    if (got != (ssize_t)sizeof report->error) {
        close(worker->fd);
        set_exit_error(wait_for_exit(worker), &report->error);
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
        (void)wait_for_exit(worker);
    }
    *worker = (struct gb_worker){.fd = -1};
}
