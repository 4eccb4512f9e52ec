#include <signal.h>
#include <string.h>

#include <glib.h>

#include "cli/commands.h"
#include "cli/options.h"
#include "figures/report/report.h"

enum { DIRECTORIES_MAX = 1000 };

static bool report_on(char **words, const char *data, char *output, struct gb_error *err)
{
    struct gb_runset set = {0};
    const guint count = g_strv_length(words);
    if (count == 0 || count > DIRECTORIES_MAX || output == NULL || *output == '\0') {
        return gb_error_set(err, GB_ERR_INPUT,
                            "report takes 1 to %d run directories and -o OUT for its "
                            "folder",
                            DIRECTORIES_MAX);
    }
    while (strlen(output) > 1 && g_str_has_suffix(output, "/")) {
        output[strlen(output) - 1] = '\0';
    }
    const bool good = gb_runset_read(&set, words, count, err) &&
                      gb_report_write(&set, data, output, err);
    gb_runset_finish(&set);
    return good;
}

int gb_cmd_report(int argc, char **argv)
{
    char *output = NULL;
    char *data = NULL;
    char **words = NULL;
    struct gb_error err = {0};
    int status = 0;
    const GOptionEntry entries[] = {
        {"output", 'o', 0, G_OPTION_ARG_FILENAME, &output, "a new folder", "OUT"},
        {"data", 0, 0, G_OPTION_ARG_FILENAME, &data,
         "measured points, for every figure with their columns", "FILE.csv"},
        {0},
    };
    static const struct gb_options_page page = {
        .usage = "DIR... -o OUT",
        .summary = "Figures with their data, pictures, tables, presets and checksums\n"
                   "in one folder with the pages index.html (for a browser) and\n"
                   "report.md.",
    };
    if (gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        signal(SIGXFSZ,
               SIG_IGN); /* a file beyond its size limit is an error of write() */
        status = report_on(words, data, output, &err) ? 0 : gb_options_fail(&err);
    }
    g_strfreev(words);
    g_free(output);
    g_free(data);
    return status;
}
