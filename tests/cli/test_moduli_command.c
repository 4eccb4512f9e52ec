#include <math.h>
#include <stdbool.h>
#include <string.h>

#include <glib.h>
#include <glib/gstdio.h>

#include "common/program.h"

/* The command `moduli`: numbers of lattices and of small runs, states of a run directory,
 * refusals. */

static const char *program;

static const char *const head =
    "density,p_MPa,probe_strain,C11_GPa,C12_GPa,C13_GPa,C22_GPa,C23_GPa,C33_GPa,C44_GPa,"
    "C55_GPa,C66_GPa,";

/* A run of a second: 100 particles to a density of 0.4. */
#define SMALL_RUN                                                                        \
    "default particles.count=100 numerics.fidelity=fast loading.until=density=0.4 "      \
    "loading.unload_from="

/* Lines of a table on stdout; status: exit status. */
static char **table_of(const char *folder, const char *words, int status)
{
    struct result result = program_call(program, folder, words);
    g_test_message("%s: %d %s", words, result.status, result.err);
    g_assert_cmpint(result.status, ==, status);
    g_assert_true(g_str_has_prefix(result.out, head));
    char **lines = g_strsplit(g_strchomp(result.out), "\n", -1);
    program_finish(&result);
    return lines;
}

/* Value of a column; NaN for an empty cell. */
static double value_of(char *const *lines, guint row, const char *column)
{
    char **names = g_strsplit(lines[0], ",", -1);
    g_assert_cmpuint(row + 1, <, g_strv_length((char **)lines));
    char **cells = g_strsplit(lines[row + 1], ",", -1);
    guint k = 0;
    while (names[k] != NULL && strcmp(names[k], column) != 0) {
        k++;
    }
    g_assert_nonnull(names[k]);
    g_assert_cmpuint(g_strv_length(names), ==, g_strv_length(cells));
    const double value = cells[k][0] ? g_ascii_strtod(cells[k], NULL) : (double)NAN;
    g_strfreev(cells);
    g_strfreev(names);
    return value;
}

static void check_near(char *const *lines, const char *column, double exact)
{
    g_assert_cmpfloat_with_epsilon(value_of(lines, 0, column), exact, 1e-6 * exact);
}

/* Set II of P1, h = 0.03 d, in closed form (tests/solve/test_moduli.c). */
static void test_fcc(void)
{
    char **lines = table_of(NULL,
                            "moduli default structure.kind=fcc structure.overlap=0.03 "
                            "particles.count=108 --csv --quiet",
                            0);
    g_assert_cmpuint(g_strv_length(lines), ==, 2);
    check_near(lines, "p_MPa", 1709.1654);
    check_near(lines, "C11_GPa", 110.925215);
    check_near(lines, "C33_GPa", 110.925215);
    check_near(lines, "C12_GPa", 13.928325);
    check_near(lines, "C44_GPa", 54.6080246);
    check_near(lines, "K_GPa", (110.925215 + 2.0 * 13.928325) / 3.0);
    check_near(lines, "vp_z_m_s",
               sqrt(110.925215e9 / (3990.0 * value_of(lines, 0, "density"))));
    g_strfreev(lines);
}

/* A hexagonal lattice is isotropic in its plane; nothing out of it has a value. */
static void test_hexagonal(void)
{
    char **lines = table_of(NULL,
                            "moduli default scene.dimension=2 structure.kind=hexagonal "
                            "structure.overlap=0.03 particles.count=100 --csv --quiet "
                            "--no-range",
                            0);
    const double c33 = value_of(lines, 0, "C33_GPa");
    check_near(lines, "C11_GPa", c33);
    check_near(lines, "C55_GPa", 0.5 * (c33 - value_of(lines, 0, "C13_GPa")));
    check_near(lines, "axial_C33_GPa", c33);
    check_near(lines, "vs_z_m_s",
               sqrt(value_of(lines, 0, "C55_GPa") * 1e9 /
                    (3990.0 * value_of(lines, 0, "density"))));
    g_assert_true(isnan(value_of(lines, 0, "K_GPa")));
    g_assert_true(isnan(value_of(lines, 0, "axial_C12_GPa")));
    g_assert_true(isnan(value_of(lines, 0, "axial_misfit")));
    g_strfreev(lines);
}

/* Means and standard errors of two seeds at a point of the run and at its end are those
 * of the two runs. */
static void test_replicas(void)
{
    static const char *const words =
        "moduli " SMALL_RUN " --at density=0.35 --no-range --csv --quiet";
    char *more[] = {g_strconcat(words, " structure.seed=1", NULL),
                    g_strconcat(words, " structure.seed=2", NULL),
                    g_strconcat(words, " structure.seed=1 --replicas 2", NULL)};
    char **one = table_of(NULL, more[0], 0);
    char **two = table_of(NULL, more[1], 0);
    char **both = table_of(NULL, more[2], 0);
    g_assert_cmpuint(g_strv_length(both), ==, 3);
    for (guint row = 0; row < 2; row++) {
        const double a = value_of(one, row, "C33_GPa"), b = value_of(two, row, "C33_GPa");
        g_assert_cmpfloat(a, >, 0.0);
        g_assert_cmpfloat(a, !=, b);
        g_assert_cmpfloat(value_of(both, row, "replicas"), ==, 2.0);
        g_assert_cmpfloat_with_epsilon(value_of(both, row, "C33_GPa"), 0.5 * (a + b),
                                       1e-8);
        g_assert_cmpfloat_with_epsilon(value_of(both, row, "error_C33_GPa"),
                                       0.5 * fabs(a - b), 1e-8);
    }
    g_assert_cmpfloat_with_epsilon(value_of(both, 0, "density"), 0.35, 1e-3);
    g_assert_cmpfloat_with_epsilon(value_of(both, 1, "density"), 0.4, 1e-9);
    g_strfreev(one);
    g_strfreev(two);
    g_strfreev(both);
    for (size_t k = 0; k < G_N_ELEMENTS(more); k++) {
        g_free(more[k]);
    }
}

/* Cells with particles that hardly anything holds: full Newton steps press them into others,
 * beyond the guard of an evaluation, and are halved. */
static void test_overshoot(void)
{
    static const char *const cells[] = {"particles.count=100 structure.seed=24",
                                        "particles.count=200 structure.seed=42",
                                        "particles.count=200 structure.seed=54"};
    for (size_t k = 0; k < G_N_ELEMENTS(cells); k++) {
        char *words = g_strconcat(
            "moduli default 'particles.diameter=10.4 nm' contact.alpha=0.37 "
            "contact.mu=0.13 'contact.bridge_length=1 d' contact.shear_strength=auto "
            "loading.until=density=0.42 loading.unload_from= --no-range --csv --quiet ",
            cells[k], NULL);
        char **lines = table_of(NULL, words, 0);
        g_assert_cmpfloat(value_of(lines, 0, "C33_GPa"), >, 0.0);
        g_strfreev(lines);
        g_free(words);
    }
}

/* A point beyond the end of the run: what was probed is printed, status 1. */
static void test_missed(void)
{
    char **lines = table_of(
        NULL, "moduli " SMALL_RUN " --at 'p=50 GPa' --no-range --csv --quiet", 1);
    g_assert_cmpuint(g_strv_length(lines), ==, 2);
    g_assert_cmpfloat_with_epsilon(value_of(lines, 0, "density"), 0.4, 1e-9);
    g_strfreev(lines);
}

/* Replicas are matched by the point asked for: a cell that ends before it is missing there
 * and does not end the others.  The first point lies between the ends of four cells. */
static void test_short_replica(void)
{
    static const char *const words =
        "moduli default particles.count=100 numerics.fidelity=fast loading.unload_from= "
        "'loading.until=30 MPa' --no-range --csv --quiet ";
    double end[4], least = INFINITY, largest = 0.0, sum = 0.0;
    for (int seed = 1; seed <= 4; seed++) {
        char *one = g_strdup_printf("%s structure.seed=%d", words, seed);
        char **lines = table_of(NULL, one, 0);
        end[seed - 1] = value_of(lines, 0, "density");
        sum += 0.25 * value_of(lines, 0, "C33_GPa");
        least = fmin(least, end[seed - 1]);
        largest = fmax(largest, end[seed - 1]);
        g_strfreev(lines);
        g_free(one);
    }
    const double between = 0.5 * (least + largest);
    int reached = 0;
    for (int k = 0; k < 4; k++) {
        reached += end[k] >= between;
    }
    char *all = g_strdup_printf("%s --replicas 4 --at 'density=%.6f; density=0.28'",
                                words, between);
    char **lines = table_of(NULL, all, 1);
    g_assert_cmpuint(g_strv_length(lines), ==, 4);
    int partial = 0, ends = 0;
    for (guint row = 0; row < 3; row++) {
        const double replicas = value_of(lines, row, "replicas");
        const double density = value_of(lines, row, "density");
        g_assert_cmpfloat(value_of(lines, row, "missing"), ==, 4.0 - replicas);
        if (replicas < 4.0) {
            g_assert_cmpfloat(replicas, ==, reached);
            g_assert_cmpfloat(density, >=, between);
            g_assert_cmpfloat(density, <, between + 0.01);
            partial++;
        } else if (fabs(value_of(lines, row, "C33_GPa") - sum) < 1e-8) {
            ends++;
        }
    }
    g_assert_cmpint(partial, ==, 1);
    g_assert_cmpint(ends, ==, 1);
    g_assert_cmpfloat_with_epsilon(value_of(lines, 0, "density"), 0.28, 5e-3);
    g_strfreev(lines);
    g_free(all);
}

static void check_refused(const char *folder, const char *words, const char *said)
{
    struct result result = program_call(program, folder, words);
    g_test_message("%s: %d %s", words, result.status, result.err);
    g_assert_cmpint(result.status, ==, 2);
    g_assert_cmpstr(result.out, ==, "");
    g_assert_true(g_str_has_prefix(result.err, "greenbody: "));
    g_assert_nonnull(strstr(result.err, said));
    const char *newline = strchr(result.err, '\n');
    g_assert_true(newline && newline[1] == '\0'); /* one line */
    program_finish(&result);
}

static void remove_run(const char *folder)
{
    static const char *const inner[] = {"run/snapshots", "run", "other", "two"};
    for (size_t k = 0; k < G_N_ELEMENTS(inner); k++) {
        char *path = g_build_filename(folder, inner[k], NULL);
        GDir *dir = g_dir_open(path, 0, NULL);
        const char *name;
        while (dir != NULL && (name = g_dir_read_name(dir)) != NULL) {
            char *file = g_build_filename(path, name, NULL);
            g_remove(file);
            g_free(file);
        }
        if (dir != NULL) {
            g_dir_close(dir);
        }
        g_rmdir(path);
        g_free(path);
    }
    g_assert_cmpint(g_rmdir(folder), ==, 0);
}

/* Kept states of a run give the numbers of the probe during the run. */
static void test_directory(void)
{
    char *folder = g_dir_make_tmp("moduli-XXXXXX", NULL);
    struct result result = program_call(
        program, folder,
        "run " SMALL_RUN " output.snapshots_at=density=0.35 --out run --quiet");
    g_test_message("%s", result.err);
    g_assert_cmpint(result.status, ==, 0);
    program_finish(&result);
    char **kept = table_of(folder, "moduli run --no-range --csv --quiet", 0);
    char **during = table_of(
        NULL, "moduli " SMALL_RUN " --at density=0.35 --no-range --csv --quiet", 0);
    char **first =
        table_of(folder, "moduli run --at density=0.35 --no-range --csv --quiet", 0);
    g_assert_cmpuint(g_strv_length(kept), ==, 3);
    g_assert_cmpuint(g_strv_length(first), ==, 2);
    g_assert_cmpstr(kept[1], ==, during[1]);
    g_assert_cmpstr(kept[2], ==, during[2]);
    g_assert_cmpstr(first[1], ==, kept[1]);
    check_refused(folder, "moduli run --at 'p=900 GPa'", "run keeps states at ");
    check_refused(folder, "moduli run contact.mu=0", "takes no keys and no --replicas");
    check_refused(folder, "moduli run --replicas 2", "takes no keys and no --replicas");
    g_strfreev(kept);
    g_strfreev(during);
    g_strfreev(first);
    remove_run(folder);
    g_free(folder);
}

/* Lines of a file of the folder without comments. */
static char **lines_of(const char *folder, const char *name)
{
    char *path = g_build_filename(folder, name, NULL);
    char *text = NULL;
    g_assert_true(g_file_get_contents(path, &text, NULL, NULL));
    const char *at = text;
    while (*at == '#') {
        at = strchr(at, '\n') + 1;
    }
    char **lines = g_strsplit(g_strchomp((char *)(size_t)at), "\n", -1);
    g_free(text);
    g_free(path);
    return lines;
}

static void call(const char *folder, const char *words, const char *said)
{
    struct result result = program_call(program, folder, words);
    g_test_message("%s: %d %s", words, result.status, result.err);
    g_assert_cmpint(result.status, ==, 0);
    g_assert_nonnull(strstr(result.err, said));
    program_finish(&result);
}

/* The table of a run grows by the states that it lacks, in their order; that of a preset is
 * new.  Both are drawn. */
static void test_out(void)
{
    char *folder = g_dir_make_tmp("moduli-XXXXXX", NULL);
    call(folder, "run " SMALL_RUN " output.snapshots_at=density=0.35 --out run --quiet",
         "");
    call(folder, "moduli run --at density=0.4 --no-range --out run", "1 of 1 states: ");
    char **last = lines_of(folder, "run/moduli.csv");
    call(folder, "moduli run/ --no-range --out run", "1 of 2 states: density 0.35");
    char **all = lines_of(folder, "run/moduli.csv");
    g_assert_cmpuint(g_strv_length(last), ==, 2);
    g_assert_cmpuint(g_strv_length(all), ==, 3);
    g_assert_cmpstr(all[2], ==, last[1]);
    g_assert_cmpfloat(value_of(all, 0, "step"), <, value_of(all, 1, "step"));
    call(folder, "moduli run --out run", "all states are in run/moduli.csv already");
    call(folder, "moduli run --no-range --out other --quiet", "");
    char **other = lines_of(folder, "other/moduli.csv");
    g_assert_cmpstr(other[1], ==, all[1]);
    g_assert_cmpstr(other[2], ==, all[2]);
    check_refused(folder, "moduli run --out other", "other: holds moduli.csv already");
    call(folder, "moduli " SMALL_RUN " --no-range --replicas 2 --out two --quiet", "");
    check_refused(folder, "moduli " SMALL_RUN " --out two", "two: holds moduli.csv");
    check_refused(folder, "moduli " SMALL_RUN " --out run", "run: holds moduli.csv");
    call(folder, "plot run two --figure moduli -o run/figure.svg", "");
    char **drawn = lines_of(folder, "run/figure.csv");
    g_assert_cmpfloat(value_of(drawn, 0, "K_GPa_1"), ==, value_of(all, 0, "K_GPa"));
    g_assert_cmpfloat(value_of(drawn, 0, "error_E_GPa_2"), >, 0.0);
    /* a run again in the same folder takes the table away */
    call(folder, "run " SMALL_RUN " --out other --quiet --force", "");
    char *stale = g_build_filename(folder, "other", "moduli.csv", NULL);
    g_assert_false(g_file_test(stale, G_FILE_TEST_EXISTS));
    g_free(stale);
    g_strfreev(last);
    g_strfreev(all);
    g_strfreev(other);
    g_strfreev(drawn);
    remove_run(folder);
    g_free(folder);
}

static void test_refused(void)
{
    static const char *const rows[][2] = {
        {"moduli", "a preset is needed"},
        {"moduli /nonexistent", "/nonexistent: No such file"},
        {"moduli default structure.knd=fcc", "structure.knd: no such key"},
        {"moduli default structure.kind=fcc particles.count=100",
         "particles.count = 100: structure.kind = fcc: expected whole unit cells of 4 particles, in a "
         "block whose edges differ by a factor of at most 2: 96 and 108 fit"},
        {"moduli default structure.kind=hexagonal particles.count=100",
         "must be grown, sc, fcc, bcc or diamond with scene.dimension = 3"},
        {"moduli default structure.kind=fcc particles.count=108 --replicas 2",
         "structure.kind = fcc: expected grown for 2 cells"},
        {"moduli default --replicas 0", "--replicas 0: must be 1 to 1000"},
        {"moduli default --at 'every 5'", "--at every 5: must be up to 16 pressures"},
        {"moduli default --at density=1.5", "--at density=1.5: must be up to 16"},
        {"moduli p3-hertz-mu0", "scene.kind = die: moduli needs a periodic cell"},
        {"moduli default --bogus", "Unknown option --bogus"},
    };
    for (size_t k = 0; k < G_N_ELEMENTS(rows); k++) {
        check_refused(NULL, rows[k][0], rows[k][1]);
    }
}

/* Usage: test_moduli_command PROGRAM PRESET_FOLDER */
int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_assert_cmpint(argc, ==, 3);
    program = argv[1];
    g_setenv("GB_PRESET_DIR", argv[2], TRUE);
    g_setenv("XDG_CONFIG_HOME", "/nonexistent", TRUE);
    g_setenv("LC_ALL", "C.UTF-8", TRUE);
    g_test_add_func("/moduli-command/fcc", test_fcc);
    g_test_add_func("/moduli-command/hexagonal", test_hexagonal);
    g_test_add_func("/moduli-command/replicas", test_replicas);
    g_test_add_func("/moduli-command/short-replica", test_short_replica);
    g_test_add_func("/moduli-command/overshoot", test_overshoot);
    g_test_add_func("/moduli-command/missed", test_missed);
    g_test_add_func("/moduli-command/directory", test_directory);
    g_test_add_func("/moduli-command/out", test_out);
    g_test_add_func("/moduli-command/refused", test_refused);
    return g_test_run();
}
