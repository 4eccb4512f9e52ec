/* Many runs, done by a pool of workers.  Several processes may work on the same list.
 * A run belongs to the process that holds the lock of its directory; what other
 * processes have finished is read from the directories.  The queue submits runs in the
 * order of the list.  A run of another process is put back into the queue when that
 * process gives it up. */
#include "many/ensemble.h"

#include <errno.h>
#include <string.h>

#include <glib.h>
#include <glib/gstdio.h>

#include "base/alloc.h"
#include "base/clock.h"
#include "io/rundir.h"
#include "many/single_run.h"
#include "run/cost.h"
#include "scene/seed.h"

/* Longest time between two calls of callbacks->cancelled. */
static const double poll_s = 0.2;
/* Waiting for a run this long is reported to the caller. */
static const double patience_s = 60.0;

bool gb_ensemble_init(struct gb_ensemble *ensemble, size_t points, size_t replicas,
                      struct gb_error *err)
{
    *ensemble = (struct gb_ensemble){.points = points, .replicas = replicas};
    if (points == 0 || replicas == 0 || points > GB_ENSEMBLE_MOST / replicas) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%zu points with %zu replicas: must be between 1 and %d runs",
                            points, replicas, GB_ENSEMBLE_MOST);
    }
    ensemble->run = gb_alloc_array(points * replicas, sizeof *ensemble->run, err);
    for (size_t i = 0; ensemble->run != NULL && i < points * replicas; i++) {
        ensemble->run[i].point = i % points;
        ensemble->run[i].replica = i / points;
    }
    return ensemble->run != NULL;
}

void gb_ensemble_finish(struct gb_ensemble *ensemble)
{
    const size_t runs = ensemble->run ? ensemble->points * ensemble->replicas : 0;
    for (size_t i = 0; i < runs; i++) {
        g_free(ensemble->run[i].directory);
    }
    gb_alloc_free(ensemble->run);
    *ensemble = (struct gb_ensemble){0};
}

struct gb_ensemble_run *gb_ensemble_at(const struct gb_ensemble *ensemble, size_t point,
                                       size_t replica)
{
    return &ensemble->run[replica * ensemble->points + point];
}

/* Is there an active run in the directory, or may its files be replaced? */
static bool is_usable(const char *directory, struct gb_error *err)
{
    struct gb_error why = {0};
    for (int i = 0; i < 3; i++) { /* a run may start or end between the checks */
        if (gb_rundir_busy(directory) ||
            gb_rundir_check(directory, GB_RUNDIR_REPLACE, &why)) {
            return true;
        }
    }
    return gb_error_set(err, why.code, "%s", why.text);
}

static bool other_error(const struct gb_ensemble_run *run, struct gb_error *err)
{
    return gb_error_set(err, GB_ERR_INPUT,
                        "%.300s: holds a run of other parameters; choose another "
                        "directory",
                        run->directory);
}

/* Time at which the status of a run was written; 0: no status. */
static int64_t status_time(const struct gb_ensemble_run *run)
{
    char *path = g_build_filename(run->directory, "status.json", NULL);
    GStatBuf info = {0};
    const bool there = g_stat(path, &info) == 0;
    g_free(path);
    return there ? (int64_t)info.st_mtim.tv_sec * 1000000000 + info.st_mtim.tv_nsec : 0;
}

bool gb_ensemble_find_done(struct gb_ensemble *ensemble, struct gb_error *err)
{
    for (size_t i = 0; i < ensemble->points; i++) {
        if (!gb_seed_check_cells(&ensemble->run[i].params, ensemble->replicas, err)) {
            return false;
        }
    }
    for (size_t i = 0; i < ensemble->points * ensemble->replicas; i++) {
        struct gb_ensemble_run *run = &ensemble->run[i];
        if (!g_file_test(run->directory, G_FILE_TEST_EXISTS)) {
            continue;
        }
        run->status_ns = status_time(run);
        const bool busy = gb_rundir_busy(run->directory);
        const enum gb_single_run_found found =
            gb_single_run_find(&run->params, run->directory);
        run->before = run->ended = found == GB_SINGLE_RUN_DONE && !busy;
        if (found == GB_SINGLE_RUN_OTHER) {
            return other_error(run, err);
        }
        if (!run->ended && !is_usable(run->directory, err)) {
            return false;
        }
    }
    return true;
}

static bool has_converged(const struct gb_ensemble *ensemble, size_t point)
{
    return ensemble->converged != NULL &&
           ensemble->converged(ensemble, point, ensemble->data);
}

/* Runs to be submitted; `from` is the smallest index that may be left. */
struct queue {
    size_t from;
    double idle_since; /* clock when this process became idle; 0: it has active runs */
};

/* Must this process do the run?  Tests the lock before the files, so that a run that
 * ends between the two tests counts as done. */
static bool is_left(struct gb_ensemble_run *run)
{
    run->elsewhere = gb_rundir_busy(run->directory);
    if (run->elsewhere) {
        return false;
    }
    switch (gb_single_run_find(&run->params, run->directory)) {
    case GB_SINGLE_RUN_DONE:
        run->error = (struct gb_error){0};
        run->before = run->ended = true;
        return false;
    case GB_SINGLE_RUN_OTHER:
        (void)other_error(run, &run->error);
        run->ended = true;
        return false;
    case GB_SINGLE_RUN_NOT_DONE:
        break;
    }
    /* another process failed at it, so it would fail here: left to the next command */
    run->before = run->ended = status_time(run) != run->status_ns &&
                               gb_single_run_failed(run->directory, &run->error);
    return !run->ended;
}

static bool is_of_part(const struct gb_ensemble *ensemble, size_t index)
{
    return ensemble->parts == 0 || index % ensemble->parts == ensemble->part;
}

/* The next run in the order of the list; NULL: none at present. */
static struct gb_ensemble_run *next_run(struct gb_ensemble *ensemble, struct queue *queue)
{
    const size_t runs = ensemble->points * ensemble->replicas;
    for (; queue->from < runs; queue->from++) {
        struct gb_ensemble_run *run = &ensemble->run[queue->from];
        if (!run->ended && !run->submitted && !run->elsewhere &&
            is_of_part(ensemble, queue->from) && !has_converged(ensemble, run->point)) {
            return run;
        }
    }
    return NULL;
}

/* Number of runs that can be submitted now.  Without a prefetch if the active runs may
 * be enough for convergence. */
static size_t room(const struct gb_ensemble *ensemble, const struct gb_pool *pool)
{
    const size_t idle = gb_pool_idle(pool);
    return idle > 0 || ensemble->converged != NULL ? idle : gb_pool_prefetch(pool);
}

static void tell(const struct gb_ensemble *ensemble,
                 const struct gb_ensemble_callbacks *callbacks,
                 const struct gb_ensemble_run *run)
{
    if (callbacks->progress != NULL) {
        callbacks->progress(ensemble, run, callbacks->data);
    }
}

/* Submits runs to idle workers.  False if no worker can be started. */
static bool submit(struct gb_ensemble *ensemble, struct gb_pool *pool,
                   struct queue *queue, const struct gb_ensemble_callbacks *callbacks,
                   struct gb_error *err)
{
    struct gb_ensemble_run *run = NULL;
    while (room(ensemble, pool) > 0 && (run = next_run(ensemble, queue)) != NULL) {
        const size_t ticket = (size_t)(run - ensemble->run);
        if (!is_left(run)) {
            tell(ensemble, callbacks, run->ended ? run : NULL);
            continue;
        }
        if (!gb_pool_submit(pool, ticket, &run->params, run->directory, err)) {
            return gb_pool_busy(pool) > 0; /* continue with fewer workers */
        }
        run->submitted = true;
    }
    return true;
}

/* Puts a run back into the queue. */
static void put_back(const struct gb_ensemble *ensemble, struct queue *queue,
                     struct gb_ensemble_run *run)
{
    run->submitted = run->elsewhere = false;
    queue->from = MIN(queue->from, (size_t)(run - ensemble->run));
}

/* Puts back the runs that other processes no longer compute. */
static void follow(struct gb_ensemble *ensemble, struct queue *queue)
{
    for (size_t i = 0; i < ensemble->points * ensemble->replicas; i++) {
        struct gb_ensemble_run *run = &ensemble->run[i];
        if (run->elsewhere && !gb_rundir_busy(run->directory)) {
            put_back(ensemble, queue, run);
        }
    }
}

/* Must this process wait for a run of another process?  Reports runs that take too
 * long. */
static bool waits(struct gb_ensemble *ensemble, struct queue *queue,
                  const struct gb_pool *pool,
                  const struct gb_ensemble_callbacks *callbacks)
{
    const double limit_s =
        callbacks->patience_s > 0.0 ? callbacks->patience_s : patience_s;
    const double now = gb_clock_s();
    bool any = false;
    if (gb_pool_busy(pool) > 0 || queue->idle_since == 0.0) {
        queue->idle_since = now;
    }
    for (size_t i = 0; i < ensemble->points * ensemble->replicas; i++) {
        struct gb_ensemble_run *run = &ensemble->run[i];
        if (!run->elsewhere || has_converged(ensemble, run->point)) {
            continue;
        }
        any = true;
        if (!run->named && now - queue->idle_since > limit_s &&
            callbacks->on_wait != NULL) {
            run->named = true;
            callbacks->on_wait(run, callbacks->data);
        }
    }
    return any && !ensemble->leaves;
}

static void receive(struct gb_ensemble *ensemble, struct gb_pool *pool,
                    struct queue *queue, const struct gb_ensemble_callbacks *callbacks)
{
    struct gb_pool_report report;
    if (!gb_pool_receive(pool, poll_s, &report)) {
        tell(ensemble, callbacks, NULL);
        return;
    }
    struct gb_ensemble_run *run = &ensemble->run[report.ticket];
    if (gb_single_run_is_taken(&report.error)) {
        put_back(ensemble, queue, run);
        tell(ensemble, callbacks, NULL);
        return;
    }
    run->ended = true;
    run->error = report.error;
    run->seconds = report.seconds;
    tell(ensemble, callbacks, run);
}

bool gb_ensemble_work(struct gb_ensemble *ensemble, struct gb_pool *pool,
                      const struct gb_ensemble_callbacks *callbacks, struct gb_error *err)
{
    struct queue queue = {0};
    bool stopping = false;
    bool good = true;
    while (true) {
        if (!stopping && callbacks->cancelled != NULL &&
            callbacks->cancelled(callbacks->data)) {
            stopping = true;
            gb_pool_stop(pool);
        }
        if (good && !stopping) {
            follow(ensemble, &queue);
            good = submit(ensemble, pool, &queue, callbacks, err);
        }
        const bool waiting =
            good && !stopping && waits(ensemble, &queue, pool, callbacks);
        if (gb_pool_busy(pool) == 0 && !waiting) {
            break;
        }
        receive(ensemble, pool, &queue, callbacks);
    }
    return good && (!stopping || gb_error_set(err, GB_ERR_CANCELLED,
                                              "stopped; the same command does the "
                                              "missing runs"));
}

size_t gb_ensemble_refresh(struct gb_ensemble *ensemble)
{
    size_t elsewhere = 0;
    for (size_t i = 0; i < ensemble->points * ensemble->replicas; i++) {
        struct gb_ensemble_run *run = &ensemble->run[i];
        if (run->ended && run->error.code == GB_OK) {
            run->elsewhere = false;
            continue;
        }
        const struct gb_ensemble_run own = *run;
        const bool left = is_left(run);
        elsewhere += run->elsewhere;
        if (run->elsewhere) {
            continue;
        }
        if (own.ended && (left || run->error.code != GB_OK)) {
            *run = own; /* it failed here and no other process has done it since then */
        } else if (left) {
            run->before = run->ended = gb_single_run_failed(run->directory, &run->error);
        }
    }
    return elsewhere;
}

bool gb_ensemble_make_directory(const char *path, struct gb_error *err)
{
    char *preset = g_build_filename(path, "preset.ini", NULL);
    const bool single = g_file_test(preset, G_FILE_TEST_EXISTS);
    g_free(preset);
    if (single) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%.300s: holds a single run; many runs need a directory of "
                            "their own",
                            path);
    }
    if (g_mkdir_with_parents(path, 0777) != 0) {
        const int why = errno;
        return gb_error_set(
            err, why == EEXIST || why == ENOTDIR ? GB_ERR_INPUT : GB_ERR_MACHINE,
            "%.300s: cannot be made: %s", path, g_strerror(why));
    }
    return true;
}

double gb_ensemble_remaining_s(const struct gb_ensemble *ensemble, size_t *runs)
{
    double seconds = 0.0;
    *runs = 0;
    for (size_t i = 0; i < ensemble->points * ensemble->replicas; i++) {
        const struct gb_ensemble_run *run = &ensemble->run[i];
        if (!run->ended) {
            seconds += gb_cost_assumed_s(&run->params);
            (*runs)++;
        }
    }
    return seconds;
}

bool gb_ensemble_check(const struct gb_ensemble *ensemble, const char *path,
                       struct gb_error *err)
{
    const struct gb_ensemble_run *first = NULL;
    enum gb_status code = GB_ERR_GUARD;
    size_t failed = 0;
    for (size_t i = 0; i < ensemble->points * ensemble->replicas; i++) {
        const struct gb_ensemble_run *run = &ensemble->run[i];
        if (run->ended && run->error.code != GB_OK) {
            first = first ? first : run;
            /* a full disk is not an error of the scene */
            code = run->error.code == GB_ERR_MACHINE ? GB_ERR_MACHINE : code;
            failed++;
        }
    }
    return failed == 0 ||
           gb_error_set(err, code, "%zu runs failed, listed in %.200s; the first: %.200s",
                        failed, path, first->error.text);
}

size_t gb_ensemble_used(const struct gb_ensemble *ensemble, size_t point)
{
    struct gb_ensemble shorter = *ensemble;
    for (shorter.replicas = 1; shorter.replicas < ensemble->replicas;
         shorter.replicas++) {
        if (has_converged(&shorter, point)) {
            break;
        }
    }
    return shorter.replicas;
}
