#include <glib.h>
#include <stdio.h>
#include <string.h>

#include "base/number.h"
#include "base/text/visible.h"
#include "cli/commands.h"
#include "cli/compact_options.h"
#include "cli/options.h"
#include "cli/signals.h"
#include "study/yield/yield.h"

/* The options, in per cent where the user gives per cent. */
struct request {
    struct gb_compact_options common;
    struct gb_yield_options yield;
    double offset_percent;
};

/* A column of a value with its error. */
static void print_value(const struct gb_fit_value *value, double unit)
{
    char number[GB_NUMBER_ERROR_MAX];
    gb_number_error(value->value / unit, value->error / unit, 2, " +- ", number);
    gb_visible_print(stdout, "  %-15s", number);
}

static void print_summary(const struct gb_yield_study *study)
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

static bool conclude(struct request *request, const struct gb_yield_study *study,
                     struct gb_error *err)
{
    struct gb_compact_options *common = &request->common;
    if (!gb_compact_options_keep_preset(common, err) ||
        !gb_yield_write(study, common->directory, gb_preset_params(common->preset)->title,
                        common->command, err)) {
        return false;
    }
    print_summary(study);
    return study->failed == 0 ||
           gb_error_set(err, study->why.code, "%s", study->why.text);
}

static bool perform(struct request *request, char **words, char **sets,
                    struct gb_error *err)
{
    struct gb_yield_study study = {0};
    request->yield.offset = 0.01 * request->offset_percent;
    request->yield.replicas = request->common.replicas;
    bool good = gb_compact_options_begin(&request->common, words, sets,
                                         &request->yield.marks, err) &&
                gb_yield_run(&study, gb_preset_params(request->common.preset),
                             &request->yield, request->common.directory,
                             request->common.jobs, &request->common.callbacks, err) &&
                conclude(request, &study, err);
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
    gb_compact_options_entries(&request.common, entries);
    memcpy(entries + GB_COMPACT_OPTIONS_ENTRIES, own, sizeof own);
    request.common.command = gb_options_command("", argc, argv);
    if (gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        status = perform(&request, words, sets, &err) ? 0 : gb_options_fail(&err);
        status = err.code == GB_ERR_CANCELLED ? gb_signals_exit_status(&err) : status;
    }
    gb_compact_options_finish(&request.common);
    g_strfreev(words);
    g_strfreev(sets);
    return status;
}
