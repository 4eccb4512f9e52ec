/* Quantities of studies and their charts: the table, what is planned, what follows from known
 * cells, what is found again on disk. */
#include <gsl/gsl_cdf.h>
#include <math.h>
#include <string.h>

#include <glib.h>

#include "common/die.h"
#include "common/run_directory.h"
#include "common/scene.h"
#include "common/tree.h"
#include "many/single_run.h"
#include "study/quantity_chart.h"

static struct gb_params scene_of(const struct gb_quantity_study *study)
{
    if (strcmp(study->name, "die") == 0) {
        return scene_params("scene.kind=die", "loading.geometry=die",
                            "contact.normal=storakers", "material.yield=800 MPa",
                            "die.cycle=full", NULL);
    }
    return scene_params("loading.unload_from=", "loading.until=100 MPa", NULL);
}

static const struct gb_quantity *find(const char *name)
{
    struct gb_error err = {0};
    const struct gb_quantity *row = gb_quantity_chart_find(name, &err);
    if (row == NULL) {
        g_error("%s", err.text);
    }
    return row;
}

/* An axis reaches the run: what is set is the next default. */
static void check_axis(const struct gb_quantity_study *study, int a)
{
    const struct gb_quantity_axis *axis = &study->axis[a];
    struct gb_params params = scene_of(study);
    struct gb_model model = scene_model(&params);
    const double own = axis->own(&params, &model);
    bool has_own = false,
         has_fifth = fabs(log(axis->factor[0])) >= log(5.0) * (1.0 - 1e-9);
    g_assert_cmpfloat(own, >, 0.0);
    for (int k = 0; k < GB_QUANTITY_FACTORS && axis->factor[k] > 0.0; k++) {
        has_own = has_own || axis->factor[k] == 1.0;
        if (axis->set != NULL) {
            axis->set(&params, own * axis->factor[k]);
            model = scene_model(&params);
            g_assert_cmpfloat_with_epsilon(axis->own(&params, &model),
                                           own * axis->factor[k],
                                           1e-9 * own * axis->factor[k]);
        }
    }
    g_assert_true(has_own);
    g_assert_true(has_fifth); /* the reference is five times tighter */
}

static void test_table(void)
{
    int rows = 0;
    for (const struct gb_quantity *row = gb_quantity_chart_quantities();
         row->name != NULL; row++) {
        struct gb_error err = {0};
        const struct gb_params params = scene_of(row->study);
        g_assert_true(find(row->name) == row); /* names are unique */
        g_assert_true(row->unit[0] != '\0' && row->meaning[0] != '\0');
        g_assert_cmpint(row->index, <, GB_QUANTITY_VALUES);
        for (const struct gb_quantity *other = gb_quantity_chart_quantities();
             other < row; other++) {
            g_assert_true(other->study != row->study || other->index != row->index);
        }
        g_assert_true(row->study->check(&params, &err));
        g_assert_cmpint(row->study->cells, >, 1);
        g_assert_cmpint(gb_quantity_chart_axes(row->study), >, 0);
        for (int a = 0; a < gb_quantity_chart_axes(row->study); a++) {
            check_axis(row->study, a);
        }
        rows++;
    }
    g_assert_cmpint(rows, >, 9);
    struct gb_error err = {0};
    g_assert_null(gb_quantity_chart_find("strength", &err));
    g_assert_nonnull(strstr(err.text, "expected E, nu"));
}

static char *folder;

static struct gb_quantity_chart chart_of(const char *name, const char *const *vary,
                                         const char *const *reference, int seeds,
                                         const char *directory)
{
    struct gb_quantity_chart chart;
    struct gb_error err = {0};
    const struct gb_params params = scene_of(find(name)->study);
    if (!gb_quantity_chart_init(&chart, find(name)->study, &params, NULL, vary, reference,
                                seeds, directory, &err)) {
        g_error("%s", err.text);
    }
    return chart;
}

static const struct gb_quantity_setting *setting(const struct gb_quantity_chart *chart,
                                                 guint i)
{
    return &g_array_index(chart->setting, struct gb_quantity_setting, i);
}

static void refused(const char *name, const char *at, const char *const *vary,
                    const char *text)
{
    struct gb_quantity_chart chart;
    struct gb_error err = {0};
    const struct gb_params params = scene_of(find(name)->study);
    char *directory = g_build_filename(folder, "refused", NULL);
    g_assert_false(gb_quantity_chart_init(&chart, find(name)->study, &params, at, vary,
                                          NULL, 2, directory, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    g_test_message("%s", err.text);
    g_assert_nonnull(strstr(err.text, text));
    g_assert_false(g_file_test(directory, G_FILE_TEST_EXISTS));
    gb_quantity_chart_finish(&chart);
    g_free(directory);
}

static void test_plan(void)
{
    char *directory = g_build_filename(folder, "plan", NULL);
    /* two axes: all combinations; the default and the reference are among them */
    struct gb_quantity_chart chart = chart_of("E", NULL, NULL, 3, directory);
    g_assert_cmpuint(chart.setting->len, ==, 4 * 4);
    g_assert_cmpuint(chart.cells.list->len, ==, 3 * chart.setting->len);
    for (int a = 0; a < 2; a++) {
        g_assert_cmpfloat_with_epsilon(setting(&chart, 0)->value[a],
                                       0.2 * setting(&chart, 1)->value[a], 1e-12);
    }
    gb_quantity_chart_finish(&chart);
    /* four: one at a time */
    chart = chart_of("residual_stress", NULL, NULL, 2, directory);
    g_assert_cmpuint(chart.setting->len, ==, 2 + 2 + 2 + 3 + 2);
    for (guint i = 2; i < chart.setting->len; i++) {
        int changed = 0;
        for (int a = 0; a < 4; a++) {
            changed += setting(&chart, i)->value[a] != setting(&chart, 1)->value[a];
        }
        g_assert_cmpint(changed, ==, 1);
    }
    gb_quantity_chart_finish(&chart);
    const char *vary[] = {"loading.step=0.1 %,0.2 %", "numerics.tolerance=0.1,0.2,0.3",
                          NULL};
    const char *reference[] = {"loading.step=0.01 %", NULL};
    chart = chart_of("heckel_A", vary, reference, 2, directory);
    g_assert_cmpuint(chart.setting->len, ==, 2 + 6);
    g_assert_cmpfloat(setting(&chart, 0)->value[1], ==, 1e-4);
    g_assert_cmpfloat(setting(&chart, 2)->value[0], ==, 0.1);
    g_assert_cmpfloat(setting(&chart, 2)->value[1], ==, 1e-3);
    gb_quantity_chart_finish(&chart);
    chart = chart_of("nu", vary + 2, NULL, 2, directory); /* an empty list */
    g_assert_cmpuint(chart.setting->len, ==, 2);
    gb_quantity_chart_finish(&chart);

    const char *no_axis[] = {"contact.mu=0.1,0.2", NULL};
    const char *no_value[] = {"numerics.tolerance=0.1,0", NULL};
    refused("E", NULL, no_axis, "expected NAME=VALUE with one of numerics.tolerance");
    refused("E", NULL, no_value, "expected a number above 0");
    refused("E", "every 3", NULL, "expected one density or pressure");
    refused("heckel_K", "density = 0.5", NULL, "expected none for a quantity of fit");
    g_free(directory);
}

/* Scenes without the quantity. */
static void test_scenes(void)
{
    struct gb_error err = {0};
    const struct gb_params cell = scene_of(find("E")->study);
    const struct gb_params die = scene_of(find("residual_stress")->study);
    for (const struct gb_quantity *row = gb_quantity_chart_quantities();
         row->name != NULL; row++) {
        const bool of_die = strcmp(row->study->name, "die") == 0;
        g_assert_false(row->study->check(of_die ? &cell : &die, &err));
        g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    }
}

enum { SEEDS = 4 };

/* An answer, as a worker writes it. */
static void answer(const struct gb_quantity_chart *chart, guint s, int seed, double cpu_s,
                   bool failed, double young)
{
    const struct gb_cells_item *item =
        g_ptr_array_index(chart->cells.list, s * SEEDS + (guint)seed);
    char *path = g_build_filename(chart->cells.directory, item->name, NULL);
    GString *text = g_string_new(item->question);
    struct gb_error err = {0};
    g_assert_true(gb_cells_answer(path, ".ini", text, &err));
    if (failed) {
        g_string_printf(text, "cpu_s,failed,E,nu\n%g,1,,\n", cpu_s);
    } else {
        g_string_printf(text, "cpu_s,failed,E,nu\n%g,0,%.17g,0.2\n", cpu_s, young);
    }
    g_assert_true(gb_cells_answer(path, ".csv", text, &err));
    g_string_free(text, TRUE);
    g_free(path);
}

/* Cells of scatter 0.8 sqrt(20/3); noise has mean 0 and is independent of the cell. */
static void answers(const struct gb_quantity_chart *chart, guint s, double error,
                    double noise, double cpu_s)
{
    static const double cell[SEEDS] = {-3.0, -1.0, 1.0, 3.0};
    static const double shape[SEEDS] = {1.0, -1.0, -1.0, 1.0};
    for (int c = 0; c < SEEDS; c++) {
        answer(chart, s, c, cpu_s, false,
               10.0 + 0.8 * cell[c] + error + noise * shape[c]);
    }
}

static void test_known(void)
{
    static const char *const vary[] = {"numerics.tolerance=0.001,0.002,0.003,0.004",
                                       NULL};
    char *directory = g_build_filename(folder, "known", NULL);
    struct gb_quantity_chart chart = chart_of("E", vary, NULL, SEEDS, directory);
    size_t missing = 0;
    g_assert_cmpuint(chart.setting->len, ==, 6);
    g_assert_cmpfloat(gb_quantity_chart_cost_s(&chart, &missing), >, 0.0);
    g_assert_cmpuint(missing, ==, 6 * SEEDS);
    answers(&chart, 0, 0.0, 0.0, 40.0);
    answers(&chart, 1, 1.5, 0.01, 2.0); /* true deviation, below half of the interval */
    answers(&chart, 2, 3.0, 0.01, 1.0); /* above it */
    answers(&chart, 3, 0.0, 3.0, 0.5);  /* lost in noise */
    answers(&chart, 4, 0.1, 0.01, 8.0); /* smaller and dearer */
    answer(&chart, 5, 0, 0.1, false, 10.0 - 2.4);
    answer(&chart, 5, 1, 0.1, true, NAN);
    gb_quantity_chart_finish(&chart);

    /* found again, and only what is missing is counted */
    chart = chart_of("nu", vary, NULL, SEEDS, directory);
    g_assert_cmpfloat(gb_quantity_chart_cost_s(&chart, &missing), >, 0.0);
    g_assert_cmpuint(missing, ==, 2);
    g_assert_cmpfloat_with_epsilon(gb_quantity_chart_spent_s(&chart),
                                   4.0 * (40.0 + 2.0 + 1.0 + 0.5 + 8.0) + 0.2, 1e-9);
    struct gb_quantity_table table;
    gb_quantity_chart_table_init(&table, &chart, find("E"), NAN);
    const double t3 = gsl_cdf_tdist_Pinv(0.975, 3.0);
    const struct gb_quantity_result *row = gb_quantity_chart_table_at(&table, 0);
    g_assert_cmpfloat_with_epsilon(row[1].error, 1.5, 1e-9);
    g_assert_cmpfloat_with_epsilon(row[1].error_95, t3 * 0.01 * sqrt(4.0 / 3.0) / 2.0,
                                   1e-9);
    g_assert_cmpfloat_with_epsilon(row[1].bound, row[1].error + row[1].error_95, 1e-9);
    g_assert_cmpfloat_with_epsilon(row[0].scatter, 0.8 * sqrt(20.0 / 3.0), 1e-9);
    g_assert_cmpfloat_with_epsilon(row[0].cost, 20.0, 1e-9);
    /* interval of eight cells, scatter pooled */
    g_assert_cmpfloat(table.half_interval, >,
                      gsl_cdf_tdist_Pinv(0.975, 7.0) * row[0].scatter / sqrt(8.0));
    g_assert_cmpfloat(table.half_interval, <, 3.0);
    g_assert_true(row[3].noise_limited && !row[1].noise_limited);
    g_assert_true(isnan(row[0].bound));
    g_assert_true(row[1].front && row[2].front && row[4].front && row[3].front);
    g_assert_cmpint(row[5].failed, ==, 1);
    g_assert_false(row[5].front || row[5].chosen);
    g_assert_true(gb_quantity_chart_table_chosen(&table) == &row[1]);
    gb_quantity_chart_table_finish(&table);
    gb_quantity_chart_table_init(&table, &chart, find("E"), 0.2);
    g_assert_true(gb_quantity_chart_table_chosen(&table) ==
                  gb_quantity_chart_table_at(&table, 4));
    gb_quantity_chart_table_finish(&table);
    gb_quantity_chart_table_init(&table, &chart, find("E"), 1e-3);
    g_assert_null(gb_quantity_chart_table_chosen(&table));
    gb_quantity_chart_table_finish(&table);
    gb_quantity_chart_finish(&chart);

    /* another scene has no answers yet */
    struct gb_error err = {0};
    struct gb_params other = scene_of(find("E")->study);
    other.mu = 0.123;
    g_assert_true(gb_quantity_chart_init(&chart, find("E")->study, &other, NULL, vary,
                                         NULL, SEEDS, directory, &err));
    gb_quantity_chart_cost_s(&chart, &missing);
    g_assert_cmpuint(missing, ==, 6 * SEEDS);
    gb_quantity_chart_finish(&chart);
    g_free(directory);
}

/* Numbers that are not known yet are "-": without cells of the default no row has a cost. */
static void test_unknown(void)
{
    static const char *const vary[] = {"numerics.tolerance=0.001,0.002", NULL};
    char *directory = g_build_filename(folder, "unknown", NULL);
    for (int known = 0; known < 3; known++) {
        struct gb_quantity_chart chart = chart_of("E", vary, NULL, SEEDS, directory);
        struct gb_quantity_table table;
        if (known == 1) {
            answers(&chart, 2, 0.1, 0.01, 1.0);
        } else if (known == 2) {
            answers(&chart, 0, 0.0, 0.0, 40.0);
        }
        gb_quantity_chart_finish(&chart);
        chart = chart_of("E", vary, NULL, SEEDS, directory);
        for (int limited = 0; limited < 2; limited++) {
            gb_quantity_chart_table_init(&table, &chart, find("E"), limited ? 1.0 : NAN);
            GString *text = gb_quantity_chart_table_text(&table);
            GString *csv = gb_quantity_chart_table_csv(&table, "");
            g_test_message("%s", text->str);
            g_assert_false(g_regex_match_simple("\\b(nan|inf)\\b", text->str, 0, 0));
            g_assert_false(g_regex_match_simple("\\b(nan|inf)\\b", csv->str, 0, 0));
            g_assert_null(strstr(text->str, "(- times"));
            g_assert_true(known == 0 || strstr(text->str, "      -      4") != NULL);
            g_string_free(csv, TRUE);
            g_string_free(text, TRUE);
            gb_quantity_chart_table_finish(&table);
        }
        gb_quantity_chart_finish(&chart);
    }
    g_free(directory);
}

static bool at_once(void *data)
{
    (void)data;
    return true;
}

/* Stopped, continued, and what a cell gives does not depend on that. */
static void test_work(void)
{
    static const char *const none[] = {NULL};
    static const char *const loose[] = {"numerics.tolerance=0.02", "loading.step=0.2 %",
                                        NULL};
    const struct gb_cells_callbacks stop = {.cancelled = at_once};
    char *directory = g_build_filename(folder, "work", NULL);
    struct gb_quantity_chart chart = chart_of("heckel_K", none, loose, 2, directory);
    struct gb_error err = {0};
    size_t missing = 0;
    g_assert_false(gb_quantity_chart_work(&chart, 1, &stop, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_CANCELLED);
    gb_quantity_chart_cost_s(&chart, &missing);
    g_assert_cmpuint(missing, >, 0);
    gb_quantity_chart_finish(&chart);
    chart = chart_of("heckel_K", none, loose, 2, directory);
    err = (struct gb_error){0};
    if (!gb_quantity_chart_work(&chart, 1, NULL, &err)) {
        g_error("%s", err.text);
    }
    gb_quantity_chart_cost_s(&chart, &missing);
    g_assert_cmpuint(missing, ==, 0);
    for (guint i = 0; i < chart.cells.list->len; i++) {
        g_assert_false(chart.cell[i].failed);
        g_assert_cmpfloat(chart.cell[i].cpu_s, >, 0.0);
        g_assert_cmpfloat(chart.cell[i].value[find("heckel_K")->index], >, 0.0);
        g_assert_cmpfloat(chart.cell[i].value[find("kawakita_a")->index], >, 0.0);
    }
    gb_quantity_chart_finish(&chart);
    g_free(directory);
}

/* Rows of the curve of a die after its first point. */
static char *later_rows(const struct gb_params *params, const struct gb_params *first)
{
    struct run_directory dir = run_directory_make("bed");
    struct gb_error err = {0};
    const bool good = first != NULL
                          ? gb_single_run_after(params, first, dir.directory, NULL, &err)
                          : gb_single_run(params, dir.directory, NULL, &err);
    if (!good) {
        g_error("%s", err.text);
    }
    char *rows = run_directory_rows(&dir);
    char *later = g_strdup(strstr(rows, "\nload,1,"));
    g_assert_nonnull(later);
    g_free(rows);
    run_directory_finish(&dir);
    return later;
}

/* A bed that is filled with other numerics is pressed with its own: the same bits where both
 * are the same, and the same bed where they differ. */
static void test_same_bed(void)
{
    struct gb_params own =
        die_params("particles.count=30", "loading.until=10 MPa",
                   "loading.record_pressure=1 MPa", "numerics.inertia_scale=10", NULL);
    struct gb_params other = own;
    other.inertia_scale = 2.0;
    char *whole = later_rows(&own, NULL);
    char *after = later_rows(&own, &own);
    char *filled = later_rows(&other, &own);
    char *alone = later_rows(&other, NULL);
    g_assert_true(strcmp(after, whole) == 0);
    g_assert_true(strcmp(filled, whole) != 0);
    g_assert_true(strcmp(filled, alone) != 0);
    g_free(whole);
    g_free(after);
    g_free(filled);
    g_free(alone);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    folder = g_dir_make_tmp("gb-quantities-XXXXXX", NULL);
    g_test_add_func("/quantities/table", test_table);
    g_test_add_func("/quantities/plan", test_plan);
    g_test_add_func("/quantities/scenes", test_scenes);
    g_test_add_func("/quantities/known", test_known);
    g_test_add_func("/quantities/unknown", test_unknown);
    g_test_add_func("/quantities/work", test_work);
    g_test_add_func("/quantities/same-bed", test_same_bed);
    const int status = g_test_run();
    remove_tree(folder);
    g_free(folder);
    return status;
}
