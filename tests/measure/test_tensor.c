#include <glib.h>
#include <math.h>

#include "common/scene.h"
#include "measure/observe.h"

/* Triaxial state: q is the difference of the pressures; simple shear: sqrt(3) times the
 * shear stress. */
static void test_deviatoric(void)
{
    const double triaxial[3][3] = {{2, 0, 0}, {0, 2, 0}, {0, 0, 5}};
    const double shear[3][3] = {{4, 0, 1}, {0, 4, 0}, {1, 0, 4}};
    const double skew[3][3] = {{4, 0, 1}, {0, 4, 0}, {-1, 0, 4}};
    const double plane[3][3] = {{1, 9, 0}, {9, 77, 9}, {0, 9, 4}};
    g_assert_cmpfloat_with_epsilon(gb_observe_mean(triaxial, 3), 3.0, 1e-15);
    g_assert_cmpfloat_with_epsilon(gb_observe_deviatoric(triaxial, 3), 3.0, 1e-14);
    g_assert_cmpfloat_with_epsilon(gb_observe_deviatoric(shear, 3), sqrt(3.0), 1e-14);
    g_assert_cmpfloat_with_epsilon(gb_observe_deviatoric(skew, 3), 0.0, 1e-14);
    g_assert_cmpfloat_with_epsilon(gb_observe_asymmetry(skew, 3), sqrt(2.0) / 4.0, 1e-14);
    g_assert_cmpfloat(gb_observe_asymmetry(shear, 3), ==, 0.0);
    g_assert_cmpfloat_with_epsilon(gb_observe_deviatoric(plane, 2), 3.0, 1e-14);
    g_assert_cmpfloat_with_epsilon(gb_observe_mean(plane, 2), 2.5, 1e-15);
}

/* Eigenvalues of deviators that are known: diagonal in a rotated frame. */
static void test_largest(void)
{
    const double diagonal[3] = {-1.5, 0.25, 7.0}, angle = 0.7;
    const double c = cos(angle), s = sin(angle);
    const double r[3][3] = {
        {c, -s * c, s * s}, {s, c * c, -c * s}, {0.0, s, c}}; /* two rotations */
    double tensor[3][3] = {{0}};
    for (int k = 0; k < 27; k++) {
        const int a = k / 9, b = k / 3 % 3, l = k % 3;
        tensor[a][b] += r[a][l] * diagonal[l] * r[b][l];
    }
    const double mean = (diagonal[0] + diagonal[1] + diagonal[2]) / 3.0;
    const double isotropic[3][3] = {{2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
    const double plane[3][3] = {{1, 0, 2}, {0, 9, 0}, {2, 0, 1}};
    g_assert_cmpfloat_with_epsilon(
        gb_observe_largest_deviator((const double(*)[3])tensor, 3), 7.0 - mean, 1e-13);
    g_assert_cmpfloat(gb_observe_largest_deviator(isotropic, 3), ==, 0.0);
    g_assert_cmpfloat_with_epsilon(gb_observe_largest_deviator(plane, 2), 2.0, 1e-14);
}

/* The trace of a fabric tensor is 1; a packing that is pressed along z has more contacts
 * there than along x. */
static void test_fabric(void)
{
    const struct gb_params params =
        scene_params("numerics.precision=double", "contact.bridge_length=1 d", NULL);
    const struct gb_model model = scene_model(&params);
    struct gb_world *world = scene_world(&model);
    double pressure[3][3];
    struct gb_fabric fabric;
    scene_press(world, 60, 10, 2.0);
    gb_observe_fabric(world, pressure, &fabric);
    g_assert_cmpfloat_with_epsilon(fabric.all[0] + fabric.all[1] + fabric.all[2], 1.0,
                                   1e-12);
    g_assert_true(isnan(fabric.anisotropy[GB_FABRIC_BRIDGED])); /* there are none */
    g_assert_cmpfloat(fabric.anisotropy[GB_FABRIC_ALL], >, 0.0);
    g_assert_cmpfloat(fabric.anisotropy[GB_FABRIC_ALL], <, 1.0);
    gb_world_destroy(world);
}

/* Two particles along z: all contacts are parallel. */
static void test_pair(void)
{
    struct gb_params params =
        scene_params("numerics.precision=double", "structure.base=6 d",
                     "structure.density=0.01", NULL);
    params.count = 2;
    const struct gb_model model = scene_model(&params);
    const double x[6] = {1.0, 1.0, 1.0, 1.0, 1.0, 1.97};
    struct gb_world *world = NULL;
    struct gb_error err = {0};
    double pressure[3][3];
    struct gb_fabric fabric;
    if (!gb_world_create(&world, &model, x, &err)) {
        g_error("%s", err.text);
    }
    scene_evaluate(world);
    gb_observe_fabric(world, pressure, &fabric);
    g_assert_cmpfloat_with_epsilon(fabric.all[2], 1.0, 1e-14);
    g_assert_cmpfloat_with_epsilon(fabric.anisotropy[GB_FABRIC_ALL], 1.0, 1e-7);
    g_assert_cmpfloat_with_epsilon(fabric.anisotropy[GB_FABRIC_FORCE], 1.0, 1e-7);
    gb_world_destroy(world);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/tensor/deviatoric", test_deviatoric);
    g_test_add_func("/tensor/largest", test_largest);
    g_test_add_func("/tensor/fabric", test_fabric);
    g_test_add_func("/tensor/pair", test_pair);
    return g_test_run();
}
