#include <stdio.h>

#include <glib.h>

#include "base/text/visible.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "cli/output/runs_output.h"
#include "cli/runs_folders.h"

static bool check_folders(char **folders, struct gb_error *err)
{
    for (int i = 0; folders[i] != NULL; i++) {
        if (!g_file_test(folders[i], G_FILE_TEST_IS_DIR)) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "%.300s: accepted a folder of run directories",
                                folders[i]);
        }
    }
    return true;
}

static int print(char **folders, bool json)
{
    struct gb_error err = {0};
    if (!check_folders(folders, &err)) {
        return gb_options_fail(&err);
    }
    GPtrArray *list = gb_runs_folders_list(folders);
    if (json) {
        gb_runs_output_json(list);
    } else if (list->len > 0) {
        gb_runs_output_table(list);
    } else {
        char *where =
            folders[0] != NULL ? g_strjoinv(", ", folders) : gb_runs_folders_text();
        gb_visible_line(stderr, "greenbody: no runs below %s", where);
        g_free(where);
    }
    g_ptr_array_unref(list);
    return 0;
}

int gb_cmd_runs(int argc, char **argv)
{
    static const struct gb_options_page page = {
        "[FOLDER]...",
        "Lists the runs below folders: live, detached and past ones, with the density and\n"
        "pressure of their last point, size on the disk and date.  Without a folder: those\n"
        "of the workbench, and of `runs` in the working folder.",
        "live: a process computes the run; detached: one without a terminal;\n"
        "interrupted: its process has ended before the run, and `greenbody resume`\n"
        "continues it.  Names of the workbench's runs are below its folder; `attach NAME` takes\n"
        "them.  --json has the directories."};
    char **words = NULL;
    int status = 0;
    gboolean json = FALSE;
    const GOptionEntry entries[] = {gb_options_json(&json), {0}};
    if (gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        status = print(words, json);
    }
    g_strfreev(words);
    return status;
}
