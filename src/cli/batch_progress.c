#include "cli/batch_progress.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include <glib/gstdio.h>

#include "base/clock.h"
#include "cli/options.h"
#include "many/single_run.h"
#include "run/cost.h"

static const double terminal_every_s = 0.25;
static const double plain_every_s = 10.0;

enum { JOBS_MOST = 4096 };

/* Set by the handler, looked at between reports. */
static volatile sig_atomic_t caught;

static void on_signal(int number)
{
    caught = number;
}

/* The first signal ends the runs in good order, the second at once. */
static void install_handlers(void)
{
    struct sigaction action = {.sa_handler = on_signal, .sa_flags = (int)SA_RESETHAND};
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    sigaction(SIGHUP, &action, NULL);
    signal(SIGXFSZ, SIG_IGN); /* a file that may not grow is an error of a write */
}

static bool is_cancelled(void *data)
{
    (void)data;
    return caught != 0;
}

static bool serve(struct gb_mpi_pool *ranks, int jobs, struct gb_error *err)
{
    const size_t workers = jobs > 0 ? (size_t)jobs : 1;
    struct gb_pool *crew = NULL;
    install_handlers();
    const bool good = gb_pool_create(&crew, workers, gb_single_run, NULL, err) &&
                      gb_mpi_pool_serve(ranks, crew, workers, is_cancelled, NULL, err);
    gb_pool_destroy(crew);
    return good;
}

bool gb_batch_progress_serve(struct gb_batch_progress *crowd, int jobs, int *status)
{
    struct gb_error err = {0};
    if (!gb_mpi_pool_create(&crowd->ranks, &err)) {
        *status = gb_options_fail(&err);
        return true;
    }
    if (gb_mpi_pool_is_first(crowd->ranks)) {
        return false;
    }
    /* what went wrong with jobs or signals is told once, by the first one */
    *status = serve(crowd->ranks, MIN(jobs, JOBS_MOST), &err)
                  ? 0
                  : gb_status_exit_code(err.code);
    gb_mpi_pool_destroy(crowd->ranks);
    return true;
}

bool gb_batch_progress_directory(const char *path, struct gb_error *err)
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

static bool is_terminal(void)
{
    return isatty(STDERR_FILENO) == 1;
}

static void clear_line(struct gb_batch_progress *crowd)
{
    if (crowd->shown > 0) {
        fprintf(stderr, "\r%*s\r", crowd->shown, "");
        crowd->shown = 0;
    }
}

static void show(struct gb_batch_progress *crowd)
{
    char line[160];
    char left[64] = "time left unknown";
    const size_t fresh = crowd->ended - crowd->before;
    const double gone = gb_clock_s() - crowd->started;
    crowd->told_at = gb_clock_s();
    if (fresh > 0) {
        const double each = gone / (double)fresh;
        char duration[48];
        gb_cost_duration(each * (double)(crowd->total - crowd->ended), duration,
                         sizeof duration);
        snprintf(left, sizeof left, "%s left", duration);
    }
    const int length = snprintf(line, sizeof line, "%zu of %zu runs, %zu failed, %s",
                                crowd->ended, crowd->total, crowd->failed, left);
    if (!is_terminal()) {
        fprintf(stderr, "%s\n", line);
        return;
    }
    fprintf(stderr, "\r%-*s", crowd->shown, line);
    fflush(stderr);
    crowd->shown = length > crowd->shown ? length : crowd->shown;
}

static void told(const struct gb_ensemble *ensemble, const struct gb_ensemble_run *run,
                 void *data)
{
    struct gb_batch_progress *crowd = data;
    (void)ensemble;
    if (run != NULL) {
        crowd->ended++;
        crowd->failed += run->error.code != GB_OK;
    }
    if (crowd->quiet) {
        return;
    }
    if (run != NULL && run->error.code != GB_OK && run->error.code != GB_ERR_CANCELLED) {
        clear_line(crowd);
        fprintf(stderr, "%s: %s\n", run->directory, run->error.text);
    }
    if (gb_clock_s() - crowd->told_at >=
        (is_terminal() ? terminal_every_s : plain_every_s)) {
        show(crowd);
    }
}

static void count(struct gb_batch_progress *crowd, const struct gb_ensemble *ensemble)
{
    crowd->total = ensemble->points * ensemble->replicas;
    crowd->ended = 0;
    crowd->failed = 0;
    for (size_t i = 0; i < crowd->total; i++) {
        crowd->ended += ensemble->run[i].ended;
    }
    crowd->before = crowd->ended;
}

bool gb_batch_progress_work(struct gb_batch_progress *crowd, struct gb_ensemble *ensemble,
                            int jobs, struct gb_error *err)
{
    struct gb_pool *crew = NULL;
    const struct gb_ensemble_callbacks watch = {is_cancelled, told, crowd};
    if (jobs < 0 || jobs > JOBS_MOST) {
        return gb_error_set(err, GB_ERR_INPUT, "--jobs %d: accepted 1 to %d, 0 for all",
                            jobs, JOBS_MOST);
    }
    const size_t workers = jobs > 0               ? (size_t)jobs
                           : crowd->ranks != NULL ? 1
                                                  : g_get_num_processors();
    install_handlers();
    count(crowd, ensemble);
    crowd->started = gb_clock_s();
    crowd->told_at = crowd->started;
    if (!crowd->quiet && !crowd->brief) {
        fprintf(stderr, "%zu runs, %zu of them done before; %zu at once\n", crowd->total,
                crowd->before, workers);
    }
    const bool good = gb_pool_create(&crew, workers, gb_single_run, crowd->ranks, err) &&
                      gb_ensemble_work(ensemble, crew, &watch, err);
    gb_pool_destroy(crew);
    clear_line(crowd);
    if (!crowd->quiet && !crowd->brief) {
        fprintf(stderr, "%zu of %zu runs, %zu failed, after %.1f s\n", crowd->ended,
                crowd->total, crowd->failed, gb_clock_s() - crowd->started);
    }
    return good;
}

bool gb_batch_progress_verdict(const struct gb_ensemble *ensemble, const char *where,
                               struct gb_error *err)
{
    const struct gb_ensemble_run *first = NULL;
    enum gb_status code = GB_ERR_GUARD;
    size_t failed = 0;
    for (size_t i = 0; i < ensemble->points * ensemble->replicas; i++) {
        const struct gb_ensemble_run *run = &ensemble->run[i];
        if (run->ended && run->error.code != GB_OK) {
            first = first ? first : run;
            /* a disk that is full is no matter of the scene */
            code = run->error.code == GB_ERR_MACHINE ? GB_ERR_MACHINE : code;
            failed++;
        }
    }
    return failed == 0 ||
           gb_error_set(err, code,
                        "%zu runs failed, listed in %.200s/runs.csv; the first: %.200s",
                        failed, where, first->error.text);
}

int gb_batch_progress_exit(const struct gb_error *err)
{
    const int status = gb_options_fail(err);
    return err->code == GB_ERR_CANCELLED && caught != 0 ? 128 + (int)caught : status;
}
