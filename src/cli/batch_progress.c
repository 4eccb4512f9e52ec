#include "cli/batch_progress.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/text/visible.h"
#include "cli/options.h"
#include "cli/signals.h"
#include "io/rundir.h"
#include "many/single_run.h"
#include "run/cost.h"

static const double terminal_interval_s = 0.25;
static const double plain_interval_s = 10.0;

enum { JOBS_MAX = 4096 };

static const char tables_lock[] = ".lock";

static const double lock_interval_s = 0.05;
static const double lock_told_s = 60.0;
/* Runs of other processes that a line names. */
enum { NAMED_MOST = 4 };

bool gb_batch_progress_init(struct gb_batch_progress *batch, int jobs, bool quiet,
                            struct gb_error *err)
{
    if (jobs < 0 || jobs > JOBS_MAX) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--jobs %d: must be between 1 and %d, or 0 for all", jobs,
                            JOBS_MAX);
    }
    batch->launch = gb_launch_read();
    batch->output = quiet                     ? GB_BATCH_PROGRESS_QUIET
                    : batch->launch.rank == 0 ? GB_BATCH_PROGRESS_ALL
                                              : GB_BATCH_PROGRESS_OTHER;
    return true;
}

/* Runs at once of this process: `jobs`, or for 0 one per processor of it. */
static size_t workers_of(const struct gb_batch_progress *batch, int jobs)
{
    return (size_t)(jobs > 0 ? jobs : gb_launch_cores(&batch->launch));
}

size_t gb_batch_progress_all_workers(const struct gb_batch_progress *batch, int jobs)
{
    return workers_of(batch, jobs) * (size_t)batch->launch.count;
}

static bool is_terminal(void)
{
    return isatty(STDERR_FILENO) == 1;
}

static void clear_line(struct gb_batch_progress *batch)
{
    if (batch->columns > 0) {
        gb_visible_rewrite(stderr, batch->columns, "");
        batch->columns = 0;
    }
}

static void format_remaining(const struct gb_batch_progress *batch, char *text,
                             size_t size)
{
    const double done = batch->cost_ended - batch->cost_before;
    if (!(done > 0.0)) {
        g_strlcpy(text, "time left unknown", size);
        return;
    }
    char duration[48];
    const double each_s = (gb_clock_s() - batch->started_s) / done;
    gb_cost_duration(each_s * (batch->cost_total - batch->cost_ended), duration,
                     sizeof duration);
    g_snprintf(text, (gulong)size, "%s left", duration);
}

static void print_line(struct gb_batch_progress *batch)
{
    char line[160], remaining[64];
    batch->printed_s = gb_clock_s();
    format_remaining(batch, remaining, sizeof remaining);
    const int length = snprintf(line, sizeof line, "%zu of %zu runs, %zu failed, %s",
                                batch->ended, batch->total, batch->failed, remaining);
    if (!is_terminal()) {
        gb_visible_line(stderr, "%s", line);
        return;
    }
    gb_visible_rewrite(stderr, batch->columns, line);
    batch->columns = MAX(length, batch->columns);
}

static double cost_of(const struct gb_batch_progress *batch,
                      const struct gb_ensemble *ensemble,
                      const struct gb_ensemble_run *run)
{
    return batch->cost != NULL ? batch->cost[run - ensemble->run] : 1.0;
}

static void on_progress(const struct gb_ensemble *ensemble,
                        const struct gb_ensemble_run *run, void *data)
{
    struct gb_batch_progress *batch = data;
    if (run != NULL) {
        batch->ended++;
        batch->cost_ended += cost_of(batch, ensemble, run);
        batch->failed += run->error.code != GB_OK;
    }
    if (batch->output == GB_BATCH_PROGRESS_QUIET) {
        return;
    }
    if (run != NULL && !run->before && run->error.code != GB_OK &&
        run->error.code != GB_ERR_CANCELLED) {
        clear_line(batch);
        gb_visible_line(stderr, "%s: %s", run->directory, run->error.text);
    }
    if (batch->output != GB_BATCH_PROGRESS_OTHER &&
        gb_clock_s() - batch->printed_s >=
            (is_terminal() ? terminal_interval_s : plain_interval_s)) {
        print_line(batch);
    }
}

static void on_wait(const struct gb_ensemble_run *run, void *data)
{
    struct gb_batch_progress *batch = data;
    if (batch->output != GB_BATCH_PROGRESS_QUIET) {
        char *holder = gb_rundir_holder(run->directory);
        clear_line(batch);
        gb_visible_line(stderr, "waiting for %s: %s works there", run->directory, holder);
        g_free(holder);
    }
}

static void begin(struct gb_batch_progress *batch, const struct gb_ensemble *ensemble)
{
    batch->total = ensemble->points * ensemble->replicas;
    batch->ended = 0;
    batch->failed = 0;
    batch->cost_total = 0.0;
    batch->cost_ended = 0.0;
    for (size_t i = 0; i < batch->total; i++) {
        const double cost = cost_of(batch, ensemble, &ensemble->run[i]);
        batch->ended += ensemble->run[i].ended;
        batch->cost_total += cost;
        batch->cost_ended += ensemble->run[i].ended ? cost : 0.0;
    }
    batch->before = batch->ended;
    batch->cost_before = batch->cost_ended;
    batch->started_s = gb_clock_s();
    batch->printed_s = batch->started_s;
}

bool gb_batch_progress_work(struct gb_batch_progress *batch, struct gb_ensemble *ensemble,
                            int jobs, struct gb_error *err)
{
    struct gb_pool *pool = NULL;
    const struct gb_ensemble_callbacks callbacks = {.cancelled = gb_signals_cancelled,
                                                    .progress = on_progress,
                                                    .on_wait = on_wait,
                                                    .data = batch};
    const size_t workers = workers_of(batch, jobs);
    gb_signals_install(GB_SIGNALS_HANGUP_ENDS);
    begin(batch, ensemble);
    if (batch->output == GB_BATCH_PROGRESS_ALL) {
        gb_visible_line(stderr, "%zu runs, %zu of them done before; %zu at once",
                        batch->total, batch->before, workers);
    }
    const bool good = gb_pool_create(&pool, workers, gb_single_run_missing, err) &&
                      gb_ensemble_work(ensemble, pool, &callbacks, err);
    gb_pool_destroy(pool);
    clear_line(batch);
    if (batch->output == GB_BATCH_PROGRESS_ALL) {
        gb_visible_line(stderr, "%zu of %zu runs, %zu failed, after %.1f s", batch->ended,
                        batch->total, batch->failed, gb_clock_s() - batch->started_s);
    }
    return good;
}

bool gb_batch_progress_lock(struct gb_lock *lock, const char *directory, bool quiet,
                            struct gb_error *err)
{
    const double begun = gb_clock_s();
    bool told = quiet;
    while (!gb_lock_take(lock, directory, tables_lock)) {
        if (errno != EWOULDBLOCK) {
            return gb_error_set(err, GB_ERR_MACHINE, "%.300s: cannot be locked: %s",
                                directory, g_strerror(errno));
        }
        if (gb_signals_cancelled(NULL)) {
            return gb_error_set(err, GB_ERR_CANCELLED, "stopped on request");
        }
        if (!told && gb_clock_s() - begun > lock_told_s) {
            char *holder = gb_lock_holder(directory, tables_lock);
            gb_visible_line(stderr, "waiting for %s: %s writes its tables", directory,
                            holder);
            g_free(holder);
            told = true;
        }
        g_usleep((gulong)(1e6 * lock_interval_s));
    }
    return true;
}

char *gb_batch_progress_elsewhere(const struct gb_ensemble *ensemble)
{
    GString *text = g_string_new(NULL);
    size_t named = 0, more = 0;
    for (size_t i = 0; i < ensemble->points * ensemble->replicas; i++) {
        const struct gb_ensemble_run *run = &ensemble->run[i];
        if (!run->elsewhere) {
            continue;
        }
        if (named == NAMED_MOST) {
            more++;
            continue;
        }
        char *name = g_path_get_basename(run->directory);
        char *holder = gb_rundir_holder(run->directory);
        g_string_append_printf(text, "%s%s (%s)", named++ > 0 ? ", " : "", name, holder);
        g_free(name);
        g_free(holder);
    }
    if (more > 0) {
        g_string_append_printf(text, " and %zu more", more);
    }
    return g_string_free(text, FALSE);
}

int gb_batch_progress_exit(const struct gb_error *err)
{
    (void)gb_options_fail(err);
    return gb_signals_exit_status(err);
}
