#include <limits.h>
#include <stdio.h>

#include <glib.h>

#include "base/file.h"
#include "base/visible.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "figures/papers_figures.h"
#include "run/cost.h"
#include "study/papers.h"

enum { COUNT_MIN = 50, COUNT_MAX = 1000000, CELLS_MAX = 1000 };

/* Value of an option that is not given. */
enum { DEFAULT = INT_MIN };

/* The options of the command line. */
struct request {
    char *out, *only;
    gint count, cells, jobs;
    gboolean fast, quiet;
};

struct command {
    const struct request *request;
    struct gb_papers_numbers numbers;
    struct gb_papers_plan plan;
    struct gb_batch_progress batch;
};

/* Value of an option for the plan: 0 if it is not given. */
static int given(int value)
{
    return value != DEFAULT ? value : 0;
}

static bool check_range(const char *option, int value, int least, int most,
                        struct gb_error *err)
{
    return value == DEFAULT || (value >= least && value <= most) ||
           gb_error_set(err, GB_ERR_INPUT, "%s %d: must be between %d and %d", option,
                        value, least, most);
}

static bool check_request(const struct request *request, char **words,
                          struct gb_error *err)
{
    if (words[0] != NULL) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "papers %.100s: expected options only; experiments are "
                            "chosen by --only",
                            words[0]);
    }
    if (request->out == NULL || request->out[0] == '\0') {
        return gb_error_set(err, GB_ERR_INPUT, "papers needs --out DIR");
    }
    return check_range("--count", request->count, COUNT_MIN, COUNT_MAX, err) &&
           check_range("--cells", request->cells, 1, CELLS_MAX, err);
}

/* Makes the list of runs, before anything is written. */
static bool prepare(struct command *command, char **words, struct gb_error *err)
{
    const struct request *request = command->request;
    char **only = request->only != NULL ? g_strsplit(request->only, ",", -1) : NULL;
    const struct gb_papers_options options = {.size = request->fast ? GB_PAPERS_FAST
                                                                    : GB_PAPERS_FULL,
                                              .only = only,
                                              .count = given(request->count),
                                              .cells = given(request->cells)};
    const bool good = check_request(request, words, err) &&
                      gb_papers_printed_read(&command->numbers, NULL, err) &&
                      gb_papers_plan_init(&command->plan, &options, request->out, err) &&
                      gb_ensemble_make_directory(request->out, err);
    g_strfreev(only);
    return good;
}

static void print_estimate(const struct command *command)
{
    const struct request *request = command->request;
    size_t runs = 0;
    char total[48], cores[48];
    const double all_s = gb_papers_plan_remaining_s(&command->plan, &runs);
    const size_t workers = gb_progress_all_workers(&command->batch, request->jobs);
    if (runs > 0 && command->batch.output == GB_BATCH_PROGRESS_ALL) {
        gb_cost_duration(all_s, cores, sizeof cores);
        gb_cost_duration(all_s / (double)MIN(workers, runs), total, sizeof total);
        gb_visible_line(stderr, "estimated: about %s, %zu runs of %s of one core", total,
                        runs, cores);
    }
}

static bool write_text(const struct command *command, const char *name, GString *text,
                       struct gb_error *err)
{
    char *path = g_build_filename(command->request->out, name, NULL);
    const bool good = gb_file_replace(path, text->str, text->len, err);
    g_free(path);
    g_string_free(text, TRUE);
    return good;
}

static bool write_results(const struct command *command, const char *line,
                          struct gb_error *err)
{
    struct gb_papers_results results = {0};
    struct gb_papers_figure *figures = NULL;
    size_t count = 0;
    const bool good =
        gb_papers_evaluate(&results, &command->numbers, &command->plan, err) &&
        gb_papers_figures_draw(&command->plan, &figures, &count, err) &&
        write_text(command, "runs.csv", gb_papers_plan_runs(&command->plan), err) &&
        write_text(command, "papers.csv", gb_papers_table(&results), err) &&
        write_text(command, "papers.md",
                   gb_papers_text(&results, &command->numbers, &command->plan, figures,
                                  count, line),
                   err);
    gb_papers_figures_finish(figures, count);
    gb_papers_finish(&results);
    return good;
}

static bool check_runs(const struct command *command, struct gb_error *err)
{
    char *list = g_build_filename(command->request->out, "runs.csv", NULL);
    const bool good = gb_ensemble_check(&command->plan.ensemble, list, err);
    g_free(list);
    return good;
}

/* Writes the page even after an interrupt. */
static bool perform(struct command *command, char **words, const char *line,
                    struct gb_error *err)
{
    const struct request *request = command->request;
    struct gb_error stopped = {0};
    struct gb_lock lock;
    if (!gb_progress_batch_init(&command->batch, request->jobs, request->quiet, err) ||
        !prepare(command, words, err)) {
        return false;
    }
    command->batch.cost = command->plan.cost;
    print_estimate(command);
    const bool worked = gb_progress_batch_work(&command->batch, &command->plan.ensemble,
                                               request->jobs, &stopped);
    if (!gb_progress_batch_lock(&lock, request->out, request->quiet, err)) {
        return false;
    }
    const bool written = write_results(command, line, err);
    gb_lock_release(&lock);
    if (!written) {
        return false;
    }
    if (!worked) {
        return gb_error_set(err, stopped.code, "%s", stopped.text);
    }
    if (command->batch.output == GB_BATCH_PROGRESS_ALL) {
        gb_visible_line(stderr, "written to %s/papers.md", request->out);
    }
    return check_runs(command, err);
}

/* The experiments for the help, after the options. */
static char *describe_experiments(void)
{
    GString *text =
        g_string_new("Experiments (preset, cells at each point: full, --fast):\n");
    for (const struct gb_papers_experiment *row = gb_papers_plan_table();
         row->name != NULL; row++) {
        g_string_append_printf(text, "  %-13s %s (%s: %d, %d)\n", row->name, row->doc,
                               row->preset, row->extent[GB_PAPERS_FULL].cells,
                               row->extent[GB_PAPERS_FAST].cells);
    }
    g_string_append(
        text,
        "\nRepeated, the command does the missing and the failed runs; finished ones are\n"
        "kept.  Several such commands in one directory share its runs.\n\n"
        "  greenbody papers --fast --out papers\n"
        "  greenbody papers --only P1-fig5,P2 --out papers");
    return g_string_free(text, FALSE);
}

int gb_cmd_papers(int argc, char **argv)
{
    struct request request = {.count = DEFAULT, .cells = DEFAULT};
    struct command command = {.request = &request};
    struct gb_error err = {0};
    char **words = NULL;
    int status = 0;
    const GOptionEntry entries[] = {
        {"out", 'o', 0, G_OPTION_ARG_FILENAME, &request.out,
         "directory of the page and the runs", "DIR"},
        {"fast", 0, 0, G_OPTION_ARG_NONE, &request.fast, "small cells and few seeds",
         NULL},
        {"only", 0, 0, G_OPTION_ARG_STRING, &request.only,
         "experiments below, or beginnings of their names, as in P1,P2-v1", "NAME,NAME"},
        {"count", 0, 0, G_OPTION_ARG_INT, &request.count, "particles of a periodic cell",
         "N"},
        {"cells", 0, 0, G_OPTION_ARG_INT, &request.cells, "cells at each point", "N"},
        {"jobs", 'j', 0, G_OPTION_ARG_INT, &request.jobs,
         "runs at once (one per processor)", "N"},
        gb_options_quiet(&request.quiet),
        {0}};
    char *experiments = describe_experiments();
    char *line = gb_options_command("", argc, argv);
    const struct gb_options_page page = {
        "",
        "Every number that the papers print and that can be computed: runs what it needs,\n"
        "compares, and writes DIR/papers.md, DIR/papers.csv and the figures.",
        experiments};
    if (gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        status = perform(&command, words, line, &err) ? 0 : gb_progress_exit(&err);
    }
    gb_papers_plan_finish(&command.plan);
    gb_papers_printed_finish(&command.numbers);
    g_strfreev(words);
    g_free(request.out);
    g_free(request.only);
    g_free(experiments);
    g_free(line);
    return status;
}
