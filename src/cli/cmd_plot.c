/* `greenbody plot`: figures of runs as PNG, SVG or PDF.  The table of figures
 * (figures/) defines which options a figure reads; this file checks the options, reads
 * the runs and the data to compare with, and draws the figure. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <glib.h>

#include "base/file.h"
#include "base/units.h"
#include "base/visible.h"
#include "base/words.h"
#include "cli/commands.h"
#include "cli/lab_input.h"
#include "cli/options.h"
#include "figures/figures.h"
#include "figures/papers_figures.h"
#include "figures/plotting.h"
#include "many/runset.h"

enum { DIRECTORIES_MAX = 1000 };

/* The options of the command line. */
struct request {
    char *figure, *reference, *densities, *pressure, *output, *log, *data, *title, *inset;
    char *at;
    gboolean force, paper;
    struct gb_page_options page;
    struct gb_lab_input lab;
};

static void free_request(struct request *request)
{
    char *const texts[] = {request->figure,   request->reference, request->densities,
                           request->pressure, request->output,    request->log,
                           request->data,     request->title,     request->at,
                           request->inset};
    for (size_t k = 0; k < G_N_ELEMENTS(texts); k++) {
        g_free(texts[k]);
    }
    gb_lab_input_finish(&request->lab);
    gb_options_page_finish(&request->page);
}

static const struct gb_figures_row *find_figure(const char *name, struct gb_error *err)
{
    const struct gb_figures_row *found = name ? gb_figures_find(name) : NULL;
    if (found == NULL) {
        char *names = gb_figures_names(0), meant[64];
        gb_error_set(
            err, GB_ERR_INPUT,
            "--figure %.80s: %sexpected a name that greenbody plot --help lists, "
            "as time or densification",
            name ? name : "",
            gb_words_nearest_in(name ? name : "", names, meant, sizeof meant));
        g_free(names);
    }
    return found;
}

static bool parse_densities(const char *text, struct gb_figures_input *to,
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
                        "--density %.80s: expected up to %d numbers between 0 and 2, as "
                        "in 0.8,0.9,0.95",
                        text, GB_FIGURES_DENSITIES);
}

/* Rejects options that the figure does not read. */
static bool check_options(const struct request *request,
                          const struct gb_figures_row *figure, struct gb_error *err)
{
    const unsigned given = (request->reference != NULL ? GB_FIGURES_REFERENCE : 0U) |
                           (request->densities != NULL ? GB_FIGURES_DENSITY : 0U) |
                           (request->pressure != NULL ? GB_FIGURES_PRESSURE : 0U) |
                           (request->at != NULL ? GB_FIGURES_AT : 0U);
    if (!gb_figures_check_options(figure, given, err)) {
        return false;
    }
    if (request->log != NULL && strspn(request->log, "xy") != strlen(request->log)) {
        return gb_error_set(err, GB_ERR_INPUT, "--log %.80s: expected x, y or xy",
                            request->log);
    }
    return true;
}

static bool check_count(guint count, struct gb_error *err)
{
    return (count > 0 && count <= DIRECTORIES_MAX) ||
           gb_error_set(err, GB_ERR_INPUT, "plot takes 1 to %d run directories",
                        DIRECTORIES_MAX);
}

static enum gb_plotting_existing existing_files(const struct request *request)
{
    return request->force ? GB_PLOTTING_REPLACE : GB_PLOTTING_KEEP;
}

/* Makes all checks that are possible before the runs are read. */
static bool check_request(const struct request *request,
                          const struct gb_figures_row *figure, char **words,
                          struct gb_error *err)
{
    return (figure->takes == GB_FIGURES_SCENE ||
            check_count(g_strv_length(words), err)) &&
           check_options(request, figure, err) &&
           (request->output == NULL ||
            gb_plotting_check(request->output, existing_files(request), err));
}

/* Lists the directories to read, and adds the reference if it is not among them.
 * Returns the index of the reference. */
static size_t list_directories(char **words, const char *reference, GPtrArray *list)
{
    for (size_t i = 0; words[i] != NULL; i++) {
        gb_runset_expand(list, words[i]);
    }
    for (guint i = 0; i < list->len; i++) {
        if (reference == NULL || gb_file_is_same(g_ptr_array_index(list, i), reference)) {
            return i;
        }
    }
    g_ptr_array_add(list, g_strdup(reference));
    return list->len - 1;
}

static bool write_series(const struct gb_series *series, const struct request *request,
                         const struct gb_figures_row *figure, const struct gb_runset *set,
                         struct gb_error *err)
{
    struct gb_plotting_page page = {.width = 1600,
                                    .height = 1200,
                                    .name = figure->name,
                                    .title = request->title,
                                    .set = set,
                                    .existing = existing_files(request)};
    if (request->output != NULL) {
        return gb_options_page_take(&request->page, &page.width, &page.height,
                                    &page.per_inch, err) &&
               gb_plotting_write(series, &page, request->output, err);
    }
    return gb_options_print(gb_series_csv(series), err);
}

static void set_log(struct gb_series *series, const char *axes)
{
    series->x.log = series->x.log || (axes != NULL && strchr(axes, 'x') != NULL);
    series->y.log = series->y.log || (axes != NULL && strchr(axes, 'y') != NULL);
}

/* Reads "5:9", the range of an inset along x; or none. */
static bool set_inset(struct gb_series *series, const char *text, struct gb_error *err)
{
    const char *end = NULL;
    double from = 0.0;
    double to = 0.0;
    const bool none = strcmp(text, "none") == 0;
    if (!none && (!gb_units_number(text, &end, &from) || *end != ':' ||
                  !gb_units_number(end + 1, &end, &to) || *end != '\0' || !(from < to))) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--inset %.80s: expected FROM:TO of the lower axis, as in "
                            "5:9, or none",
                            text);
    }
    series->inset[0] = none ? NAN : from;
    series->inset[1] = none ? NAN : to;
    return true;
}

/* Adds measured points.  Points for other axes than pressure and density come from a
 * table of this program. */
static bool add_data(struct gb_series *series, const struct request *request,
                     struct gb_error *err)
{
    struct gb_table *table = NULL;
    const char *const axes[] = {series->x.name, series->y.name, NULL};
    const bool good =
        gb_lab_input_read(&table, &request->lab, request->data, axes, err) &&
        (table == NULL || gb_plotting_data(series, table, err));
    gb_table_destroy(table);
    return good;
}

/* Adds the values printed in the papers for the scenes of these runs. */
static bool add_paper(struct gb_series *series, const struct request *request,
                      const struct gb_figures_row *figure, const struct gb_runset *set,
                      struct gb_error *err)
{
    size_t drawn = 0;
    if (!request->paper) {
        return true;
    }
    return (set == NULL || gb_papers_figures_add(series, figure, set, &drawn, err)) &&
           (drawn > 0 ||
            gb_error_set(err, GB_ERR_INPUT,
                         "--paper: the papers print no number for the figure %s of these "
                         "scenes; omit --paper",
                         figure->name));
}

static bool plot_series(const struct request *request,
                        const struct gb_figures_row *figure,
                        const struct gb_figures_input *input, struct gb_error *err)
{
    struct gb_series series = {0};
    bool good = gb_figures_run(figure, &series, input, err) &&
                (request->inset == NULL || set_inset(&series, request->inset, err)) &&
                add_data(&series, request, err) &&
                add_paper(&series, request, figure, input->set, err);
    if (good) {
        set_log(&series, request->log);
        good = write_series(&series, request, figure, input->set, err);
    }
    gb_series_finish(&series);
    return good;
}

static bool plot_runs(const struct request *request, const struct gb_figures_row *figure,
                      struct gb_figures_input *input, char **words, struct gb_error *err)
{
    struct gb_runset set = {0};
    GPtrArray *list = g_ptr_array_new_with_free_func(g_free);
    const size_t reference = list_directories(words, request->reference, list);
    bool good = check_count(list->len, err) &&
                gb_runset_read(&set, (char *const *)list->pdata, list->len, err);
    if (good) {
        gb_figures_group(figure, &set);
        input->set = &set;
        input->reference = set.run[reference].group;
        good = plot_series(request, figure, input, err);
    }
    gb_runset_finish(&set);
    g_ptr_array_unref(list);
    return good;
}

/* Draws the figure of a law, with the figure's own preset unless another is named. */
static bool plot_scene(const struct request *request, const struct gb_figures_row *figure,
                       struct gb_figures_input *input, char **words, struct gb_error *err)
{
    struct gb_preset *preset = NULL;
    GPtrArray *list = g_ptr_array_new();
    bool named = false;
    for (size_t i = 0; words[i] != NULL; i++) {
        named = named || strchr(words[i], '=') == NULL;
    }
    if (!named) {
        g_ptr_array_add(list, (char *)(uintptr_t)figure->preset);
    }
    for (size_t i = 0; words[i] != NULL; i++) {
        g_ptr_array_add(list, words[i]);
    }
    g_ptr_array_add(list, NULL);
    bool good = gb_options_scene(&preset, (char **)list->pdata, NULL,
                                 GB_OPTIONS_PRESET_OPTIONAL, err);
    if (good) {
        input->scene = gb_preset_params(preset);
        good = plot_series(request, figure, input, err);
    }
    gb_preset_destroy(preset);
    g_ptr_array_unref(list);
    return good;
}

static bool plot(const struct request *request, char **words, struct gb_error *err)
{
    struct gb_figures_input input = {.at = request->at, .words = words};
    const struct gb_figures_row *figure = find_figure(request->figure, err);
    if (figure == NULL || !check_request(request, figure, words, err) ||
        (request->densities && !parse_densities(request->densities, &input, err)) ||
        (request->pressure &&
         !gb_units_parse(request->pressure, GB_DIM_PRESSURE, &input.pressure_pa, err))) {
        return false;
    }
    if (figure->takes == GB_FIGURES_TABLE) {
        return plot_series(request, figure, &input, err);
    }
    return figure->takes == GB_FIGURES_SCENE
               ? plot_scene(request, figure, &input, words, err)
               : plot_runs(request, figure, &input, words, err);
}

/* The list of figures for the help, after the options. */
static char *describe_figures(void)
{
    GString *text = g_string_new("Figures:\n");
    const struct gb_figures_row *row = NULL;
    for (size_t k = 0; (row = gb_figures_at(k)) != NULL; k++) {
        char *line = gb_figures_describe(row);
        g_string_append_printf(text, "  %-20s %s\n", row->name, line);
        g_free(line);
    }
    g_string_append(
        text,
        "\nRuns whose presets are equal but for seed, title, threads "
        "and [output] are one\ngroup; means are over its runs (figures of the "
        "loading branch: also those that differ in\nloading.hold).  The directory "
        "of a sweep stands for its runs.\nFigures of laws, from contact to "
        "critical-step, take a preset and group.key=value\nin place of runs; "
        "card, moduli, yield, strength and chart the directory of the command of their\n"
        "name; two of moduli are compared.\n"
        "A figure has a twin ending in .csv next to it;\n"
        "the table of --data has the columns of its axes, and may have "
        "series (words) and\n<column>_error.\n\n");
    char *journals = gb_options_page_journals();
    g_string_append_printf(text, "%s\n%s", journals, gb_lab_input_help);
    g_free(journals);
    return g_string_free(text, FALSE);
}

/* What an option does, with the names of the figures that read it. */
static char *describe_option(const char *what, enum gb_figures_options option)
{
    char *names = gb_figures_names(option);
    char *text = g_strdup_printf("%s: %s", names, what);
    g_free(names);
    return text;
}

/* Texts of options that depend on the tables. */
struct option_texts {
    char *output, *reference, *density, *pressure, *at;
};

static struct option_texts describe_options(void)
{
    return (struct option_texts){
        .output = gb_plotting_pattern(GB_PLOTTING_FIGURE),
        .reference = describe_option("a run of the group that is subtracted",
                                     GB_FIGURES_REFERENCE),
        .density = describe_option("densities at which pressures are compared",
                                   GB_FIGURES_DENSITY),
        .pressure = describe_option("pressure compared (100 MPa; chart: the last)",
                                    GB_FIGURES_PRESSURE),
        .at = describe_option("a kept state, as \"p=500 MPa\" (the last)", GB_FIGURES_AT),
    };
}

static void free_texts(struct option_texts *texts)
{
    g_free(texts->output);
    g_free(texts->reference);
    g_free(texts->density);
    g_free(texts->pressure);
    g_free(texts->at);
}

int gb_cmd_plot(int argc, char **argv)
{
    struct option_texts texts = describe_options();
    struct request request = {0};
    struct gb_error err = {0};
    char **words = NULL;
    int status = 0;
    const GOptionEntry own[] = {
        {"figure", 0, 0, G_OPTION_ARG_STRING, &request.figure, "one of those below",
         "NAME"},
        {"output", 'o', 0, G_OPTION_ARG_FILENAME, &request.output,
         "the figure, and its data next to it (standard output)", texts.output},
        GB_PAGE_OPTIONS_ENTRIES(&request.page),
        {"log", 0, 0, G_OPTION_ARG_STRING, &request.log, "axes that are logarithmic",
         "x|y|xy"},
        {"data", 0, 0, G_OPTION_ARG_FILENAME, &request.data,
         "measured points, drawn as marks", "FILE.csv"},
        {"paper", 0, 0, G_OPTION_ARG_NONE, &request.paper,
         "numbers that the papers print for the scenes of the runs, as marks", NULL},
        {"inset", 0, 0, G_OPTION_ARG_STRING, &request.inset,
         "enlarges a range of the x axis in a free corner; or none", "FROM:TO"},
        {"title", 0, 0, G_OPTION_ARG_STRING, &request.title, "above the figure", "TEXT"},
        {"force", 0, 0, G_OPTION_ARG_NONE, &request.force, "replace an existing file",
         NULL},
        {"reference", 0, 0, G_OPTION_ARG_FILENAME, &request.reference, texts.reference,
         "DIR"},
        {"density", 0, 0, G_OPTION_ARG_STRING, &request.densities, texts.density,
         "RHO,RHO..."},
        {"pressure", 0, 0, G_OPTION_ARG_STRING, &request.pressure, texts.pressure, "P"},
        {"at", 0, 0, G_OPTION_ARG_STRING, &request.at, texts.at, "POINT"},
        {0},
    };
    GOptionEntry *entries = gb_lab_input_entries(&request.lab, own);
    char *figures = describe_figures();
    const struct gb_options_page page = {
        .usage = "DIR... or PRESET [group.key=value]...",
        .summary = "A figure over one or more run directories, or its data as CSV.",
        .description = figures,
    };
    if (gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        status = plot(&request, words, &err) ? 0 : gb_options_fail(&err);
    }
    g_free(entries);
    g_free(figures);
    free_texts(&texts);
    g_strfreev(words);
    free_request(&request);
    return status;
}
