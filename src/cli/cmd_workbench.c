#include <glib.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/visible.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "tui/app/app.h"
#include "tui/app/keys.h"
#include "tui/session/run_lifecycle.h"
#include "tui/term/term_profile.h"
#include "tui/view/views.h"

static bool names_preset(char **words)
{
    for (int i = 0; words[i] != NULL; i++) {
        if (strchr(words[i], '=') == NULL) {
            return true;
        }
    }
    return false;
}

/* The words with the preset `default` before them. */
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

/* Prints the key table of the workbench. */
void gb_cmd_workbench_keys(void)
{
    const size_t count = gb_keys_count();
    for (size_t i = 0; i < count; i++) {
        const struct gb_key key = gb_keys_at(i);
        gb_visible_print(stdout, "%-10s%s\n", key.name, key.help);
    }
}

void gb_cmd_workbench_views(void)
{
    for (size_t i = 0; i < gb_views_count(); i++) {
        const struct gb_plot_view *view = gb_views_at(i);
        gb_visible_print(stdout, "%s %s\n", view->key,
                         view->title_by_step != NULL ? view->title_by_step : view->title);
    }
}

/* Prints the output of --diagnose or opens the workbench; returns the exit status. */
static int open_workbench(const struct gb_screen_options *screen, char **words,
                          char **sets, const char *folder)
{
    struct gb_error err = {0};
    struct gb_settings settings;
    struct gb_preset *preset = NULL;
    int status = 0;
    if (!gb_options_screen_settings(screen, &settings, &err)) {
        return gb_options_fail(&err);
    }
    if (screen->diagnose) {
        gb_term_profile_print(stdout, STDOUT_FILENO, &settings);
        gb_run_lifecycle_print_runs(stdout, folder);
        return 0;
    }
    if (gb_options_scene(&preset, words, sets, GB_OPTIONS_PRESET_OPTIONAL, &err)) {
        status = gb_app_run(preset, folder, NULL, &settings, &err);
    }
    gb_preset_destroy(preset);
    return err.code != GB_OK ? gb_options_fail(&err) : status;
}

static const struct gb_options_page page = {
    .usage = "[PRESET] [group.key=value]...",
    .summary = "The workbench: a live simulation with its parameters.",
    .description =
        "Without a preset it opens the preset default.  ? lists the keys, and so does\n"
        "greenbody --keys.  With --batch, or where stdout is no terminal, it works as\n"
        "greenbody run.  color, graph, images, mouse, ascii and slow (on or off) can be\n"
        "set in the group [screen] of $XDG_CONFIG_HOME/greenbody/screen.ini.",
};

int gb_cmd_workbench(int argc, char **argv)
{
    enum { OWN = 2 };
    char **sets = NULL;
    char **words = NULL;
    char *folder = NULL;
    int status = 0;
    struct gb_screen_options screen = {0};
    GOptionEntry entries[GB_SCREEN_OPTIONS_ENTRIES + OWN + 1] = {
        gb_options_set(&sets),
        {"runs", 0, 0, G_OPTION_ARG_FILENAME, &folder,
         "folder of the runs (default: greenbody/runs in $XDG_STATE_HOME)", "DIR"}};
    gb_options_screen_entries(&screen, entries + OWN);
    if (gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        words = names_preset(words) ? words : with_default(words);
        folder = folder != NULL ? folder : gb_run_lifecycle_folder();
        status = open_workbench(&screen, words, sets, folder);
    }
    gb_options_screen_finish(&screen);
    g_free(folder);
    g_strfreev(words);
    g_strfreev(sets);
    return status;
}
