#include <glib.h>
#include <stdio.h>
#include <string.h>

#include "cli/commands.h"
#include "cli/options.h"
#include "tui/app.h"
#include "tui/keys.h"
#include "tui/life.h"

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
    const GOptionEntry entries[] = {
        GB_OPTIONS_SET(&sets),
        {"runs", 0, 0, G_OPTION_ARG_FILENAME, &folder,
         "folder that keeps the runs (default: greenbody/runs in $XDG_STATE_HOME)",
         "DIR"},
        {0}};
    const struct gb_options_page page = {
        .usage = "[PRESET] [group.key=value]...",
        .summary = "The workbench: a pressing seen live, its parameters at hand.",
        .description =
            "Without a preset it opens the one named default.  ? lists the keys, and so "
            "does greenbody --keys.",
    };
    if (!gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        g_strfreev(sets);
        g_free(folder);
        return status;
    }
    if (!names_preset(words)) {
        words = with_default(words);
    }
    struct gb_error err = {0};
    struct gb_preset *preset = NULL;
    if (gb_options_scene(&preset, words, sets, false, &err)) {
        folder = folder != NULL ? folder : gb_life_folder();
        status = gb_app_run(preset, folder, NULL, &err);
    }
    if (err.code != GB_OK) {
        status = gb_options_fail(&err);
    }
    gb_preset_destroy(preset);
    g_free(folder);
    g_strfreev(words);
    g_strfreev(sets);
    return status;
}
