/* Experiments from CSV files, and how far a curve lies from them. */
#include <glib.h>
#include <glib/gstdio.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

#include "io/lab/lab_reader.h"
#include "io/measured.h"

static char *write_file(const char *content)
{
    char *path = g_build_filename(g_get_tmp_dir(), "gb-measured-XXXXXX", NULL);
    const int fd = g_mkstemp(path);
    g_assert_cmpint(fd, >=, 0);
    g_assert_cmpint(write(fd, content, strlen(content)), ==, (gssize)strlen(content));
    close(fd);
    return path;
}

/* As everything that reads measured points does: the table first. */
static bool read_file(struct gb_measured **measured, const char *path,
                      struct gb_error *err)
{
    struct gb_table *table = NULL;
    struct gb_lab_report report;
    const enum gb_lab_outcome outcome =
        gb_lab_reader_read(&table, path, NULL, NULL, &report, err);
    if (outcome == GB_LAB_QUESTION) {
        return gb_error_set(err, GB_ERR_INPUT, "%s", report.question);
    }
    g_assert_cmpstr(report.told, ==, "");
    const bool good =
        outcome == GB_LAB_READ && gb_measured_take(measured, table, false, err);
    gb_table_destroy(table);
    return good;
}

static struct gb_measured *read_good(const char *content)
{
    struct gb_measured *measured = NULL;
    struct gb_error err = {0};
    char *path = write_file(content);
    if (!read_file(&measured, path, &err)) {
        g_error("%s", err.text);
    }
    g_unlink(path);
    g_free(path);
    return measured;
}

static void expect_error(const char *content, const char *part)
{
    struct gb_measured *measured = NULL;
    struct gb_error err = {0};
    char *path = write_file(content);
    g_assert_false(read_file(&measured, path, &err));
    if (strstr(err.text, part) == NULL || strchr(err.text, '\n') != NULL) {
        g_error("\"%s\" does not say \"%s\" in one line", err.text, part);
    }
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    g_unlink(path);
    g_free(path);
}

static void test_columns(void)
{
    struct gb_measured *a = read_good("# P1, Fig. 5\ndensity,p_MPa,p_MPa_error\n"
                                      "0.387,100,2\n0.6,1000,\n");
    g_assert_cmpuint(a->count, ==, 2);
    g_assert_cmpfloat(a->density[0], ==, 0.387);
    g_assert_cmpfloat(a->pressure_pa[1], ==, 1e9);
    g_assert_cmpfloat(a->pressure_error_pa[0], ==, 2e6);
    g_assert_true(isnan(a->pressure_error_pa[1]) && isnan(a->density_error[0]));
    struct gb_measured *b =
        read_good("pressure_GPa,density_percent,density_percent_error,"
                  "series\n0.1,38.7,0.5,9.7 nm\n");
    g_assert_cmpfloat_with_epsilon(b->density[0], 0.387, 1e-15);
    g_assert_cmpfloat_with_epsilon(b->density_error[0], 0.005, 1e-15);
    g_assert_cmpfloat(b->pressure_pa[0], ==, 1e8);
    gb_measured_destroy(a);
    gb_measured_destroy(b);
    gb_measured_destroy(NULL);
}

static void test_refusals(void)
{
    expect_error("density,force\n0.3,1\n", "force from column 2");
    expect_error("density,p_MPa\n", "has no rows");
    expect_error("density,p_MPa\n0.3,10\n38.7,100\n", ":3: density 38.7: expected");
    expect_error("density,p_MPa\n0.3,-1\n", ":2: p_MPa -1: expected");
    expect_error("density,p_MPa\n0.3,0\n", ":2: p_MPa 0: expected above 0");
    expect_error("density,p_MPa\n0.3,\n", ":2: p_MPa");
    expect_error("density,p_MPa,density_error\n0.3,10,-1\n", "density_error -1");
    expect_error("density,p_MPa\n0.3,ten\n", "ten");
}

/* A straight curve, 0.1 at 0 MPa to 0.6 at 500 MPa, and a branch that does not count. */
static struct gb_curve *straight(void)
{
    struct gb_curve *curve = NULL;
    g_assert_true(gb_curve_create(&curve, NULL));
    for (int i = 0; i <= 5; i++) {
        const struct gb_point point = {
            .branch = GB_BRANCH_LOAD, .density = 0.1 + 0.1 * i, .p_pa = 1e8 * i};
        const struct gb_point back = {.branch = 1, .density = 0.9, .p_pa = 1e8 * i};
        g_assert_true(gb_curve_append(curve, &point, NULL));
        g_assert_true(gb_curve_append(curve, &back, NULL));
    }
    return curve;
}

static void test_misfit(void)
{
    struct gb_curve *curve = straight();
    struct gb_measured *measured =
        read_good("density,p_MPa,density_error\n"
                  "0.24,150,0.01\n0.34,250,0.01\n0.5,9000,0.01\n");
    struct gb_measured_misfit misfit;
    gb_measured_compare(measured, curve, 12, &misfit);
    g_assert_cmpuint(misfit.reached, ==, 2);
    g_assert_cmpfloat_with_epsilon(misfit.mean, 0.01, 1e-12);
    g_assert_cmpfloat_with_epsilon(misfit.rms, 0.01, 1e-12);
    g_assert_cmpfloat_with_epsilon(misfit.weighted, 1.0, 1e-9);
    gb_measured_compare(measured, curve, 3, &misfit);
    g_assert_cmpuint(misfit.reached, ==, 0);
    g_assert_true(isnan(misfit.mean) && isnan(misfit.weighted));
    gb_measured_destroy(measured);
    gb_curve_destroy(curve);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/run/measured/columns", test_columns);
    g_test_add_func("/run/measured/refusals", test_refusals);
    g_test_add_func("/run/measured/misfit", test_misfit);
    return g_test_run();
}
