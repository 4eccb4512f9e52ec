#include <glib.h>
#include <math.h>
#include <string.h>

#include "base/mat.h"
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

/* Folded tilts are the same lattice, and nearest images those of a search over images. */
static void test_tilted(void)
{
    GRand *random = g_rand_new_with_seed(5);
    for (int round = 0; round < 200; round++) {
        struct gb_cell cell, folded;
        gb_cell_init(&cell, 3, edges);
        for (int k = 0; k < 3; k++) {
            cell.tilt[k] = g_rand_double_range(random, -9.0, 9.0);
        }
        folded = cell;
        g_assert_true(gb_cell_fold(&folded) || round > 0);
        g_assert_cmpfloat(fabs(folded.tilt[0]), <=, 0.5 * edges[0]);
        g_assert_cmpfloat(fabs(folded.tilt[1]), <=, 0.5 * edges[0]);
        g_assert_cmpfloat(fabs(folded.tilt[2]), <=, 0.5 * edges[1]);
        g_assert_cmpfloat_with_epsilon(gb_cell_volume(&cell), 120.0, 1e-12);
        double least = INFINITY, matrix[3][3], far[3], near[3];
        gb_cell_matrix(&cell, matrix);
        for (int k = 0; k < 3; k++) {
            far[k] = g_rand_double_range(random, -4.0, 4.0);
        }
        for (int image = 0; image < 21 * 21 * 21; image++) {
            const double n[3] = {image % 21 - 10, image / 21 % 21 - 10, image / 441 - 10};
            double shift[3];
            gb_mat_apply((const double(*)[3])matrix, n, shift);
            gb_vec_add(shift, 1.0, far);
            /* not fmin: gcc 12.2 stops at its reduction on aarch64 */
            const double length = gb_vec_length(shift);
            least = length < least ? length : least;
        }
        memcpy(near, far, sizeof near);
        gb_cell_nearest(&folded, near);
        if (least < 0.5 * gb_cell_shortest(&folded)) {
            g_assert_cmpfloat_with_epsilon(gb_vec_length(near), least, 1e-12);
        }
        gb_cell_wrap(&folded, far);
        gb_cell_fraction(&folded, far, near);
        for (int k = 0; k < 3; k++) {
            g_assert_cmpfloat(near[k], >, -1e-12);
            g_assert_cmpfloat(near[k], <, 1.0 + 1e-12);
        }
    }
    g_rand_free(random);
}

/* The motion between two cells does not depend on a fold in between. */
static void test_motion(void)
{
    struct gb_cell before, after;
    const struct gb_deformation step = {{{1.01, 0.0, 0.03}, {0, 0.99, -0.02}, {0, 0, 1}}};
    gb_cell_init(&before, 3, edges);
    before.tilt[1] = 0.499 * edges[0];
    before.tilt[2] = -0.499 * edges[1];
    after = before;
    gb_cell_deform(&after, &step);
    g_assert_true(gb_cell_fold(&after));
    const struct gb_deformation motion = gb_cell_motion(&before, &after);
    for (int k = 0; k < 9; k++) {
        g_assert_cmpfloat_with_epsilon(motion.f[k / 3][k % 3], step.f[k / 3][k % 3],
                                       1e-14);
    }
    g_assert_cmpfloat_with_epsilon(after.shear[1], 0.03, 1e-15);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/cell/three-dimensions", test_three_dimensions);
    g_test_add_func("/cell/plane", test_plane);
    g_test_add_func("/cell/wrap-borders", test_wrap_borders);
    g_test_add_func("/cell/tilted", test_tilted);
    g_test_add_func("/cell/motion", test_motion);
    return g_test_run();
}
