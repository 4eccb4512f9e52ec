#include <errno.h>
#include <signal.h>
#include <string.h>

#include <glib.h>
#include <glib/gstdio.h>

#include "cli/commands.h"
#include "cli/options.h"
#include "figures/report/report.h"

enum { DIRECTORIES_MAX = 1000 };

/* Removes what a report that failed has left; only folders that this program made. */
static void remove_tree(const char *path)
{
    GDir *dir = g_dir_open(path, 0, NULL);
    for (const char *name = dir ? g_dir_read_name(dir) : NULL; name != NULL;
         name = g_dir_read_name(dir)) {
        char *inner = g_build_filename(path, name, NULL);
        if (g_file_test(inner, G_FILE_TEST_IS_DIR) &&
            !g_file_test(inner, G_FILE_TEST_IS_SYMLINK)) {
            remove_tree(inner);
        } else {
            g_unlink(inner);
        }
        g_free(inner);
    }
    if (dir != NULL) {
        g_dir_close(dir);
    }
    g_rmdir(path);
}

/* The report grows beside its place and moves there when it is whole. */
static bool write_report(const struct gb_runset *set, const char *data,
                         const char *output, struct gb_error *err)
{
    char *partial = g_strdup_printf("%s.partial-XXXXXX", output);
    if (g_mkdtemp_full(partial, 0777) == NULL) {
        gb_error_set(err, GB_ERR_MACHINE, "%.300s: cannot be made: %s", output,
                     g_strerror(errno));
        g_free(partial);
        return false;
    }
    struct gb_report report = {.set = set, .folder = partial, .data = data};
    bool good = gb_report_write(&report, err);
    if (good && g_rename(partial, output) != 0) {
        good = gb_error_set(err, GB_ERR_MACHINE, "%.300s: cannot be made: %s", output,
                            g_strerror(errno));
    }
    if (!good) {
        remove_tree(partial);
    }
    g_free(partial);
    return good;
}

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
    if (g_file_test(output, G_FILE_TEST_EXISTS)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%.300s: exists; a report goes to a new folder", output);
    }
    const bool good =
        gb_runset_read(&set, words, count, err) && write_report(&set, data, output, err);
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
        {"output", 'o', 0, G_OPTION_ARG_FILENAME, &output, "a folder that is not there",
         "OUT"},
        {"data", 0, 0, G_OPTION_ARG_FILENAME, &data,
         "points of an experiment, in every figure that has its columns", "FILE.csv"},
        {0},
    };
    static const struct gb_options_page page = {
        .usage = "DIR... -o OUT",
        .summary =
            "A folder to hand in: figures with their data, pictures, tables, presets "
            "and\nchecksums, under one page, index.html (a double click opens it) "
            "and report.md.",
    };
    if (gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        signal(SIGXFSZ, SIG_IGN); /* a file that may not grow is an error of a write */
        status = report_on(words, data, output, &err) ? 0 : gb_options_fail(&err);
    }
    g_strfreev(words);
    g_free(output);
    g_free(data);
    return status;
}
