#include <math.h>
#include <string.h>

#include <glib.h>

#include "base/alloc.h"
#include "measure/average.h"

static const double x[] = {0.0, 1.0, 2.0, 2.0, 4.0};
static const double y[] = {0.0, 2.0, 3.0, 5.0, (double)NAN};
static const struct gb_average_curve curve = {x, y, 5};

static void test_resample(void)
{
    const double grid[] = {-0.1, 0.0, 0.25, 1.0, 2.0, 3.0, 4.0, 4.1, (double)NAN};
    const double want[] = {(double)NAN, 0.0,         0.5,         2.0,        3.0,
                           (double)NAN, (double)NAN, (double)NAN, (double)NAN};
    double got[9];
    struct gb_error err = {0};
    g_assert_true(gb_average_resample(&curve, grid, 9, got, &err));
    for (int k = 0; k < 9; k++) {
        g_assert_true(isnan(want[k]) ? isnan(got[k]) : got[k] == want[k]);
    }
    const double falling[] = {0.0, 1.0, 0.5};
    const struct gb_average_curve bad = {falling, y, 3};
    g_assert_false(gb_average_resample(&bad, grid, 9, got, &err));
    g_assert_nonnull(strstr(err.text, "point 3 of a curve"));
    const double broken[] = {0.0, (double)NAN};
    const struct gb_average_curve worse = {broken, y, 2};
    g_assert_false(gb_average_resample(&worse, grid, 9, got, &err));
    const struct gb_average_curve empty = {x, y, 0};
    g_assert_true(gb_average_resample(&empty, grid, 9, got, &err));
    g_assert_true(isnan(got[1]));
}

static void test_grid(void)
{
    const double other[] = {0.5, 1.0 + 1e-12, 3.0, 5.0};
    const struct gb_average_curve curves[2] = {curve, {other, y, 4}};
    const double want[] = {0.0, 0.5, 1.0, 2.0, 3.0, 4.0, 5.0};
    double *grid = NULL;
    size_t size = 0;
    struct gb_error err = {0};
    g_assert_true(gb_average_grid(curves, 2, 100, &grid, &size, &err));
    g_assert_cmpuint(size, ==, 7);
    for (size_t k = 0; k < size; k++) {
        g_assert_cmpfloat(grid[k], ==, want[k]);
    }
    gb_alloc_free(grid);
    g_assert_true(gb_average_grid(curves, 2, 3, &grid, &size, &err));
    g_assert_cmpuint(size, ==, 3);
    g_assert_cmpfloat(grid[0], ==, 0.0);
    g_assert_cmpfloat(grid[2], ==, 5.0);
    gb_alloc_free(grid);
    const struct gb_average_curve empty = {x, y, 0};
    g_assert_false(gb_average_grid(&empty, 1, 9, &grid, &size, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
}

static void test_mean(void)
{
    const double values[] = {1.0, (double)NAN, 3.0, 5.0};
    double mean = 0.0, error = 0.0;
    g_assert_cmpuint(gb_average_values(values, 4, &mean, &error), ==, 3);
    g_assert_cmpfloat(mean, ==, 3.0);
    g_assert_cmpfloat_with_epsilon(error, 2.0 / sqrt(3.0), 1e-15);
    g_assert_cmpuint(gb_average_values(values, 2, &mean, &error), ==, 1);
    g_assert_true(mean == 1.0 && isnan(error));
    g_assert_cmpuint(gb_average_values(values + 1, 1, &mean, &error), ==, 0);
    g_assert_true(isnan(mean) && isnan(error));

    const double rows[] = {1.0, 2.0, (double)NAN, 3.0, 6.0, 7.0};
    double means[3], errors[3];
    gb_average_rows(rows, 2, 3, GB_AVERAGE_PRESENT, means, errors);
    g_assert_true(means[0] == 2.0 && means[1] == 4.0 && means[2] == 7.0);
    g_assert_true(errors[0] == 1.0 && errors[1] == 2.0 && isnan(errors[2]));
    gb_average_rows(rows, 2, 3, GB_AVERAGE_ALL, means, NULL);
    g_assert_true(means[1] == 4.0 && isnan(means[2]));
}

static void test_crossing(void)
{
    const double wave[] = {1.0, 3.0, 2.0, 5.0, (double)NAN, 8.0};
    const double time[] = {0.0, 1.0, 2.0, 3.0, 4.0, 5.0};
    const struct gb_average_curve path = {wave, time, 6};
    size_t at = 99;
    g_assert_cmpfloat(gb_average_crossing(&path, 2.0, &at), ==, 0.5);
    g_assert_cmpuint(at, ==, 1);
    g_assert_cmpfloat(gb_average_crossing(&path, 1.0, &at), ==, 0.0);
    g_assert_cmpfloat_with_epsilon(gb_average_crossing(&path, 4.0, &at), 2.0 + 2.0 / 3.0,
                                   1e-15);
    g_assert_cmpfloat(gb_average_crossing(&path, 8.0, NULL), ==, 5.0);
    g_assert_true(isnan(gb_average_crossing(&path, 0.5, NULL)));
    g_assert_true(isnan(gb_average_crossing(&path, 6.0, NULL))); /* across a gap */
    g_assert_true(isnan(gb_average_crossing(&path, (double)NAN, NULL)));
}

/* The jackknife of a mean is its standard error. */
static void test_jackknife(void)
{
    static const double values[] = {3.0, 7.0, 8.0, 1.0, 4.0};
    enum { COUNT = G_N_ELEMENTS(values) };
    double without[COUNT], mean, error, sum = 0.0;
    gb_average_values(values, COUNT, &mean, &error);
    for (int i = 0; i < COUNT; i++) {
        sum += values[i];
    }
    for (int i = 0; i < COUNT; i++) {
        without[i] = (sum - values[i]) / (COUNT - 1);
    }
    g_assert_cmpfloat_with_epsilon(gb_average_jackknife(without, COUNT), error, 1e-12);
    g_assert_true(isnan(gb_average_jackknife(without, 1)));
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/average/resample", test_resample);
    g_test_add_func("/average/grid", test_grid);
    g_test_add_func("/average/mean", test_mean);
    g_test_add_func("/average/crossing", test_crossing);
    g_test_add_func("/average/jackknife", test_jackknife);
    return g_test_run();
}
