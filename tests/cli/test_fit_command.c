/* `greenbody fit` on files and runs written here: columns, refusals, the figure. */
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include <glib.h>
#include <glib/gstdio.h>

#include "common/program.h"

static const char *program;
static char *folder;

static struct result call(const char *words)
{
    return program_call(program, folder, words);
}

static void write_file(const char *name, const char *text)
{
    char *path = g_build_filename(folder, name, NULL);
    g_assert_true(g_file_set_contents(path, text, -1, NULL));
    g_free(path);
}

/* Kawakita with a = 0.55, b = 0.03/MPa, D0 = 0.35, and an error of 1e-3 that alternates. */
static double kawakita(double p, int i)
{
    const double c = 0.55 * 0.03 * p / (1.0 + 0.03 * p);
    return 0.35 / (1.0 - c) + (i % 2 ? 1e-3 : -1e-3);
}

static void write_lab(void)
{
    GString *text = g_string_new("p_MPa,density,density_error\n");
    for (int i = 0; i < 24; i++) {
        const double p = pow(1.3, i);
        g_string_append_printf(text, "%.6f,%.6f,0.001\n", p, kawakita(p, i));
    }
    write_file("lab.csv", text->str);
    g_string_append(text, "2000,1,0.001\n");
    write_file("full.csv", text->str);
    g_string_free(text, TRUE);
    write_file("few.csv", "p_MPa,density\n10,0.4\n20,0.5\n30,0.55\n");
    write_file("two.csv", "series,p_MPa,density\nA,10,0.4\nB,20,0.5\n");
}

static void write_run(const char *name, int seed, const char *mu)
{
    char *path = g_build_filename(folder, name, NULL);
    g_assert_cmpint(g_mkdir(path, 0700), ==, 0);
    g_free(path);
    char *preset = g_strdup_printf("[scene]\ntitle = synthetic\n[contact]\nmu = %s\n"
                                   "[structure]\nseed = %d\n",
                                   mu, seed);
    char *file = g_build_filename(name, "preset.ini", NULL);
    write_file(file, preset);
    g_free(file);
    g_free(preset);
    GString *text = g_string_new("branch,step,density,p_MPa\nrelax,0,0.35,0\n");
    for (int i = 1; i < 200; i++) {
        const double p = 2.5 * i;
        g_string_append_printf(text, "load,%d,%.9f,%.6f\n", i,
                               kawakita(p, 0) + 1e-3 + 2e-4 * seed, p);
    }
    g_string_append(text, "unload:497.5MPa,201,0.7,0\n");
    file = g_build_filename(name, "curve.csv", NULL);
    write_file(file, text->str);
    g_free(file);
    g_string_free(text, TRUE);
}

static bool find_row(char **lines, const char *equation, const char *parameter,
                     double value[3])
{
    for (int i = 1; lines[i] != NULL; i++) {
        char **cell = g_strsplit(lines[i], ",", -1);
        const bool here = cell[0] != NULL && strcmp(cell[0], equation) == 0 &&
                          strcmp(cell[1], parameter) == 0;
        for (int k = 0; here && k < 3; k++) {
            value[k] = *cell[2 + k] ? g_ascii_strtod(cell[2 + k], NULL) : (double)NAN;
        }
        g_strfreev(cell);
        if (here) {
            return true;
        }
    }
    return false;
}

/* Six cells a row, numbers, intervals around the values. */
static void check_csv(const char *text)
{
    char **lines = g_strsplit(text, "\n", -1);
    g_assert_cmpstr(lines[0], ==, "equation,parameter,value,low,high,unit");
    int rows = 0;
    for (int i = 1; lines[i] != NULL && *lines[i] != '\0'; i++, rows++) {
        char **cell = g_strsplit(lines[i], ",", -1);
        g_test_message("%s", lines[i]);
        g_assert_cmpuint(g_strv_length(cell), ==, 6);
        g_assert_true(*cell[0] && *cell[1] && *cell[2] && *cell[5]);
        const double value = g_ascii_strtod(cell[2], NULL);
        g_assert_true(isfinite(value));
        g_assert_true(!*cell[3] || g_ascii_strtod(cell[3], NULL) <= value);
        g_assert_true(!*cell[4] || g_ascii_strtod(cell[4], NULL) >= value);
        g_strfreev(cell);
    }
    g_assert_cmpint(rows, >, 2);
    g_strfreev(lines);
}

static void expect(char **lines, const char *equation, const char *parameter,
                   double truth)
{
    double value[3];
    g_assert_true(find_row(lines, equation, parameter, value));
    g_assert_cmpfloat(value[1], <=, truth);
    g_assert_cmpfloat(value[2], >=, truth);
}

static void test_csv(void)
{
    struct result result = call("fit lab.csv --csv");
    g_assert_cmpint(result.status, ==, 0);
    g_assert_cmpstr(result.err, ==, "");
    check_csv(result.out);
    char **lines = g_strsplit(result.out, "\n", -1);
    g_assert_true(g_str_has_prefix(lines[1], "kawakita,a,")); /* the best first */
    expect(lines, "kawakita", "a", 0.55);
    expect(lines, "kawakita", "b", 0.03);
    expect(lines, "kawakita", "D0", 0.35);
    double value[3], from[3], to[3];
    static const char *const names[][2] = {{"heckel", "K"},
                                           {"heckel", "yield_pressure"},
                                           {"cooper-eaton", "k2"},
                                           {"walker", "K"},
                                           {"balshin", "C1"},
                                           {"adams", "alpha"},
                                           {"shapiro-konopicky", "b"},
                                           {"panelli-ambrozio", "A"},
                                           {"secondi", "r_inf"},
                                           {"secondi", "aicc"},
                                           {"secondi", "rms"}};
    for (size_t i = 0; i < G_N_ELEMENTS(names); i++) {
        g_assert_true(find_row(lines, names[i][0], names[i][1], value));
    }
    g_assert_true(find_row(lines, "heckel", "stretch_from", from));
    g_assert_true(find_row(lines, "heckel", "stretch_to", to));
    g_assert_cmpfloat(from[0], <, to[0]);
    g_strfreev(lines);
    program_finish(&result);
}

static void test_window(void)
{
    struct result result =
        call("fit lab.csv --csv --equation kawakita --from 5MPa --to 200MPa "
             "--initial 0.35");
    g_assert_cmpint(result.status, ==, 0);
    check_csv(result.out);
    char **lines = g_strsplit(result.out, "\n", -1);
    double value[3];
    expect(lines, "kawakita", "a", 0.55);
    g_assert_false(find_row(lines, "kawakita", "D0", value));
    g_assert_false(find_row(lines, "heckel", "K", value));
    g_strfreev(lines);
    program_finish(&result);
    result = call("fit lab.csv --from 5MPa --to 200MPa");
    g_assert_nonnull(strstr(result.out, "14 points from 6.275 to 190"));
    g_assert_nonnull(strstr(result.out, "straightest stretch: "));
    g_assert_nonnull(strstr(result.out, "errors of the densities"));
    program_finish(&result);
}

/* Three replicas: their mean, weights, D0 from before loading; unloading left out. */
static void test_runs(void)
{
    struct result result = call("fit one two three --csv");
    g_assert_cmpint(result.status, ==, 0);
    check_csv(result.out);
    char **lines = g_strsplit(result.out, "\n", -1);
    double value[3];
    g_assert_true(find_row(lines, "kawakita", "a", value));
    g_assert_cmpfloat_with_epsilon(value[0], 0.55, 1e-2);
    g_assert_false(find_row(lines, "kawakita", "D0", value));
    g_strfreev(lines);
    program_finish(&result);
    result = call("fit one two three --initial fit");
    g_assert_cmpint(result.status, ==, 0);
    g_assert_nonnull(strstr(result.out, "3 runs, 48 points from 4.975 to 497.5 MPa"));
    g_assert_nonnull(strstr(result.out, "standard errors of the replicas"));
    g_assert_nonnull(strstr(result.out, "D0: unknown, fitted"));
    program_finish(&result);
}

/* The others are printed; each that is not defined is named on stderr. */
static void test_partly(void)
{
    struct result result = call("fit full.csv --csv");
    g_assert_cmpint(result.status, ==, 0);
    check_csv(result.out);
    g_assert_null(strstr(result.out, "heckel,"));
    g_assert_nonnull(strstr(result.out, "walker,"));
    g_assert_nonnull(
        strstr(result.err, "greenbody: heckel: not defined at a density of"));
    program_finish(&result);
    result = call("fit full.csv");
    g_assert_nonnull(strstr(result.out, "\nnot fitted:\nheckel: not defined"));
    program_finish(&result);
}

static void test_figure(void)
{
    struct result result = call("fit lab.csv -o fit.svg");
    g_assert_cmpint(result.status, ==, 0);
    program_finish(&result);
    char *csv = g_build_filename(folder, "fit.csv", NULL);
    char *svg = g_build_filename(folder, "fit.svg", NULL);
    char *text = NULL;
    g_assert_true(g_file_get_contents(csv, &text, NULL, NULL));
    g_assert_nonnull(strstr(text, "residual_kawakita_1_percent"));
    g_free(text);
    g_assert_true(g_file_get_contents(svg, &text, NULL, NULL));
    g_assert_true(strstr(text, "<svg") != NULL && strstr(text, "</svg>") != NULL);
    g_free(text);
    result = call("fit lab.csv -o fit.svg");
    g_assert_cmpint(result.status, ==, 2);
    g_assert_cmpstr(result.out, ==, "");
    g_assert_nonnull(strstr(result.err, "exists"));
    program_finish(&result);
    g_unlink(csv);
    g_unlink(svg);
    g_free(csv);
    g_free(svg);
}

/* The points of lab.csv as a German spreadsheet has them: the same fit, and a line. */
static void write_german(void)
{
    GString *text = g_string_new("Versuch;Al2O3\r\n\r\nNr.;Druck [MPa];rel. Dichte [%];"
                                 "Fehler der Dichte [%]\r\n");
    for (int i = 0; i < 24; i++) {
        const double p = pow(1.3, i);
        g_string_append_printf(text, "%d;%.6f;%.4f;0.1\r\n", i + 1, p,
                               100.0 * kawakita(p, i));
    }
    for (char *c = text->str + strlen("Versuch"); *c != '\0'; c++) {
        *c = *c == '.' && g_ascii_isdigit(c[-1]) ? ',' : *c;
    }
    write_file("german.csv", text->str);
    g_string_free(text, TRUE);
    write_file("thousands.csv", "p (MPa);d (%)\n1,125;45\n2,250;50\n");
    write_file("press.csv", "Weg [mm];Kraft [kN]\n0,0;0,0\n2,0;10,5\n4,0;20,5\n5,0;40,5\n"
                            "5,5;60,5\n4,9;5,5\n");
    write_file("powders.csv", "Probe;p [MPa];TD [%]\nA;10,5;40\nB;10,5;45\nA;20,5;45\n"
                              "A;40,5;50\nA;80,5;55\nA;160,5;60\n");
}

static void test_spreadsheet(void)
{
    struct result own = call("fit lab.csv --csv");
    struct result result = call("fit german.csv --csv");
    g_assert_cmpint(result.status, ==, 0);
    static const char told[] =
        "greenbody: german.csv: pressure from column 2 'Druck [MPa]' in MPa, density from "
        "column 3 'rel. Dichte [%]' in percent, density_error from column 4 'Fehler der "
        "Dichte [%]' in percent; between semicolons, decimal comma, headings in line 3; 24 "
        "points, 1 to 417.5 MPa, relative density 0.3547 to 0.7143; not read: 'Nr.'\n";
    g_assert_cmpstr(result.err, ==, told);
    char **lines[2] = {g_strsplit(own.out, "\n", -1), g_strsplit(result.out, "\n", -1)};
    for (int k = 0; k < 3; k++) {
        static const char *const names[] = {"a", "b", "D0"};
        double value[2][3];
        g_assert_true(find_row(lines[0], "kawakita", names[k], value[0]));
        g_assert_true(find_row(lines[1], "kawakita", names[k], value[1]));
        g_assert_cmpfloat_with_epsilon(value[1][0], value[0][0], 1e-5 * value[0][0]);
        g_assert_cmpfloat_with_epsilon(value[1][1], value[0][1], 1e-3 * value[0][0]);
    }
    g_strfreev(lines[0]);
    g_strfreev(lines[1]);
    program_finish(&own);
    program_finish(&result);
}

/* All that is needed is given: not a word, but of rows that are left out. */
static void test_given(void)
{
    struct result result =
        call("fit thousands.csv --columns pressure=1:MPa,density=2:% --decimal , "
             "--separator ';' --csv");
    g_assert_null(strstr(result.err, "thousands.csv: pressure"));
    program_finish(&result);
    result = call("fit press.csv --die-area 1cm2 --powder-mass 2g --true-density 4g/cm3 "
                  "--initial-height 13mm --compliance '5 um/kN' --csv");
    g_assert_nonnull(strstr(result.err, "1 row without pressure (line 2), 1 row of "
                                        "unloading (line 7); 4 points, 105 to 605 MPa"));
    program_finish(&result);
    result = call("fit powders.csv --series A --equation walker --csv");
    g_assert_cmpint(result.status, ==, 0);
    program_finish(&result);
}

/* Words, and a part of the one line on stderr; exit status 2, nothing on stdout. */
static const char *const refused[][2] = {
    {"fit", "fit takes run directories of one scene, or one file"},
    {"fit --csv", "fit takes run directories"},
    {"fit thousands.csv",
     "thousands.csv: '1,125' in line 2: is it 1.125 (decimal comma) or 1125 (decimal "
     "point)? Give --columns 'pressure=1:MPa,density=2:%,decimal=comma' or --columns "
     "'pressure=1:MPa,density=2:%,decimal=point'"},
    {"fit press.csv",
     "punch travel needs die-area, powder-mass, true-density, initial-height"},
    {"fit german.csv --columns density=9:%",
     "density=9: expected one of the columns 1 'Nr.'"},
    {"fit german.csv --decimal x", "--decimal=x: expected comma, point"},
    {"fit german.csv --die-area 3", "expected a number above 0 in mm2, cm2, m2"},
    {"fit one --decimal ,", "--decimal is for a file of measured points"},
    {"plot one --figure densification --decimal ,",
     "--decimal: expected a file given with --data"},
    {"report one --columns pressure=1 -o report",
     "--columns: expected a file given with --data"},
    {"plot one --figure densification --data thousands.csv", "decimal=comma"},
    {"report one --data thousands.csv -o report", "decimal=comma"},
    {"calibrate default --data thousands.csv --free contact.mu -o fit", "decimal=comma"},
    {"fit nowhere", "nowhere: is not a run directory"},
    {"fit nowhere.csv", "nowhere.csv"},
    {"fit lab.csv few.csv", "one file of measured points at a time"},
    {"fit few.csv", "heckel: 3 points in the window; 2 parameters take 5"},
    {"fit few.csv --equation secondi", "secondi: 3 points"},
    {"fit full.csv --equation heckel",
     "not defined at a density of 1 or more (1 at 2000"},
    {"fit two.csv", "expected one series of A, B"},
    {"fit two.csv --series C", "expected one series of A, B"},
    {"fit lab.csv --series A", "has no column series"},
    {"fit one --series A", "--series is for a file"},
    {"fit one other", "other: another scene than one (contact.mu)"},
    {"fit one one", "same preset and seed"},
    {"fit lab.csv --equation heckle", "--equation heckle: expected heckel, kawakita,"},
    {"fit lab.csv --from 10", "--from 10: expected a pressure above 0 with its unit"},
    {"fit lab.csv --to -5MPa", "--to -5MPa: expected"},
    {"fit lab.csv --to 5nm", "--to 5nm: expected"},
    {"fit lab.csv --from 1GPa", "no point of loading in the window"},
    {"fit one --from 1GPa", "no two points between 1000 and 497.5"},
    {"fit lab.csv --initial 1.5", "--initial 1.5: expected a relative density"},
    {"fit lab.csv --initial x", "--initial x: expected"},
    {"fit lab.csv --initial 0.6 --equation adams", "below the initial density 0.6"},
    {"fit lab.csv -o fit.gif", "-o fit.gif: expected a name ending in"},
};

static void test_refused(void)
{
    for (size_t i = 0; i < G_N_ELEMENTS(refused); i++) {
        struct result result = call(refused[i][0]);
        g_test_message("%s: %d %s", refused[i][0], result.status, result.err);
        g_assert_cmpint(result.status, ==, 2);
        g_assert_cmpstr(result.out, ==, "");
        g_assert_true(g_str_has_prefix(result.err, "greenbody: "));
        g_assert_nonnull(strstr(result.err, refused[i][1]));
        const char *newline = strchr(result.err, '\n');
        g_assert_true(newline && newline[1] == '\0');
        program_finish(&result);
    }
}

/* The line that says how the file was read, and behind it that of the error. */
static void test_refused_behind(void)
{
    static const char *const cases[][2] = {
        {"fit powders.csv", "powders.csv: expected one series of A, B"},
        {"fit powders.csv --series C", "--series C: expected one series of A, B"},
        {"calibrate default --data powders.csv --free contact.mu -o fit",
         "powders.csv:3: series B after A"}};
    for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
        struct result result = call(cases[i][0]);
        char **lines = g_strsplit(result.err, "\n", -1);
        g_test_message("%s", result.err);
        g_assert_cmpint(result.status, ==, 2);
        g_assert_cmpstr(result.out, ==, "");
        g_assert_cmpuint(g_strv_length(lines), ==, 3);
        g_assert_nonnull(strstr(lines[0], "series from column 1 'Probe'"));
        g_assert_nonnull(strstr(lines[1], cases[i][1]));
        g_strfreev(lines);
        program_finish(&result);
    }
}

static void remove_all(const char *path)
{
    GDir *dir = g_dir_open(path, 0, NULL);
    const char *name = NULL;
    while (dir != NULL && (name = g_dir_read_name(dir)) != NULL) {
        char *inner = g_build_filename(path, name, NULL);
        remove_all(inner);
        g_free(inner);
    }
    if (dir != NULL) {
        g_dir_close(dir);
    }
    g_remove(path);
}

/* Usage: test_fit_command PROGRAM */
int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    program = argv[1];
    folder = g_dir_make_tmp("greenbody-fit-XXXXXX", NULL);
    write_lab();
    write_german();
    write_run("one", 1, "0.1");
    write_run("two", 2, "0.1");
    write_run("three", 3, "0.1");
    write_run("other", 1, "0.2");
    g_test_add_func("/fit/csv", test_csv);
    g_test_add_func("/fit/window", test_window);
    g_test_add_func("/fit/runs", test_runs);
    g_test_add_func("/fit/partly", test_partly);
    g_test_add_func("/fit/figure", test_figure);
    g_test_add_func("/fit/spreadsheet", test_spreadsheet);
    g_test_add_func("/fit/given", test_given);
    g_test_add_func("/fit/refused", test_refused);
    g_test_add_func("/fit/refused-behind", test_refused_behind);
    const int status = g_test_run();
    remove_all(folder);
    g_free(folder);
    return status;
}
