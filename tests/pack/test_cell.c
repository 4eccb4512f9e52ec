#include <glib.h>
#include <math.h>

#include "pack/cell/cell.h"

static const double edges[3] = {4.0, 5.0, 6.0};

static void test_three_dimensions(void)
{
    struct gb_cell cell;
    gb_cell_init(&cell, 3, edges);
    g_assert_cmpfloat(gb_cell_volume(&cell), ==, 120.0);
    g_assert_cmpfloat(gb_cell_shortest(&cell), ==, 4.0);
    double r[3] = {2.5, -2.6, 13.0};
    gb_cell_nearest(&cell, r);
    g_assert_cmpfloat_with_epsilon(r[0], -1.5, 1e-15);
    g_assert_cmpfloat_with_epsilon(r[1], 2.4, 1e-15);
    g_assert_cmpfloat_with_epsilon(r[2], 1.0, 1e-15);
}

/* y is no axis of the plane: neither wrapped nor counted. */
static void test_plane(void)
{
    struct gb_cell cell;
    gb_cell_init(&cell, 2, edges);
    g_assert_false(cell.periodic[1]);
    g_assert_cmpfloat(gb_cell_volume(&cell), ==, 24.0);
    g_assert_cmpfloat(gb_cell_shortest(&cell), ==, 4.0);
    double r[3] = {3.0, 3.0, -4.0};
    gb_cell_nearest(&cell, r);
    g_assert_cmpfloat(r[0], ==, -1.0);
    g_assert_cmpfloat(r[1], ==, 3.0);
    g_assert_cmpfloat(r[2], ==, 2.0);
    double x[3] = {-1.0, -3.0, 6.5};
    gb_cell_wrap(&cell, x);
    g_assert_cmpfloat(x[0], ==, 3.0);
    g_assert_cmpfloat(x[1], ==, -3.0);
    g_assert_cmpfloat(x[2], ==, 0.5);
}

/* Whatever rounding does, the result lies in [0, edge). */
static void test_wrap_borders(void)
{
    const double odd[3] = {0.1 + 0.2, 17.999999999999996, 53.87};
    const double steps[] = {-1e-300, -1e-17, -1e-9, 0.0, 1e-17, 1e-9};
    struct gb_cell cell;
    gb_cell_init(&cell, 3, odd);
    for (int image = -3; image <= 3; image++) {
        for (size_t i = 0; i < G_N_ELEMENTS(steps); i++) {
            double x[3];
            for (int k = 0; k < 3; k++) {
                x[k] = image * odd[k] + steps[i];
            }
            gb_cell_wrap(&cell, x);
            for (int k = 0; k < 3; k++) {
                g_assert_cmpfloat(x[k], >=, 0.0);
                g_assert_cmpfloat(x[k], <, odd[k]);
            }
        }
    }
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/cell/three-dimensions", test_three_dimensions);
    g_test_add_func("/cell/plane", test_plane);
    g_test_add_func("/cell/wrap-borders", test_wrap_borders);
    return g_test_run();
}
