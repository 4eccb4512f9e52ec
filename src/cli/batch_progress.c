#include "cli/batch_progress.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/text/visible.h"
#include "cli/options.h"
#include "cli/signals.h"
#include "many/single_run.h"
#include "run/cost.h"

static const double terminal_interval_s = 0.25;
static const double plain_interval_s = 10.0;

enum { JOBS_MAX = 4096 };

static bool serve(struct gb_mpi_pool *mpi, int jobs, struct gb_error *err)
{
    const size_t workers = jobs > 0 ? (size_t)jobs : 1;
    struct gb_pool *local = NULL;
    gb_signals_install(GB_SIGNALS_HANGUP_ENDS);
    const bool good =
        gb_pool_create(&local, workers, gb_single_run_missing, NULL, err) &&
        gb_mpi_pool_serve(mpi, local, workers, gb_signals_cancelled, NULL, err);
    gb_pool_destroy(local);
    return good;
}

enum gb_batch_progress_rank gb_batch_progress_join(struct gb_batch_progress *batch,
                                                   int jobs, int *status)
{
    struct gb_error err = {0};
    if (!gb_mpi_pool_create(&batch->mpi, &err)) {
        *status = gb_options_fail(&err);
        return GB_BATCH_PROGRESS_OTHER;
    }
    batch->launched = batch->mpi != NULL;
    if (gb_mpi_pool_is_first(batch->mpi)) {
        return GB_BATCH_PROGRESS_FIRST;
    }
    /* errors of --jobs and signals are printed once, by the first rank */
    *status =
        serve(batch->mpi, MIN(jobs, JOBS_MAX), &err) ? 0 : gb_status_exit_code(err.code);
    /* every rank that is left does what the command says: runs are shared by directory */
    const bool goes_on = gb_mpi_pool_first_is_lost(batch->mpi);
    gb_mpi_pool_destroy(batch->mpi);
    batch->mpi = NULL;
    return goes_on ? GB_BATCH_PROGRESS_FIRST : GB_BATCH_PROGRESS_OTHER;
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
    if (run != NULL && run->error.code != GB_OK && run->error.code != GB_ERR_CANCELLED) {
        clear_line(batch);
        gb_visible_line(stderr, "%s: %s", run->directory, run->error.text);
    }
    if (gb_clock_s() - batch->printed_s >=
        (is_terminal() ? terminal_interval_s : plain_interval_s)) {
        print_line(batch);
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
    const struct gb_ensemble_callbacks callbacks = {gb_signals_cancelled, on_progress,
                                                    batch};
    if (jobs < 0 || jobs > JOBS_MAX) {
        return gb_error_set(err, GB_ERR_INPUT, "--jobs %d: must be between 1 and %d, or 0 for all",
                            jobs, JOBS_MAX);
    }
    const size_t workers = jobs > 0          ? (size_t)jobs
                           : batch->launched ? 1
                                             : g_get_num_processors();
    gb_signals_install(GB_SIGNALS_HANGUP_ENDS);
    begin(batch, ensemble);
    if (batch->output == GB_BATCH_PROGRESS_ALL) {
        gb_visible_line(stderr, "%zu runs, %zu of them done before; %zu at once",
                        batch->total, batch->before, workers);
    }
    const bool good = gb_pool_create(&pool, workers, gb_single_run_missing, batch->mpi, err) &&
                      gb_ensemble_work(ensemble, pool, &callbacks, err);
    gb_pool_destroy(pool);
    clear_line(batch);
    if (batch->output == GB_BATCH_PROGRESS_ALL) {
        gb_visible_line(stderr, "%zu of %zu runs, %zu failed, after %.1f s", batch->ended,
                        batch->total, batch->failed, gb_clock_s() - batch->started_s);
    }
    return good;
}

int gb_batch_progress_exit(const struct gb_error *err)
{
    (void)gb_options_fail(err);
    return gb_signals_exit_status(err);
}
