#include <glib.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "base/number.h"
#include "base/visible.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "io/preset.h"
#include "many/pool.h"
#include "scene/field/keep_points.h"
#include "study/cells.h"
#include "study/strength.h"
#include "study/study_text.h"
#include "study/yield.h"

/* Common parts of the commands on compacts (yield, strength): options, preset, progress
 * of the cells on stderr, signals. */
struct compact_options {
    char *directory, *at, *density;
    int replicas, jobs;
    gboolean quiet;
    char *command; /* as typed */
    struct gb_preset *preset;
    struct gb_progress progress;
    struct gb_cells_callbacks callbacks; /* for the study */
};

enum { GB_COMPACT_OPTIONS_ENTRIES = 6 };

enum { JOBS_MAX = 4096 };

/* Fills entry[GB_COMPACT_OPTIONS_ENTRIES]. */
static void compact_options_entries(struct compact_options *options, GOptionEntry *entry)
{
    const GOptionEntry own[GB_COMPACT_OPTIONS_ENTRIES] = {
        {"out", 'o', 0, G_OPTION_ARG_FILENAME, &options->directory,
         "directory of the results", "DIR"},
        {"at", 0, 0, G_OPTION_ARG_STRING, &options->at,
         "compacts: pressures or densities of pressing", "'100 MPa; density = 0.5'"},
        {"density", 0, 0, G_OPTION_ARG_STRING, &options->density,
         "compacts by density alone", "'0.5; 0.55'"},
        {"replicas", 0, 0, G_OPTION_ARG_INT, &options->replicas,
         "cells, from structure.seed on", "N"},
        {"jobs", 'j', 0, G_OPTION_ARG_INT, &options->jobs,
         "cells at once (one per processor)", "N"},
        gb_options_quiet(&options->quiet)};
    memcpy(entry, own, sizeof own);
}

/* Turns "0.4;0.5" into "density = 0.4; density = 0.5". */
static char *densities(const char *text)
{
    char **parts = g_strsplit_set(text, ";,", -1);
    GString *all = g_string_new(NULL);
    for (size_t i = 0; parts[i] != NULL; i++) {
        if (*g_strstrip(parts[i]) != '\0') {
            g_string_append_printf(all, "%sdensity = %s", all->len > 0 ? "; " : "",
                                   parts[i]);
        }
    }
    g_strfreev(parts);
    return g_string_free(all, FALSE);
}

static bool read_marks(const struct compact_options *options,
                       struct gb_keep_points *marks, struct gb_error *err)
{
    struct gb_error why = {0};
    if (options->at != NULL && options->density != NULL) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--at and --density: expected one of them");
    }
    if (options->at == NULL && options->density == NULL) {
        return true;
    }
    char *text =
        options->at != NULL ? g_strdup(options->at) : densities(options->density);
    const bool good = gb_keep_points_parse(text, marks, &why);
    g_free(text);
    return good || gb_error_set(err, GB_ERR_INPUT, "--%s: %.300s",
                                options->at != NULL ? "at" : "density", why.text);
}

static void on_progress(void *data, const struct gb_cells_item *cell, size_t done,
                        size_t total)
{
    struct compact_options *options = data;
    if (cell->error.code != GB_OK && cell->error.code != GB_ERR_CANCELLED) {
        gb_progress_say(&options->progress, "%zu of %zu  %s: %s", done, total, cell->name,
                        cell->error.text);
    } else {
        gb_progress_say(&options->progress, "%zu of %zu  %s", done, total, cell->name);
    }
}

static void on_wait(void *data, const struct gb_cells_item *cell, const char *holder)
{
    struct compact_options *options = data;
    if (!options->quiet) {
        gb_visible_line(stderr, "waiting for cells/%s: %s works on it", cell->name,
                        holder);
    }
}

/* Checks --out and --jobs, reads the preset and the points (unchanged without --at and
 * --density), and installs the signal handlers. */
static bool compact_options_begin(struct compact_options *options, char **words,
                                  char **sets, struct gb_keep_points *marks,
                                  struct gb_error *err)
{
    if (options->directory == NULL) {
        return gb_error_set(err, GB_ERR_INPUT, "needs --out DIR, a directory of results");
    }
    if (options->jobs < 0 || options->jobs > JOBS_MAX) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--jobs %d: must be between 1 and %d, or 0 for all",
                            options->jobs, JOBS_MAX);
    }
    if (!read_marks(options, marks, err) ||
        !gb_options_scene(&options->preset, words, sets, GB_OPTIONS_PRESET_NEEDED, err)) {
        return false;
    }
    gb_progress_init(&options->progress, options->quiet || gb_pool_launch().rank > 0);
    gb_progress_catch_signals(GB_SIGNALS_HANGUP_ENDS);
    options->callbacks =
        (struct gb_cells_callbacks){gb_progress_cancelled, on_progress, on_wait, options};
    return true;
}

/* Writes scene.ini into the directory. preset.ini would mark it as a single run, in
 * which many cells are refused. */
static bool compact_options_keep_preset(struct compact_options *options,
                                        struct gb_error *err)
{
    char *path = g_build_filename(options->directory, "scene.ini", NULL);
    const bool good = gb_preset_save(options->preset, path, GB_PRESET_ALL_KEYS, err);
    g_free(path);
    return good;
}

static void compact_options_finish(struct compact_options *options)
{
    gb_preset_destroy(options->preset);
    g_free(options->directory);
    g_free(options->at);
    g_free(options->density);
    g_free(options->command);
}

/* The options, in per cent as given by the user. */
struct request {
    struct compact_options common;
    struct gb_yield_options yield;
    double offset_percent;
};

/* Prints a value with its error as a column. */
static void print_value(const struct gb_fit_value *value, double unit)
{
    char number[GB_NUMBER_ERROR_MAX];
    gb_number_error(value->value / unit, value->error / unit, 2, " +- ", number);
    gb_visible_print(stdout, "  %-15s", number);
}

static void cmd_yield_print_summary(const struct gb_yield_study *study)
{
    gb_visible_put(
        stdout, "density  offset %  centre p MPa     half axis p MPa  half axis q MPa  "
                "dilatancy        flow from normal\n");
    for (guint i = 0; i < study->surface->len; i++) {
        const struct gb_yield_surface *surface = g_ptr_array_index(study->surface, i);
        const struct gb_fit_value *value = surface->quantity;
        gb_visible_print(stdout, "%.4f   %8g", surface->density.value,
                         100.0 * surface->offset);
        print_value(&value[GB_YIELD_CENTRE_P], 1e6);
        print_value(&value[GB_YIELD_HALF_P], 1e6);
        print_value(&value[GB_YIELD_HALF_Q], 1e6);
        print_value(&value[GB_YIELD_DILATANCY_COMPRESSION], 1.0);
        print_value(&value[GB_YIELD_FLOW_DEVIATION], 1.0);
        gb_visible_put(stdout, "\n");
    }
}

static bool cmd_yield_conclude(struct request *request,
                               const struct gb_yield_study *study, struct gb_error *err)
{
    struct compact_options *common = &request->common;
    if (!compact_options_keep_preset(common, err) ||
        !gb_yield_write(study, common->directory, gb_preset_params(common->preset)->title,
                        common->command, err)) {
        return false;
    }
    cmd_yield_print_summary(study);
    return study->failed == 0 ||
           gb_error_set(err, study->why.code, "%s", study->why.text);
}

static bool cmd_yield_perform(struct request *request, char **words, char **sets,
                              struct gb_error *err)
{
    struct gb_yield_study study = {0};
    request->yield.offset = 0.01 * request->offset_percent;
    request->yield.replicas = request->common.replicas;
    bool good = compact_options_begin(&request->common, words, sets,
                                      &request->yield.marks, err) &&
                gb_yield_run(&study, gb_preset_params(request->common.preset),
                             &request->yield, request->common.directory,
                             request->common.jobs, &request->common.callbacks, err) &&
                cmd_yield_conclude(request, &study, err);
    gb_yield_finish(&study);
    return good;
}

int gb_cmd_yield(int argc, char **argv)
{
    static const struct gb_options_page page = {
        "PRESET [group.key=value]...",
        "Yield surface and plastic flow of compacts.  Cells are pressed as in the preset\n"
        "(its path, or its geometry) to densities or pressures, unloaded to a point inside\n"
        "(a fraction of p, q = 0), and copies are loaded from there along directions of the\n"
        "(p, q) plane until the plastic strain reaches an offset.",
        "DIR receives yield.csv (points, flow), yield_cells.csv, yield_fit.csv (ellipse,\n"
        "dilatancy, angle between flow and normal), yield.md and scene.ini; half and\n"
        "double offset are reported, too.  cells/ keeps what is measured: repeated, the\n"
        "command continues."};
    struct request request = {.offset_percent = 0.1};
    struct gb_error err = {0};
    char **sets = NULL, **words = NULL;
    int status = 0;
    gb_yield_options_init(&request.yield);
    request.common.replicas = request.yield.replicas;
    const GOptionEntry own[] = {
        gb_options_set(&sets),
        {"offset", 0, 0, G_OPTION_ARG_DOUBLE, &request.offset_percent,
         "plastic strain of a yield point, per cent (0.1)", "0.1"},
        {"directions", 0, 0, G_OPTION_ARG_INT, &request.yield.directions,
         "evenly spaced in the (p, q) plane (12)", "N"},
        {"inside", 0, 0, G_OPTION_ARG_DOUBLE, &request.yield.inside,
         "pressure where probes begin, over the compact's (0.5)", "0.5"},
        {0}};
    GOptionEntry entries[GB_COMPACT_OPTIONS_ENTRIES + G_N_ELEMENTS(own)];
    compact_options_entries(&request.common, entries);
    memcpy(entries + GB_COMPACT_OPTIONS_ENTRIES, own, sizeof own);
    request.common.command = gb_options_command("", argc, argv);
    if (gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        status =
            cmd_yield_perform(&request, words, sets, &err) ? 0 : gb_options_fail(&err);
        status = err.code == GB_ERR_CANCELLED ? gb_progress_exit_status(&err) : status;
    }
    compact_options_finish(&request.common);
    g_strfreev(words);
    g_strfreev(sets);
    return status;
}

static void print_summary(const struct gb_strength_study *study)
{
    gb_visible_put(
        stdout,
        "pressed to  test         strength MPa        strain %  Weibull modulus\n");
    for (guint i = 0; i < study->result->len; i++) {
        const struct gb_strength_result *r =
            &g_array_index(study->result, struct gb_strength_result, i);
        const struct gb_fit_value modulus = {.value = r->weibull.modulus,
                                             .low = r->weibull.modulus_low,
                                             .high = r->weibull.modulus_high};
        char strength[GB_NUMBER_ERROR_MAX], strain[GB_NUMBER_MAX];
        GString *weibull = g_string_new(NULL);
        gb_study_text_interval(weibull, "", "%.3g", &modulus, 1.0);
        gb_number_error(1e-6 * r->strength_pa, 1e-6 * r->strength_error_pa, 2, " +- ",
                        strength);
        gb_visible_print(stdout, "%7g %-3s  %-11s  %17s  %8s  %s\n",
                         r->mark.by_density ? r->mark.value : 1e-6 * r->mark.value,
                         r->mark.by_density ? "" : "MPa", gb_strength_tests[r->test].name,
                         strength, gb_number_shown("%.3g", 100.0 * r->strain, strain),
                         weibull->str);
        g_string_free(weibull, TRUE);
    }
}

static bool conclude(struct compact_options *common,
                     const struct gb_strength_study *study, struct gb_error *err)
{
    if (!compact_options_keep_preset(common, err) ||
        !gb_strength_write(study, common->directory,
                           gb_preset_params(common->preset)->title, common->command,
                           err)) {
        return false;
    }
    print_summary(study);
    return study->failed == 0 ||
           gb_error_set(err, study->why.code, "%s", study->why.text);
}

static bool perform(struct compact_options *common, char **words, char **sets,
                    struct gb_error *err)
{
    struct gb_strength_study study = {0};
    struct gb_strength_options options;
    gb_strength_options_init(&options);
    options.replicas = common->replicas;
    const bool good =
        compact_options_begin(common, words, sets, &options.marks, err) &&
        gb_strength_run(&study, gb_preset_params(common->preset), &options,
                        common->directory, common->jobs, &common->callbacks, err) &&
        conclude(common, &study, err);
    gb_strength_finish(&study);
    return good;
}

int gb_cmd_strength(int argc, char **argv)
{
    static const struct gb_options_page page = {
        "PRESET [group.key=value]...",
        "Strength of compacts after unloading.  Cells are pressed as in the preset, all\n"
        "stresses are taken away, and copies are stretched and compressed along z at\n"
        "p_x = p_y = 0, and sheared along xz at p_z = 0, to beyond the largest stress.",
        "DIR receives strength.csv (largest stress, strain, bridges broken, Weibull\n"
        "modulus), strength_curves.csv, strength.md and scene.ini.  cells/ keeps what is\n"
        "measured: repeated, the command continues."};
    struct compact_options common = {.replicas = 8};
    struct gb_error err = {0};
    char **sets = NULL, **words = NULL;
    int status = 0;
    GOptionEntry entries[GB_COMPACT_OPTIONS_ENTRIES + 2] = {0};
    compact_options_entries(&common, entries);
    entries[GB_COMPACT_OPTIONS_ENTRIES] = gb_options_set(&sets);
    common.command = gb_options_command("", argc, argv);
    if (gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        status = perform(&common, words, sets, &err) ? 0 : gb_options_fail(&err);
        status = err.code == GB_ERR_CANCELLED ? gb_progress_exit_status(&err) : status;
    }
    compact_options_finish(&common);
    g_strfreev(words);
    g_strfreev(sets);
    return status;
}
