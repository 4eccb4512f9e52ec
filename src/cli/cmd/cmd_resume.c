#include <glib.h>

#include "cli/commands.h"
#include "cli/foreground.h"
#include "cli/options.h"

static int perform(struct gb_foreground *run, const char *directory, bool before)
{
    struct gb_simulation *simulation = NULL;
    struct gb_error err = {0};
    const bool good = before ? gb_simulation_resume_before(&simulation, directory, &err)
                             : gb_simulation_resume(&simulation, directory, &err);
    if (!good) {
        return gb_foreground_fail(run, &err);
    }
    gb_foreground_attach(run, simulation);
    if (simulation->loop.experiment == NULL) { /* killed before its first checkpoint */
        gb_progress_say(&run->progress,
                        "there is no checkpoint yet: the run starts again");
    }
    return gb_foreground_run(run);
}

int gb_cmd_resume(int argc, char **argv)
{
    static const struct gb_options_page page = {
        "DIR",
        "Continues an interrupted run from its last checkpoint, bit-identical to a run\n"
        "without the interruption.",
        "Rows of curve.csv after the checkpoint are computed again.  preset.ini may\n"
        "have changed in [output], title and threads only."};
    struct gb_foreground run = {0};
    char **words = NULL;
    gboolean quiet = FALSE, before = FALSE, json = FALSE;
    int status = 0;
    const GOptionEntry entries[] = {
        {"before", 0, 0, G_OPTION_ARG_NONE, &before,
         "from state-before.h5, where the last checkpoint is damaged", NULL},
        gb_options_json(&json),
        gb_options_quiet(&quiet),
        {0}};
    if (gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        struct gb_error err = {0};
        const char *directory = gb_options_directory(words, "resume", &err);
        if (directory == NULL) {
            status = gb_options_fail(&err);
        } else {
            gb_foreground_init(&run, quiet);
            run.json = json;
            status = perform(&run, directory, before);
        }
    }
    gb_foreground_finish(&run);
    g_strfreev(words);
    return status;
}
