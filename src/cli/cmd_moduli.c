/* `greenbody moduli`: elastic moduli of the states of a run directory, or of the points
 * of a preset as means over replicas.  States are probed (solve/moduli), printed with
 * standard errors, and stored in moduli.csv. */
#include <errno.h>
#include <glib.h>
#include <glib/gstdio.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/file.h"
#include "base/number.h"
#include "base/visible.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "figures/states.h"
#include "io/preset.h"
#include "run/moduli_table.h"
#include "run/record/kept_states.h"
#include "scene/loading_kind.h"
#include "scene/seed.h"

/* "123.4" or "123.4 +- 0.5". */
static void print_value(const struct gb_moduli_state *state, const char *column,
                        int digits)
{
    const int k = gb_moduli_table_find(column);
    const double error = gb_moduli_table_error(state, k);
    char text[GB_NUMBER_ERROR_MAX];
    if (!isfinite(gb_moduli_table_mean(state, k))) {
        gb_visible_print(stdout, "-");
        return;
    }
    if (error > 0.0) {
        gb_number_error(gb_moduli_table_mean(state, k), error, 2, " +- ", text);
    } else {
        g_snprintf(text, sizeof text, "%.*g", digits, gb_moduli_table_mean(state, k));
    }
    gb_visible_print(stdout, "%s", text);
}

static double plain(const struct gb_moduli_state *state, const char *column)
{
    return gb_moduli_table_mean(state, gb_moduli_table_find(column));
}

static void print_matrix(const struct gb_moduli_state *state)
{
    static const char *const axes[] = {"xx", "yy", "zz", "yz", "xz", "xy"};
    gb_visible_print(stdout, "C, GPa ");
    for (int n = 0; n < 6; n++) {
        gb_visible_print(stdout, "%11s", axes[n]);
    }
    gb_visible_put(stdout, "\n");
    for (int m = 0; m < 6; m++) {
        gb_visible_print(stdout, "    %s ", axes[m]);
        for (int n = 0; n < 6; n++) {
            gb_visible_print(stdout, "%11.5f", state->c_gpa[m][n] / state->count);
        }
        gb_visible_put(stdout, "\n");
    }
}

static void print_line(const struct gb_moduli_state *state, const char *title,
                       const char *const columns[][2], const char *unit)
{
    gb_visible_print(stdout, "%-15s", title);
    for (int k = 0; columns[k][0] != NULL; k++) {
        gb_visible_print(stdout, "%s%s ", k > 0 ? ", " : "", columns[k][1]);
        print_value(state, columns[k][0], 5);
    }
    gb_visible_print(stdout, "%s%s\n", unit[0] ? " " : "", unit);
}

static void print_derived(const struct gb_moduli_state *state)
{
    static const char *const hill[][2] = {
        {"K_GPa", "K"}, {"G_GPa", "G"}, {"E_GPa", "E"}, {NULL, NULL}};
    static const char *const voigt[][2] = {
        {"K_voigt_GPa", "K"}, {"G_voigt_GPa", "G"}, {NULL, NULL}};
    static const char *const reuss[][2] = {
        {"K_reuss_GPa", "K"}, {"G_reuss_GPa", "G"}, {NULL, NULL}};
    static const char *const nu[][2] = {{"nu", "nu"}, {NULL, NULL}};
    static const char *const axial[][2] = {
        {"axial_C11_GPa", "C11"}, {"axial_C12_GPa", "C12"}, {"axial_C13_GPa", "C13"},
        {"axial_C33_GPa", "C33"}, {"axial_C44_GPa", "C44"}, {NULL, NULL}};
    static const char *const misfit[][2] = {{"axial_misfit", "share of C"}, {NULL, NULL}};
    static const char *const waves[][2] = {{"vp_z_m_s", "P along z"},
                                           {"vp_x_m_s", "across"},
                                           {"vs_z_m_s", "S along z"},
                                           {"vs_x_m_s", "across"},
                                           {NULL, NULL}};
    print_line(state, "Hill", hill, "GPa");
    print_line(state, "", nu, "");
    print_line(state, "Voigt", voigt, "GPa");
    print_line(state, "Reuss", reuss, "GPa");
    print_line(state, "axis z", axial, "GPa");
    print_line(state, "  left out", misfit, "");
    print_line(state, "waves", waves, "m/s");
}

/* Prints the moduli of a state: C in full, averages, wave speeds, elastic range; with
 * standard errors over replicas. */
static void moduli_output_state(const struct gb_moduli_state *state)
{
    gb_visible_print(stdout, "density        ");
    print_value(state, "density", 6);
    gb_visible_print(stdout, ", p ");
    print_value(state, "p_MPa", 6);
    gb_visible_print(stdout, " MPa (x %.5g, y %.5g, z %.5g)\n", plain(state, "px_MPa"),
                     plain(state, "py_MPa"), plain(state, "pz_MPa"));
    if (state->count + state->missing > 1) {
        gb_visible_print(stdout,
                         "replicas       %d of %d, errors are standard errors of the "
                         "mean\n",
                         state->count, state->count + state->missing);
    }
    gb_visible_print(
        stdout,
        "probe          strain %.3g; half of it differs by %.1e of the largest C\n",
        plain(state, "probe_strain"), plain(state, "sizes_differ"));
    gb_visible_print(
        stdout, "state          residual %.1e, relaxed by %.2g d (rms), %.2g d at most\n",
        plain(state, "residual"), plain(state, "moved_rms_d"),
        plain(state, "moved_most_d"));
    if (isfinite(plain(state, "elastic_range"))) {
        gb_visible_print(stdout, "elastic range  %s%.3g (a secant has lost 5 %%)\n",
                         state->range_open ? "above " : "",
                         plain(state, "elastic_range"));
    }
    print_matrix(state);
    print_derived(state);
}

/* The folder of `greenbody moduli --out`: moduli.csv, and for a preset also preset.ini.
 */
struct moduli_folder {
    const char *path;    /* NULL: none; nothing is written */
    const char *command; /* as typed, for the table's comment */
    GArray *earlier;     /* struct gb_moduli_state, from the existing file */
};

static void moduli_folder_init(struct moduli_folder *folder, const char *path,
                               const char *command)
{
    *folder = (struct moduli_folder){
        path, command, g_array_new(FALSE, TRUE, sizeof(struct gb_moduli_state))};
}

static void moduli_folder_finish(struct moduli_folder *folder)
{
    g_array_free(folder->earlier, TRUE);
}

static bool exists(const struct moduli_folder *folder, const char *name)
{
    char *path = g_build_filename(folder->path, name, NULL);
    const bool found = g_file_test(path, G_FILE_TEST_EXISTS);
    g_free(path);
    return found;
}

static bool make(const struct moduli_folder *folder, struct gb_error *err)
{
    return g_mkdir_with_parents(folder->path, 0777) == 0 ||
           gb_error_set(err, GB_ERR_MACHINE, "--out %.300s: cannot be made: %s",
                        folder->path, g_strerror(errno));
}

/* Creates the folder for a preset and writes preset.ini.  Errors: GB_ERR_INPUT if it
 * has a preset or moduli already, GB_ERR_MACHINE. */
static bool moduli_folder_begin(const struct moduli_folder *folder,
                                struct gb_preset *preset, struct gb_error *err)
{
    static const char *const names[] = {GB_MODULI_STATES_FILE, "preset.ini"};
    if (folder->path == NULL) {
        return true;
    }
    for (size_t k = 0; k < G_N_ELEMENTS(names); k++) {
        if (exists(folder, names[k])) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "--out %.300s: holds %s already; choose another folder",
                                folder->path, names[k]);
        }
    }
    char *path = g_build_filename(folder->path, "preset.ini", NULL);
    const bool good =
        make(folder, err) && gb_preset_save(preset, path, GB_PRESET_ALL_KEYS, err);
    g_free(path);
    return good;
}

/* Opens the folder for a run: the run's own directory, whose table is extended, or a
 * folder without moduli.  Errors: as above; see gb_moduli_table_read. */
static bool moduli_folder_open(struct moduli_folder *folder, const char *directory,
                               struct gb_error *err)
{
    if (folder->path == NULL) {
        return true;
    }
    char *path = g_build_filename(folder->path, GB_MODULI_STATES_FILE, NULL);
    bool good = make(folder, err);
    if (good && g_file_test(path, G_FILE_TEST_EXISTS)) {
        good = gb_file_is_same(directory, folder->path)
                   ? gb_moduli_table_read(folder->earlier, path, err)
                   : gb_error_set(err, GB_ERR_INPUT,
                                  "--out %.300s: holds %s already; choose another folder",
                                  folder->path, GB_MODULI_STATES_FILE);
    }
    good = good && gb_file_check_target(path, err);
    g_free(path);
    return good;
}

/* Writes moduli.csv with the earlier states and these (struct gb_moduli_state). */
static bool moduli_folder_write(const struct moduli_folder *folder, const GArray *states,
                                struct gb_error *err)
{
    if (folder->path == NULL) {
        return true;
    }
    GArray *all = g_array_new(FALSE, FALSE, sizeof(struct gb_moduli_state));
    g_array_append_vals(all, folder->earlier->data, folder->earlier->len);
    g_array_append_vals(all, states->data, states->len);
    gb_moduli_table_sort(all);
    char *comment = g_strdup_printf("greenbody %s\n%s", GB_VERSION, folder->command);
    const bool good = gb_listing_store(gb_moduli_table_listing(all, comment),
                                       folder->path, GB_MODULI_STATES_FILE, err);
    g_free(comment);
    g_array_free(all, TRUE);
    return good;
}

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
    struct moduli_folder folder; /* of --out */
    /* struct gb_moduli_state.  For a preset: the requested points and the end, each as
     * a mean over the replicas.  For a run directory: its states. */
    GArray *state;
    struct gb_keep_points points; /* for a preset */
    unsigned reached;             /* points reached by the present replica, as bits */
    guint at, total; /* progress over the states of a run directory; 0: none */
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

static struct gb_moduli_state *state_at(const struct collector *collector, guint k)
{
    return &g_array_index(collector->state, struct gb_moduli_state, k);
}

/* Do two rows describe the same state?  This happens if a run ends at a point, or a
 * step passes two points. */
static bool is_repeated(const struct gb_moduli_state *a, const struct gb_moduli_state *b)
{
    return a->count == b->count && memcmp(a->sum, b->sum, sizeof a->sum) == 0;
}

/* The existing states in the order of the run, each once. */
static GArray *list_states(const struct collector *collector)
{
    GArray *list = g_array_new(FALSE, FALSE, sizeof(struct gb_moduli_state));
    for (guint k = 0; k < collector->state->len; k++) {
        bool wanted = state_at(collector, k)->count > 0;
        for (guint i = 0; i < k && wanted; i++) {
            wanted = !is_repeated(state_at(collector, i), state_at(collector, k));
        }
        if (wanted) {
            g_array_append_vals(list, state_at(collector, k), 1);
        }
    }
    if (collector->total == 0) {
        gb_moduli_table_sort(list);
    }
    return list;
}

/* Adds the replica's states to the means.  The last state of a run that stopped early
 * does not enter a mean. */
static void add_to_points(struct collector *collector,
                          const struct gb_moduli_table_row *row)
{
    const bool alone = collector->request->replicas == 1;
    unsigned what = row->what & (GB_KEEP_WALK_END | (GB_KEEP_WALK_END - 1));
    if ((row->what & GB_KEEP_WALK_STOPPED) && alone) {
        what |= GB_KEEP_WALK_END;
    }
    for (int k = 0; k < collector->points.count; k++) {
        if (what & 1U << k) {
            gb_moduli_table_add(state_at(collector, (guint)k), row);
        }
    }
    if (what & GB_KEEP_WALK_END) {
        gb_moduli_table_add(state_at(collector, (guint)collector->points.count), row);
    }
    collector->reached |= what;
}

static bool add_row(void *data, const struct gb_moduli_table_row *row,
                    struct gb_error *err)
{
    struct collector *collector = data;
    if (collector->total > 0) {
        struct gb_moduli_state state = {0};
        gb_moduli_table_add(&state, row);
        g_array_append_val(collector->state, state);
    } else {
        add_to_points(collector, row);
    }
    if (!(row->what & GB_KEEP_WALK_VISITED)) {
        print_progress(collector, row);
    }
    GArray *list = list_states(collector);
    const bool good =
        list->len == 0 || moduli_folder_write(&collector->folder, list, err);
    g_array_free(list, TRUE);
    return good;
}

static bool is_new(void *data, int64_t step)
{
    const struct collector *collector = data;
    return !gb_moduli_table_has(collector->folder.earlier, step);
}

static void print_states(const struct request *request, const GArray *states)
{
    if (request->csv || request->json) {
        gb_options_print(gb_listing_end(gb_moduli_table_listing(states, NULL),
                                        request->json ? GB_LISTING_JSON : GB_LISTING_CSV),
                         NULL); /* main reports errors of stdout */
        return;
    }
    for (guint s = 0; s < states->len; s++) {
        if (s > 0) {
            gb_visible_put(stdout, "\n");
        }
        moduli_output_state(&g_array_index(states, struct gb_moduli_state, s));
    }
}

static struct gb_moduli_table_sink sink_of(struct collector *collector)
{
    return (struct gb_moduli_table_sink){.row = add_row,
                                         .data = collector,
                                         .wanted = is_new,
                                         .cancelled = gb_progress_cancelled,
                                         .range = !collector->request->quick};
}

/* Counts the present replica as missing at the points that it did not reach. */
static void end_replica(struct collector *collector)
{
    for (int k = 0; k <= collector->points.count; k++) {
        const unsigned bit =
            k < collector->points.count ? 1U << k : (unsigned)GB_KEEP_WALK_END;
        state_at(collector, (guint)k)->missing += !(collector->reached & bit);
    }
}

/* Fails for a point that all replicas missed; why: the error of the first that stopped.
 */
static bool check_reached(const struct collector *collector, const struct gb_error *why,
                          struct gb_error *err)
{
    const int replicas = collector->request->replicas;
    for (int k = 0; k < collector->points.count; k++) {
        const struct gb_keep_point *at = &collector->points.point[k];
        const int missing = state_at(collector, (guint)k)->missing;
        if (missing > 0) {
            return gb_error_set(err, GB_ERR_GUARD,
                                "%s = %g%s: reached by %d of %d runs%s%s",
                                at->by_density ? "density" : "p",
                                at->by_density ? at->value : 1e-6 * at->value,
                                at->by_density ? "" : " MPa", replicas - missing,
                                replicas, why->code != GB_OK ? "; " : "", why->text);
        }
    }
    return why->code == GB_OK || gb_error_set(err, why->code, "%s", why->text);
}

/* Probes runs of one preset that differ by their seed.  A run that stops early does not
 * end the others. */
static bool probe_preset(const struct request *request, const struct gb_params *params,
                         struct collector *collector, struct gb_error *err)
{
    const struct gb_moduli_table_sink sink = sink_of(collector);
    struct gb_error why = {0};
    collector->points = request->points;
    if (request->at == NULL) {
        (void)gb_keep_points_parse(params->snapshots_at, &collector->points, NULL);
    }
    g_array_set_size(collector->state, (guint)collector->points.count + 1);
    for (int k = 0; k < request->replicas; k++) {
        struct gb_params replica = *params;
        struct gb_error own = {0};
        int missed = 0;
        replica.seed += (uint64_t)k;
        collector->reached = 0;
        if (!gb_moduli_table_run(&replica, &collector->points, &sink, &missed, &own)) {
            if (own.code != GB_ERR_GUARD && own.code != GB_ERR_NOT_CONVERGED) {
                *err = own;
                return false;
            }
            why = why.code == GB_OK ? own : why;
        }
        end_replica(collector);
    }
    GArray *list = list_states(collector);
    const bool good =
        list->len == 0 || moduli_folder_write(&collector->folder, list, err);
    g_array_free(list, TRUE);
    return good && check_reached(collector, &why, err);
}

static bool check_replicas(const struct request *request, const struct gb_params *params,
                           struct gb_error *err)
{
    if (request->replicas < 1 || request->replicas > REPLICAS_MAX) {
        return gb_error_set(err, GB_ERR_INPUT, "--replicas %d: must be 1 to %d",
                            request->replicas, REPLICAS_MAX);
    }
    return gb_seed_check_cells(params, (size_t)request->replicas, err);
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
                      moduli_folder_begin(&collector->folder, preset, err) &&
                      probe_preset(request, params, collector, err);
    gb_preset_destroy(preset);
    return done;
}

/* Probes the states of a run directory, each point once; with --at only those nearest
 * to its points. */
static bool run_directory(const struct request *request, const char *directory,
                          struct collector *collector, struct gb_error *err)
{
    const struct gb_moduli_table_sink sink = sink_of(collector);
    GPtrArray *paths = moduli_folder_open(&collector->folder, directory, err)
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

/* Prints what was probed, even after a later error. */
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
    moduli_folder_init(&collector.folder, request->out, request->command);
    collector.state = g_array_new(FALSE, TRUE, sizeof(struct gb_moduli_state));
    done = done && (directory ? run_directory(request, words[0], &collector, &err)
                              : run_preset(request, words, &collector, &err));
    GArray *list = list_states(&collector);
    if (list->len > 0) {
        print_states(request, list);
    }
    g_array_free(list, TRUE);
    g_array_free(collector.state, TRUE);
    moduli_folder_finish(&collector.folder);
    if (done) {
        return 0;
    }
    (void)gb_options_fail(&err);
    return gb_progress_exit_status(&err);
}

int gb_cmd_moduli(int argc, char **argv)
{
    struct request request = {.replicas = 1};
    const GOptionEntry entries[] = {
        {"csv", 0, 0, G_OPTION_ARG_NONE, &request.csv,
         "one header row and one row per state", NULL},
        gb_options_json(&request.json),
        {"at", 0, 0, G_OPTION_ARG_STRING, &request.at,
         "states to probe, as \"p=100 MPa; density=0.5\" (default: the points "
         "of output.snapshots_at and the last one; of a lattice, the initial one)",
         "POINTS"},
        {"replicas", 0, 0, G_OPTION_ARG_INT, &request.replicas,
         "runs that differ by their seed (default: 1); means with standard errors", "N"},
        {"out", 'o', 0, G_OPTION_ARG_FILENAME, &request.out,
         "folder for moduli.csv, which plot --figure moduli draws; in the directory of the "
         "run itself, only new states are probed",
         "DIR"},
        {"no-range", 0, 0, G_OPTION_ARG_NONE, &request.quick,
         "skip the elastic range; takes half the time", NULL},
        gb_options_quiet(&request.quiet),
        {0},
    };
    static const struct gb_options_page page = {
        "PRESET|DIR [group.key=value]...",
        "Elastic moduli of a packing.  A copy is strained a little in six ways, each in both\n"
        "directions; particles move and turn freely, and contacts keep their histories.\n"
        "PRESET is run and probed on the way; of a run DIR, the kept states and the last\n"
        "state are probed.",
        "Lattices: greenbody moduli default structure.kind=fcc structure.overlap=0.03\n"
        "particles.count=500.  docs/mechanics.md has the definitions."};
    char **words = NULL;
    int status = 0;
    request.command = gb_options_command("", argc, argv);
    if (gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        gb_progress_catch_signals(GB_SIGNALS_HANGUP_ENDS);
        status = perform(&request, words);
    }
    g_free(request.at);
    g_free(request.out);
    g_free(request.command);
    g_strfreev(words);
    return status;
}
