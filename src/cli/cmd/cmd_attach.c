#include <signal.h>
#include <stdio.h>
#include <unistd.h>

#include <glib.h>

#include "cli/commands.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "cli/screening.h"
#include "cli/signals.h"
#include "io/rundir.h"
#include "run/runner/runner.h"
#include "tui/app/app.h"
#include "tui/term/term_profile.h"
#include "tui/watch/watch.h"

/* Of many runs: how they stand, once. */
static int tell_runs(const char *directory, struct gb_error *err)
{
    struct gb_runset_view swarm;
    const bool read = gb_runset_view_read(&swarm, directory, err);
    if (read) {
        printf("%zu runs: %zu done, %zu under way, %zu failed\n", swarm.runs, swarm.done,
               swarm.live, swarm.failed);
    }
    gb_runset_view_finish(&swarm);
    return read ? 0 : gb_options_fail(err);
}

/* Without a screen: its progress, line by line, until it ends or the watcher is stopped.
 */
static int watch(const char *directory, struct gb_error *err)
{
    struct gb_runner *runner = NULL;
    struct gb_progress progress;
    if (gb_runset_view_is(directory)) {
        return tell_runs(directory, err);
    }
    if (!gb_runner_follow(&runner, directory, err)) {
        return gb_options_fail(err);
    }
    gb_signals_install();
    gb_progress_init(&progress, false);
    const struct gb_snapshot *shot = gb_runner_snapshot(runner, NULL);
    while (gb_signals_caught() == 0 && shot->state <= GB_RUN_PAUSED) {
        g_usleep(200000);
        shot = gb_runner_snapshot(runner, NULL);
        if (shot->now_valid && gb_progress_due(&progress, shot->seconds)) {
            gb_progress_show(&progress, shot);
        }
    }
    if (shot->error.code == GB_ERR_MACHINE) { /* not the run's own, which is told below */
        *err = shot->error;
        gb_progress_clear(&progress);
        gb_runner_destroy(runner);
        return gb_options_fail(err);
    }
    gb_progress_say(&progress, "%s: density %.4f, p %.4g MPa, step %lld%s%s", directory,
                    shot->now.density, shot->now.p_pa / 1e6, (long long)shot->now.step,
                    shot->error.text[0] != '\0' ? ", " : "", shot->error.text);
    gb_runner_destroy(runner);
    const int number = gb_signals_caught();
    return number != 0 ? 128 + number : 0;
}

static int show(const char *directory, const struct gb_settings *settings,
                struct gb_error *err)
{
    struct gb_preset *preset = NULL;
    char *path = g_build_filename(directory, "preset.ini", NULL);
    int status = 0;
    if (gb_runset_view_is(directory)) {
        status = gb_watch_run(directory, settings, err);
    } else if (!g_file_test(path, G_FILE_TEST_IS_REGULAR)) {
        gb_error_set(err, GB_ERR_INPUT, "%s: no run directory, it has no preset.ini",
                     directory);
    } else if (gb_preset_load(&preset, path, err)) {
        status = gb_app_run(preset, NULL, directory, settings, err);
    }
    gb_preset_destroy(preset);
    g_free(path);
    return err->code != GB_OK ? gb_options_fail(err) : status;
}

int gb_cmd_attach(int argc, char **argv)
{
    static const struct gb_options_page page = {
        "DIR",
        "Shows a run that is under way elsewhere, live, from its directory.  Leaving "
        "does "
        "not touch the run.  For a directory of many runs (sweep, calibrate) it shows "
        "their mean curves with standard errors, the density over what was varied, and "
        "how far each run is.",
        "t takes it over: its engine is asked to stop with a checkpoint, and the run "
        "goes "
        "on here.  Where stdout is no terminal, its progress is told line by line."};
    char **words = NULL;
    int status = 0;
    struct gb_screening screening = {0};
    const GOptionEntry entries[] = {GB_SCREENING_OPTIONS(&screening), {0}};
    if (gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        struct gb_error err = {0};
        struct gb_settings settings;
        if (screening.diagnose && gb_screening_settings(&screening, &settings, &err)) {
            gb_term_profile_print(stdout, STDOUT_FILENO, &settings);
        } else if (words[0] == NULL || words[1] != NULL) {
            gb_error_set(&err, GB_ERR_INPUT, "attach: one run directory is needed");
            status = gb_options_fail(&err);
        } else if (!gb_screening_settings(&screening, &settings, &err)) {
            status = gb_options_fail(&err);
        } else {
            status = isatty(STDOUT_FILENO) ? show(words[0], &settings, &err)
                                           : watch(words[0], &err);
        }
    }
    gb_screening_finish(&screening);
    g_strfreev(words);
    return status;
}
