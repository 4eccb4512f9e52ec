#include <glib.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "cli/commands.h"
#include "cli/options.h"
#include "cli/screening.h"
#include "tui/app/app.h"
#include "tui/app/keys.h"
#include "tui/session/run_lifecycle.h"
#include "tui/term/term_profile.h"

static bool names_preset(char **words)
{
    for (int i = 0; words[i] != NULL; i++) {
        if (strchr(words[i], '=') == NULL) {
            return true;
        }
    }
    return false;
}

/* Without a preset the workbench opens the one that answers in seconds. */
static char **with_default(char **words)
{
    GPtrArray *all = g_ptr_array_new();
    g_ptr_array_add(all, g_strdup("default"));
    for (int i = 0; words[i] != NULL; i++) {
        g_ptr_array_add(all, words[i]);
    }
    g_ptr_array_add(all, NULL);
    g_free(words);
    return (char **)g_ptr_array_free(all, FALSE);
}

/* The table that the workbench itself is driven by. */
void gb_cmd_workbench_keys(void)
{
    size_t count = 0;
    const struct gb_key *key = gb_keys_table(&count);
    for (size_t i = 0; i < count; i++) {
        printf("%-10s%s\n", key[i].name, key[i].help);
    }
}

int gb_cmd_workbench(int argc, char **argv)
{
    char **sets = NULL;
    char **words = NULL;
    int status = 0;
    char *folder = NULL;
    struct gb_screening screening = {0};
    struct gb_settings settings;
    const GOptionEntry entries[] = {
        GB_OPTIONS_SET(&sets),
        GB_SCREENING_OPTIONS(&screening),
        {"runs", 0, 0, G_OPTION_ARG_FILENAME, &folder,
         "folder that keeps the runs (default: greenbody/runs in $XDG_STATE_HOME)",
         "DIR"},
        {0}};
    const struct gb_options_page page = {
        .usage = "[PRESET] [group.key=value]...",
        .summary = "The workbench: a pressing seen live, its parameters at hand.",
        .description =
            "Without a preset it opens the one named default.  ? lists the keys, and so "
            "does greenbody --keys.  With --batch, or where stdout is no terminal, it "
            "does what greenbody run does.  color, graph, images, mouse, ascii and slow "
            "(on or off) can stand in [screen] of greenbody/screen.ini in "
            "$XDG_CONFIG_HOME.",
    };
    if (!gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        g_strfreev(sets);
        g_free(folder);
        gb_screening_finish(&screening);
        return status;
    }
    if (!names_preset(words)) {
        words = with_default(words);
    }
    struct gb_error err = {0};
    struct gb_preset *preset = NULL;
    folder = folder != NULL ? folder : gb_run_lifecycle_folder();
    if (!gb_screening_settings(&screening, &settings, &err)) {
        status = gb_options_fail(&err);
        err.code = GB_OK;
    } else if (screening.diagnose) {
        gb_term_profile_print(stdout, STDOUT_FILENO, &settings);
        gb_run_lifecycle_print_runs(stdout, folder);
    } else if (gb_options_scene(&preset, words, sets, false, &err)) {
        status = gb_app_run(preset, folder, NULL, &settings, &err);
    }
    if (err.code != GB_OK) {
        status = gb_options_fail(&err);
    }
    gb_preset_destroy(preset);
    gb_screening_finish(&screening);
    g_free(folder);
    g_strfreev(words);
    g_strfreev(sets);
    return status;
}
