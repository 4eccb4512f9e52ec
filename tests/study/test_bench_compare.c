#include <glib.h>
#include <glib/gstdio.h>
#include <math.h>
#include <string.h>

#include "study/bench/bench_compare.h"
#include "study/bench/bench_figure.h"

/* A run compared with a stored one. */

enum { ROWS = 6 };

static const struct gb_bench_row now[ROWS] = {
    {"particles", 8000.0, 0.0, "", GB_BENCH_FACT},
    {"evaluation", 0.030, 0.0003, "us per particle", GB_BENCH_LESS},
    {"steps", 28.0, 0.5, "million particle-steps per s", GB_BENCH_MORE},
    {"noisy", 0.050, 0.010, "us per particle", GB_BENCH_LESS},
    {"memory", 800.0, 0.0, "bytes per particle", GB_BENCH_FACT},
    {"new", 1.0, 0.0, "s", GB_BENCH_LESS},
};

/* Compares with a file of these rows. */
static bool compare(const char *rows, struct gb_bench_change change[ROWS],
                    struct gb_error *err)
{
    GError *failure = NULL;
    char *folder = g_dir_make_tmp("gb-bench-XXXXXX", &failure);
    g_assert_no_error(failure);
    char *path = g_build_filename(folder, "bench.csv", NULL);
    g_assert_true(g_file_set_contents(path, rows, -1, NULL));
    const bool good = gb_bench_compare(path, now, ROWS, change, err);
    g_unlink(path);
    g_rmdir(folder);
    g_free(path);
    g_free(folder);
    return good;
}

#define HEAD "# greenbody\nfigure,value,unit,spread\nparticles,8000,,0\n"

static void test_verdicts(void)
{
    struct gb_bench_change change[ROWS];
    struct gb_error err = {0};
    g_assert_true(compare(HEAD "evaluation,0.040,us per particle,0.0004\n"
                               "steps,40,million particle-steps per s,0.5\n"
                               "noisy,0.060,us per particle,0.001\n"
                               "memory,900,bytes per particle,0\n",
                          change, &err));
    g_assert_cmpint(change[0].verdict, ==, GB_BENCH_UNKNOWN);
    g_assert_cmpfloat_with_epsilon(change[1].ratio, 0.75, 1e-12);
    g_assert_cmpint(change[1].verdict, ==, GB_BENCH_BETTER);
    g_assert_cmpint(change[2].verdict, ==, GB_BENCH_WORSE);
    g_assert_cmpint(change[3].verdict, ==, GB_BENCH_WITHIN);
    g_assert_cmpint(change[4].verdict, ==, GB_BENCH_UNKNOWN);
    g_assert_cmpfloat_with_epsilon(change[4].before, 900.0, 1e-9);
    g_assert_true(isnan(change[5].before));
    g_assert_cmpint(change[5].verdict, ==, GB_BENCH_UNKNOWN);
}

/* Changes as small as those between two runs count neither way. */
static void test_least(void)
{
    struct gb_bench_change change[ROWS];
    struct gb_error err = {0};
    g_assert_true(compare(HEAD "evaluation,0.0292,us per particle,0\n"
                               "steps,26,million particle-steps per s,0\n"
                               "noisy,0.030,us per particle,0\n",
                          change, &err));
    g_assert_cmpint(change[1].verdict, ==, GB_BENCH_WITHIN);
    g_assert_cmpint(change[2].verdict, ==, GB_BENCH_BETTER);
    g_assert_cmpint(change[3].verdict, ==, GB_BENCH_WORSE);
}

static void test_refused(void)
{
    static const char *const wrong[][2] = {
        {"# greenbody\nfigure,value,unit,spread\nparticles,1000,,0\n", "1000"},
        {"figure,value,unit\nparticles,8000,\n", "spread"},
        {"terms,us_per_particle,share,spread\nall terms,1,1,0\n", "bench.csv"},
        {"figure,value,unit,spread\nevaluation,1,us per particle,0\n", "particles"},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(wrong); i++) {
        struct gb_bench_change change[ROWS];
        struct gb_error err = {0};
        g_assert_false(compare(wrong[i][0], change, &err));
        g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
        if (!strstr(err.text, wrong[i][1])) {
            g_error("%s: without %s", err.text, wrong[i][1]);
        }
    }
}

static void test_figure(void)
{
    double round[] = {3.0, 1.0, 2.0, 5.0, 2.5}, without[] = {1.0, (double)NAN};
    const struct gb_bench_figure figure = gb_bench_figure_of(round, 5);
    g_assert_cmpfloat(figure.value, ==, 2.5);
    g_assert_cmpfloat(figure.spread, ==, 2.0);
    g_assert_true(isnan(gb_bench_figure_of(without, 2).value));
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/bench-compare/verdicts", test_verdicts);
    g_test_add_func("/bench-compare/least", test_least);
    g_test_add_func("/bench-compare/refused", test_refused);
    g_test_add_func("/bench-compare/figure", test_figure);
    return g_test_run();
}
