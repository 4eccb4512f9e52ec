/* Measured values of several quantities, and what a simulated curve says to them. */
#include <math.h>
#include <string.h>

#include <glib.h>
#include <glib/gstdio.h>

#include "common/scene.h"
#include "many/compaction_data.h"

static char *folder;

static struct gb_table *table_of(const char *text)
{
    struct gb_table *table = NULL;
    struct gb_error err = {0};
    char *path = g_build_filename(folder, "a.csv", NULL);
    g_assert_true(g_file_set_contents(path, text, -1, NULL));
    if (!gb_table_read(&table, path, "branch", &err)) {
        g_error("%s", err.text);
    }
    g_remove(path);
    g_free(path);
    return table;
}

static bool take(struct gb_labdata *measured, const char *text, struct gb_error *err)
{
    const struct gb_params params = scene_params(NULL, NULL);
    struct gb_table *table = table_of(text);
    const bool good = gb_compaction_data_take(measured, table, &params, err);
    gb_table_destroy(table);
    return good;
}

static void test_quantities(void)
{
    struct gb_labdata measured;
    struct gb_error err = {0};
    g_assert_true(take(&measured,
                       "p_MPa,density,density_error,lateral_ratio,lateral_ratio_error,"
                       "unloading_modulus_GPa,unloading_modulus_GPa_error,branch,weight\n"
                       "100,0.5,0.01,0.6,0.02,,,load,3\n"
                       "150,,,,,12,0.5,load,\n"
                       "200,0.55,0.01,,,,,unload,0.5\n",
                       &err));
    g_assert_cmpuint(measured.count, ==, 4);
    g_assert_cmpuint(measured.scenes, ==, 1);
    static const struct {
        enum gb_lab_quantity quantity;
        double mpa, value, error, weight;
        bool unloaded;
    } want[] = {
        {GB_LAB_QUANTITY_DENSITY, 100, 0.5, 0.01, 3, false},
        {GB_LAB_QUANTITY_LATERAL_RATIO, 100, 0.6, 0.02, 3, false},
        {GB_LAB_QUANTITY_UNLOADING_MODULUS, 150, 12, 0.5, 1, false},
        {GB_LAB_QUANTITY_DENSITY, 200, 0.55, 0.01, 0.5, true},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(want); i++) {
        g_assert_cmpint(measured.row[i].quantity, ==, want[i].quantity);
        g_assert_cmpfloat_with_epsilon(measured.row[i].pressure_pa, 1e6 * want[i].mpa, 1);
        g_assert_cmpfloat(measured.value[i], ==, want[i].value);
        g_assert_cmpfloat(measured.error[i], ==, want[i].error);
        g_assert_cmpfloat(measured.weight[i], ==, want[i].weight);
        g_assert_cmpint(measured.row[i].unloaded, ==, want[i].unloaded);
    }
    /* a modulus is measured on unloading */
    g_assert_cmpint(measured.scene[0].unload_count, ==, 2);
    g_assert_cmpfloat_with_epsilon(measured.scene[0].unload_from_pa[0], 150e6, 1);
    g_assert_cmpfloat_with_epsilon(measured.scene[0].until_pressure_pa, 200e6, 1);
    gb_compaction_data_targets_finish(&measured);
}

static void test_refused(void)
{
    static const struct {
        const char *text, *told;
    } bad[] = {
        {"p_MPa,density,lateral_ratio\n100,0.5,0.6\n", "an error above 0"},
        {"p_MPa,lateral_ratio,branch\n100,0.6,unload\n", "expected on branch load"},
        {"p_MPa,coordination\n100,40\n", "between 0 and 15"},
        {"p_MPa,unloading_modulus_GPa\n100,-1\n", "must be above 0"},
        {"p_MPa,density,weight\n100,0.5,0\n", "weight must be above 0"},
        {"p_MPa,density\n100,\n", "measured value"},
        {"p_MPa,density\n100,1.2\n", "between 0 and 1"},
        {"p_MPa,density,strength\n100,0.5,1\n", "column strength"},
        {"p_MPa,weight\n100,1\n", "density"},
        {"p_MPa,density,density_error\n100,0.5,0.01\n200,0.5,\n", "an error above 0"},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(bad); i++) {
        struct gb_labdata measured;
        struct gb_error err = {0};
        g_assert_false(take(&measured, bad[i].text, &err));
        g_test_message("%s", err.text);
        g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
        g_assert_nonnull(strstr(err.text, bad[i].told));
    }
}

/* Unloading from 100 MPa with a modulus of 20 GPa: ln(density) falls by dp / M. */
static void test_simulated(void)
{
    GString *text = g_string_new("branch,density,px_MPa,py_MPa,pz_MPa,p_MPa,coordination,"
                                 "bridged,rattlers\n"
                                 "load,0.40,30,30,50,50,5,0,0\n"
                                 "load,0.50,66,66,110,110,6,0,0\n");
    const double from = 0.40 + 0.10 * 50.0 / 60.0; /* at 100 MPa */
    for (int p = 99; p >= 0; p -= 3) {
        g_string_append_printf(text, "unload:100MPa,%.12g,1,1,%d,%d,5.5,0,0\n",
                               from * exp(-(100.0 - p) / 20e3), p, p);
    }
    struct gb_table *curve = table_of(text->str);
    g_string_free(text, TRUE);
    struct gb_labdata_row row = {.pressure_pa = 100e6};
    g_assert_cmpfloat_with_epsilon(gb_compaction_data_simulated(&row, curve), from,
                                   1e-12);
    row.quantity = GB_LAB_QUANTITY_LATERAL_RATIO;
    g_assert_cmpfloat_with_epsilon(gb_compaction_data_simulated(&row, curve), 0.6, 1e-12);
    row.quantity = GB_LAB_QUANTITY_COORDINATION;
    g_assert_cmpfloat_with_epsilon(gb_compaction_data_simulated(&row, curve),
                                   5.0 + 5.0 / 6.0, 1e-12);
    row.quantity = GB_LAB_QUANTITY_UNLOADING_MODULUS;
    g_assert_cmpfloat_with_epsilon(gb_compaction_data_simulated(&row, curve), 20.0, 1e-3);
    row.pressure_pa = 50e6; /* no unloading from there */
    g_assert_true(isnan(gb_compaction_data_simulated(&row, curve)));
    gb_table_destroy(curve);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    folder = g_dir_make_tmp("labdata-XXXXXX", NULL);
    g_test_add_func("/labdata/quantities", test_quantities);
    g_test_add_func("/labdata/refused", test_refused);
    g_test_add_func("/labdata/simulated", test_simulated);
    const int failed = g_test_run();
    g_rmdir(folder);
    g_free(folder);
    return failed;
}
