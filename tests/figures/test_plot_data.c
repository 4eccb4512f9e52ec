#include <math.h>
#include <stdbool.h>
#include <string.h>

#include <glib.h>
#include <glib/gstdio.h>

#include "common/program.h"
#include "common/tree.h"

/* `greenbody plot` on run directories with known curves. */

static const char *program;
static char *folder;

static const char header[] = "# made up\nbranch,step,density,p_MPa,time_ns\n";

/* P2 Table 1, v1. */
static double relaxation(double t)
{
    return 2603.9 + 441.1 * exp(-t / 0.0719) + 35.3 * exp(-t / 4.9304);
}

/* p_stat and k_v of (9), with an offset per seed. */
static double pressure(double rho, double rate, int seed)
{
    return 5000.0 * pow(rho - 0.5, 2.0) + 21.5 * pow(rate, 0.25) * pow(rho - 0.5, 3.0) +
           seed;
}

static void write_in(const char *name, const char *file, const char *text)
{
    char *path = g_build_filename(folder, name, NULL);
    g_mkdir_with_parents(path, 0700);
    char *full = g_build_filename(path, file, NULL);
    g_assert_true(g_file_set_contents(full, text, -1, NULL));
    g_free(full);
    g_free(path);
}

static void write_preset(const char *name, double rate, int seed, const char *more)
{
    char *text = g_strdup_printf(
        "[scene]\ntitle = %s\nkind = dynamic\ndimension = 2\n[particles]\ncount = 1000\n"
        "[structure]\nseed = %d\n[loading]\ngeometry = isotropic\n"
        "until = density = 0.95\nrate = %g 1/us\n%s",
        name, seed, rate * 1e-6, more);
    write_in(name, "preset.ini", text);
    g_free(text);
}

static void write_run(const char *name, double rate, int seed)
{
    GString *curve = g_string_new(header);
    for (int i = 0; i <= 90; i++) {
        /* the end of real runs is short of the order by rounding, of some */
        const double rho = i < 90 || seed % 2 ? 0.5 + 0.005 * i : 0.95 * (1.0 - 1e-12);
        g_string_append_printf(curve, "load,%d,%.17g,%.17g,%.17g\n", i, rho,
                               pressure(rho, rate, seed), 10.0 + 0.01 * i);
    }
    for (int i = 1; i <= 900; i++) {
        const double t = 30.0 * pow(i / 900.0, 3.0);
        g_string_append_printf(curve, "hold,%d,0.95,%.17g,%.17g\n", 90 + i,
                               relaxation(t) + 1e-3 * sin(1e4 * i), 10.9 + t);
    }
    write_preset(name, rate, seed, "");
    write_in(name, "curve.csv", curve->str);
    g_string_free(curve, TRUE);
}

/* Words may name runs; the program is called in their folder. */
static struct result call(const char *words)
{
    char *line = g_strconcat("plot ", words, NULL);
    const struct result result = program_call(program, folder, line);
    g_free(line);
    return result;
}

/* The cell of a column in a row of data (from 0); NaN when empty. */
static double cell(const char *csv, const char *column, int row)
{
    char **lines = g_strsplit(csv, "\n", -1);
    int head = 0;
    while (lines[head][0] == '#') {
        head++;
    }
    char **names = g_strsplit(lines[head], ",", -1);
    guint k = 0;
    while (names[k] != NULL && strcmp(names[k], column) != 0) {
        k++;
    }
    if (names[k] == NULL) {
        g_error("no column %s in: %s", column, lines[head]);
    }
    char **cells = g_strsplit(lines[head + 1 + row], ",", -1);
    g_assert_cmpuint(g_strv_length(cells), ==, g_strv_length(names));
    const double value = cells[k][0] ? g_ascii_strtod(cells[k], NULL) : (double)NAN;
    g_strfreev(cells);
    g_strfreev(names);
    g_strfreev(lines);
    return value;
}

static struct result fine(const char *words)
{
    struct result result = call(words);
    g_test_message("%s: %d %s", words, result.status, result.err);
    g_assert_cmpint(result.status, ==, 0);
    g_assert_cmpstr(result.err, ==, "");
    return result;
}

static void near_to(double got, double want, double margin)
{
    g_assert_cmpfloat(fabs(got - want), <=, margin);
}

static void test_time(void)
{
    struct result result = fine("a1 a2 --figure time");
    near_to(cell(result.out, "time_ns", 0), 10.0, 1e-9);
    near_to(cell(result.out, "run_1_MPa", 0), 1.0, 1e-9);
    near_to(cell(result.out, "run_2_MPa", 0), 2.0, 1e-9);
    near_to(cell(result.out, "mean_1_MPa", 0), 1.5, 1e-9);
    near_to(cell(result.out, "se_1_MPa", 0), 0.5, 1e-9);
    program_finish(&result);
}

static void test_densification(void)
{
    struct result result = fine("a1 b1 a2 --figure densification");
    g_assert_nonnull(strstr(result.out, "# group 1: 2 runs, loading.rate = "));
    const int row = 80; /* 0.9 */
    near_to(cell(result.out, "density", row), 0.9, 1e-9);
    near_to(cell(result.out, "mean_1_MPa", row), pressure(0.9, 6.8e8, 0) + 1.5, 1e-6);
    near_to(cell(result.out, "se_1_MPa", row), 0.5, 1e-6);
    near_to(cell(result.out, "mean_2_MPa", row), pressure(0.9, 6.8e7, 1), 1e-6);
    g_assert_true(isnan(cell(result.out, "se_2_MPa", row)));
    near_to(cell(result.out, "asymptote_1_MPa", row), 691.66423634, 1e-5);
    g_assert_true(isnan(cell(result.out, "asymptote_1_MPa", 0)));
    g_assert_null(strstr(result.out, "asymptote_2"));
    program_finish(&result);
}

/* Runs that differ after the loading only are one group in a figure of the loading
 * branch, but equal seeds count once. */
static void test_held(void)
{
    static const char *const hold = "hold = 2 ns\n";
    char *curve = g_build_filename(folder, "a1", "curve.csv", NULL);
    char *text = NULL;
    g_assert_true(g_file_get_contents(curve, &text, NULL, NULL));
    write_preset("h3", 6.8e8, 3, hold);
    write_in("h3", "curve.csv", text);
    write_preset("h1", 6.8e8, 1, hold);
    write_in("h1", "curve.csv", text);
    struct result result = fine("a1 a2 h3 --figure densification");
    g_assert_nonnull(strstr(result.out, "# group 1: 3 runs\n"));
    g_assert_null(strstr(result.out, "# group 2"));
    program_finish(&result);
    result = fine("a1 h1 --figure densification");
    g_assert_nonnull(strstr(result.out, "# group 1: 1 runs, loading.hold"));
    g_assert_nonnull(strstr(result.out, "# group 2: 1 runs, loading.hold = 2 ns"));
    program_finish(&result);
    result = fine("a1 a2 h3 --figure time");
    g_assert_nonnull(strstr(result.out, "# group 2: 1 runs, loading.hold = 2 ns"));
    program_finish(&result);
    g_free(text);
    g_free(curve);
}

static void test_difference(void)
{
    const char *const words[] = {"a1 a2 b1 b2 --figure difference --reference b2",
                                 "a1 a2 b1 --figure difference --reference ./b2/"};
    for (size_t i = 0; i < G_N_ELEMENTS(words); i++) {
        struct result result = fine(words[i]);
        const double want = pressure(0.9, 6.8e8, 0) - pressure(0.9, 6.8e7, 0);
        near_to(cell(result.out, "difference_1_MPa", 80), want, 1e-6);
        near_to(cell(result.out, "se_1_MPa", 80), 0.5 * sqrt(2.0), 1e-6);
        g_assert_null(strstr(result.out, "difference_2"));
        program_finish(&result);
    }
}

static void test_rate(void)
{
    struct result result =
        fine("a1 a2 b1 b2 c1 c2 d1 d2 --figure rate --density 0.8,0.9,0.99");
    near_to(cell(result.out, "density", 0), 0.8, 0.0);
    near_to(cell(result.out, "rate_per_s", 0), 6.8e8, 1.0);
    near_to(cell(result.out, "p_MPa", 0), pressure(0.8, 6.8e8, 0) + 1.5, 1e-3);
    near_to(cell(result.out, "se_MPa", 0), 0.5, 1e-6);
    near_to(cell(result.out, "runs", 0), 2.0, 0.0);
    near_to(cell(result.out, "fit_MPa", 0), cell(result.out, "p_MPa", 0), 1e-2);
    g_assert_nonnull(strstr(result.out, "n = 0.25 ("));
    g_assert_nonnull(strstr(result.out, "k_v = 21.5 ("));
    g_assert_nonnull(strstr(result.out, "free exponent of the rate: 0.25 ("));
    g_assert_null(strstr(result.out, "0.99"));
    program_finish(&result);
    result = fine("a1 a2 b1 b2 c1 c2 --figure rate --density 0.95");
    for (int row = 0; row < 3; row++) {
        near_to(cell(result.out, "runs", row), 2.0, 0.0);
    }
    program_finish(&result);
    result = fine("a1 b1 --figure rate");
    g_assert_nonnull(strstr(result.out, "no power law: 2 different rates"));
    program_finish(&result);
}

static void test_relaxation(void)
{
    struct result result = fine("a1 a2 b1 --figure relaxation");
    for (int row = 0; row < 2; row++) {
        near_to(cell(result.out, "group", row), row + 1, 0.0);
        near_to(cell(result.out, "runs", row), 2 - row, 0.0);
        near_to(cell(result.out, "exponentials", row), 2.0, 0.0);
        near_to(cell(result.out, "p0_MPa", row), 2603.9, 0.01);
        near_to(cell(result.out, "p1_MPa", row), 441.1, 0.01);
        near_to(cell(result.out, "tau1_ns", row), 0.0719, 1e-5);
        near_to(cell(result.out, "p2_MPa", row), 35.3, 0.01);
        near_to(cell(result.out, "tau2_ns", row), 4.9304, 1e-3);
        near_to(cell(result.out, "fall_MPa", row), 476.4, 0.02);
        near_to(cell(result.out, "efold_ns", row), 0.08224, 2e-5);
        g_assert_cmpfloat(cell(result.out, "tau2_low_ns", row), <, 4.9304 + 1e-3);
        g_assert_cmpfloat(cell(result.out, "tau2_high_ns", row), >, 4.9304 - 1e-3);
    }
    program_finish(&result);
}

static bool is_there(const char *name)
{
    char *path = g_build_filename(folder, name, NULL);
    const bool there = g_file_test(path, G_FILE_TEST_EXISTS);
    g_free(path);
    return there;
}

static void test_output(void)
{
    struct result result = fine("a1 --figure time -o x.csv");
    g_assert_cmpstr(result.out, ==, "");
    program_finish(&result);
    result = call("a1 --figure time -o x.csv");
    g_assert_cmpint(result.status, ==, 2);
    g_assert_nonnull(strstr(result.err, "x.csv: exists; --force replaces it"));
    program_finish(&result);
    result = fine("a1 --figure densification -o x.csv --force");
    program_finish(&result);
    char *text = NULL;
    char *path = g_build_filename(folder, "x.csv", NULL);
    g_assert_true(g_file_get_contents(path, &text, NULL, NULL));
    g_assert_nonnull(strstr(text, "\ndensity,mean_1_MPa,se_1_MPa,asymptote_1_MPa\n"));
    g_free(text);
    g_free(path);
}

/* A figure of each format with its data; existing files are not replaced. */
static void test_figures(void)
{
    static const char *const names[] = {"fig.png", "fig2.svg", "fig3.pdf"};
    for (size_t k = 0; k < G_N_ELEMENTS(names); k++) {
        char *words = g_strdup_printf("a1 a2 b1 --figure densification --size 400x300 "
                                      "--title <b -o %s",
                                      names[k]);
        char *twin =
            g_strdup_printf("%s/%.*s.csv", folder, (int)strlen(names[k]) - 4, names[k]);
        char *text = NULL;
        struct result result = fine(words);
        program_finish(&result);
        g_assert_true(g_file_get_contents(twin, &text, NULL, NULL));
        g_assert_nonnull(strstr(text, "\ndensity,mean_1_MPa,se_1_MPa,"));
        result = call(words);
        g_assert_cmpint(result.status, ==, 2);
        g_assert_nonnull(strstr(result.err, "exists; --force replaces it"));
        program_finish(&result);
        g_free(text);
        g_free(twin);
        g_free(words);
    }
}

/* A second format beside the first has the same CSV and needs no --force; other data do. */
static void test_second_format(void)
{
    struct result result = fine("a1 a2 --figure densification -o both.pdf");
    program_finish(&result);
    result = fine("a1 a2 --figure densification -o both.svg");
    program_finish(&result);
    g_assert_true(is_there("both.svg"));
    result = call("a1 b1 --figure densification -o both.png");
    g_assert_cmpint(result.status, ==, 2);
    g_assert_cmpstr(result.err, ==,
                    "greenbody: both.csv: exists with other data; --force replaces it\n");
    g_assert_false(is_there("both.png"));
    program_finish(&result);
    result = fine("a1 b1 --figure densification -o both.png --force");
    program_finish(&result);
}

/* Against the rate one rate is a dot: refused before a file is written; its numbers are in
 * a CSV, the fit also beside the decay. */
static void test_one_rate(void)
{
    static const char *const figures[] = {"rate", "relaxation", "relaxation-amplitude"};
    for (size_t k = 0; k < G_N_ELEMENTS(figures); k++) {
        char *words = g_strdup_printf("a1 a2 --figure %s -o dot.svg", figures[k]);
        char *reason = g_strdup_printf(
            "greenbody: %s: all points have rate_per_s = 6.8e+08; a figure takes two "
            "values of it or more, a CSV one\n",
            figures[k]);
        struct result result = call(words);
        g_assert_cmpstr(result.err, ==, reason);
        g_assert_cmpint(result.status, ==, 2);
        g_assert_false(is_there("dot.svg") || is_there("dot.csv"));
        program_finish(&result);
        g_free(reason);
        g_free(words);
    }
    struct result result = fine("a1 a2 --figure relaxation -o dot.csv");
    program_finish(&result);
    g_assert_true(is_there("dot.csv"));
    result = fine("a1 b1 --figure relaxation -o two.svg");
    program_finish(&result);
    result = fine("a1 a2 --figure decay");
    g_assert_nonnull(strstr(result.out, "# group 1: fit of P2 (4), p0 = 2603.9 ("));
    g_assert_nonnull(strstr(result.out, ", tau2 = 4.930"));
    program_finish(&result);
}

static void test_data(void)
{
    write_in(".", "lab.csv",
             "density,p_MPa,p_MPa_error,series\n0.6,50,5,press A\n0.7,90,,press B\n"
             "0.8,200,,press A\n");
    struct result result = fine("a1 --figure densification --data lab.csv");
    near_to(cell(result.out, "data_1_density", 0), 0.6, 0.0);
    near_to(cell(result.out, "data_1_p_MPa", 1), 200.0, 0.0);
    near_to(cell(result.out, "data_1_p_MPa_error", 0), 5.0, 0.0);
    near_to(cell(result.out, "data_2_p_MPa", 0), 90.0, 0.0);
    g_assert_true(isnan(cell(result.out, "data_2_p_MPa", 1)));
    program_finish(&result);
}

/* Laws need no run: the bridged branch of P1 Fig. 1 passes through C and ends at D. */
static void test_laws(void)
{
    struct result result = fine("--figure contact");
    near_to(cell(result.out, "h_C", 0), 0.008, 1e-12);
    near_to(cell(result.out, "h_C", 400), 0.0, 1e-12);
    near_to(cell(result.out, "h_loading", 400), 0.02, 1e-12);
    g_assert_cmpfloat(cell(result.out, "f_C_nN", 400), <, -60.0);
    program_finish(&result);
    /* P3: 0.02 N at 0.83 % of the diameter by Hertz, 0.93 % without hardening */
    result = fine("--figure pair");
    near_to(cell(result.out, "h_nm", 166), 166.0, 1.0);
    near_to(cell(result.out, "force_mN_0", 166), 20.0, 0.2);
    near_to(cell(result.out, "force_mN_1", 186), 20.0, 0.3);
    program_finish(&result);
    result = fine("--figure critical-step");
    g_assert_cmpfloat(cell(result.out, "step_ns_0", 10), >,
                      cell(result.out, "step_ns_1", 10));
    program_finish(&result);
    write_in("errors", "chart.csv",
             "relaxer,particles,reference,seeds,evaluations,cpu_s,bound,front,chosen,"
             "error_5MPa,error_se_5MPa,scatter_5MPa,error_40MPa,error_se_40MPa,"
             "scatter_40MPa\n"
             "fire,1000,1,3,900,9,,0,0,0,0,0.003,0,0,0.001\n"
             "fire,1000,0,3,200,2,0.01,1,0,0.008,0.002,0.005,-0.004,0.001,0.007\n"
             "fire,1000,0,3,100,1,0.02,1,1,-0.02,0,,-0.02,0,\n"
             "fire,500,0,3,300,3,,0,0,0.1,0.01,0.5,,,\n");
    result = fine("errors --figure chart");
    near_to(cell(result.out, "front_cpu_s", 0), 1.0, 0.0);
    near_to(cell(result.out, "front_bound", 1), 1.0, 1e-12);
    near_to(cell(result.out, "chosen_bound", 0), 2.0, 1e-12);
    program_finish(&result);
    result = fine("errors --figure chart-error"); /* at the last pressure */
    near_to(cell(result.out, "evaluations_1", 0), 200.0, 0.0);
    near_to(cell(result.out, "error_1_points", 0), -0.4, 1e-12);
    near_to(cell(result.out, "error_1_se_points", 0), 0.1, 1e-12);
    near_to(cell(result.out, "error_1_points", 1), -2.0, 1e-12);
    near_to(cell(result.out, "scatter_points", 0), 0.5, 1e-12); /* of 0.1 and 0.7 */
    near_to(cell(result.out, "scatter_evaluations", 1), 900.0, 0.0);
    program_finish(&result);
    result = fine("errors --figure chart-error --pressure 5MPa");
    near_to(cell(result.out, "error_1_points", 0), 0.8, 1e-12);
    near_to(cell(result.out, "error_2_points", 0), 10.0, 1e-12);
    near_to(cell(result.out, "scatter_points", 1), 0.1 * sqrt(17.0), 1e-12);
    program_finish(&result);
    result = call("errors --figure chart-error --pressure 7MPa");
    g_assert_cmpint(result.status, ==, 2);
    g_assert_nonnull(
        strstr(result.err, "--pressure 7 MPa: the chart has 5 MPa, 40 MPa\n"));
    program_finish(&result);
    write_in("unpressed", "chart.csv", "relaxer,particles,cpu_s\nfire,1000,2\n");
    result = call("unpressed --figure chart-error");
    g_assert_cmpint(result.status, ==, 2);
    g_assert_nonnull(strstr(result.err, "chart.csv: no error at a pressure"));
    program_finish(&result);
    write_in("die", "preset.ini",
             "[scene]\nkind = die\n[contact]\nnormal = hertz\n"
             "[loading]\ngeometry = die\n");
    write_in("die", "curve.csv",
             "branch,p_MPa,wanted_MPa,density,central_density,height_change\n"
             "load,1.1,1,0.6,0.65,-0.01\nload,2.1,2,0.62,0.67,-0.02\n");
    result = fine("die --figure die-density");
    near_to(cell(result.out, "p_MPa", 1), 2.0, 0.0);
    near_to(cell(result.out, "density_1", 1), 0.62, 1e-12);
    near_to(cell(result.out, "central_density_1", 0), 0.65, 1e-12);
    program_finish(&result);
    result = fine("die --figure die-height");
    near_to(cell(result.out, "height_change_1", 1), -0.02, 1e-12);
    program_finish(&result);
    result = fine("--figure bridge-strength");
    g_assert_cmpfloat(cell(result.out, "strength_0.01_GPa", 0), <, 382.0 / 30.0);
    program_finish(&result);
}

/* Words, and a part of the one line on stderr; exit status 2. */
static const char *const refused[][2] = {
    {"", "--figure : expected a name that greenbody plot --help lists"},
    {"a1", "--figure : expected a name"},
    {"a1 --figure pie", "--figure pie: expected a name"},
    {"a1 --figure densificaton",
     "--figure densificaton: did you mean densification? expected a name"},
    {"--figure time", "1 to 1000 run directories"},
    {"a1 --figure time --bogus", "Unknown option --bogus"},
    {"a1 --figure time -o x.gif", "a name ending in .png, "},
    {"a1 --figure time -o y.png --size 0x100", "16 to 16384 a side"},
    {"a1 --figure time -o y.png --size 100000x100000", "16 to 16384 a side"},
    {"a1 --figure time --log z", "--log z: expected x, y or xy"},
    {"a1 --figure time --at p=1MPa",
     "--at is for the figures rdf, contacts, force-angle, sizes"},
    {"a1 --figure time --pressure 1MPa", "--pressure is for the figures size-effect"},
    {"a1 --figure time --data nodata.csv", "nodata.csv: No such file"},
    {"a1 --figure time --data a1/curve.csv --log y --data nocolumn/curve.csv",
     "no column time_ns"},
    {"a1 --figure rdf", "a1/state.h5: no such file"},
    {"a1 --figure lateral", "no column px_MPa"},
    {"--figure contact nopreset.ini", "nopreset.ini"},
    {"--figure contact contact.bridge_length=\"1 d\"", "the scene has no bridges"},
    {"a1 --figure time -o .csv/x.csv", ".csv/x.csv"},
    {"a1 b1 --figure difference", "needs --reference DIR"},
    {"a1 --figure time --reference a1", "--reference is for the figure difference"},
    {"a1 --figure time --density 0.9",
     "--density is for the figures rate, rate-difference"},
    {"a1 --figure rate --density x", "--density x: expected"},
    {"a1 --figure rate --density 0.9,", "expected"},
    {"a1 --figure rate --density 5", "between 0 and 2"},
    {"a1 --figure rate --density 0.99", "no run reaches density 0.99"},
    {"a1 a2 --figure difference --reference a1", "two groups"},
    {"nowhere --figure time", "nowhere: is not a run directory"},
    {"a1 a1 --figure time", "a1: same preset and seed as a1"},
    {"nopreset --figure time", "is not a run directory"},
    {"nocurve --figure time", "nocurve/curve.csv: No such file"},
    {"nocolumn --figure time", "no column time_ns; there are branch, density, p_MPa"},
    {"nocolumn --figure relaxation", "no column time_ns"},
    {"nobranch --figure time", "no column branch"},
    {"norows --figure densification", "norows/curve.csv: no point of branch load"},
    {"nohold --figure relaxation", "no point of branch hold"},
    {"short --figure relaxation", "short: relaxation: 2 points of a relaxation"},
    {"falls --figure densification", "density falls from 0.6 to 0.5"},
    {"broken --figure time", "broken/curve.csv:2: p_MPa = 'x'"},
    {"badpreset --figure time", "badpreset/preset.ini:"},
    {"still --figure rate", "scene.kind is not dynamic"},
    {"still --figure die-density", "scene.kind is not die"},
    {"a1 a2 --figure size-effect", "all runs have one diameter"},
    {"a1 b1 --figure chart", "take one directory of `greenbody chart`"},
    {"nowhere --figure chart", "nowhere: No such file"},
    {"still --figure relaxation", "scene.kind is not dynamic"},
    {"a1 other --figure rate", "a1 and other differ in contact.mu"},
};

static void write_broken(void)
{
    write_in("nopreset", "curve.csv", header);
    write_preset("nocurve", 1e8, 1, "");
    write_preset("nocolumn", 1e8, 1, "");
    write_in("nocolumn", "curve.csv", "branch,density,p_MPa\nload,0.5,1\nhold,0.5,1\n");
    write_preset("nobranch", 1e8, 1, "");
    write_in("nobranch", "curve.csv", "density,p_MPa,time_ns\n0.5,1,1\n");
    write_preset("norows", 1e8, 1, "");
    write_in("norows", "curve.csv", header);
    write_preset("nohold", 1e8, 1, "");
    write_in("nohold", "curve.csv", "branch,density,p_MPa,time_ns\nload,0.5,1,1\n");
    write_preset("short", 1e8, 1, "");
    write_in("short", "curve.csv",
             "branch,density,p_MPa,time_ns\nload,0.5,1,1\nhold,0.5,1,2\nhold,0.5,1,3\n");
    write_preset("falls", 1e8, 1, "");
    write_in("falls", "curve.csv",
             "branch,density,p_MPa,time_ns\nload,0.6,1,1\nload,0.5,1,2\n");
    write_preset("broken", 1e8, 1, "");
    write_in("broken", "curve.csv", "branch,density,p_MPa,time_ns\nload,0.6,x,1\n");
    write_in("badpreset", "preset.ini", "[contact]\nmu = fish\n");
    write_in("badpreset", "curve.csv", header);
    write_in("still", "preset.ini", "[scene]\ntitle = still\n");
    write_in("still", "curve.csv", "branch,density,p_MPa,time_ns\nload,0.6,1,1\n");
    write_preset("other", 1e8, 1, "[contact]\nmu = 0.3\n");
    write_in("other", "curve.csv", "branch,density,p_MPa,time_ns\nload,0.6,1,1\n");
}

static void test_refused(void)
{
    for (size_t i = 0; i < G_N_ELEMENTS(refused); i++) {
        struct result result = call(refused[i][0]);
        g_test_message("%s: %d %s", refused[i][0], result.status, result.err);
        g_assert_cmpint(result.status, ==, 2 + (strstr(refused[i][0], ".csv/") != NULL));
        g_assert_cmpstr(result.out, ==, "");
        g_assert_true(g_str_has_prefix(result.err, "greenbody: "));
        g_assert_nonnull(strstr(result.err, refused[i][1]));
        const char *newline = strchr(result.err, '\n');
        g_assert_true(newline && newline[1] == '\0'); /* one line */
        program_finish(&result);
    }
}

/* Usage: test_plot_data PROGRAM */
int main(int argc, char **argv)
{
    static const struct {
        const char *name;
        double rate;
        int seed;
    } runs[] = {{"a1", 6.8e8, 1}, {"a2", 6.8e8, 2}, {"b1", 6.8e7, 1}, {"b2", 6.8e7, 2},
                {"c1", 6.8e6, 1}, {"c2", 6.8e6, 2}, {"d1", 6.8e5, 1}, {"d2", 6.8e5, 2}};
    g_test_init(&argc, &argv, NULL);
    g_assert_cmpint(argc, ==, 2);
    program = argv[1];
    folder = g_dir_make_tmp("plot-XXXXXX", NULL);
    g_setenv("LC_ALL", "C.UTF-8", TRUE);
    for (size_t i = 0; i < G_N_ELEMENTS(runs); i++) {
        write_run(runs[i].name, runs[i].rate, runs[i].seed);
    }
    write_broken();
    g_test_add_func("/plot/time", test_time);
    g_test_add_func("/plot/densification", test_densification);
    g_test_add_func("/plot/held", test_held);
    g_test_add_func("/plot/difference", test_difference);
    g_test_add_func("/plot/rate", test_rate);
    g_test_add_func("/plot/relaxation", test_relaxation);
    g_test_add_func("/plot/one-rate", test_one_rate);
    g_test_add_func("/plot/output", test_output);
    g_test_add_func("/plot/figures", test_figures);
    g_test_add_func("/plot/second-format", test_second_format);
    g_test_add_func("/plot/data", test_data);
    g_test_add_func("/plot/laws", test_laws);
    g_test_add_func("/plot/refused", test_refused);
    const int status = g_test_run();
    remove_tree(folder);
    g_free(folder);
    return status;
}
