/* Charts: what is planned, what follows from known cells, what is found again on disk. */
#include <math.h>
#include <string.h>

#include <glib.h>
#include <glib/gstdio.h>

#include "common/scene.h"
#include "study/chart_table.h"

static struct gb_params small_scene(void)
{
    return scene_params("particles.count=300", "loading.until=100 MPa",
                        "loading.unload_from=", "numerics.relaxer=fire", NULL);
}

static const char *const vary_tolerance[] = {"numerics.tolerance=0.05,0.02,0.01", NULL};

static struct gb_chart_plan plan_of(const struct gb_params *params,
                                    const char *const *vary, int seeds)
{
    struct gb_chart_plan plan;
    struct gb_error err = {0};
    if (!gb_chart_plan_init(&plan, params, vary, NULL, NULL, seeds, &err)) {
        g_error("%s", err.text);
    }
    return plan;
}

static void test_plan(void)
{
    const struct gb_params params = small_scene();
    const char *both[] = {"numerics.tolerance=0.05,0.02", "loading.step=0.1 %,0.5 %,1 %",
                          NULL};
    struct gb_chart_plan plan = plan_of(&params, both, 3);
    g_assert_cmpuint(plan.settings, ==, 2 + 6); /* the preset's is none of them */
    g_assert_cmpint(plan.pressures, ==, 1);
    g_assert_cmpfloat(plan.pressure_pa[0], ==, 100e6);
    for (size_t i = 1; i < plan.settings; i++) {
        g_assert_cmpfloat(plan.setting[0].strain_step, <, plan.setting[i].strain_step);
        g_assert_cmpfloat(plan.setting[0].tolerance, <, plan.setting[i].tolerance);
        for (size_t j = 0; j < i; j++) {
            g_assert_false(gb_chart_same(&plan.setting[i], &plan.setting[j]));
        }
    }
    for (size_t i = 3; i < plan.settings; i++) { /* cheap ones first */
        g_assert_cmpfloat(gb_chart_effort(&plan.setting[i - 1]), <=,
                          gb_chart_effort(&plan.setting[i]));
    }
    gb_chart_plan_finish(&plan);
    plan = plan_of(&params, NULL, 3);
    g_assert_cmpuint(plan.settings, >, 25);
    gb_chart_plan_finish(&plan);
    const char *wrong[] = {"contact.mu=0.1,0.2", NULL};
    struct gb_error err = {0};
    g_assert_false(gb_chart_plan_init(&plan, &params, wrong, NULL, NULL, 3, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    g_assert_nonnull(strstr(err.text, "loading.step"));
    gb_chart_plan_finish(&plan);
    struct gb_params scaled = params;
    scaled.tolerance = 0.1;
    scaled.tolerance_scale = GB_TOLERANCE_ATTRACTION;
    g_assert_false(gb_chart_plan_init(&plan, &scaled, NULL, NULL, NULL, 3, &err));
    g_assert_nonnull(strstr(err.text, "tolerance_scale: must be contact"));
    gb_chart_plan_finish(&plan);
    g_assert_false(gb_chart_plan_init(&plan, &params, NULL, NULL, "many", 3, &err));
    gb_chart_plan_finish(&plan);
}

/* Choices survive the way into params and back. */
static void test_choose(void)
{
    const struct gb_params params = small_scene();
    struct gb_chart_plan plan = plan_of(&params, NULL, 2);
    for (size_t i = 0; i < plan.settings; i++) {
        struct gb_params chosen = params;
        struct gb_chart_setting back;
        struct gb_error err = {0};
        gb_chart_apply(&chosen, &plan.setting[i]);
        g_assert_true(gb_chart_setting_of(&back, &chosen, &err));
        g_assert_true(gb_chart_same(&back, &plan.setting[i]));
    }
    gb_chart_plan_finish(&plan);
}

static char *fresh_directory(void)
{
    char *path = g_dir_make_tmp("gb-chart-XXXXXX", NULL);
    g_assert_nonnull(path);
    return path;
}

static void remove_directory(char *path)
{
    GDir *dir = g_dir_open(path, 0, NULL);
    const char *name;
    while ((name = g_dir_read_name(dir)) != NULL) {
        char *file = g_build_filename(path, name, NULL);
        g_remove(file);
        g_free(file);
    }
    g_dir_close(dir);
    g_rmdir(path);
    g_free(path);
}

enum { SEEDS = 4 };

/* Density of a cell: its own part, the error of the setting, and noise that has mean 0 and
 * standard deviation 0.002 sqrt(20/3) over the four seeds. */
static double made_up(int seed, double error, double noise)
{
    static const double cell[SEEDS] = {-0.012, -0.004, 0.004, 0.012};
    static const double shape[SEEDS] = {3.0, -1.0, 1.0, -3.0};
    return 0.4 + cell[seed] + error + 0.002 * noise * shape[seed];
}

static void fill_log(struct gb_chart_log *log, size_t setting, double error, double noise,
                     double cpu_s)
{
    for (int s = 0; s < SEEDS; s++) {
        struct gb_chart_run run = {.setting = log->plan->setting[setting],
                                   .seed = log->plan->params.seed + (uint64_t)s,
                                   .evaluations = 1000.0 * cpu_s,
                                   .cpu_s = cpu_s};
        struct gb_error err = {0};
        run.density[0] = made_up(s, error, noise);
        run.coordination[0] = 5.0 + 10.0 * error;
        g_assert_true(gb_chart_add(log, &run, &err));
    }
}

/* The reference, the preset's own (tolerance 0.01), 0.05 and 0.02. */
static void fill_known(struct gb_chart_log *log)
{
    g_assert_cmpuint(log->plan->settings, ==, 4);
    fill_log(log, 0, 0.0, 0.0, 40.0);
    fill_log(log, 1, 0.004, 0.1, 4.0);  /* true error, below the scatter */
    fill_log(log, 2, 0.03, 0.1, 2.0);   /* above it */
    fill_log(log, 3, 0.0005, 1.0, 8.0); /* lost in noise */
}

static void test_table(void)
{
    const struct gb_params params = small_scene();
    struct gb_chart_plan plan = plan_of(&params, vary_tolerance, SEEDS);
    struct gb_chart_log log;
    struct gb_error err = {0};
    char *directory = fresh_directory();
    g_assert_true(gb_chart_open(&log, directory, &plan, &err));
    fill_known(&log);
    struct gb_chart_table table;
    gb_chart_table_init(&table, &log, NAN);
    const struct gb_chart_row *row = table.row;
    g_assert_cmpfloat_with_epsilon(row[1].error[0], 0.004, 1e-12);
    /* sd of the shape is sqrt(20/3), over sqrt(4) */
    g_assert_cmpfloat_with_epsilon(row[1].error_se[0], 0.0002 * sqrt(20.0 / 3.0) / 2.0,
                                   1e-12);
    g_assert_cmpfloat_with_epsilon(row[1].bound, row[1].error[0] + row[1].error_se[0],
                                   1e-12);
    g_assert_cmpfloat_with_epsilon(row[1].coordination_error[0], 0.04, 1e-12);
    g_assert_cmpfloat_with_epsilon(row[0].scatter[0], 0.004 * sqrt(20.0 / 3.0), 1e-12);
    g_assert_false(row[1].noise_limited);
    g_assert_false(row[2].noise_limited);
    g_assert_true(row[3].noise_limited);
    g_assert_true(row[1].pareto && row[2].pareto && row[3].pareto);
    g_assert_true(gb_chart_table_chosen(&table) == &row[1]);
    gb_chart_table_finish(&table);
    gb_chart_table_init(&table, &log, 0.0035);
    g_assert_true(gb_chart_table_chosen(&table) == &table.row[3]);
    gb_chart_table_finish(&table);
    gb_chart_table_init(&table, &log, 1e-5);
    g_assert_null(gb_chart_table_chosen(&table));
    gb_chart_table_finish(&table);
    gb_chart_close(&log);
    gb_chart_plan_finish(&plan);
    remove_directory(directory);
}

/* A failed cell and a setting with fewer seeds than the reference are never chosen. */
static void test_incomplete(void)
{
    const struct gb_params params = small_scene();
    struct gb_chart_plan plan = plan_of(&params, vary_tolerance, SEEDS);
    struct gb_chart_log log;
    struct gb_error err = {0};
    char *directory = fresh_directory();
    g_assert_true(gb_chart_open(&log, directory, &plan, &err));
    fill_log(&log, 0, 0.0, 0.0, 40.0);
    fill_log(&log, 1, 0.0, 0.1, 4.0);
    g_array_index(log.runs, struct gb_chart_run, log.runs->len - 1).failed = true;
    fill_log(&log, 2, 0.0, 0.1, 4.0);
    g_array_set_size(log.runs, log.runs->len - 1);
    struct gb_chart_table table;
    gb_chart_table_init(&table, &log, NAN);
    g_assert_null(gb_chart_table_chosen(&table));
    g_assert_cmpint(table.row[1].failed, ==, 1);
    g_assert_cmpint(table.row[2].seeds, ==, SEEDS - 1);
    g_assert_cmpint(table.row[3].seeds, ==, 0);
    gb_chart_table_finish(&table);
    gb_chart_close(&log);
    gb_chart_plan_finish(&plan);
    remove_directory(directory);
}

/* What is on disk is found again, to the last bit; other scenes and other files are
 * refused. */
static void test_log(void)
{
    const struct gb_params params = small_scene();
    struct gb_chart_plan plan = plan_of(&params, vary_tolerance, SEEDS);
    struct gb_chart_log log, again;
    struct gb_error err = {0};
    char *directory = fresh_directory();
    g_assert_true(gb_chart_open(&log, directory, &plan, &err));
    fill_known(&log);
    g_assert_false(gb_chart_open(&again, directory, &plan, &err)); /* under way */
    g_assert_nonnull(strstr(err.text, "under way"));
    gb_chart_close(&again);
    gb_chart_close(&log);
    g_assert_true(gb_chart_open(&log, directory, &plan, &err));
    g_assert_cmpuint(log.runs->len, ==, 4 * SEEDS);
    for (size_t i = 0; i < plan.settings; i++) {
        const struct gb_chart_run *run =
            gb_chart_find(&log, &plan.setting[i], plan.params.seed + 2);
        g_assert_nonnull(run);
        g_assert_cmpfloat(run->cpu_s, >, 1.0);
    }
    g_assert_null(gb_chart_find(&log, &plan.setting[0], plan.params.seed + SEEDS));
    gb_chart_close(&log);
    gb_chart_plan_finish(&plan);

    struct gb_params other = params;
    other.mu = 0.3;
    plan = plan_of(&other, vary_tolerance, SEEDS);
    g_assert_false(gb_chart_open(&log, directory, &plan, &err));
    g_assert_nonnull(strstr(err.text, "contact.mu"));
    gb_chart_close(&log);
    char *alien = g_build_filename(directory, "runs.csv", NULL);
    g_remove(alien); /* what is left is no chart */
    g_free(alien);
    g_assert_false(gb_chart_open(&log, directory, &plan, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    gb_chart_close(&log);
    gb_chart_plan_finish(&plan);
    remove_directory(directory);
}

static bool at_once(void *data, double cpu_s)
{
    (void)data;
    return cpu_s >= 0.0;
}

/* One real cell: the same twice, cheaper where less is asked, and cancelled. */
static void test_press(void)
{
    const struct gb_params params = small_scene();
    struct gb_chart_plan plan = plan_of(&params, vary_tolerance, 2);
    struct gb_error err = {0};
    struct gb_chart_run run[3];
    for (int i = 0; i < 3; i++) {
        run[i] = (struct gb_chart_run){.setting = plan.setting[i < 2 ? 1 : 2], .seed = 7};
        g_assert_true(
            gb_chart_press(&run[i], &params, plan.pressure_pa, 1, NULL, NULL, &err));
        g_assert_false(run[i].failed);
        g_assert_cmpfloat(run[i].density[0], >, 0.3);
        g_assert_cmpfloat(run[i].density[0], <, 0.55);
        g_assert_cmpfloat(run[i].cpu_s, >, 0.0);
    }
    g_assert_cmpfloat(run[0].density[0], ==, run[1].density[0]);
    g_assert_cmpfloat(run[0].evaluations, ==, run[1].evaluations);
    g_assert_cmpfloat(run[2].evaluations, <, run[0].evaluations);
    g_assert_false(
        gb_chart_press(&run[0], &params, plan.pressure_pa, 1, at_once, NULL, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_CANCELLED);
    gb_chart_plan_finish(&plan);
}

/* Cells that halve the scatter are four times as few; small ones are told. */
static void test_advice(void)
{
    const struct gb_params params = scene_params(
        "particles.count=1000", "loading.until=100 MPa", "loading.unload_from=", NULL);
    const char *sizes[] = {"particles.count=150,1000", NULL};
    struct gb_chart_plan plan = plan_of(&params, sizes, SEEDS);
    struct gb_chart_log log;
    struct gb_error err = {0};
    char *directory = fresh_directory();
    g_assert_true(gb_chart_open(&log, directory, &plan, &err));
    for (size_t i = 0; i < plan.settings; i++) {
        fill_log(&log, i, 0.0, 0.0, 3.0);
    }
    struct gb_chart_table table;
    struct gb_chart_advice advice[2];
    gb_chart_table_init(&table, &log, NAN);
    for (int i = 0; i < 2; i++) {
        g_assert_true(
            gb_chart_table_advise(&advice[i], &table, &plan, i ? 0.0005 : 0.001, &err));
        g_assert_cmpint(advice[i].sizes, ==, 2);
    }
    g_assert_cmpfloat(advice[0].size[1].cells, ==, ceil(16.0 * 20.0 / 3.0));
    g_assert_cmpfloat(advice[1].size[1].cells, ==, ceil(64.0 * 20.0 / 3.0));
    g_assert_cmpint(advice[0].size[0].count, ==, 150);
    g_assert_false(advice[0].size[0].large_enough);
    g_assert_true(advice[0].size[1].large_enough);
    gb_chart_table_finish(&table);
    gb_chart_close(&log);
    gb_chart_plan_finish(&plan);
    remove_directory(directory);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/chart/plan", test_plan);
    g_test_add_func("/chart/choose", test_choose);
    g_test_add_func("/chart/table", test_table);
    g_test_add_func("/chart/incomplete", test_incomplete);
    g_test_add_func("/chart/log", test_log);
    g_test_add_func("/chart/press", test_press);
    g_test_add_func("/chart/advice", test_advice);
    return g_test_run();
}
