#include <signal.h>
#include <unistd.h>

#include <glib.h>

#include "base/text/visible.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "cli/runs_folders.h"
#include "cli/screen_options.h"
#include "cli/signals.h"
#include "io/rundir.h"
#include "io/runs/run_list.h"
#include "runner/runner.h"
#include "tui/app/app.h"
#include "tui/term/term_profile.h"
#include "tui/watch/runs_picker.h"
#include "tui/watch/runset_view.h"
#include "tui/watch/watch.h"

/* One line about a directory of many runs. */
static int print_runs(const char *directory, struct gb_error *err)
{
    struct gb_runset_view view;
    const bool read = gb_runset_view_read(&view, directory, err);
    if (read) {
        gb_visible_print(stdout, "%zu runs: %zu done, %zu under way, %zu failed\n",
                         view.runs, view.done, view.live, view.failed);
    }
    gb_runset_view_finish(&view);
    return read ? 0 : gb_options_fail(err);
}

/* Without a screen: progress lines, until the run or this command ends. */
static int print_progress(const char *directory, struct gb_error *err)
{
    struct gb_runner *runner = NULL;
    struct gb_progress progress;
    if (gb_runset_view_any(directory)) {
        return print_runs(directory, err);
    }
    if (!gb_runner_follow(&runner, directory, err)) {
        return gb_options_fail(err);
    }
    gb_signals_install(GB_SIGNALS_HANGUP_NOTED);
    gb_progress_init(&progress, false);
    const struct gb_snapshot *shot = gb_runner_snapshot(runner, NULL);
    while (gb_signals_caught() == 0 && shot->state <= GB_RUN_PAUSED) {
        g_usleep(200000);
        shot = gb_runner_snapshot(runner, NULL);
        if (shot->now_valid && gb_progress_due(&progress, shot->seconds)) {
            gb_progress_show(&progress, shot);
        }
    }
    if (shot->error.code == GB_ERR_MACHINE || shot->error.code == GB_ERR_INPUT) {
        /* an error of reading; that of the run is printed below */
        *err = shot->error;
        gb_progress_clear(&progress);
        gb_runner_destroy(runner);
        return gb_options_fail(err);
    }
    char where[GB_PROGRESS_POINT];
    gb_progress_point(where, &shot->now, ", ");
    gb_progress_say(&progress, "%s: %s, step %lld%s%s", directory, where,
                    (long long)shot->now.step, shot->error.text[0] != '\0' ? ", " : "",
                    shot->error.text);
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
    if (gb_runset_view_any(directory)) {
        status = gb_watch_run(directory, settings, err);
    } else if (!g_file_test(path, G_FILE_TEST_IS_REGULAR)) {
        gb_error_set(err, GB_ERR_INPUT,
                     "%s: is not a run directory: it has no preset.ini", directory);
    } else if (gb_preset_load(&preset, path, err)) {
        status = gb_app_run(preset, NULL, directory, settings, err);
    }
    gb_preset_destroy(preset);
    g_free(path);
    return err->code != GB_OK ? gb_options_fail(err) : status;
}

static GPtrArray *list_runs(void)
{
    return gb_runs_folders_list(NULL);
}

/* The run that is chosen on the screen, g_free; NULL: none, or an error. */
static char *choose(const struct gb_settings *settings, int *status, struct gb_error *err)
{
    char *directory = NULL;
    GPtrArray *list = list_runs();
    if (list->len == 0) {
        char *where = gb_runs_folders_text();
        gb_error_set(err, GB_ERR_INPUT,
                     "attach: there are no runs below %.200s; expected a run directory",
                     where);
        g_free(where);
    } else {
        *status = gb_runs_picker_run(list_runs, settings, &directory, err);
    }
    g_ptr_array_unref(list);
    return directory;
}

/* Without a terminal the live runs are named. */
static void name_live(struct gb_error *err)
{
    GPtrArray *list = gb_runs_folders_live();
    if (list->len == 0) {
        char *where = gb_runs_folders_text();
        gb_error_set(err, GB_ERR_INPUT,
                     "attach: no run is live below %.200s; expected a run directory "
                     "(`greenbody runs` lists all)",
                     where);
        g_free(where);
    } else {
        const struct gb_run_list_item *first = g_ptr_array_index(list, 0);
        gb_error_set(err, GB_ERR_INPUT,
                     "attach: expected one run directory; %u live, the newest in %.200s "
                     "(`greenbody runs` lists all)",
                     list->len, first->directory);
    }
    g_ptr_array_unref(list);
}

/* g_free; NULL: none, or an error. */
static char *find_directory(char **words, const struct gb_settings *settings, int *status,
                            struct gb_error *err)
{
    if (words[0] == NULL && isatty(STDOUT_FILENO) && isatty(STDIN_FILENO)) {
        return choose(settings, status, err);
    }
    if (words[0] == NULL) {
        name_live(err);
        return NULL;
    }
    const char *name = gb_options_directory(words, "attach", err);
    return name != NULL ? gb_runs_folders_find(name) : NULL;
}

static int attach(const struct gb_screen_options *screen, char **words)
{
    struct gb_error err = {0};
    struct gb_settings settings;
    if (screen->diagnose && gb_screen_options_settings(screen, &settings, &err)) {
        gb_term_profile_print(stdout, STDOUT_FILENO, &settings);
        return 0;
    }
    if (!gb_screen_options_settings(screen, &settings, &err)) {
        return gb_options_fail(&err);
    }
    int status = 0;
    char *directory = find_directory(words, &settings, &status, &err);
    if (err.code != GB_OK) {
        status = gb_options_fail(&err);
    } else if (directory != NULL) {
        status = isatty(STDOUT_FILENO) ? show(directory, &settings, &err)
                                       : print_progress(directory, &err);
    }
    g_free(directory);
    return status;
}

int gb_cmd_attach(int argc, char **argv)
{
    static const struct gb_options_page page = {
        "[DIR]",
        "Shows a running simulation of another process, live, from its directory;\n"
        "without one a list of live, detached and past runs to choose from, with a\n"
        "filter, sizes and a key that deletes.  A name of `greenbody runs` is enough\n"
        "for a run of the workbench.\n"
        "Leaving does not affect it.  For a directory of many runs (sweep, calibrate)\n"
        "it shows their mean curves with standard errors, the density over the varied\n"
        "values, and the progress of each run.",
        "t takes the run over: the other process is asked to stop with a checkpoint,\n"
        "and the run continues here.  Where stdout is no terminal, progress is\n"
        "printed line by line."};
    char **words = NULL;
    int status = 0;
    struct gb_screen_options screen = {0};
    GOptionEntry entries[GB_SCREEN_OPTIONS_ENTRIES + 1] = {0};
    gb_screen_options_entries(&screen, entries);
    if (gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        status = attach(&screen, words);
    }
    gb_screen_options_finish(&screen);
    g_strfreev(words);
    return status;
}
