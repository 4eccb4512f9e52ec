#include <string.h>

#include <glib.h>

#include "cli/commands.h"
#include "cli/lab_input.h"
#include "cli/options.h"
#include "figures/figures.h"
#include "figures/report.h"

enum { DIRECTORIES_MAX = 1000 };

/* The measured points given on the command line. */
struct measured {
    char *path;
    struct gb_lab_input lab;
};

/* Reads measured data.  A table of this program may have the axes of any figure. */
static bool read_data(struct gb_table **table, const struct measured *measured,
                      struct gb_error *err)
{
    GPtrArray *axes = g_ptr_array_new();
    const struct gb_figures_row *row = NULL;
    for (size_t k = 0; (row = gb_figures_at(k)) != NULL; k++) {
        const char *const names[] = {row->x.name, row->y.name};
        for (size_t axis = 0; axis < G_N_ELEMENTS(names); axis++) {
            if (names[axis] != NULL) {
                g_ptr_array_add(axes, (char *)(uintptr_t)names[axis]);
            }
        }
    }
    g_ptr_array_add(axes, NULL);
    const bool good = gb_lab_input_read(table, &measured->lab, measured->path,
                                        (const char *const *)axes->pdata, err);
    g_ptr_array_unref(axes);
    return good;
}

static bool report_on(char **words, const struct measured *measured, char *output,
                      struct gb_error *err)
{
    struct gb_table *data = NULL;
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
    const bool good = read_data(&data, measured, err) &&
                      gb_runset_read(&set, words, count, err) &&
                      gb_report_write(&set, data, output, err);
    gb_table_destroy(data);
    gb_runset_finish(&set);
    return good;
}

int gb_cmd_report(int argc, char **argv)
{
    char *output = NULL;
    struct measured measured = {.path = NULL};
    char **words = NULL;
    struct gb_error err = {0};
    int status = 0;
    const GOptionEntry own[] = {
        {"output", 'o', 0, G_OPTION_ARG_FILENAME, &output, "a new folder", "OUT"},
        {"data", 0, 0, G_OPTION_ARG_FILENAME, &measured.path,
         "measured points, for every figure with their columns", "FILE.csv"},
        {0},
    };
    static const struct gb_options_page page = {
        .usage = "DIR... -o OUT",
        .summary =
            "A folder with the pages index.html (for a browser) and report.md:\n"
            "key results with errors and conditions on the first one, numbered\n"
            "figures with their data, tables, pictures, the keys in use, papers in\n"
            "full, presets, curves and the file of --data with checksums.",
        .description = gb_lab_input_help,
    };
    GOptionEntry *entries = gb_lab_input_entries(&measured.lab, own);
    if (gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        status = report_on(words, &measured, output, &err) ? 0 : gb_options_fail(&err);
    }
    g_strfreev(words);
    g_free(output);
    g_free(measured.path);
    gb_lab_input_finish(&measured.lab);
    g_free(entries);
    return status;
}
