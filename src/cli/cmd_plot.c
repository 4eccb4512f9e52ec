#include <signal.h>
#include <stdio.h>
#include <string.h>

#include <glib.h>

#include "base/file.h"
#include "base/units.h"
#include "cli/commands.h"
#include "cli/figures.h"
#include "cli/options.h"
#include "run/runset.h"

enum { DIRECTORIES_MAX = 1000 };

/* What the command line said. */
struct request {
    char *figure, *reference, *densities, *output;
    gboolean force;
};

static void free_request(struct request *request)
{
    g_free(request->figure);
    g_free(request->reference);
    g_free(request->densities);
    g_free(request->output);
}

static const struct gb_figures_row *find_figure(const char *name, struct gb_error *err)
{
    const struct gb_figures_row *found = name ? gb_figures_find(name) : NULL;
    if (found == NULL) {
        GString *names = g_string_new(NULL);
        for (const struct gb_figures_row *row = gb_figures_all(); row->name; row++) {
            g_string_append_printf(names, "%s%s", names->len ? ", " : "", row->name);
        }
        gb_error_set(err, GB_ERR_INPUT, "--figure %.80s: accepted %s", name ? name : "",
                     names->str);
        g_string_free(names, TRUE);
    }
    return found;
}

static bool parse_densities(const char *text, struct gb_figures_request *to,
                            struct gb_error *err)
{
    char **parts = g_strsplit(text, ",", GB_FIGURES_DENSITIES + 1);
    bool good = parts[0] != NULL;
    for (size_t i = 0; parts[i] != NULL && good; i++) {
        good = i < GB_FIGURES_DENSITIES &&
               gb_units_parse(parts[i], GB_DIM_NONE, &to->density[i], NULL) &&
               to->density[i] > 0.0 && to->density[i] < 2.0;
        to->densities = i + 1;
    }
    g_strfreev(parts);
    return good ||
           gb_error_set(err, GB_ERR_INPUT,
                        "--density %.80s: accepted up to %d numbers between 0 and 2, as "
                        "in 0.8,0.9,0.95",
                        text, GB_FIGURES_DENSITIES);
}

/* All that can be known to be wrong before the runs are read. */
static bool check_request(const struct request *request, char **words,
                          struct gb_error *err)
{
    const guint count = g_strv_length(words);
    if (count == 0 || count > DIRECTORIES_MAX) {
        return gb_error_set(err, GB_ERR_INPUT, "plot takes 1 to %d run directories",
                            DIRECTORIES_MAX);
    }
    const bool differs = request->figure && strcmp(request->figure, "difference") == 0;
    if (differs != (request->reference != NULL)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            differs ? "the figure difference needs --reference DIR"
                                    : "--reference is for the figure difference");
    }
    if (request->densities &&
        (!request->figure || strcmp(request->figure, "rate") != 0)) {
        return gb_error_set(err, GB_ERR_INPUT, "--density is for the figure rate");
    }
    if (request->output == NULL) {
        return true;
    }
    if (!g_str_has_suffix(request->output, ".csv")) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "-o %.300s: a name ending in .csv is accepted",
                            request->output);
    }
    if (!request->force && g_file_test(request->output, G_FILE_TEST_EXISTS)) {
        return gb_error_set(err, GB_ERR_INPUT, "%.300s: exists; --force replaces it",
                            request->output);
    }
    return gb_file_check_target(request->output, err);
}

static bool same_place(const char *a, const char *b)
{
    char *first = g_canonicalize_filename(a, NULL);
    char *second = g_canonicalize_filename(b, NULL);
    const bool same = strcmp(first, second) == 0;
    g_free(first);
    g_free(second);
    return same;
}

/* The directories to read; the reference comes last when it is none of the words. Returns
 * its place; the caller frees the array. */
static size_t list_directories(char **words, const char *reference, GPtrArray *list)
{
    size_t place = 0;
    bool found = reference == NULL;
    for (size_t i = 0; words[i] != NULL; i++) {
        if (!found && same_place(words[i], reference)) {
            found = true;
            place = i;
        }
        g_ptr_array_add(list, words[i]);
    }
    if (!found) {
        place = list->len;
        g_ptr_array_add(list, (char *)reference);
    }
    return place;
}

static bool write_series(const struct gb_series *series, const char *output,
                         struct gb_error *err)
{
    GString *text = gb_series_csv(series);
    bool good = true;
    if (output != NULL) {
        good = gb_file_replace(output, text->str, text->len, err);
    } else if (fwrite(text->str, 1, text->len, stdout) != text->len ||
               fflush(stdout) != 0) {
        good = gb_options_output_failed(err);
    }
    g_string_free(text, TRUE);
    return good;
}

static bool plot(const struct request *request, char **words, struct gb_error *err)
{
    struct gb_runset set = {0};
    struct gb_series series = {0};
    struct gb_figures_request wanted = {0};
    const struct gb_figures_row *figure = find_figure(request->figure, err);
    if (figure == NULL || !check_request(request, words, err) ||
        (request->densities && !parse_densities(request->densities, &wanted, err))) {
        return false;
    }
    GPtrArray *list = g_ptr_array_new();
    const size_t place = list_directories(words, request->reference, list);
    bool good = gb_runset_read(&set, (char *const *)list->pdata, list->len, err);
    if (good) {
        wanted.reference = set.run[place].group;
        good = figure->compute(&series, &set, &wanted, err) &&
               write_series(&series, request->output, err);
    }
    gb_series_finish(&series);
    gb_runset_finish(&set);
    g_ptr_array_unref(list);
    return good;
}

/* The list of figures under the options. */
static char *describe_figures(void)
{
    GString *text = g_string_new("Figures:\n");
    for (const struct gb_figures_row *row = gb_figures_all(); row->name != NULL; row++) {
        g_string_append_printf(text, "  %-14s %s\n", row->name, row->doc);
    }
    g_string_append(text, "\nRuns whose presets are equal but for seed, title, threads "
                          "and [output] are one\ngroup; means are over its runs.");
    return g_string_free(text, FALSE);
}

int gb_cmd_plot(int argc, char **argv)
{
    struct request request = {0};
    struct gb_error err = {0};
    char **words = NULL;
    int status = 0;
    const GOptionEntry entries[] = {
        {"figure", 0, 0, G_OPTION_ARG_STRING, &request.figure, "one of those below",
         "NAME"},
        {"output", 'o', 0, G_OPTION_ARG_FILENAME, &request.output,
         "the data of the figure (standard output)", "FILE.csv"},
        {"force", 0, 0, G_OPTION_ARG_NONE, &request.force, "replace an existing file",
         NULL},
        {"reference", 0, 0, G_OPTION_ARG_FILENAME, &request.reference,
         "difference: a run of the group that is subtracted", "DIR"},
        {"density", 0, 0, G_OPTION_ARG_STRING, &request.densities,
         "rate: densities at which pressures are compared", "RHO,RHO..."},
        {0},
    };
    char *figures = describe_figures();
    const struct gb_options_page page = {
        .usage = "DIR...",
        .summary = "Data of a figure over one or more run directories, as CSV.",
        .description = figures,
    };
    if (gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        signal(SIGXFSZ, SIG_IGN); /* a file that may not grow is an error of a write */
        status = plot(&request, words, &err) ? 0 : gb_options_fail(&err);
    }
    g_free(figures);
    g_strfreev(words);
    free_request(&request);
    return status;
}
