#include <math.h>
#include <stdbool.h>
#include <string.h>

#include <glib.h>
#include <glib/gstdio.h>

#include "common/program.h"

/* The installed commands: exit status, the line on stderr, numbers. */

static const char *program;

static struct result call(const char *words)
{
    return program_call(program, NULL, words);
}

/* Words, and a part of the one line on stderr; exit status 2. */
static const char *const refused[][2] = {
    {"moduli p3-cycle", "scene.kind = die: moduli needs a periodic cell"},
    {"moduli default loading.geometry=die",
     "loading.geometry = die: must be uniaxial (a closed die), biaxial or isotropic with "
     "scene.kind = quasistatic"},
    {"yield p3-cycle --out nowhere",
     "scene.kind and scene.dimension: must be quasistatic"},
    {"yield p2-3d-v1 --out nowhere",
     "scene.kind and scene.dimension: must be quasistatic"},
    {"yield p3-pair --out nowhere", "a compact does not hold together"},
    {"yield default loading.geometry=die --out nowhere",
     "loading.geometry = die: must be"},
    {"strength p3-cycle --out nowhere", "scene.kind and scene.dimension: must be"},
    {"strength p2-v1 --out nowhere", "scene.kind and scene.dimension: must be"},
    {"strength p3-pair --out nowhere", "a compact does not hold together"},
    {"strength default contact.normal=hertz contact.bridge_length=1d --out nowhere",
     "a compact does not hold together"},
    {"strength default loading.geometry=die --out nowhere",
     "loading.geometry = die: must"},
    {"card p3-cycle --out nowhere",
     "scene.kind and scene.dimension: must be quasistatic"},
    {"card p2-v1 --out nowhere", "scene.kind and scene.dimension: must be quasistatic"},
    {"card p3-pair --out nowhere", "a compact does not hold together"},
    {"card default loading.geometry=die --out nowhere",
     "loading.geometry = die: must be"},
    {"run p2-v1 loading.geometry=die", "loading.geometry = die: must be uniaxial"},
    {"nothing", "nothing: no such option, command, file or preset; commands:"},
    {"sweeep",
     "sweeep: no such option, command, file or preset; did you mean sweep? commands:"},
    {"defualt", "file or preset; did you mean default? commands:"},
    {"run defualt", "defualt: no such file or preset; did you mean default? looked in "},
    {"params extra", "params takes no words"},
    {"stability extra", "extra: no such file or preset"},
    {"stability --at 100MPa", "--at: expected with a PRESET"},
    {"stability default --at here", "--at here: must be up to 16 pressures"},
    {"stability p3-cycle", "scene.kind = die: stability needs a periodic cell"},
    {"moduli default structure.kind=fcc particles.count=108 --replicas 2",
     "structure.kind = fcc: expected grown for 2 cells"},
    {"strength default structure.kind=fcc particles.count=108 --replicas 2 --out nowhere",
     "structure.kind = fcc: expected grown for 2 cells"},
    {"card default structure.kind=fcc particles.count=108 --replicas 4 --out nowhere",
     "structure.kind = fcc: expected grown for 4 cells"},
    {"yield default structure.kind=fcc particles.count=108 --replicas 2 --out nowhere",
     "structure.kind = fcc: expected grown for 2 cells"},
    {"chart default structure.kind=fcc particles.count=108 --seeds 3 --out nowhere",
     "structure.kind = fcc: expected grown for 3 cells"},
    {"sweep default structure.kind=fcc particles.count=108 --vary contact.mu=0.1,0.2 --replicas 2 --out nowhere",
     "structure.kind = fcc: expected grown for 2 cells"},
    {"sweep default particles.count=108 --vary structure.kind=grown,fcc --replicas 2 --out nowhere",
     "structure.kind = fcc: expected grown for 2 cells"},
    {"pack default structure.kind=fcc particles.count=108 --percolation 3",
     "--percolation: expected structure.kind = grown"},
    {"sizes", "sizes takes one file"},
    {"sizes a.csv b.csv", "sizes takes one file"},
    {"params --bogus", "Unknown option --bogus"},
    {"law", "law without name: expected rod, "},
    {"law storm --at h=0.1", "law storm: expected rod"},
    {"law rod", "law rod needs --at h=VALUE or --range"},
    {"law rod --bogus", "Unknown option --bogus"},
    {"law rod --at", "Missing argument"},
    {"law rod --at h=1", "h = 1: expected"},
    {"law rod --at h=nan", "--at h=nan: expected"},
    {"law rod --at h=inf", "--at h=inf: expected"},
    {"law rod --at h=1e999", "expected"},
    {"law rod --at h=", "expected"},
    {"law rod --at h", "expected"},
    {"law rod --at r=0.1", "--at r=0.1: expected h"},
    {"law rod --at h=0.1,h=0.2", "expected h, each once"},
    {"law rod --at h=0.1,h_min=0.2", "expected h, each once"},
    {"law rod --range h=0:0.1:0", "--range h=0:0.1:0: expected"},
    {"law rod --range h=0:0.1:-5", "expected"},
    {"law rod --range h=0:0.1:10000001", "count 1 to 10000000"},
    {"law rod --range h=0:0.1:1e300", "count 1 to 10000000"},
    {"law rod --range h=0:0.1:2.5", "expected"},
    {"law rod --range h=0.1:0:5", "from below to"},
    {"law rod --range h=0.1:0.1:5", "from below to"},
    {"law rod --range h=0:0.1", "expected name=from:to:count"},
    {"law rod --range h=0:1:5", "h = 1: expected"},
    {"law rod --range r=0:0.1:5", "expected h for law rod"},
    {"law rod --range h=0:nan:5", "expected"},
    {"law rod --path 0,0.1", "law rod: expected --at or --range"},
    {"law normal --path 0", "--path 0: expected two or more"},
    {"law normal --path 0,1", "--path 0,1: expected h below 1"},
    {"law normal --path 0,x", "expected two or more"},
    {"law normal --path 0,0.1 --at h=0.1", "alone"},
    {"law dispersion --at r=-1", "r = -1: expected"},
    {"law bridge --at h_min=0.02", "needs --at h="},
    {"law bridge --at h_min=0.02,h=0.03", "expected h up to h_min"},
    {"law bridge --at h_min=2,h=0.03", "h_min = 2"},
    {"law bridge --at h=0.01 contact.bridge_length=1d", "no bridges"},
    {"law equilibrium --at h=0.1", "no --at"},
    {"law lattice --at h=0.01", "needs --lattice"},
    {"law lattice --lattice hcp --at h=0.01", "expected sc, fcc, bcc or diamond"},
    {"law rod --lattice sc --at h=0.01", "--lattice is for"},
    {"law rod --at h=nm", "--at h=nm: expected"},
    {"law rod --at h=2MPa", "--at h=2MPa: expected"},
    {"law rod --at h=10nm", "h = 1: expected"}, /* a diameter */
    {"law hertz",
     "law hertz needs --at h_m=VALUE or --range h_m=FROM:TO:COUNT or --path"},
    {"law hertz p3-pair --at h=1", "h_m = 2e-05: expected -20 up to below 2e-05"},
    {"law hertz p3-pair --at r=1um", "expected h_m, h or h/2R, each once"},
    {"law hertz p3-pair --range h_m=20nm:1e-8:5", "from below to"},
    {"law hertz p3-pair --range r=0:1nm:5", "expected h_m for law hertz"},
    {"law storakers p3-pair --path 0,1", "expected h_m below 2e-05"},
    {"law storakers p3-pair --path r=0,20nm", "--path r=0,20nm: expected h_m"},
    {"law models p3-pair --path 0,20nm", "law models: expected --at or --range"},
    {"law yield p3-pair --at h_m=0", "law yield: expected no --at"},
    {"law hertz --at h=0 contact.radius_i=wall contact.radius_j=wall", "a wall"},
    {"law hertz --at h=0 material.yield=500GPa",
     "material.yield = 500 GPa: must be at most material.young = 382 GPa"},
    {"law hertz --at h=0 material.young_j=100MPa",
     "material.yield = 800 MPa: must be at most material.young_j = 100 MPa"},
    {"law hertz --at h=0 contact.radius_j=inf", "must be auto, wall or between 0.1 nm"},
    {"run default contact.normal=storakers",
     "contact.normal = storakers: must be rod or hertz"},
    {"plot default contact.normal=hertz --figure bridge-strength",
     "bridge-strength: expected contact.normal = rod"},
    {"plot default contact.normal=hertz --figure contact",
     "contact: expected contact.normal = rod"},
    {"law rod default contact.normal=hertz --at h=0.1",
     "law rod: expected contact.normal = rod; law hertz is for grains without cohesion"},
    {"law rod --at h=0.1 --set contact.mu=-1",
     "contact.mu = -1: must be between 0 and 2"},
    {"law rod --at h=0.1 contact.muu=1", "no such key"},
    {"law rod --at h=0.1 --set nonsense", "must be group.key=value"},
    {"law rod --at h=0.1 no-preset", "no-preset: no such file or preset; looked in "},
    {"law rod --at h=0.1 default p1-set2-38nm", "p1-set2-38nm: expected one preset"},
    {"run default contact.mu", "contact.mu: missing \"=value\""},
    {"law rod --at h=0.1 /dev/zero", "/dev/zero: larger"},
    {"law equilibrium contact.alpha=0.05 'material.epsilon=100000 kB'", "adhesion"},
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
        g_assert_true(newline && newline[1] == '\0'); /* one line */
        program_finish(&result);
    }
}

static const char *const fine[][2] = {
    {"--help", "Commands:"},
    {"-h", "Commands:"},
    {"--version", "compiler: "},
    {"law --help", "Figure 1 of P1"},
    {"params --help", "--markdown"},
    {"params", "contact.mu "},
    {"params --markdown", "| `contact.mu` | 0.1 | 0 to 2 | - |"},
    {"law rod --at h=0.01", "h,force,stiffness,force_nN\n0.01,"},
    {"law dispersion --at r=1", "r,force,force_nN\n1,"},
    {"law shear --at h=0.01", "h,stiffness,cap\n"},
    {"law pivot --at h=0.01", "h,stiffness,cap\n"},
    {"law roll --at h=0.01", "h,stiffness,cap\n"},
    {"law equilibrium", "h_eq,force_max,force_max_nN\n"},
    {"law bridge-strength --at h=0", "h,strength_GPa\n0,"},
    {"law lattice --lattice bcc --at h=0.02", "h,density,pressure_GPa\n"},
    {"law bridge-strength --at h=0 --vary contact.bridge_length=0.005d,0.01d",
     "contact.bridge_length,h,strength_GPa\n0.005d,0,7.2678313435"},
    {"law rod --range h=0.1:0.1:1", "\n0.1"},
    {"law rod --at h=1nm", "\n0.1"}, /* over the diameter of 10 nm */
    {"law hertz p3-pair --at h=-1nm", "h_m,force_N,stiffness_N_per_m\n-1"},
    {"law storakers p3-pair contact.normal=storakers --range h/2R=0:0.01:2",
     "h_m,force_N,stiffness_N_per_m\n0,0,0\n2"},
    {"law models p3-line --at h=0 --vary material.hardening=0,0.2",
     "material.hardening,h_m,hertz_N,storakers_N,printed_N\n0,0,0,0,0\n0.2,0,0,0,0\n"},
    {"law critical-step p3-pair --at h=0", "h_m,hertz_s,storakers_s,printed_s\n0,inf"},
    {"law yield p3-pair", "h_m,force_N\n"},
    {"law models p3-pair --range h_m=0:200nm:101 --vary "
     "material.hardening=0,0.05,0.1,0.2",
     "\n0.05,"},
    {"law models p3-line --range h_m=0:600nm:101 --vary "
     "material.hardening=0,0.05,0.1,0.2",
     "\n0.1,"},
    {"law critical-step p3-pair --range h_m=0:200nm:101 --vary "
     "material.hardening=0,0.05,0.1,0.2",
     "\n0.2,"},
    {"law mindlin p3-pair --at h=0", "h_m,stiffness_N_per_m,cap_N\n0,0,0\n"},
};

static void test_fine(void)
{
    for (size_t i = 0; i < G_N_ELEMENTS(fine); i++) {
        struct result result = call(fine[i][0]);
        g_test_message("%s: %d %s", fine[i][0], result.status, result.err);
        g_assert_cmpint(result.status, ==, 0);
        g_assert_cmpstr(result.err, ==, "");
        g_assert_nonnull(strstr(result.out, fine[i][1]));
        program_finish(&result);
    }
}

/* Words, column of the first row, value. */
static const struct {
    const char *words;
    int column;
    double value;
} values[] = {
    {"law rod --at h=0.02", 1, 1.196710123552e-3},
    {"law rod --at h=0.02", 2, 9.465896406283e-2},
    {"law roll --at h=0.05", 1, 1.987615980000e-3},
    {"law dispersion --at r=1 particles.diameter=9.7nm", 2, 2.930977912525e+1},
    {"law dispersion --at r=1.2 --set particles.diameter=38nm", 1, 1.534127738445e-8},
    {"law equilibrium p1-set2-9.7nm", 0, 1.568325077091e-2},
    {"law equilibrium p1-set1-uniaxial", 0, 8.531363037942e-3},
    {"law bridge p1-set2-9.7nm --at h_min=0.02,h=0.012", 1, -3.760273184113e-4},
    {"law bridge p1-set2-9.7nm --at h=0", 1, -9.731570609486e-4},
    {"law bridge p1-set2-38nm --at h=0.042", 1, 3.629017196809e-3},
    {"law normal p1-set2-9.7nm --at h=-0.05", 1, -1.772580304453e-5},
    {"law bridge-strength contact.bridge_length=0.015d --at h=0.02", 1, 3.986581957290},
    {"law lattice --lattice sc p1-set2-9.7nm --at h=0.02", 2, 1.516403150176e-1},
    {"law lattice --lattice fcc p1-set2-38nm --at h=0.05", 2, 5.961866653769},
    {"law lattice --lattice fcc --at h=0", 1, 0.74048048969306},
    {"law lattice --lattice bcc --at h=0", 1, 0.68017476158710},
    {"law lattice --lattice diamond --at h=0", 1, 0.34008738079355},
    {"law hertz p3-pair --at h_m=2e-8", 1, 8.340072949895e-04},
    {"law hertz p3-pair --at h/2R=0.001", 1, 8.340072949895e-04},
    {"law hertz p3-line --at h=20nm", 1, 4.815143362683e-04},
    {"law hertz p3-line contact.radius_i=2um contact.radius_j=10um --at h=20nm", 1,
     4.815143362683e-04},
    {"law storakers p3-pair contact.storakers=printed material.hardening=0.1 "
     "'material.hollomon=1375 MPa' --at h_m=2e-8",
     1, 2.060865593633e-03},
    {"law storakers p3-pair --at h_m=2e-8", 1, 8.340072949895e-04}, /* still elastic */
    {"law storakers p3-pair --at h_m=2e-7", 1, 2.156389197424e-02},
    {"law models p3-line --at h=0.01", 3, 1.437592798283e-03},
    /* 2 sqrt(m/k), (24), (29): k = 2 E* sqrt(R* h), m = 2.4756e-11 kg; with xi = 0.9 */
    {"law critical-step p3-pair --at h=200nm", 1, 2.2374455971219e-08},
    {"law critical-step p3-pair --at h=200nm contact.damping=0.9", 2,
     3.0305361215714e-08 * 0.44536240470737},
    /* against a wall R* doubles; k_t of (12) */
    {"law hertz p3-pair contact.radius_j=wall --at h=20nm", 1,
     8.340072949895e-04 * M_SQRT2},
    {"law mindlin p3-pair --at h=200nm", 1, 8.0 * 180e9 / (2.0 * 1.7 * 2.6) * 1e-6},
};

static void test_values(void)
{
    for (size_t i = 0; i < G_N_ELEMENTS(values); i++) {
        struct result result = call(values[i].words);
        g_test_message("%s: %s%s", values[i].words, result.err, "");
        g_assert_cmpint(result.status, ==, 0);
        char **lines = g_strsplit(result.out, "\n", -1);
        char **cells = g_strsplit(lines[1], ",", -1);
        const double got = g_ascii_strtod(cells[values[i].column], NULL);
        g_assert_cmpfloat_with_epsilon(got, values[i].value,
                                       1e-10 * fabs(values[i].value));
        g_strfreev(cells);
        g_strfreev(lines);
        program_finish(&result);
    }
}

/* The stiffness column is the slope of the force column, on each branch of Fig. 1. */
static void test_path(void)
{
    struct result result =
        call("law normal p1-set2-16nm --path=-0.02,0.0081,-0.01,0.02,-0.01");
    g_assert_cmpint(result.status, ==, 0);
    char **lines = g_strsplit(g_strchomp(result.out), "\n", -1);
    g_assert_cmpuint(g_strv_length(lines), ==, 1 + 1 + 4 * 200);
    double last[3] = {NAN, NAN, NAN};
    int smooth = 0, jumps = 0;
    for (int i = 1; lines[i]; i++) {
        char **cells = g_strsplit(lines[i], ",", -1);
        double now[3];
        for (int k = 0; k < 3; k++) {
            now[k] = g_ascii_strtod(cells[k], NULL);
        }
        const double rise = now[1] - last[1];
        const double want = 0.5 * (now[2] + last[2]) * (now[0] - last[0]);
        const bool fits = fabs(rise - want) < 0.02 * fabs(want) + 1e-7;
        smooth += fits;
        jumps += now[0] <= 0.0 && last[0] > 0.0; /* D to B */
        memcpy(last, now, sizeof last);
        g_strfreev(cells);
    }
    g_assert_cmpint(jumps, ==, 2);
    g_assert_cmpint(smooth, >, 600); /* the rest is partial breaking, and jumps */
    g_strfreev(lines);
    program_finish(&result);
}

/* Work done along the rows of a path, and the force at the end. */
static double path_work(const char *words, double *last)
{
    struct result result = call(words);
    g_assert_cmpint(result.status, ==, 0);
    char **lines = g_strsplit(g_strchomp(result.out), "\n", -1);
    double h = NAN, work = 0.0;
    *last = NAN;
    for (int i = 1; lines[i]; i++) {
        char **cells = g_strsplit(lines[i], ",", -1);
        const double now = g_ascii_strtod(cells[0], NULL);
        const double force = g_ascii_strtod(cells[1], NULL);
        work += i > 1 ? 0.5 * (force + *last) * (now - h) : 0.0;
        h = now;
        *last = force;
        g_strfreev(cells);
    }
    g_strfreev(lines);
    program_finish(&result);
    return work;
}

/* One contact of NiAl loaded and unloaded: no loss below the crossing of the two laws,
 * more than half of the work lost well above it, independent of a repeated part of the
 * path; a contact that has opened starts anew. */
static void test_plastic_path(void)
{
    double force = 0.0, again = 0.0;
    const double in = path_work("law storakers p3-pair --path 0,300nm", &force);
    g_assert_cmpfloat_with_epsilon(force, 3.2345837961e-02, 1e-9);
    g_assert_cmpfloat(
        fabs(path_work("law storakers p3-pair --path h_m=0,1e-7,0", &again)), <,
        1e-12 * in);
    const double loop = path_work("law storakers p3-pair --path 0,300nm,-1nm", &again);
    g_assert_cmpfloat(loop, >, 0.2 * in);
    g_assert_cmpfloat(loop, <, in);
    g_assert_cmpfloat(again, ==, 0.0);
    const double twice =
        path_work("law storakers p3-pair --path 0,0.015,0.0135,0.015", &again);
    g_assert_cmpfloat_with_epsilon(twice, in, 1e-6 * in);
    g_assert_cmpfloat_with_epsilon(again, force, 1e-12 * force);
    const double loops =
        path_work("law storakers p3-pair --path 0,300nm,0,300nm,0", &again);
    g_assert_cmpfloat_with_epsilon(loops, 2.0 * loop, 1e-3 * loop);
    g_assert_cmpfloat(fabs(path_work("law hertz p3-pair --path 0,300nm,0", &again)), <,
                      1e-12 * in);
}

/* A full disk is an error of the machine; a closed pipe is no error. */
static void test_output(void)
{
    static const struct {
        const char *shell;
        int status;
        const char *said;
    } rows[] = {
        {"\"$0\" law rod --range h=0:0.1:100000 > /dev/full", 3,
         "standard output: No space"},
        {"\"$0\" params > /dev/full", 3, "standard output: No space"},
        {"\"$0\" law rod --range h=0:0.1:10000000 | head -n 1", 0, ""},
        {"\"$0\" --help | true", 0, ""},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        char *arguments[] = {(char *)"/bin/sh", (char *)"-c", (char *)rows[i].shell,
                             (char *)program, NULL};
        struct result result = {0};
        int wait = 0;
        g_assert_true(g_spawn_sync(NULL, arguments, NULL, G_SPAWN_DEFAULT, NULL, NULL,
                                   &result.out, &result.err, &wait, NULL));
        g_test_message("%s: %s", rows[i].shell, result.err);
        g_assert_cmpint(WEXITSTATUS(wait), ==, rows[i].status);
        g_assert_nonnull(strstr(result.err, rows[i].said));
        g_assert_true(rows[i].status != 0 || result.err[0] == '\0');
        program_finish(&result);
    }
}

/* Usage: test_cli PROGRAM PRESET_FOLDER */
/* Expected numbers of P1's law for 1000 particles in classes of 4 nm. */
static void test_sizes(void)
{
    static const char text[] =
        "diameter_nm,count\n2,11\n6,140\n10,235\n14,207\n18,147\n22,96\n26,60\n30,38\n34,"
        "24\n38,15\n42,9\n46,6\n50,4\n54,3\n";
    char *path = NULL;
    const int file = g_file_open_tmp("greenbody-XXXXXX.csv", &path, NULL);
    g_assert_cmpint(file, >=, 0);
    g_close(file, NULL);
    g_assert_true(g_file_set_contents(path, text, -1, NULL));
    char *words = g_strconcat("sizes ", path, NULL);
    struct result result = call(words);
    g_test_message("%s%s", result.out, result.err);
    g_assert_cmpint(result.status, ==, 0);
    const char *median = strstr(result.out, "particles.diameter = ");
    const char *sigma = strstr(result.out, "particles.sigma = ");
    g_assert_true(median != NULL && sigma != NULL);
    g_assert_cmpfloat_with_epsilon(g_ascii_strtod(median + 21, NULL), exp(2.644), 0.7);
    g_assert_cmpfloat_with_epsilon(g_ascii_strtod(sigma + 18, NULL), 0.547, 0.04);
    g_assert_nonnull(strstr(median, " nm\n"));
    program_finish(&result);
    static const char two_powders[] =
        "diameter_nm,count\n5,0\n10,400\n15,90\n20,2\n25,0\n30,3\n35,95\n40,350\n";
    g_assert_true(g_file_set_contents(path, two_powders, -1, NULL));
    result = call(words);
    g_assert_cmpint(result.status, ==, 1);
    g_assert_nonnull(strstr(result.err, "does not describe these sizes"));
    g_assert_nonnull(strstr(result.out, "particles.sigma = "));
    program_finish(&result);
    g_assert_true(g_file_set_contents(path, "diameter_nm,number\n2,11\n", -1, NULL));
    result = call(words);
    g_assert_cmpint(result.status, ==, 2);
    g_assert_nonnull(strstr(result.err, "expected a column count"));
    program_finish(&result);
    g_unlink(path);
    g_free(words);
    g_free(path);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_assert_cmpint(argc, ==, 3);
    program = argv[1];
    g_setenv("GB_PRESET_DIR", argv[2], TRUE);
    g_setenv("XDG_CONFIG_HOME", "/nonexistent", TRUE);
    g_setenv("LC_ALL", "C.UTF-8", TRUE);
    g_test_add_func("/cli/refused", test_refused);
    g_test_add_func("/cli/fine", test_fine);
    g_test_add_func("/cli/values", test_values);
    g_test_add_func("/cli/path", test_path);
    g_test_add_func("/cli/plastic-path", test_plastic_path);
    g_test_add_func("/cli/output", test_output);
    g_test_add_func("/cli/sizes", test_sizes);
    return g_test_run();
}
