#include <math.h>
#include <stdio.h>
#include <string.h>

#include <glib.h>

#include "cli/commands.h"
#include "cli/options.h"
#include "cli/signals.h"
#include "figures/states.h"
#include "io/preset.h"
#include "run/moduli_table.h"
#include "scene/loading_kind.h"

enum { COLUMNS = GB_MODULI_TABLE_COLUMNS, REPLICAS_MAX = 1000 };

/* The options of the command line. */
struct request {
    gboolean csv, quiet, quick;
    int replicas;
    char *at;
    struct gb_keep_points points; /* of --at */
};

/* Sums over replicas of one state of a run. */
struct state {
    int count;
    double sum[COLUMNS], squares[COLUMNS];
    double c_gpa[6][6];
    bool range_open;
};

struct collector {
    const struct request *request;
    GArray *state; /* struct state */
    guint next;    /* state of the run under way */
};

static bool add_row(void *data, const struct gb_moduli_table_row *row,
                    struct gb_error *err)
{
    struct collector *collector = data;
    (void)err;
    if (collector->next == collector->state->len) {
        g_array_set_size(collector->state, collector->next + 1);
    }
    struct state *state = &g_array_index(collector->state, struct state, collector->next);
    collector->next++;
    state->count++;
    state->range_open = state->range_open || row->range_open;
    for (int k = 0; k < COLUMNS; k++) {
        state->sum[k] += row->value[k];
        state->squares[k] += row->value[k] * row->value[k];
    }
    for (int k = 0; k < 36; k++) {
        state->c_gpa[k / 6][k % 6] += row->c_gpa[k / 6][k % 6];
    }
    if (!collector->request->quiet) {
        fprintf(stderr, "moduli: density %.4f, p %.6g MPa\n",
                row->value[gb_moduli_table_find("density")],
                row->value[gb_moduli_table_find("p_MPa")]);
    }
    return true;
}

static double mean_of(const struct state *state, int k)
{
    return state->sum[k] / state->count;
}

/* Standard error over replicas; NaN for one. */
static double error_of(const struct state *state, int k)
{
    const double n = state->count, mean = mean_of(state, k);
    const double variance = (state->squares[k] - n * mean * mean) / (n - 1.0);
    return n > 1.0 ? sqrt(fmax(variance, 0.0) / n) : (double)NAN;
}

static void print_number(double value)
{
    if (isfinite(value)) {
        printf("%.10g", value);
    }
}

static void print_csv(const GArray *states)
{
    const bool errors =
        states->len > 0 && g_array_index(states, struct state, 0).count > 1;
    for (int k = 0; k < COLUMNS; k++) {
        printf("%s%s", k > 0 ? "," : "", gb_moduli_table_name(k));
    }
    printf(",replicas");
    for (int k = 0; k < COLUMNS && errors; k++) {
        printf(",error_%s", gb_moduli_table_name(k));
    }
    putchar('\n');
    for (guint s = 0; s < states->len; s++) {
        const struct state *state = &g_array_index(states, struct state, s);
        for (int k = 0; k < COLUMNS; k++) {
            print_number(mean_of(state, k));
            putchar(',');
        }
        printf("%d", state->count);
        for (int k = 0; k < COLUMNS && errors; k++) {
            putchar(',');
            print_number(error_of(state, k));
        }
        putchar('\n');
    }
}

/* "123.4" or "123.4 +- 0.5". */
static void print_value(const struct state *state, const char *column, int digits)
{
    const int k = gb_moduli_table_find(column);
    const double error = error_of(state, k);
    char text[64];
    if (!isfinite(mean_of(state, k))) {
        printf("-");
        return;
    }
    g_snprintf(text, sizeof text, "%.*g", digits, mean_of(state, k));
    printf("%s", text);
    if (isfinite(error)) {
        printf(" +- %.2g", error);
    }
}

static double plain(const struct state *state, const char *column)
{
    return mean_of(state, gb_moduli_table_find(column));
}

static void print_matrix(const struct state *state)
{
    static const char *const axes[] = {"xx", "yy", "zz", "yz", "xz", "xy"};
    printf("C, GPa ");
    for (int n = 0; n < 6; n++) {
        printf("%11s", axes[n]);
    }
    putchar('\n');
    for (int m = 0; m < 6; m++) {
        printf("    %s ", axes[m]);
        for (int n = 0; n < 6; n++) {
            printf("%11.5f", state->c_gpa[m][n] / state->count);
        }
        putchar('\n');
    }
}

static void print_line(const struct state *state, const char *title,
                       const char *const columns[][2], const char *unit)
{
    printf("%-15s", title);
    for (int k = 0; columns[k][0] != NULL; k++) {
        printf("%s%s ", k > 0 ? ", " : "", columns[k][1]);
        print_value(state, columns[k][0], 5);
    }
    printf("%s%s\n", unit[0] ? " " : "", unit);
}

static void print_derived(const struct state *state)
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

static void print_state(const struct state *state)
{
    printf("density        ");
    print_value(state, "density", 6);
    printf(", p ");
    print_value(state, "p_MPa", 6);
    printf(" MPa (x %.5g, y %.5g, z %.5g)\n", plain(state, "px_MPa"),
           plain(state, "py_MPa"), plain(state, "pz_MPa"));
    if (state->count > 1) {
        printf("replicas       %d, errors are standard errors of the mean\n",
               state->count);
    }
    printf("probe          strain %.3g; half of it differs by %.1e of the largest C\n",
           plain(state, "probe_strain"), plain(state, "sizes_differ"));
    printf("state          residual %.1e, relaxed by %.2g d (rms), %.2g d at most\n",
           plain(state, "residual"), plain(state, "moved_rms_d"),
           plain(state, "moved_most_d"));
    if (isfinite(plain(state, "elastic_range"))) {
        printf("elastic range  %s%.3g (a secant has lost 5 %%)\n",
               state->range_open ? "above " : "", plain(state, "elastic_range"));
    }
    print_matrix(state);
    print_derived(state);
}

static void print_states(const struct request *request, const GArray *states)
{
    if (request->csv) {
        print_csv(states);
        return;
    }
    for (guint s = 0; s < states->len; s++) {
        if (s > 0) {
            putchar('\n');
        }
        print_state(&g_array_index(states, struct state, s));
    }
}

/* --at in the form of output.snapshots_at; "p=" before a pressure is accepted. */
static bool parse_at(struct request *request, struct gb_error *err)
{
    struct gb_error why;
    char **parts = g_strsplit(request->at ? request->at : "", ";", -1);
    for (int k = 0; parts[k] != NULL; k++) {
        char *part = g_strstrip(parts[k]);
        if (part[0] == 'p' && strchr(" =", part[1]) != NULL) {
            char *value = strchr(part, '=');
            memmove(part, value ? value + 1 : part, strlen(value ? value + 1 : part) + 1);
        }
    }
    char *text = g_strjoinv(";", parts);
    const bool good =
        gb_keep_points_parse(text, &request->points, &why) && request->points.every == 0;
    g_free(text);
    g_strfreev(parts);
    return good || gb_error_set(err, GB_ERR_INPUT,
                                "--at %.80s: must be up to %d pressures or densities "
                                "separated by ';', as in \"p=100 MPa; density=0.5\"",
                                request->at, GB_KEEP_POINTS_MAX);
}

static struct gb_moduli_table_sink sink_of(struct collector *collector)
{
    return (struct gb_moduli_table_sink){.row = add_row,
                                         .data = collector,
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
                      probe_preset(request, params, collector, err);
    gb_preset_destroy(preset);
    return done;
}

/* States of a run directory, each point once; with --at those nearest to its points. */
static bool run_directory(const struct request *request, const char *directory,
                          struct collector *collector, struct gb_error *err)
{
    const struct gb_moduli_table_sink sink = sink_of(collector);
    GPtrArray *paths = gb_states_select(directory, &request->points, err);
    bool good = paths != NULL;
    for (guint k = 0; good && k < paths->len; k++) {
        const char *path = g_ptr_array_index(paths, k);
        good = gb_moduli_table_file(directory, path + strlen(directory) + 1, &sink, err);
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
    struct collector collector = {request, NULL, 0};
    const bool directory = words[0] != NULL && g_file_test(words[0], G_FILE_TEST_IS_DIR);
    bool done = parse_at(request, &err);
    if (done && directory && (words[1] != NULL || request->replicas != 1)) {
        done = gb_error_set(&err, GB_ERR_INPUT,
                            "moduli of a run directory takes no keys and no --replicas");
    }
    collector.state = g_array_new(FALSE, TRUE, sizeof(struct state));
    done = done && (directory ? run_directory(request, words[0], &collector, &err)
                              : run_preset(request, words, &collector, &err));
    if (collector.state->len > 0) {
        print_states(request, collector.state);
    }
    g_array_free(collector.state, TRUE);
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
        {"at", 0, 0, G_OPTION_ARG_STRING, &request.at,
         "states, as \"p=100 MPa; density=0.5\" (default: those of output.snapshots_at "
         "and the last; a lattice as it was placed)",
         "POINTS"},
        {"replicas", 0, 0, G_OPTION_ARG_INT, &request.replicas,
         "runs that differ by their seed; means with standard errors (1)", "N"},
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
    if (gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        gb_signals_install(GB_SIGNALS_HANGUP_ENDS);
        status = perform(&request, words);
    }
    g_free(request.at);
    g_strfreev(words);
    return status;
}
