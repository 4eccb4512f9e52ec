#include <glib.h>
#include <math.h>
#include <string.h>

#include "base/record.h"
#include "common/world.h"
#include "measure/observe.h"
#include "pack/cell/nonaffine.h"
#include "pack/cell/world.h"
#include "pack/cell/world_record.h"

/* Worlds whose cell is tilted. */

static struct gb_model sheared_model(const struct gb_params *params)
{
    struct gb_model model = scene_model(params);
    model.sheared = true;
    return model;
}

/* Simple shear: row x, column z for an engineering shear xz. */
static struct gb_deformation simple_shear(int row, int column, double amount)
{
    struct gb_deformation shear = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    shear.f[row][column] = amount;
    return shear;
}

static void shake(struct gb_world *world, GRand *random, double most)
{
    const struct gb_bodies b = gb_world_movable(world);
    const bool planar = gb_world_model(world)->dimension == 2;
    for (int64_t i = 0; i < 3 * b.count; i++) {
        if (!planar || i % 3 != 1) {
            b.position[i] += g_rand_double_range(random, -most, most);
        }
    }
}

/* Lists of cells under shear hold every pair, also across folds, in cells of many bins and
 * of few, in 3D and 2D. */
static void test_lists(void)
{
    const char *scene[][2] = {{"particles.count=150", "scene.dimension=3"},
                              {"particles.count=700", "scene.dimension=3"},
                              {"particles.count=200", "scene.dimension=2"}};
    for (int s = 0; s < 3; s++) {
        const struct gb_params params =
            scene_params("numerics.precision=double", scene[s][0], scene[s][1], NULL);
        const struct gb_model model = sheared_model(&params);
        struct gb_world *world = scene_world(&model);
        GRand *random = g_rand_new_with_seed(11);
        bool folded = false;
        for (int step = 0; step < 60; step++) {
            const struct gb_deformation xz = simple_shear(0, 2, 0.02);
            const struct gb_deformation yz = simple_shear(1, 2, 0.013);
            const double before = gb_world_cell(world)->tilt[1];
            gb_world_deform(world, &xz);
            if (model.dimension == 3) {
                gb_world_deform(world, &yz);
            }
            shake(world, random, 0.004);
            world_evaluate_any(world);
            world_check_lists(world);
            folded = folded || gb_world_cell(world)->tilt[1] < before - 1.0;
        }
        g_assert_true(folded);
        g_assert_cmpfloat_with_epsilon(gb_world_cell(world)->shear[1], 1.2, 1e-12);
        g_rand_free(random);
        gb_world_destroy(world);
    }
}

static void check_same_pressure(const struct gb_world *a, const struct gb_world *b,
                                double relative)
{
    double p[2][3][3], scale = 0.0;
    gb_world_pressure(a, p[0]);
    gb_world_pressure(b, p[1]);
    for (int k = 0; k < 3; k++) {
        scale = fmax(scale, fabs(p[0][k][k]));
    }
    for (int k = 0; k < 9; k++) {
        g_assert_cmpfloat_with_epsilon(p[0][k / 3][k % 3], p[1][k / 3][k % 3],
                                       relative * scale);
    }
}

/* The same packing in its cell and in one whose third edge vector is longer by the first. */
static void test_fold(void)
{
    const struct gb_params params = scene_params("numerics.precision=double", NULL);
    const struct gb_model model = sheared_model(&params);
    struct gb_world *plain = scene_world(&model), *tilted = scene_world(&model);
    struct gb_cell cell = *gb_world_cell(plain);
    cell.tilt[0] = cell.edge[0];
    cell.tilt[1] = -cell.edge[0];
    cell.tilt[2] = cell.edge[1];
    gb_particles_replace(&tilted->engine.particles, &cell, gb_world_position(plain));
    scene_evaluate(plain);
    scene_evaluate(tilted);
    g_assert_false(gb_cell_tilted(gb_world_cell(tilted)));
    g_assert_cmpint(gb_world_tally(plain)->contacts, >, 0);
    g_assert_cmpint(gb_world_tally(plain)->contacts, ==,
                    gb_world_tally(tilted)->contacts);
    check_same_pressure(plain, tilted, 1e-12);
    gb_world_destroy(plain);
    gb_world_destroy(tilted);
}

/* A pressed packing that is turned as a rigid body: the springs see nothing of it, the
 * stress turns with it. */
static void test_rotation(void)
{
    const double angle = 1e-6;
    const struct gb_params params =
        scene_params("numerics.precision=double", "numerics.tolerance=1e-6", NULL);
    const struct gb_model model = sheared_model(&params);
    struct gb_world *world = scene_world(&model);
    struct gb_deformation rotation = simple_shear(0, 2, angle);
    double before[3][3], after[3][3];
    rotation.f[2][0] = -angle;
    scene_press(world, 8, 200, 2.0);
    gb_world_pressure(world, before);
    gb_world_deform(world, &rotation);
    scene_evaluate(world);
    gb_world_pressure(world, after);
    const double expected = before[0][2] + angle * (before[2][2] - before[0][0]);
    g_assert_cmpfloat(fabs(before[2][2]), >, 1e-6);
    for (int k = 0; k < 3; k++) {
        g_assert_cmpfloat_with_epsilon(after[k][k] / before[k][k], 1.0, 1e-4);
    }
    g_assert_cmpfloat_with_epsilon(after[0][2], expected, 1e-6 * fabs(before[2][2]));
    gb_world_destroy(world);
}

/* Small shear and back, without sliding, gives back the stress. */
static void test_round_trip(void)
{
    const struct gb_params params = scene_params("numerics.precision=double", NULL);
    const struct gb_model model = sheared_model(&params);
    struct gb_world *world = scene_world(&model), *still = scene_world(&model);
    scene_press(world, 8, 100, 2.0);
    scene_press(still, 8, 100, 2.0);
    double stress[3][3], sheared[3][3];
    gb_world_pressure(world, stress);
    for (int step = 0; step < 4; step++) {
        const struct gb_deformation shear = simple_shear(0, 2, step < 2 ? 1e-7 : -1e-7);
        gb_world_deform(world, &shear);
        scene_evaluate(world);
        if (step == 1) {
            gb_world_pressure(world, sheared);
            g_assert_cmpfloat(sheared[0][2], <, stress[0][2]);
        }
    }
    check_same_pressure(world, still, 1e-6);
    gb_world_destroy(world);
    gb_world_destroy(still);
}

/* An affine motion of the cell, folds included, leaves no nonaffine displacement. */
static void test_nonaffine(void)
{
    const struct gb_params params = scene_params("numerics.precision=double", NULL);
    const struct gb_model model = sheared_model(&params);
    struct gb_world *world = scene_world(&model);
    struct gb_world_copy *copy = NULL;
    struct gb_error err = {0};
    for (int step = 0; step < 40; step++) {
        const struct gb_deformation shear = simple_shear(0, 1, 0.03);
        scene_evaluate(world);
        g_assert_true(gb_world_copy_save(world, &copy, &err));
        gb_world_deform(world, &shear);
        world_evaluate_any(world);
        g_assert_cmpfloat(gb_nonaffine_since(world, copy).farthest, <, 1e-12);
    }
    gb_world_copy_destroy(copy);
    gb_world_destroy(world);
}

/* A strain of the cell alone, beyond what the skin allows for, builds the lists anew. */
static void test_strain_alone(gconstpointer data)
{
    const struct precision *precision = data;
    const struct gb_params params = scene_params(precision->setting, NULL);
    const struct gb_model model = scene_model(&params);
    struct gb_world *world = scene_world(&model);
    const double factor[3] = {1.0, 1.0, 0.97};
    for (int step = 0; step < 20; step++) {
        gb_world_strain(world, factor);
        world_evaluate_any(world);
        world_check_lists(world);
    }
    gb_world_destroy(world);
}

/* A saved and loaded world goes on to the same bits. */
static void test_record(void)
{
    const struct gb_params params = scene_params("numerics.precision=double", NULL);
    const struct gb_model model = sheared_model(&params);
    struct gb_world *world = scene_world(&model), *loaded = NULL;
    struct gb_error err = {0};
    struct gb_record record = {0};
    const struct gb_deformation shear = simple_shear(0, 2, 0.011);
    scene_press(world, 3, 30, 2.0);
    for (int step = 0; step < 50; step++) {
        gb_world_deform(world, &shear);
        world_evaluate_any(world);
    }
    g_assert_true(gb_world_record(world, &record, &err));
    record.loading = true;
    double *position = scene_positions(&model);
    g_assert_true(gb_world_create(&loaded, &model, position, &err));
    gb_alloc_free(position);
    if (!gb_world_record(loaded, &record, &err)) {
        g_error("%s", err.text);
    }
    for (int step = 0; step < 20; step++) {
        g_assert_cmpuint(gb_world_hash(loaded), ==, gb_world_hash(world));
        g_assert_cmpfloat(gb_world_cell(loaded)->shear[1], ==,
                          gb_world_cell(world)->shear[1]);
        gb_world_deform(world, &shear);
        gb_world_deform(loaded, &shear);
        world_evaluate_any(world);
        world_evaluate_any(loaded);
    }
    gb_record_finish(&record);
    gb_world_destroy(loaded);
    gb_world_destroy(world);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/shear/lists", test_lists);
    g_test_add_func("/shear/fold", test_fold);
    g_test_add_func("/shear/rotation", test_rotation);
    g_test_add_func("/shear/round-trip", test_round_trip);
    g_test_add_func("/shear/nonaffine", test_nonaffine);
    g_test_add_func("/shear/record", test_record);
    g_test_add_data_func("/shear/strain-alone", &precisions[0], test_strain_alone);
    g_test_add_data_func("/shear/strain-alone-single", &precisions[1], test_strain_alone);
    return g_test_run();
}
