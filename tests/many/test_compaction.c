/* Points for the equations of compaction, from curves and from files. */
#include <math.h>
#include <string.h>

#include <glib.h>
#include <glib/gstdio.h>
#include <gsl/gsl_errno.h>

#include "io/lab/lab_reader.h"
#include "many/compaction_data.h"
#include "measure/compaction_fits.h"

static const struct gb_compaction_window whole = {
    .from = (double)NAN, .to = (double)NAN, .initial = (double)NAN};

static char *folder;

static char *write_file(const char *name, const char *text)
{
    char *path = g_build_filename(folder, name, NULL);
    g_assert_true(g_file_set_contents(path, text, -1, NULL));
    return path;
}

static bool read_path(struct gb_compaction_data *data, const char *path,
                      const char *series, const struct gb_compaction_window *window,
                      struct gb_error *err)
{
    struct gb_table *table = NULL;
    struct gb_lab_report report;
    *data = (struct gb_compaction_data){0};
    const enum gb_lab_outcome outcome =
        gb_lab_reader_read(&table, path, NULL, NULL, &report, err);
    if (outcome == GB_LAB_QUESTION) {
        return gb_error_set(err, GB_ERR_INPUT, "%s: %s", path, report.question);
    }
    const bool good = outcome == GB_LAB_READ &&
                      gb_compaction_data_file(data, table, series, window, err);
    gb_table_destroy(table);
    return good;
}

static bool read_text(struct gb_compaction_data *data, const char *text,
                      const char *series, const struct gb_compaction_window *window,
                      struct gb_error *err)
{
    char *path = write_file("lab.csv", text);
    const bool good = read_path(data, path, series, window, err);
    g_assert_true(good || g_strrstr(err->text, "lab.csv") != NULL);
    g_assert_null(strchr(err->text, '\n'));
    g_free(path);
    return good;
}

/* Units, order, errors, branches. */
static void test_file(void)
{
    struct gb_compaction_data data;
    struct gb_error err = {0};
    g_assert_true(read_text(&data,
                            "# a comment\n"
                            "branch,pressure_GPa,density_percent,density_percent_error\n"
                            "load,0.2,60,0.1\n,0.1,50,0.2\nload,0.05,40,0.1\n"
                            "unload,0.2,58,0.1\nunload:200MPa,0.001,57,0.1\n",
                            NULL, &whole, &err));
    g_assert_cmpuint(data.points.count, ==, 3);
    g_assert_cmpfloat_with_epsilon(data.points.pressure[0], 50.0, 1e-9);
    g_assert_cmpfloat_with_epsilon(data.points.density[1], 0.5, 1e-12);
    g_assert_cmpfloat_with_epsilon(data.points.error[1], 0.002, 1e-12);
    g_assert_true(isnan(data.points.initial));
    g_assert_cmpuint(data.curves, ==, 0);
    gb_compaction_data_finish(&data);

    const struct gb_compaction_window part = {60.0, 150.0, 0.3, false};
    g_assert_true(read_text(&data, "p_MPa,density,density_error\n50,0.4,0.1\n100,0.5,\n",
                            NULL, &part, &err));
    g_assert_cmpuint(data.points.count, ==, 1);
    g_assert_null(data.points.error); /* not all points have one */
    g_assert_cmpfloat(data.points.initial, ==, 0.3);
    gb_compaction_data_finish(&data);
}

/* A row at pressure 0 is the powder before loading. */
static void test_from_zero(void)
{
    static const char text[] = "p_MPa,density\n0,0.31\n10,0.4\n0,0.33\n20,0.5\n";
    struct gb_compaction_window window = whole;
    struct gb_compaction_data data;
    struct gb_error err = {0};
    for (int kind = 0; kind < 3; kind++) {
        window.initial = kind == 1 ? 0.35 : (double)NAN;
        window.fits_initial = kind == 2;
        g_assert_true(read_text(&data, text, NULL, &window, &err));
        g_assert_cmpuint(data.points.count, ==, 2);
        g_assert_cmpfloat(data.points.pressure[0], ==, 10.0);
        if (kind == 2) {
            g_assert_true(isnan(data.points.initial));
        } else {
            g_assert_cmpfloat_with_epsilon(data.points.initial, kind == 1 ? 0.35 : 0.32,
                                           1e-12);
        }
        gb_compaction_data_finish(&data);
    }
}

static void test_series(void)
{
    static const char text[] = "series,p_MPa,density\nA,10,0.4\nB,10,0.45\nA,20,0.5\n";
    struct gb_compaction_data data;
    struct gb_error err = {0};
    g_assert_false(read_text(&data, text, NULL, &whole, &err));
    g_assert_nonnull(strstr(err.text, "one series of A, B"));
    g_assert_false(read_text(&data, text, "C", &whole, &err));
    g_assert_true(read_text(&data, text, "A", &whole, &err));
    g_assert_cmpuint(data.points.count, ==, 2);
    gb_compaction_data_finish(&data);
    g_assert_true(
        read_text(&data, "series,p_MPa,density\nA,10,0.4\n", NULL, &whole, &err));
    gb_compaction_data_finish(&data);
}

/* Each is one line with the file, and nothing is left behind. */
static void test_hostile(void)
{
    static const char *const texts[] = {
        "",
        "\n\n\n",
        "p_MPa,density\n",
        "density\n0.5\n",
        "p_MPa\n5\n",
        "p_MPa,density\n10\n",
        "p_MPa,density\n10,0.5,3\n",
        "p_MPa,density\nten,0.5\n",
        "p_MPa,density\n10,nan\n",
        "p_MPa,density\ninf,0.5\n",
        "p_MPa,density\n1e999,0.5\n",
        "p_MPa,density\n-10,0.5\n",
        "p_MPa,density\n0,0.5\n",
        "p_MPa,density\n10,0\n",
        "p_MPa,density\n10,1.2\n",
        "p_MPa,density\n10,-0.5\n",
        "p_MPa,density,density_error\n10,0.5,-1\n",
        "p_MPa,p_MPa,density\n10,10,0.5\n",
        "branch,p_MPa,density\nup,10,0.5\n",
        "branch,p_MPa,density\nunload,10,0.5\n",
        "particles.diameter_nm,p_MPa,density\n10,10,0.5\n20,20,0.6\n",
        "\xff\xfe\x00p",
    };
    for (size_t i = 0; i < G_N_ELEMENTS(texts); i++) {
        struct gb_compaction_data data;
        struct gb_error err = {0};
        const bool good = read_text(&data, texts[i], NULL, &whole, &err);
        g_test_message("%zu: %s", i, err.text);
        g_assert_false(good);
        g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
        g_assert_null(data.memory);
    }
    struct gb_compaction_data data;
    struct gb_error err = {0};
    g_assert_false(read_path(&data, folder, NULL, &whole, &err));
    g_assert_false(read_path(&data, "/nonexistent.csv", NULL, &whole, &err));
}

/* Many rows take seconds at most, too many are refused. */
static void test_long(void)
{
    GString *text = g_string_new("p_MPa,density\n");
    struct gb_compaction_data data;
    struct gb_compaction_fits fits;
    struct gb_error err = {0};
    for (int i = 0; i < 100000; i++) {
        const double p = 1.0 + 0.01 * i;
        g_string_append_printf(text, "%.2f,%.9f\n", p, -expm1(-(0.001 * p + 0.4)));
    }
    g_assert_true(read_text(&data, text->str, NULL, &whole, &err));
    g_assert_true(gb_compaction_fits(&fits, &data.points, gb_equations_find("heckel"),
                                     GB_COMPACTION_PROFILE, &err));
    g_assert_cmpfloat_with_epsilon(fits.yield.value, 1000.0, 0.1);
    gb_compaction_data_finish(&data);
    g_string_append(text, "5000,0.99\n");
    g_assert_false(read_text(&data, text->str, NULL, &whole, &err));
    g_assert_nonnull(strstr(err.text, "100001 rows"));
    g_string_free(text, TRUE);
}

enum { ROWS = 200 };

/* rho = 0.3 + 0.05 ln(1 + P/10), and a constant more. */
static void fill_curve(double *x, double *y, double more)
{
    for (int i = 0; i < ROWS; i++) {
        x[i] = 5.0 * i;
        y[i] = 0.3 + more + 0.05 * log1p(x[i] / 10.0);
    }
}

/* Levels, mean, errors and window of replicas. */
static void test_curves(void)
{
    static const double more[] = {-0.01, 0.0, 0.01};
    double x[3][ROWS], y[3][ROWS];
    struct gb_average_curve curves[3];
    struct gb_compaction_data data;
    struct gb_error err = {0};
    for (int c = 0; c < 3; c++) {
        fill_curve(x[c], y[c], more[c]);
        curves[c] = (struct gb_average_curve){x[c], y[c], ROWS - (size_t)c};
    }
    g_assert_true(gb_compaction_data_curves(&data, curves, 3, 0.3, &whole, &err));
    const struct gb_equations_points *points = &data.points;
    const double most = 5.0 * (ROWS - 3); /* that of the shortest */
    g_assert_cmpuint(points->count, ==, GB_COMPACTION_DATA_LEVELS);
    g_assert_cmpfloat_with_epsilon(points->pressure[0], 0.01 * most, 1e-9);
    g_assert_cmpfloat(points->pressure[points->count - 1], ==, most);
    g_assert_cmpfloat(points->initial, ==, 0.3);
    for (size_t i = 0; i < points->count; i++) {
        const double rho = 0.3 + 0.05 * log1p(points->pressure[i] / 10.0);
        g_assert_cmpfloat_with_epsilon(points->density[i], rho, 2e-3);
        g_assert_cmpfloat_with_epsilon(points->error[i], 0.01 / sqrt(3.0), 1e-9);
        g_assert_cmpfloat_with_epsilon(points->rows[points->stride + i], rho, 2e-3);
    }
    gb_compaction_data_finish(&data);

    const struct gb_compaction_window part = {400.0, 440.0, NAN, true};
    g_assert_true(gb_compaction_data_curves(&data, curves, 1, 0.3, &part, &err));
    g_assert_cmpuint(data.points.count, ==, 9); /* as many as the curve has there */
    g_assert_null(data.points.error);
    g_assert_true(isnan(data.points.initial));
    gb_compaction_data_finish(&data);
    const struct gb_compaction_window beyond = {5000.0, NAN, NAN, false};
    g_assert_false(gb_compaction_data_curves(&data, curves, 1, 0.3, &beyond, &err));
    g_assert_nonnull(strstr(err.text, "no two points between 5000 and"));
    g_assert_null(data.memory);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    gsl_set_error_handler_off();
    folder = g_dir_make_tmp("greenbody-compaction-XXXXXX", NULL);
    g_test_add_func("/compaction/file", test_file);
    g_test_add_func("/compaction/from-zero", test_from_zero);
    g_test_add_func("/compaction/series", test_series);
    g_test_add_func("/compaction/hostile", test_hostile);
    g_test_add_func("/compaction/long", test_long);
    g_test_add_func("/compaction/curves", test_curves);
    const int status = g_test_run();
    char *path = g_build_filename(folder, "lab.csv", NULL);
    g_unlink(path);
    g_rmdir(folder);
    g_free(path);
    g_free(folder);
    return status;
}
