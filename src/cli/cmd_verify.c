#include <inttypes.h>
#include <stdio.h>

#include <glib.h>

#include "base/visible.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "run/verify.h"

enum { DIFFERENT = 1 };

static int print_result(const struct gb_verify *verify)
{
    gb_visible_print(stdout,
                     "repeated from step %" PRId64 " to step %" PRId64 "\n"
                     "kept      %016" PRIx64 "\n"
                     "repeated  %016" PRIx64 "\n",
                     verify->from, verify->to, verify->kept, verify->repeated);
    if (verify->equal) {
        gb_visible_put(stdout, "equal\n");
        return 0;
    }
    gb_visible_print(stdout, "different: first in %s, row %" PRId64 "\n", verify->name,
                     verify->row);
    return DIFFERENT;
}

static int perform(const char *directory)
{
    struct gb_error err = {0};
    struct gb_verify verify;
    if (!gb_verify_run(&verify, directory, gb_progress_cancelled, NULL, &err)) {
        (void)gb_options_fail(&err);
        return gb_progress_exit_status(&err);
    }
    return print_result(&verify);
}

int gb_cmd_verify(int argc, char **argv)
{
    static const struct gb_options_page page = {
        "DIR",
        "Repeats the last part of a run, from the checkpoint before the last one (or\n"
        "from the beginning), and compares the two states bit by bit.",
        "Exit status 0: equal; 1: different, with the first array and row that differ.\n"
        "The directory is not changed."};
    char **words = NULL;
    int status = 0;
    const GOptionEntry entries[] = {{0}};
    if (gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        struct gb_error err = {0};
        const char *directory = gb_options_directory(words, "verify", &err);
        if (directory == NULL) {
            status = gb_options_fail(&err);
        } else {
            gb_progress_catch_signals(GB_SIGNALS_HANGUP_NOTED);
            status = perform(directory);
        }
    }
    g_strfreev(words);
    return status;
}
