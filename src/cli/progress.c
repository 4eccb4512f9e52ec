#include "cli/progress.h"

#include <errno.h>
#include <glib.h>
#include <math.h>
#include <signal.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/visible.h"
#include "cli/options.h"
#include "greenbody/status.h"
#include "io/lock.h"
#include "io/rundir.h"
#include "io/status_json.h"
#include "many/ensemble.h"
#include "many/pool.h"
#include "many/single_run.h"
#include "run/cost.h"

/* Signals and progress of commands without a screen: the handlers, the progress of many
 * runs (gb_batch_progress) and of a single run (gb_progress). */

/* Set by the handlers, tested between slices. */
static volatile sig_atomic_t caught, hung;

static void on_signal(int number)
{
    caught = number;
}

static void on_hangup(int number)
{
    (void)number;
    hung = 1;
}

void gb_progress_catch_signals(enum gb_signals_hangup hangup)
{
    struct sigaction before;
    struct sigaction action = {.sa_handler = on_signal, .sa_flags = (int)SA_RESETHAND};
    const struct sigaction note = {.sa_handler = on_hangup, .sa_flags = SA_RESTART};
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    sigaction(SIGHUP, NULL, &before);
    if (before.sa_handler != SIG_IGN) {
        sigaction(SIGHUP, hangup == GB_SIGNALS_HANGUP_ENDS ? &action : &note, NULL);
    }
    signal(SIGPIPE, SIG_IGN);
}

int gb_progress_caught(void)
{
    return (int)caught;
}

bool gb_progress_cancelled(void *data)
{
    (void)data;
    return caught != 0;
}

bool gb_progress_take_hangup(void)
{
    const bool was = hung != 0;
    hung = 0;
    return was;
}

void gb_progress_stop_by_hangup(void)
{
    caught = SIGHUP;
}

int gb_progress_exit_status(const struct gb_error *err)
{
    return err->code == GB_ERR_CANCELLED && caught != 0 ? 128 + (int)caught
                                                        : gb_status_exit_code(err->code);
}

static const double terminal_interval_s = 0.25;
static const double plain_interval_s = 10.0;

enum { JOBS_MAX = 4096 };

static const char tables_lock[] = ".lock";

static const double lock_interval_s = 0.05;
static const double lock_told_s = 60.0;
/* Largest number of runs of other processes named in a line. */
enum { NAMED_MOST = 4 };

bool gb_progress_batch_init(struct gb_batch_progress *batch, int jobs, bool quiet,
                            struct gb_error *err)
{
    if (jobs < 0 || jobs > JOBS_MAX) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--jobs %d: must be between 1 and %d, or 0 for all", jobs,
                            JOBS_MAX);
    }
    batch->launch = gb_pool_launch();
    batch->output = quiet                     ? GB_BATCH_PROGRESS_QUIET
                    : batch->launch.rank == 0 ? GB_BATCH_PROGRESS_ALL
                                              : GB_BATCH_PROGRESS_OTHER;
    return true;
}

/* Number of workers of this process: `jobs`, or for 0 its number of processors. */
static size_t workers_of(const struct gb_batch_progress *batch, int jobs)
{
    return (size_t)(jobs > 0 ? jobs : gb_pool_cores(&batch->launch));
}

size_t gb_progress_all_workers(const struct gb_batch_progress *batch, int jobs)
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

bool gb_progress_batch_work(struct gb_batch_progress *batch, struct gb_ensemble *ensemble,
                            int jobs, struct gb_error *err)
{
    struct gb_pool *pool = NULL;
    const struct gb_ensemble_callbacks callbacks = {.cancelled = gb_progress_cancelled,
                                                    .progress = on_progress,
                                                    .on_wait = on_wait,
                                                    .data = batch};
    const size_t workers = workers_of(batch, jobs);
    gb_progress_catch_signals(GB_SIGNALS_HANGUP_ENDS);
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

bool gb_progress_batch_lock(struct gb_lock *lock, const char *directory, bool quiet,
                            struct gb_error *err)
{
    const double begun = gb_clock_s();
    bool told = quiet;
    while (!gb_lock_take(lock, directory, tables_lock)) {
        if (errno != EWOULDBLOCK) {
            return gb_error_set(err, GB_ERR_MACHINE, "%.300s: cannot be locked: %s",
                                directory, g_strerror(errno));
        }
        if (gb_progress_cancelled(NULL)) {
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

char *gb_progress_batch_elsewhere(const struct gb_ensemble *ensemble)
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

int gb_progress_exit(const struct gb_error *err)
{
    (void)gb_options_fail(err);
    return gb_progress_exit_status(err);
}

static const double terminal_every_s = 0.25;
static const double plain_every_s = 5.0;

enum { LINE_MAX_BYTES = 256, WIDTH_UNKNOWN = 80 };

void gb_progress_init(struct gb_progress *progress, bool quiet)
{
    progress->quiet = quiet;
    progress->terminal = isatty(STDERR_FILENO) == 1;
    progress->shown = 0;
    progress->line_at = 0.0;
}

void gb_progress_clear(struct gb_progress *progress)
{
    if (progress->shown > 0) {
        gb_visible_rewrite(stderr, progress->shown, "");
        progress->shown = 0;
    }
}

void gb_progress_say(struct gb_progress *progress, const char *format, ...)
{
    if (progress->quiet) {
        return;
    }
    gb_progress_clear(progress);
    va_list args;
    va_start(args, format);
    (void)gb_visible_line_of(stderr, format, args);
    va_end(args);
}

bool gb_progress_due(const struct gb_progress *progress, double seconds)
{
    const double every = progress->terminal ? terminal_every_s : plain_every_s;
    return !progress->quiet && seconds - progress->line_at >= every;
}

/* "1 h 05 min", "2 min 10 s", "7 s". */
static void format_left(double seconds, char *text, size_t size)
{
    if (!(seconds >= 0.0) || seconds > 1e8) {
        snprintf(text, size, "time left unknown");
        return;
    }
    const long whole = (long)ceil(seconds);
    if (whole >= 3600) {
        snprintf(text, size, "%ld h %02ld min left", whole / 3600, whole / 60 % 60);
    } else if (whole >= 60) {
        snprintf(text, size, "%ld min %02ld s left", whole / 60, whole % 60);
    } else {
        snprintf(text, size, "%ld s left", whole);
    }
}

/* Progress of a die run: its stage, and the density if the pressure changes it.  No
 * time is shown while powder comes to rest, because the end is unknown. */
static void format_stage(const struct gb_snapshot *shot, char *line, size_t size)
{
    char left[48], where[128], density[32] = "";
    const enum gb_stage stage = shot->stage.stage;
    format_left(shot->seconds_left, left, sizeof left);
    gb_status_json_stage_line(&shot->stage, where, sizeof where);
    if (shot->now_valid && (stage == GB_STAGE_PRESS || stage == GB_STAGE_UNLOADING)) {
        snprintf(density, sizeof density, "  density %.4f", shot->now.density);
    }
    snprintf(line, size, "%s%s  %.3gk steps/s  %.0f %%  %s", where, density,
             shot->evaluations_per_s / 1e3, 100.0 * shot->progress,
             shot->seconds_left >= 0.0 ? left : "estimating");
}

void gb_progress_point(char text[GB_PROGRESS_POINT], const struct gb_point *point,
                       const char *separator)
{
    char density[32] = "";
    if (isfinite(point->density)) {
        snprintf(density, sizeof density, "density %.4f%s", point->density, separator);
    }
    snprintf(text, GB_PROGRESS_POINT, "%sp %.4g MPa", density, point->p_pa / 1e6);
}

static void format_line(const struct gb_snapshot *shot, char *line, size_t size)
{
    char left[48];
    char where[GB_PROGRESS_POINT] = "relaxing the start";
    if (shot->stage.stage != GB_STAGE_NONE) {
        format_stage(shot, line, size);
        return;
    }
    format_left(shot->seconds_left, left, sizeof left);
    if (shot->now_valid) {
        gb_progress_point(where, &shot->now, "  ");
    }
    snprintf(line, size, "%s  %.3gM particle-evaluations/s  %.0f %%  %s", where,
             shot->particle_evaluations_per_s / 1e6, 100.0 * shot->progress, left);
}

/* Width of the terminal.  A longer line would wrap and could not be rewritten. */
static int terminal_width(void)
{
    struct winsize window;
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &window) == 0 && window.ws_col > 1) {
        return window.ws_col;
    }
    return WIDTH_UNKNOWN;
}

/* Rewrites the line of a terminal; elsewhere prints another line. */
static void write_line(struct gb_progress *progress, double seconds, char *line)
{
    progress->line_at = seconds;
    if (!progress->terminal) {
        gb_visible_line(stderr, "%s", line);
        return;
    }
    const int width = terminal_width() - 1;
    if ((int)strlen(line) > width) {
        line[width] = '\0';
    }
    const int length = (int)strlen(line);
    const int before = progress->shown < width ? progress->shown : width;
    gb_visible_rewrite(stderr, before, line);
    progress->shown = length > before ? length : before;
}

void gb_progress_show(struct gb_progress *progress, const struct gb_snapshot *snapshot)
{
    char line[LINE_MAX_BYTES];
    if (!progress->quiet) {
        format_line(snapshot, line, sizeof line);
        write_line(progress, snapshot->seconds, line);
    }
}

void gb_progress_count(struct gb_progress *progress, size_t done, size_t total,
                       const char *what, double seconds)
{
    char line[LINE_MAX_BYTES];
    char left[48];
    const bool last = done == total && progress->terminal && !progress->quiet;
    if (!last && !gb_progress_due(progress, seconds)) {
        return;
    }
    format_left(seconds / (double)done * (double)(total - done), left, sizeof left);
    snprintf(line, sizeof line, "%zu of %zu %s  %.0f %%  %s", done, total, what,
             100.0 * (double)done / (double)total, left);
    write_line(progress, seconds, line);
}
