#include <stdio.h>

#include <glib.h>

#include "cli/commands.h"
#include "cli/foreground.h"
#include "cli/options.h"
#include "run/checkpoint.h"

static bool cancelled(void *data)
{
    (void)data;
    return *gb_foreground_caught() != 0;
}

/* A run that was killed before its first checkpoint has lost nothing but the time. */
static bool begin_anew(struct gb_foreground *run, struct gb_error *err)
{
    gb_progress_say(&run->progress, "there is no checkpoint yet: the run begins anew");
    gb_foreground_begin(run, 0.0);
    return gb_experiment_create(&run->experiment, gb_run_recorder_params(run->keep),
                                cancelled, NULL, err);
}

static bool go_on(struct gb_foreground *run, struct gb_error *err)
{
    char text[96];
    const double gone = gb_run_recorder_seconds(run->keep);
    const long long step = gb_experiment_point(run->experiment)->step;
    gb_foreground_begin(run, gone);
    snprintf(text, sizeof text, "resumed from the checkpoint of step %lld, after %.1f s",
             step, gone);
    run->shot.now.step = step;
    return gb_foreground_event(run, text, err);
}

static int perform(struct gb_foreground *run, const char *directory)
{
    struct gb_error err = {0};
    if (!gb_run_recorder_resume(&run->keep, &run->experiment, directory, &err) ||
        !(run->experiment != NULL ? go_on(run, &err) : begin_anew(run, &err))) {
        return gb_foreground_fail(run, &err);
    }
    run->packed = gb_foreground_elapsed(run);
    if (!gb_foreground_open(run, &err)) {
        return gb_foreground_fail(run, &err);
    }
    return gb_foreground_perform(run);
}

int gb_cmd_resume(int argc, char **argv)
{
    static const struct gb_options_page page = {
        "DIR",
        "Goes on with a run that was stopped or killed, from its last checkpoint, bit "
        "for "
        "bit as if it had never stopped.",
        "Rows of curve.csv after the checkpoint are computed again.  preset.ini may have "
        "changed only in [output], title and threads."};
    struct gb_foreground run = {0};
    char **words = NULL;
    gboolean quiet = FALSE;
    int status = 0;
    const GOptionEntry entries[] = {
        {"quiet", 'q', 0, G_OPTION_ARG_NONE, &quiet, "tell only what went wrong", NULL},
        {0}};
    if (gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        struct gb_error err = {0};
        if (words[0] == NULL || words[1] != NULL) {
            gb_error_set(&err, GB_ERR_INPUT, "resume: one run directory is needed");
            status = gb_options_fail(&err);
        } else {
            gb_progress_init(&run.progress, quiet);
            gb_foreground_catch_signals();
            status = perform(&run, words[0]);
        }
    }
    gb_foreground_finish(&run);
    g_strfreev(words);
    return status;
}
