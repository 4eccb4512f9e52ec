/* The rose of forces against functions of direction that it can hold exactly. */
#include "draw/rose.h"

#include <glib.h>
#include <gsl/gsl_errno.h>
#include <math.h>

enum { COUNT = 400 };

static double axis[3 * COUNT];
static double value[COUNT];

/* Directions all over the sphere, of different lengths. */
static void fill_axes(void)
{
    for (int i = 0; i < COUNT; i++) {
        const double z = 1.0 - 2.0 * (i + 0.5) / COUNT;
        const double a = 2.399963 * i;
        const double r = sqrt(1.0 - z * z);
        const double size = 0.5 + 0.002 * i;
        axis[3 * i] = size * r * cos(a);
        axis[3 * i + 1] = size * r * sin(a);
        axis[3 * i + 2] = size * z;
    }
}

static double known(const double *n)
{
    const double size = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    const double x = n[0] / size;
    const double y = n[1] / size;
    const double z = n[2] / size;
    return 3.0 + 2.0 * z * z - 0.7 * x * y + 0.4 * z * z * z * z + 0.2 * x * x * x * z;
}

static void test_exact(void)
{
    struct gb_rose rose;
    struct gb_error err = {0};
    fill_axes();
    double sum = 0.0;
    for (int i = 0; i < COUNT; i++) {
        value[i] = known(&axis[3 * i]);
        sum += value[i];
    }
    g_assert_true(gb_rose_fit(&rose, 3, axis, value, COUNT, &err));
    g_assert_cmpfloat_with_epsilon(rose.mean, sum / COUNT, 1e-12);
    const double away[][3] = {{1, 2, 3}, {0, 0, 1}, {-2, 0.1, 0}, {1, -1, 0.5}};
    for (size_t k = 0; k < G_N_ELEMENTS(away); k++) {
        const double back[3] = {-away[k][0], -away[k][1], -away[k][2]};
        g_assert_cmpfloat_with_epsilon(gb_rose_at(&rose, away[k]), known(away[k]), 1e-9);
        g_assert_cmpfloat_with_epsilon(gb_rose_at(&rose, back), known(away[k]), 1e-9);
    }
}

static void test_planar(void)
{
    struct gb_rose rose;
    struct gb_error err = {0};
    for (int i = 0; i < 60; i++) {
        axis[3 * i] = cos(0.1 * i);
        axis[3 * i + 1] = 0.0;
        axis[3 * i + 2] = sin(0.1 * i);
        value[i] = 1.0 + 0.5 * cos(0.2 * i);
    }
    g_assert_true(gb_rose_fit(&rose, 2, axis, value, 60, &err));
    g_assert_cmpfloat_with_epsilon(gb_rose_at(&rose, (const double[3]){1, 0, 0}), 1.5,
                                   1e-9);
    g_assert_cmpfloat_with_epsilon(gb_rose_at(&rose, (const double[3]){0, 0, 1}), 0.5,
                                   1e-9);
}

static void test_refused(void)
{
    struct gb_rose rose;
    struct gb_error err = {0};
    fill_axes();
    g_assert_false(gb_rose_fit(&rose, 3, axis, value, GB_ROSE_TERMS - 1, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    for (int i = 0; i < 3 * COUNT; i++) {
        axis[i] = 1.0; /* one direction does not determine the others */
    }
    g_assert_false(gb_rose_fit(&rose, 3, axis, value, COUNT, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    gsl_set_error_handler_off();
    g_test_add_func("/measure/rose/exact", test_exact);
    g_test_add_func("/measure/rose/planar", test_planar);
    g_test_add_func("/measure/rose/refused", test_refused);
    return g_test_run();
}
