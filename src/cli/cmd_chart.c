/* `greenbody chart`: error against cost of numerical settings.  The command measures a
 * cell for each setting, writes the log chart.csv after each cell, and continues an
 * existing log.  At the end it prints a table and a plot of characters, and with
 * --write stores the recommended setting in a preset.  With --quantity the study of
 * quantities does the work (study/chart). */
#include <glib.h>
#include <langinfo.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/clock.h"
#include "base/file.h"
#include "base/units.h"
#include "base/visible.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "io/preset.h"
#include "run/cost.h"
#include "solve/relax/relax.h"
#include "study/chart_table.h"
#include "study/quantity_chart.h"
#include "tui/panel/plot.h"

enum { ROWS = 18, COLUMNS = 78 };

/* Points (log10 of cost, error) of one relaxer, or for NULL of the Pareto front, sorted
 * by cost.  Returns their number. */
static size_t collect(const struct gb_chart_table *table, const char *relaxer, double *x,
                      double *y)
{
    size_t count = 0;
    for (size_t i = 1; i < table->rows; i++) {
        const struct gb_chart_row *row = &table->row[i];
        const bool shown =
            relaxer ? strcmp(row->setting.relaxer, relaxer) == 0 : row->pareto;
        if (!shown || !(row->bound > 0.0) || row->cpu_s <= 0.0 ||
            row->setting.count != table->row[0].setting.count) {
            continue;
        }
        size_t at = count++;
        for (; at > 0 && x[at - 1] > log10(row->cpu_s); at--) {
            x[at] = x[at - 1];
            y[at] = y[at - 1];
        }
        x[at] = log10(row->cpu_s);
        y[at] = row->bound;
    }
    return count;
}

static double smallest_scatter(const struct gb_chart_table *table, int pressures)
{
    double smallest = INFINITY;
    for (int k = 0; k < pressures; k++) {
        smallest = fmin(smallest, table->scatter[k]);
    }
    return isfinite(table->allowed) ? table->allowed : smallest;
}

static void draw(struct gb_plot *plot, const struct gb_chart_table *table, double level,
                 double *x, double *y)
{
    static const char *const dynamic = "verlet"; /* instead of a relaxer */
    struct gb_plot_entry entry[8];
    int entries = 0;
    const size_t pareto = collect(table, NULL, x, y);
    gb_plot_line(plot, &(struct gb_plot_series){
                           .x = x, .y = y, .count = pareto, .ink = GB_PLOT_INK_SERIES});
    const double ends[2] = {plot->x.low, plot->x.high}, same[2] = {level, level};
    gb_plot_line(plot, &(struct gb_plot_series){
                           .x = ends, .y = same, .count = 2, .ink = GB_PLOT_INK_DIM});
    for (int m = 0; m < 6; m++) {
        const struct gb_relaxer *const method = gb_relax_table()[m];
        const char *name = method ? method->name : dynamic;
        const size_t count = collect(table, name, x, y);
        gb_plot_line(plot, &(struct gb_plot_series){.x = x,
                                                    .y = y,
                                                    .count = count,
                                                    .ink = GB_PLOT_INK_SERIES + m,
                                                    .marker = m + 1,
                                                    .spacing = 1,
                                                    .points = true});
        if (count > 0) {
            entry[entries] = (struct gb_plot_entry){GB_PLOT_INK_SERIES + m, m + 1, ""};
            snprintf(entry[entries++].name, GB_PLOT_NAME, "%s", name);
        }
        if (!method) {
            break;
        }
    }
    gb_plot_legend(plot, entry, entries);
}

/* Error against CPU time as a plot of characters with its legend; empty if fewer than
 * two settings have errors. g_string_free. */
static GString *chart_plot(const struct gb_chart_table *table,
                           const struct gb_chart_plan *plan)
{
    GString *text = g_string_new(NULL);
    double *x = g_new(double, 2 * table->rows), *y = x + table->rows;
    const double level = smallest_scatter(table, plan->pressures);
    double x_ends[2] = {INFINITY, -INFINITY}, y_ends[2] = {level, level};
    size_t count = 0;
    for (size_t i = 1; i < table->rows; i++) {
        const struct gb_chart_row *row = &table->row[i];
        if (row->bound > 0.0 && row->cpu_s > 0.0) {
            x_ends[0] = fmin(x_ends[0], log10(row->cpu_s));
            x_ends[1] = fmax(x_ends[1], log10(row->cpu_s));
            y_ends[0] = fmin(y_ends[0], row->bound);
            y_ends[1] = fmax(y_ends[1], row->bound);
            count++;
        }
    }
    struct gb_plot plot;
    gb_plot_init(&plot);
    const bool unicode = strcmp(nl_langinfo(CODESET), "UTF-8") == 0;
    if (count > 1 && isfinite(level) &&
        gb_plot_resize(&plot, ROWS, COLUMNS, unicode ? GB_PLOT_BRAILLE : GB_PLOT_ASCII,
                       NULL)) {
        gb_plot_axes(&plot, x_ends, y_ends, GB_PLOT_LOG, "log10 of CPU seconds",
                     "|error| + standard error");
        draw(&plot, table, level, x, y);
        char *dump = gb_plot_dump(&plot);
        g_string_append_printf(text, "\n%s", dump);
        g_string_append(text,
                        isfinite(table->allowed)
                            ? "horizontal line: error limit\n"
                            : "horizontal line: scatter between seeds, the smallest of "
                              "all pressures\n");
        g_free(dump);
    }
    gb_plot_finish(&plot);
    g_free(x);
    return text;
}

/* Default standard error of a mean density. */
#define STANDARD_ERROR 0.001

enum { SEEDS_MAX = 1000, JOBS_MAX = 4096, DESCRIPTION = 160 };

struct chart {
    char *directory, *write, *pressures, *budget_text, *quantity;
    char **vary, **reference;
    int seeds, jobs;
    double budget_s, allowed, standard_error;
    gboolean force, quiet;
    char *command; /* as typed, for the head of chart.csv */
    struct gb_preset *preset;
    struct gb_chart_plan plan;
    struct gb_chart_log log;
    struct gb_progress progress;
    double spent_s;
    int missing;                         /* cells beyond the budget */
    struct gb_quantity_chart quantities; /* for --quantity */
    double before_s; /* processor time of these cells before this command */
    double since_s;  /* clock when the last of them ended */
};

static bool cancelled(void *data, double cpu_s)
{
    const struct chart *chart = data;
    return gb_progress_caught() != 0 || chart->spent_s + cpu_s > chart->budget_s;
}

/* Checks the file of --write: a new file, or the preset itself; any other file only
 * with --force. */
static bool check_write(const struct chart *chart, struct gb_error *err)
{
    if (!chart->write || !gb_file_check_target(chart->write, err)) {
        return chart->write == NULL;
    }
    char *there = g_canonicalize_filename(chart->write, NULL);
    char *own = g_canonicalize_filename(gb_preset_path(chart->preset), NULL);
    const bool fine = chart->force || strcmp(there, own) == 0 ||
                      !g_file_test(chart->write, G_FILE_TEST_EXISTS);
    g_free(there);
    g_free(own);
    return fine ||
           gb_error_set(err, GB_ERR_INPUT,
                        "--write %.300s: exists; expected: a new file, the preset "
                        "itself, or --force",
                        chart->write);
}

static bool check(struct chart *chart, struct gb_error *err)
{
    chart->budget_s = INFINITY;
    if (chart->directory == NULL) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "chart needs --out DIR, a directory for the chart");
    }
    if (chart->seeds < 2 || chart->seeds > SEEDS_MAX) {
        return gb_error_set(err, GB_ERR_INPUT, "--seeds %d: must be between 2 and %d",
                            chart->seeds, SEEDS_MAX);
    }
    if (!(chart->standard_error > 0.0) || chart->allowed < 0.0) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--allow and --standard-error: expected above 0");
    }
    struct gb_error why = {0};
    if (chart->budget_text &&
        (!gb_units_parse(chart->budget_text, GB_DIM_TIME, &chart->budget_s, &why) ||
         !(chart->budget_s > 0.0))) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--budget %.80s: expected a time above 0, as in '10 min'",
                            chart->budget_text);
    }
    return true;
}

static bool prepare(struct chart *chart, char **words, char **sets, struct gb_error *err)
{
    return check(chart, err) &&
           gb_options_scene(&chart->preset, words, sets, GB_OPTIONS_PRESET_NEEDED, err) &&
           check_write(chart, err) &&
           gb_chart_plan_init(&chart->plan, gb_preset_params(chart->preset),
                              (const char *const *)chart->vary,
                              (const char *const *)chart->reference, chart->pressures,
                              chart->seeds, err) &&
           gb_chart_open(&chart->log, chart->directory, &chart->plan, err);
}

static bool write_table(const struct chart *chart, struct gb_error *err)
{
    struct gb_chart_table table;
    gb_chart_table_init(&table, &chart->log,
                        chart->allowed > 0.0 ? chart->allowed : (double)NAN);
    char *comment = g_strdup_printf(
        "preset: %s\n%s\n"
        "error: density minus the density of the reference, same seeds; scatter: standard "
        "deviation between the seeds; bound: largest |error| + error_se\n"
        "step and step_error are fractions; cpu_s and evaluations: mean of one cell, "
        "loading only",
        chart->plan.params.title, chart->command);
    GString *text = gb_chart_table_csv(&table, &chart->plan, comment);
    const bool good = gb_chart_keep(&chart->log, "chart.csv", text, err);
    g_string_free(text, TRUE);
    g_free(comment);
    gb_chart_table_finish(&table);
    return good;
}

/* Simulates a cell that is not in the log.  False after an error only. */
static bool measure(struct chart *chart, const struct gb_chart_setting *setting,
                    uint64_t seed, struct gb_error *err)
{
    if (gb_chart_find(&chart->log, setting, seed)) {
        return true;
    }
    if (chart->missing > 0) { /* no budget left */
        chart->missing++;
        return true;
    }
    struct gb_chart_run run = {.setting = *setting, .seed = seed};
    const bool done = gb_chart_press(&run, &chart->plan.params, chart->plan.pressure_pa,
                                     chart->plan.pressures, cancelled, chart, err);
    chart->spent_s += run.cpu_s;
    if (!done && err->code == GB_ERR_CANCELLED && gb_progress_caught() == 0) {
        chart->missing++;
        return true;
    }
    return done && gb_chart_add(&chart->log, &run, err);
}

static bool measure_all(struct chart *chart, struct gb_error *err)
{
    const struct gb_chart_plan *plan = &chart->plan;
    for (size_t i = 0; i < plan->settings; i++) {
        const double before = chart->spent_s;
        const int missing = chart->missing;
        for (int s = 0; s < plan->seeds; s++) {
            if (!measure(chart, &plan->setting[i], plan->params.seed + (uint64_t)s,
                         err)) {
                return false;
            }
        }
        if (chart->spent_s > before && missing == chart->missing) {
            char text[DESCRIPTION];
            gb_progress_say(&chart->progress, "%3zu of %zu  %6.1f CPU s  %s", i + 1,
                            plan->settings, chart->spent_s - before,
                            gb_chart_describe(&plan->setting[i], text, sizeof text));
        }
        if (chart->spent_s > before && !write_table(chart, err)) {
            return false;
        }
    }
    return write_table(chart, err);
}

/* Writes the recommended setting into the preset file; other keys do not change. */
static bool write_preset(const struct chart *chart, const struct gb_chart_row *chosen,
                         struct gb_error *err)
{
    struct gb_preset *preset = NULL;
    if (!chosen) {
        return gb_error_set(
            err, GB_ERR_INPUT,
            "--write %.300s: no setting has an error below the limit (--allow, "
            "or the scatter between cells); nothing is written",
            chart->write);
    }
    if (!gb_preset_load(&preset, gb_preset_path(chart->preset), err)) {
        return false;
    }
    struct gb_chart_setting setting = chosen->setting;
    setting.count = gb_preset_params(preset)->count;
    gb_chart_apply(gb_preset_params(preset), &setting);
    const bool good = gb_params_check(gb_preset_params(preset), err) &&
                      gb_preset_save(preset, chart->write, GB_PRESET_CHANGED_KEYS, err);
    gb_preset_destroy(preset);
    if (good) {
        gb_visible_print(stdout, "written to %s\n", chart->write);
    }
    return good;
}

static void print_text(GString *text)
{
    gb_visible_put(stdout, text->str);
    g_string_free(text, TRUE);
}

static bool conclude(struct chart *chart, struct gb_error *err)
{
    struct gb_chart_table table;
    struct gb_chart_advice advice;
    gb_chart_table_init(&table, &chart->log,
                        chart->allowed > 0.0 ? chart->allowed : (double)NAN);
    bool good =
        gb_chart_table_advise(&advice, &table, &chart->plan, chart->standard_error, err);
    if (good) {
        print_text(gb_chart_table_text(&table, &chart->plan));
        print_text(chart_plot(&table, &chart->plan));
        print_text(gb_chart_table_results(&table, &chart->plan, &advice));
        if (chart->missing > 0) {
            gb_visible_print(
                stdout,
                "%d cells are missing: the budget is spent; the same command continues\n",
                chart->missing);
        }
        good = !chart->write || write_preset(chart, gb_chart_table_chosen(&table), err);
    }
    gb_chart_table_finish(&table);
    return good;
}

/* --quantity */

static void list_quantities(void)
{
    gb_visible_put(stdout, "quantity            unit   study     meaning\n");
    for (const struct gb_quantity *row = gb_quantity_chart_quantities();
         row->name != NULL; row++) {
        gb_visible_print(stdout, "%-18s  %-5s  %-8s  %s\n", row->name, row->unit,
                         row->study->name, row->meaning);
    }
}

/* Rejects options for densities together with --quantity, and the reverse. */
static bool check_quantity(const struct chart *chart, struct gb_error *err)
{
    if (chart->jobs < 0 || chart->jobs > JOBS_MAX) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--jobs %d: expected 1 to %d, or 0 for one per processor",
                            chart->jobs, JOBS_MAX);
    }
    if (chart->quantity == NULL) {
        return chart->jobs == 0 ||
               gb_error_set(err, GB_ERR_INPUT, "--jobs: needs --quantity");
    }
    return (chart->write == NULL && chart->standard_error == STANDARD_ERROR) ||
           gb_error_set(err, GB_ERR_INPUT,
                        "--write, --standard-error: expected a chart of densities, "
                        "without --quantity");
}

/* Is the budget used up?  Processor time of completed cells, and an estimate for active
 * ones. */
static bool quantity_cancelled(void *data)
{
    const struct chart *chart = data;
    const double jobs = chart->jobs > 0 ? chart->jobs : (double)g_get_num_processors();
    return gb_progress_caught() != 0 ||
           chart->spent_s + jobs * (gb_clock_s() - chart->since_s) > chart->budget_s;
}

static void quantity_progress(void *data, const struct gb_cells_item *cell, size_t done,
                              size_t total)
{
    struct chart *chart = data;
    struct gb_error ignored;
    (void)gb_quantity_chart_read(&chart->quantities, &ignored);
    chart->spent_s = gb_quantity_chart_spent_s(&chart->quantities) - chart->before_s;
    chart->since_s = gb_clock_s();
    if (cell->error.code != GB_ERR_CANCELLED) {
        gb_progress_say(&chart->progress, "%zu of %zu  %s%s%s", done, total, cell->name,
                        cell->error.code != GB_OK ? ": " : "", cell->error.text);
    }
}

static void quantity_waits(void *data, const struct gb_cells_item *cell,
                           const char *holder)
{
    (void)data;
    gb_visible_line(stderr, "waiting for cells/%s: %s works on it", cell->name, holder);
}

/* Writes the preset as scene.ini, because preset.ini marks a single run. */
static bool keep_scene(const struct chart *chart, struct gb_error *err)
{
    char *path = g_build_filename(chart->directory, "scene.ini", NULL);
    const bool good = gb_preset_save(chart->preset, path, GB_PRESET_ALL_KEYS, err);
    g_free(path);
    return good;
}

/* Writes a table for each quantity of the study and prints the requested one. */
static bool write_quantities(const struct chart *chart, const struct gb_quantity *wanted,
                             struct gb_error *err)
{
    bool good = true;
    char *comment = g_strdup_printf(
        "preset: %s\n%s\nerror: value minus the value of the reference, same seeds, mean; "
        "error_95: half of its 95 %% interval; bound: |error| + error_95; half_interval: "
        "half of the 95 %% interval of the default with %d cells; cost: processor time "
        "over the default's; settings in SI",
        chart->quantities.params.title, chart->command, wanted->study->cells);
    for (const struct gb_quantity *row = gb_quantity_chart_quantities();
         good && row->name != NULL; row++) {
        struct gb_quantity_table table;
        if (row->study != wanted->study) {
            continue;
        }
        gb_quantity_chart_table_init(
            &table, &chart->quantities, row,
            row == wanted && chart->allowed > 0.0 ? chart->allowed : (double)NAN);
        GString *csv = gb_quantity_chart_table_csv(&table, comment);
        char *path = g_strconcat(chart->directory, "/", row->name, ".csv", NULL);
        good = gb_file_replace(path, csv->str, csv->len, err);
        if (good && row == wanted) {
            print_text(gb_quantity_chart_table_text(&table));
        }
        g_string_free(csv, TRUE);
        g_free(path);
        gb_quantity_chart_table_finish(&table);
    }
    g_free(comment);
    return good;
}

static bool perform_quantity(struct chart *chart, char **words, char **sets,
                             struct gb_error *err)
{
    const struct gb_quantity *wanted = gb_quantity_chart_find(chart->quantity, err);
    const struct gb_cells_callbacks callbacks = {quantity_cancelled, quantity_progress,
                                                 quantity_waits, chart};
    char cost[64];
    size_t missing = 0;
    struct gb_error why = {0};
    if (wanted == NULL || !check(chart, err) ||
        !gb_options_scene(&chart->preset, words, sets, GB_OPTIONS_PRESET_NEEDED, err) ||
        !gb_quantity_chart_init(
            &chart->quantities, wanted->study, gb_preset_params(chart->preset),
            chart->pressures, (const char *const *)chart->vary,
            (const char *const *)chart->reference, chart->seeds, chart->directory, err) ||
        !keep_scene(chart, err)) {
        return false;
    }
    const double cost_s = gb_quantity_chart_cost_s(&chart->quantities, &missing);
    gb_visible_print(stdout, "%zu of %u cells to measure: about %s of processor time\n\n",
                     missing, chart->quantities.cells.list->len,
                     gb_cost_duration(cost_s, cost, sizeof cost));
    (void)fflush(stdout);
    chart->since_s = gb_clock_s();
    chart->before_s = gb_quantity_chart_spent_s(&chart->quantities);
    bool good = gb_quantity_chart_work(&chart->quantities, chart->jobs, &callbacks, &why);
    const bool spent = why.code == GB_ERR_CANCELLED && gb_progress_caught() == 0;
    if (!write_quantities(chart, wanted, err)) {
        return false;
    }
    if (spent) {
        gb_quantity_chart_cost_s(&chart->quantities, &missing);
        gb_visible_print(
            stdout,
            "%zu cells are missing: the budget is spent; the same command continues\n",
            missing);
    }
    return good || spent || gb_error_set(err, why.code, "%s", why.text);
}

static int perform(struct chart *chart, char **words, char **sets)
{
    struct gb_error err = {0};
    if (chart->quantity != NULL && strcmp(chart->quantity, "list") == 0) {
        list_quantities();
        return 0;
    }
    if (check_quantity(chart, &err) && chart->quantity != NULL) {
        if (perform_quantity(chart, words, sets, &err)) {
            return 0;
        }
    } else if (err.code == GB_OK && prepare(chart, words, sets, &err) &&
               measure_all(chart, &err) && conclude(chart, &err)) {
        return 0;
    }
    if (err.code == GB_ERR_CANCELLED && gb_progress_caught() != 0) {
        struct gb_error ignored;
        if (chart->quantity == NULL) {
            write_table(chart, &ignored);
        }
        gb_progress_say(&chart->progress, "stopped; the same command continues");
        return gb_progress_exit_status(&err);
    }
    return gb_options_fail(&err);
}

static void finish(struct chart *chart)
{
    gb_quantity_chart_finish(&chart->quantities);
    gb_chart_close(&chart->log);
    gb_chart_plan_finish(&chart->plan);
    gb_preset_destroy(chart->preset);
    g_free(chart->directory);
    g_free(chart->write);
    g_free(chart->pressures);
    g_free(chart->quantity);
    g_free(chart->budget_text);
    g_free(chart->command);
    g_strfreev(chart->vary);
    g_strfreev(chart->reference);
}

int gb_cmd_chart(int argc, char **argv)
{
    static const struct gb_options_page page = {
        "PRESET [group.key=value]...",
        "Measures the accuracy of numerical settings of a scene against their cost.\n"
        "Each setting simulates the same cells as a reference with a small strain step\n"
        "and a tight tolerance; densities at given pressures are compared cell by\n"
        "cell.  Marks the Pareto-optimal settings, recommends the cheapest one with an\n"
        "error below the scatter between cells, marks rows that are limited by noise,\n"
        "and estimates the number of cells for a standard error.",
        "--quantity NAME charts a number that a study reports (`--quantity list`):\n"
        "modulus, yield surface, card, strength, springback, constants of a fit.  It\n"
        "prints its cost, varies the numerics of that study (--vary: tolerance=A,B or\n"
        "numerics.inertia_scale=A,B) and recommends the cheapest setting whose\n"
        "deviation from the tightest one has its 95 % bound below half of the interval\n"
        "that the study reports.  DIR receives NAME.csv and cells/.\n\n"
        "DIR receives chart.csv (one row per setting), runs.csv (one row per cell)\n"
        "and preset.ini.  Repeated, the command continues an interrupted chart.\n"
        "`greenbody plot DIR --figure chart` draws it, `--figure chart-error` the\n"
        "errors at one of the pressures."};
    struct chart chart = {
        .seeds = 4, .standard_error = STANDARD_ERROR, .log = {.lock = -1}};
    char **sets = NULL, **words = NULL;
    int status = 0;
    const GOptionEntry entries[] = {
        gb_options_set(&sets),
        {"out", 'o', 0, G_OPTION_ARG_FILENAME, &chart.directory, "directory of the chart",
         "DIR"},
        {"quantity", 0, 0, G_OPTION_ARG_STRING, &chart.quantity,
         "a number that a study reports, in place of densities; list: their names",
         "NAME"},
        {"jobs", 'j', 0, G_OPTION_ARG_INT, &chart.jobs,
         "cells of a quantity at once (one per processor)", "N"},
        {"seeds", 0, 0, G_OPTION_ARG_INT, &chart.seeds,
         "cells per setting, from structure.seed on (4)", "N"},
        {"budget", 0, 0, G_OPTION_ARG_STRING, &chart.budget_text,
         "CPU time after which it stops", "'10 min'"},
        {"at", 0, 0, G_OPTION_ARG_STRING, &chart.pressures,
         "pressures (where it unloads, and the final one); of a quantity the compact",
         "'100 MPa; 1 GPa'"},
        {"vary", 0, 0, G_OPTION_ARG_STRING_ARRAY, &chart.vary,
         "values of a key; repeated: all combinations", "group.key=A,B,..."},
        {"reference", 0, 0, G_OPTION_ARG_STRING_ARRAY, &chart.reference,
         "another value for the reference; may be repeated", "group.key=value"},
        {"allow", 0, 0, G_OPTION_ARG_DOUBLE, &chart.allowed,
         "limit of the error in density (the scatter); of a quantity, in its unit",
         "0.002"},
        {"standard-error", 0, 0, G_OPTION_ARG_DOUBLE, &chart.standard_error,
         "of a mean density, for the number of cells (0.001)", "0.001"},
        {"write", 0, 0, G_OPTION_ARG_FILENAME, &chart.write,
         "write the preset with the recommended setting: a new file, or the preset",
         "FILE"},
        {"force", 'f', 0, G_OPTION_ARG_NONE, &chart.force,
         "let --write replace another file", NULL},
        {"quiet", 'q', 0, G_OPTION_ARG_NONE, &chart.quiet, "only errors on stderr", NULL},
        {0}};
    chart.command = gb_options_command("command: ", argc, argv);
    if (gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        gb_progress_init(&chart.progress, chart.quiet);
        gb_progress_catch_signals(GB_SIGNALS_HANGUP_ENDS);
        status = perform(&chart, words, sets);
    }
    finish(&chart);
    g_strfreev(words);
    g_strfreev(sets);
    return status;
}
