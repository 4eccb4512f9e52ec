#include <stdio.h>
#include <string.h>

#include <glib.h>

#include "base/text/visible.h"
#include "cli/commands.h"
#include "cli/moduli_folder.h"
#include "cli/options.h"
#include "cli/output/json_output.h"
#include "cli/output/moduli_output.h"
#include "cli/signals.h"
#include "figures/states.h"
#include "io/preset.h"
#include "run/moduli/moduli_states.h"
#include "scene/loading_kind.h"

enum { REPLICAS_MAX = 1000 };

/* The options of the command line. */
struct request {
    gboolean csv, json, quiet, quick;
    int replicas;
    char *at, *out;
    char *command;                /* as typed */
    struct gb_keep_points points; /* of --at */
};

struct collector {
    const struct request *request;
    struct gb_moduli_folder folder; /* of --out */
    GArray *state;                  /* struct gb_moduli_state */
    guint next;                     /* state of the run under way */
    guint at, total;                /* of the states of a run directory; 0: none */
};

static void print_progress(const struct collector *collector,
                           const struct gb_moduli_table_row *row)
{
    const double density = row->value[gb_moduli_table_find("density")];
    const double p = row->value[gb_moduli_table_find("p_MPa")];
    if (collector->request->quiet) {
        return;
    }
    if (collector->total > 0) {
        gb_visible_line(stderr, "%u of %u states: density %.4f, p %.6g MPa",
                        collector->at, collector->total, density, p);
    } else {
        gb_visible_line(stderr, "moduli: density %.4f, p %.6g MPa", density, p);
    }
}

static bool add_row(void *data, const struct gb_moduli_table_row *row,
                    struct gb_error *err)
{
    struct collector *collector = data;
    if (collector->next == collector->state->len) {
        g_array_set_size(collector->state, collector->next + 1);
    }
    gb_moduli_states_add(
        &g_array_index(collector->state, struct gb_moduli_state, collector->next++), row);
    print_progress(collector, row);
    return gb_moduli_folder_write(&collector->folder, collector->state, err);
}

static bool is_new(void *data, int64_t step)
{
    const struct collector *collector = data;
    return !gb_moduli_states_has(collector->folder.earlier, step);
}

static void print_states(const struct request *request, const GArray *states)
{
    if (request->csv || request->json) {
        GString *text = gb_moduli_states_csv(states, NULL);
        if (request->json) {
            gb_json_output_table(text->str);
        } else {
            gb_visible_put(stdout, text->str);
        }
        g_string_free(text, TRUE);
        return;
    }
    for (guint s = 0; s < states->len; s++) {
        if (s > 0) {
            gb_visible_put(stdout, "\n");
        }
        gb_moduli_output_state(&g_array_index(states, struct gb_moduli_state, s));
    }
}

static struct gb_moduli_table_sink sink_of(struct collector *collector)
{
    return (struct gb_moduli_table_sink){.row = add_row,
                                         .data = collector,
                                         .wanted = is_new,
                                         .cancelled = gb_signals_cancelled,
                                         .range = !collector->request->quick};
}

/* Runs of one preset that differ by their seed. */
static bool probe_preset(const struct request *request, const struct gb_params *params,
                         struct collector *collector, struct gb_error *err)
{
    const struct gb_moduli_table_sink sink = sink_of(collector);
    struct gb_keep_points points = request->points;
    if (request->at == NULL) {
        (void)gb_keep_points_parse(params->snapshots_at, &points, NULL);
    }
    for (int k = 0; k < request->replicas; k++) {
        struct gb_params replica = *params;
        int missed = 0;
        replica.seed += (uint64_t)k;
        collector->next = 0;
        if (!gb_moduli_table_run(&replica, &points, &sink, &missed, err)) {
            return false;
        }
        if (missed > 0) {
            return gb_error_set(err, GB_ERR_GUARD,
                                "the run has ended before %d of the %d points asked for",
                                missed, points.count);
        }
    }
    return true;
}

static bool check_replicas(const struct request *request, const struct gb_params *params,
                           struct gb_error *err)
{
    if (request->replicas < 1 || request->replicas > REPLICAS_MAX) {
        return gb_error_set(err, GB_ERR_INPUT, "--replicas %d: must be 1 to %d",
                            request->replicas, REPLICAS_MAX);
    }
    return request->replicas == 1 || params->structure == GB_STRUCTURE_GROWN ||
           gb_error_set(err, GB_ERR_INPUT,
                        "--replicas: must be 1 with a lattice, which has no seed");
}

static bool run_preset(const struct request *request, char **words,
                       struct collector *collector, struct gb_error *err)
{
    struct gb_preset *preset = NULL;
    if (!gb_options_scene(&preset, words, NULL, GB_OPTIONS_PRESET_NEEDED, err)) {
        return false;
    }
    const struct gb_params *params = gb_preset_params(preset);
    const bool done = gb_loading_kind_check_cell(params, "moduli", err) &&
                      check_replicas(request, params, err) &&
                      gb_moduli_folder_begin(&collector->folder, preset, err) &&
                      probe_preset(request, params, collector, err);
    gb_preset_destroy(preset);
    return done;
}

/* States of a run directory, each point once; with --at those nearest to its points. */
static bool run_directory(const struct request *request, const char *directory,
                          struct collector *collector, struct gb_error *err)
{
    const struct gb_moduli_table_sink sink = sink_of(collector);
    GPtrArray *paths = gb_moduli_folder_open(&collector->folder, directory, err)
                           ? gb_states_select(directory, &request->points, err)
                           : NULL;
    bool good = paths != NULL;
    collector->total = good ? paths->len : 0;
    for (guint k = 0; good && k < paths->len; k++) {
        const char *path = (char *)g_ptr_array_index(paths, k) + strlen(directory);
        collector->at = k + 1;
        good = gb_moduli_table_file(directory, path + strspn(path, "/"), &sink, err);
    }
    if (good && collector->state->len == 0 && !request->quiet) {
        gb_visible_print(
            stderr, "moduli: all states are in %s/" GB_MODULI_STATES_FILE " already\n",
            request->out);
    }
    if (paths != NULL) {
        g_ptr_array_unref(paths);
    }
    return good;
}

/* What was probed is printed, whatever came after it. */
static int perform(struct request *request, char **words)
{
    struct gb_error err = {0};
    struct collector collector = {.request = request};
    const bool directory = words[0] != NULL && g_file_test(words[0], G_FILE_TEST_IS_DIR);
    bool done = gb_options_points(&request->points, request->at, &err);
    if (done && directory && (words[1] != NULL || request->replicas != 1)) {
        done = gb_error_set(&err, GB_ERR_INPUT,
                            "moduli of a run directory takes no keys and no --replicas");
    }
    gb_moduli_folder_init(&collector.folder, request->out, request->command);
    collector.state = g_array_new(FALSE, TRUE, sizeof(struct gb_moduli_state));
    done = done && (directory ? run_directory(request, words[0], &collector, &err)
                              : run_preset(request, words, &collector, &err));
    if (collector.state->len > 0) {
        print_states(request, collector.state);
    }
    g_array_free(collector.state, TRUE);
    gb_moduli_folder_finish(&collector.folder);
    if (done) {
        return 0;
    }
    (void)gb_options_fail(&err);
    return gb_signals_exit_status(&err);
}

int gb_cmd_moduli(int argc, char **argv)
{
    struct request request = {.replicas = 1};
    const GOptionEntry entries[] = {
        {"csv", 0, 0, G_OPTION_ARG_NONE, &request.csv,
         "one header row and one row per state", NULL},
        gb_options_json(&request.json),
        {"at", 0, 0, G_OPTION_ARG_STRING, &request.at,
         "states, as \"p=100 MPa; density=0.5\" (default: those of output.snapshots_at "
         "and the last; a lattice as it was placed)",
         "POINTS"},
        {"replicas", 0, 0, G_OPTION_ARG_INT, &request.replicas,
         "runs that differ by their seed; means with standard errors (1)", "N"},
        {"out", 'o', 0, G_OPTION_ARG_FILENAME, &request.out,
         "folder of moduli.csv, for plot --figure moduli; a run directory keeps those of "
         "its own states, and only new ones are probed",
         "DIR"},
        {"no-range", 0, 0, G_OPTION_ARG_NONE, &request.quick,
         "without the elastic range, in half the time", NULL},
        gb_options_quiet(&request.quiet),
        {0},
    };
    static const struct gb_options_page page = {
        "PRESET|DIR [group.key=value]...",
        "Elastic moduli of a packing: six small strains both ways on a copy, particles\n"
        "free to move and turn, contact histories as they are.  PRESET is run and "
        "probed\n"
        "on the way; DIR is a run whose kept states and last state are probed.",
        "Lattices: greenbody moduli default structure.kind=fcc structure.overlap=0.03\n"
        "particles.count=500.  docs/mechanics.md has the definitions."};
    char **words = NULL;
    int status = 0;
    request.command = gb_options_command("", argc, argv);
    if (gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        gb_signals_install(GB_SIGNALS_HANGUP_ENDS);
        status = perform(&request, words);
    }
    g_free(request.at);
    g_free(request.out);
    g_free(request.command);
    g_strfreev(words);
    return status;
}
