/* A pool of worker processes.  Each worker receives one run after the other over a
 * socket.  It answers with a message of one byte when only the files of the run are
 * left to be written, and with a report when the run has ended. */

#include "many/pool.h"

#include <errno.h>
#include <glib.h>
#include <limits.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/alloc.h"
#include "base/clock.h"
#include "base/file.h"
#include "greenbody/params.h"

enum { COUNT_MOST = 10000000, TEXT_BYTES = 16384 };

/* Environment variables of one launcher. */
struct variables {
    const char *rank, *count, *local_count;
    bool all; /* all must be set, including the last one */
};

/* The first launcher whose variables are set is used: mpirun inside a Slurm job also
 * sees the variables of the job, and srun sets some variables of PMI.
 * SLURM_STEP_TASKS_PER_NODE is like "4(x2),3"; its first number is right for steps that
 * are spread evenly. */
static const struct variables launchers[] = {
    {"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_LOCAL_SIZE", false},
    {"PMI_RANK", "PMI_SIZE", "MPI_LOCALNRANKS", true},
    {"SLURM_PROCID", "SLURM_STEP_NUM_TASKS", "SLURM_STEP_TASKS_PER_NODE", false},
    {"PMI_RANK", "PMI_SIZE", "PMI_LOCAL_SIZE", false},
};

/* A number from the environment; `otherwise` if it is missing or invalid. */
static long read_number(const char *name, long otherwise)
{
    const char *text = getenv(name);
    char *end = NULL;
    const long value = text != NULL ? strtol(text, &end, 10) : 0;
    return text != NULL && end != text && value >= 0 && value <= COUNT_MOST ? value
                                                                            : otherwise;
}

/* Adds the tasks of an array, which are separate jobs with their own processors. */
static void add_array(struct gb_launch *launch)
{
    const long tasks = read_number("SLURM_ARRAY_TASK_COUNT", 0);
    const long task = read_number("SLURM_ARRAY_TASK_ID", -1);
    const long first = read_number("SLURM_ARRAY_TASK_MIN", 0);
    const long step = read_number("SLURM_ARRAY_TASK_STEP", 1);
    if (tasks > 0 && task >= first) {
        launch->rank += (task - first) / MAX(step, 1) * launch->count;
        launch->count *= tasks;
        launch->launched = true;
    }
}

struct gb_launch gb_pool_launch(void)
{
    struct gb_launch launch = {.count = 1, .local_count = 1};
    for (size_t i = 0; i < G_N_ELEMENTS(launchers) && !launch.launched; i++) {
        const struct variables *by = &launchers[i];
        const long rank = read_number(by->rank, -1), count = read_number(by->count, 0);
        const long local = read_number(by->local_count, 0);
        if (rank < 0 || rank >= count || (by->all && local < 1)) {
            continue;
        }
        launch = (struct gb_launch){.rank = rank, .count = count, .launched = true};
        launch.local_count = CLAMP(local, 1, count);
    }
    add_array(&launch);
    return launch;
}

/* Reads the beginning of a kernel file, whose size is unknown before reading. */
static bool read_text(const char *path, char text[TEXT_BYTES])
{
    const int file = gb_file_open(path, NULL);
    const ssize_t length = file >= 0 ? read(file, text, TEXT_BYTES - 1) : -1;
    if (file >= 0) {
        close(file);
    }
    text[length > 0 ? length : 0] = '\0';
    return length > 0;
}

/* Processors from cpu.max of one cgroup, "400000 100000" or "max 100000", rounded up. */
static long read_quota(const char *folder)
{
    char *path = g_build_filename(folder, "cpu.max", NULL);
    char text[TEXT_BYTES];
    double used = 0.0, period = 0.0;
    long cores = 0;
    if (read_text(path, text) && sscanf(text, "%lf %lf", &used, &period) == 2 &&
        used > 0.0 && period > 0.0) {
        cores = (long)fmin(fmax(ceil(used / period), 1.0), COUNT_MOST);
    }
    g_free(path);
    return cores;
}

long gb_pool_quota(const char *root, const char *group)
{
    char *at = g_strdup(group);
    long least = 0;
    while (true) {
        char *folder = g_build_filename(root, at, NULL);
        const long cores = read_quota(folder);
        least = cores > 0 && (least == 0 || cores < least) ? cores : least;
        g_free(folder);
        char *end = strrchr(at, '/');
        if (end == NULL) {
            break;
        }
        *end = '\0';
    }
    g_free(at);
    return least;
}

static long own_quota(void)
{
    char text[TEXT_BYTES];
    long cores = 0;
    if (read_text("/proc/self/cgroup", text)) {
        char **lines = g_strsplit(text, "\n", -1);
        for (int i = 0; lines[i] != NULL; i++) {
            if (g_str_has_prefix(lines[i], "0::/")) {
                cores = gb_pool_quota("/sys/fs/cgroup", lines[i] + strlen("0::"));
            }
        }
        g_strfreev(lines);
    }
    return cores;
}

long gb_pool_cores(const struct gb_launch *launch)
{
    const long own = (long)g_get_num_processors(); /* from the affinity mask */
    long together = MAX(sysconf(_SC_NPROCESSORS_ONLN), own);
    const long allocated = read_number("SLURM_CPUS_ON_NODE", 0), quota = own_quota();
    together = allocated > 0 ? MIN(together, allocated) : together;
    together = quota > 0 ? MIN(together, quota) : together;
    return CLAMP(together / launch->local_count, 1, own);
}

/* --- in the process of a worker ----------------------------------------------------- */

/* Message to a worker: parameters, and the name of the directory without padding. */
struct run_message {
    struct gb_params params;
    char directory[PATH_MAX];
};

/* SIGTERM stays blocked and is polled between slices. */
static bool is_cancelled(void *data)
{
    sigset_t pending;
    (void)data;
    return sigpending(&pending) == 0 && sigismember(&pending, SIGTERM) == 1;
}

/* Waits for the next run.  False if the pool has closed the socket. */
static bool receive_run(int fd, struct run_message *message)
{
    ssize_t got = 0;
    do {
        got = recv(fd, message, sizeof *message, 0);
    } while (got < 0 && errno == EINTR);
    return got > (ssize_t)sizeof message->params;
}

/* Sends the message of one byte; a report is longer. */
static void send_loaded(void *data)
{
    const int *fd = data;
    (void)!send(*fd, "", 1, MSG_NOSIGNAL);
}

/* Loop of a worker; never returns.  The terminal sends SIGINT to all processes: workers
 * ignore it, and the parent handles it and sends SIGTERM. */
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

/* --- a worker, in the process of the pool ------------------------------------------- */

/* A process of the pool.  All zero except fd = -1: not started. */
struct worker {
    pid_t pid; /* 0: none yet */
    int fd;    /* socket: runs to the worker, reports from it; -1: none */
    bool busy, stopped;
    bool writing; /* busy, but its run is loaded and only files are being written */
    size_t ticket;
    double since; /* clock when it was submitted, s */
};

static pid_t fork_worker(const struct worker *worker, size_t count, gb_pool_work *work,
                         const int ends[2])
{
    sigset_t term, before;
    const pid_t parent = getpid();
    sigemptyset(&term);
    sigaddset(&term, SIGTERM);
    sigprocmask(SIG_BLOCK, &term, &before); /* before the fork, so that none is lost */
    const pid_t pid = fork();
    if (pid == 0) {
        close(ends[0]);
        /* workers must not inherit sockets of others, which would hide that the pool
         * has closed them */
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

static bool begin(struct worker *worker, size_t count, size_t index, gb_pool_work *work,
                  struct gb_error *err)
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
    worker[index] = (struct worker){.pid = pid, .fd = ends[0]};
    return true;
}

/* Sends a run as one message; false if the process has ended. */
static bool send_run(const struct worker *worker, const struct gb_params *params,
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

static int wait_for_exit(const struct worker *worker)
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

/* Ends an idle worker's process, if it has one. */
static void worker_end(struct worker *worker)
{
    if (worker->pid != 0) {
        close(worker->fd);
        (void)wait_for_exit(worker);
    }
    *worker = (struct worker){.fd = -1};
}

/* Sends a run to worker[index], which must be idle, and starts its process if
 * necessary. worker[count] are all workers of the pool, because a new process closes
 * the sockets of the others.  Errors: GB_ERR_MACHINE (no process, no socket),
 * GB_ERR_INPUT (the name of the directory is too long). */
static bool worker_submit(struct worker *worker, size_t count, size_t index,
                          gb_pool_work *work, size_t ticket,
                          const struct gb_params *params, const char *directory,
                          struct gb_error *err)
{
    struct worker *own = &worker[index];
    if (strlen(directory) >= PATH_MAX) {
        return gb_error_set(err, GB_ERR_INPUT, "%.300s: the name is too long", directory);
    }
    bool sent = own->pid != 0 && send_run(own, params, directory);
    if (!sent) { /* no process yet, or it died while idle */
        worker_end(own);
        if (!begin(worker, count, index, work, err)) {
            return false;
        }
        sent = send_run(own, params, directory);
    }
    if (!sent) {
        gb_error_set(err, GB_ERR_MACHINE, "no run can be sent to a worker: %s",
                     strerror(errno));
        worker_end(own);
        return false;
    }
    own->busy = true;
    own->ticket = ticket;
    own->since = gb_clock_s();
    return true;
}

/* Receives a message from a busy worker with a readable fd.  True: a report, or its
 * process ended.  False: its run is loaded. */
static bool worker_receive(struct worker *worker, struct gb_pool_report *report)
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
        *worker = (struct worker){.fd = -1};
    } else if (worker->stopped) {
        worker_end(worker);
    }
    return true;
}

/* Asks a busy worker to stop its run.  It still reports, then its process ends. */
static void worker_stop(struct worker *worker)
{
    worker->stopped = true;
    kill(worker->pid, SIGTERM);
}

/* --- the pool ----------------------------------------------------------------------- */

struct gb_pool {
    gb_pool_work *work;
    struct worker *worker;
    struct pollfd *poll;  /* of workers with a run, ... */
    size_t *polled;       /* ... and their indices */
    size_t count;         /* runs loaded at the same time */
    size_t slots;         /* workers: twice `count`, since half may be writing files */
    size_t busy, writing; /* workers with a run; those that only write files */
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
    const bool given = worker_submit(pool->worker, pool->slots, idle, pool->work, ticket,
                                     params, directory, err);
    pool->busy += given;
    return given;
}

/* Reads a message of worker i; true for a report. */
static bool read_worker(struct gb_pool *pool, size_t i, struct gb_pool_report *report)
{
    const bool wrote = pool->worker[i].writing;
    const bool ended = worker_receive(&pool->worker[i], report);
    pool->busy -= ended;
    pool->writing -= ended && wrote;
    pool->writing += !ended && !wrote;
    return ended;
}

bool gb_pool_receive(struct gb_pool *pool, double seconds, struct gb_pool_report *report)
{
    size_t count = 0; /* only open sockets: poll limits the number */
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
            worker_stop(&pool->worker[i]);
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
        worker_end(&pool->worker[i]);
    }
    gb_alloc_free(pool->worker);
    gb_alloc_free(pool->poll);
    gb_alloc_free(pool->polled);
    gb_alloc_free(pool);
}
