#include <stdio.h>

#include <glib.h>

#include "cli/commands.h"
#include "cli/foreground.h"
#include "cli/options.h"
#include "cli/signals.h"

/* A run that was killed before its first checkpoint starts again. */
static bool start_again(struct gb_foreground *run, struct gb_error *err)
{
    struct gb_experiment *experiment = NULL;
    gb_progress_say(&run->progress, "there is no checkpoint yet: the run starts again");
    if (!gb_experiment_create(&experiment, gb_run_recorder_params(run->loop.recorder),
                              gb_signals_cancelled, NULL, err)) {
        return false;
    }
    gb_run_loop_attach(&run->loop, experiment);
    return true;
}

static void resume(struct gb_foreground *run, struct gb_experiment *experiment)
{
    char text[96];
    const double seconds = gb_run_recorder_seconds(run->loop.recorder);
    gb_run_loop_set_seconds(&run->loop, seconds);
    gb_run_loop_attach(&run->loop, experiment);
    snprintf(text, sizeof text, "resumed from the checkpoint of step %lld, after %.1f s",
             (long long)gb_experiment_point(experiment)->step, seconds);
    gb_run_loop_event(&run->loop, text);
}

static int perform(struct gb_foreground *run, const char *directory,
                   enum gb_run_recorder_from from)
{
    struct gb_experiment *experiment = NULL;
    struct gb_error err = {0};
    bool good =
        gb_run_recorder_resume(&run->loop.recorder, &experiment, directory, from, &err);
    if (experiment != NULL) {
        resume(run, experiment);
    } else {
        good = good && start_again(run, &err);
    }
    return good ? gb_foreground_run(run) : gb_foreground_fail(run, &err);
}

int gb_cmd_resume(int argc, char **argv)
{
    static const struct gb_options_page page = {
        "DIR",
        "Continues an interrupted run from its last checkpoint, to the same bits as\n"
        "without the interruption.",
        "Rows of curve.csv after the checkpoint are computed again.  preset.ini may\n"
        "have changed in [output], title and threads only."};
    struct gb_foreground run = {0};
    char **words = NULL;
    gboolean quiet = FALSE, before = FALSE;
    int status = 0;
    const GOptionEntry entries[] = {
        {"before", 0, 0, G_OPTION_ARG_NONE, &before,
         "from state-before.h5, where the last checkpoint is damaged", NULL},
        gb_options_quiet(&quiet),
        {0}};
    if (gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        struct gb_error err = {0};
        const char *directory = gb_options_directory(words, "resume", &err);
        if (directory == NULL) {
            status = gb_options_fail(&err);
        } else {
            gb_foreground_init(&run, quiet);
            status = perform(&run, directory,
                             before ? GB_RUN_RECORDER_BEFORE : GB_RUN_RECORDER_LAST);
        }
    }
    gb_foreground_finish(&run);
    g_strfreev(words);
    return status;
}
