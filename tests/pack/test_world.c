#include <glib.h>
#include <math.h>
#include <stdlib.h>

#include "common/world.h"
#include "measure/observe.h"

/* Blocks hold every particle once, whatever their size. */
static void test_blocks(void)
{
    const int64_t counts[] = {1,      1024,   1025,   8000,    131071,
                              131072, 131073, 262144, 1000000, 10000000};
    for (size_t i = 0; i < G_N_ELEMENTS(counts); i++) {
        const int64_t count = counts[i], blocks = gb_blocks_count(count);
        int64_t end = 0;
        for (int64_t b = 0; b < blocks; b++) {
            g_assert_cmpint(gb_blocks_begin(count, b), ==, end);
            g_assert_cmpint(gb_blocks_end(count, b), >, end);
            end = gb_blocks_end(count, b);
        }
        g_assert_cmpint(end, ==, count);
        g_assert_true(count < 131072 || blocks >= GB_BLOCKS_COUNT_MIN);
    }
}

static int64_t brute_pairs(const struct gb_world *world, double reach)
{
    int64_t found = 0;
    for (int64_t i = 0; i < gb_world_model(world)->count; i++) {
        for (int64_t j = 0; j < i; j++) {
            found += world_distance(world, i, j) < reach;
        }
    }
    return found;
}

static void check_order(const struct gb_pair_list *list, int64_t count)
{
    for (int64_t i = 0; i < count; i++) {
        for (int64_t k = list->start[i]; k < list->start[i + 1]; k++) {
            g_assert_cmpint(list->other[k], >, i);
            g_assert_true(k == list->start[i] || list->other[k - 1] < list->other[k]);
        }
    }
}

/* The lists hold exactly the pairs that a scan of all pairs finds, in order, in 3D and 2D,
 * also in cells barely wider than twice the reach. */
static void test_pairs(void)
{
    const char *scene[][2] = {{"particles.count=150", "structure.seed=3"},
                              {"particles.count=2000", "structure.seed=4"},
                              {"scene.dimension=2", "structure.seed=5"}};
    for (int s = 0; s < 3; s++) {
        const struct gb_params params = scene_params(scene[s][0], scene[s][1], NULL);
        const struct gb_model model = scene_model(&params);
        struct gb_world *world = scene_world(&model);
        scene_evaluate(world);
        const struct gb_neighbour_list *pairs = gb_world_pairs(world);
        const double reach = model.numerics.cutoff + model.numerics.skin;
        g_assert_cmpint(pairs->near.pair_count + pairs->far.pair_count, ==,
                        brute_pairs(world, reach));
        g_assert_cmpint(pairs->near.pair_count, ==,
                        brute_pairs(world, 1.0 + model.numerics.skin));
        if (gb_engine_is_f32(&world->engine)) {
            world_check_slots(world, &pairs->near);
        } else {
            check_order(&pairs->near, model.count);
        }
        gb_world_destroy(world);
    }
}

/* Coordination numbers against those counted from distances. */
static void test_coordination(gconstpointer data)
{
    const struct precision *precision = data;
    const struct gb_params params = scene_params(precision->setting, NULL);
    const struct gb_model model = scene_model(&params);
    struct gb_world *world = scene_world(&model);
    scene_press(world, 150, 10, 2.0);
    const int32_t *coordination = gb_world_coordination(world);
    int64_t most = 0;
    for (int64_t i = 0; i < model.count; i++) {
        int touching = 0, close = 0;
        for (int64_t j = 0; j < model.count; j++) {
            const double gap = i == j ? 1.0 : world_distance(world, i, j) - 1.0;
            touching += gap < 0.0;
            close += fabs(gap) < 1e-6;
        }
        g_assert_cmpint(abs(coordination[i] - touching), <=, close);
        most = coordination[i] > most ? coordination[i] : most;
    }
    g_assert_cmpint(most, >, 3);
    gb_world_destroy(world);
}

/* The skin changes when lists are rebuilt and not the results: histories survive a
 * rebuild. */
static void test_skin(const void *data)
{
    const struct precision *precision = data;
    const struct gb_params params = scene_params(precision->setting, NULL);
    double pressure[3][3][3];
    int64_t rebuilds[3];
    for (int s = 0; s < 3; s++) {
        struct gb_model model = scene_model(&params);
        model.numerics.skin = 0.02 * (1 << s);
        struct gb_world *world = scene_world(&model);
        scene_press(world, 12, 30, 2.0);
        gb_observe_pressure(world, pressure[s]);
        rebuilds[s] = gb_world_rebuilds(world);
        gb_world_destroy(world);
    }
    g_assert_cmpint(rebuilds[0], >, rebuilds[1]);
    g_assert_cmpint(rebuilds[1], >, rebuilds[2]);
    for (int s = 1; s < 3; s++) {
        for (int k = 0; k < 3; k++) {
            g_assert_cmpfloat_with_epsilon(pressure[s][k][k] / pressure[0][k][k], 1.0,
                                           precision->skin);
        }
    }
}

static void test_threads(const void *data)
{
    const struct precision *precision = data;
    const struct gb_params params =
        scene_params(precision->setting, "particles.count=9000", NULL);
    uint64_t first = 0;
    g_assert_cmpint(gb_blocks_count(9000), >, 4);
    for (int threads = 1; threads <= 8; threads++) {
        struct gb_model model = scene_model(&params);
        model.numerics.threads = threads;
        struct gb_world *world = scene_world(&model);
        scene_press(world, 3, 15, 2.0);
        const uint64_t hash = gb_world_hash(world);
        first = threads == 1 ? hash : first;
        g_assert_cmpuint(hash, ==, first);
        gb_world_destroy(world);
    }
}

/* Restoring a copy and repeating gives the same bits. */
static void test_copy(const void *data)
{
    const struct precision *precision = data;
    const struct gb_params params = scene_params(precision->setting, NULL);
    const struct gb_model model = scene_model(&params);
    struct gb_world *world = scene_world(&model);
    struct gb_world_copy *copy = NULL;
    struct gb_error err = {0};
    uint64_t hash[2];
    scene_press(world, 5, 30, 2.0);
    g_assert_true(gb_world_copy_save(world, &copy, &err));
    for (int i = 0; i < 2; i++) {
        scene_press(world, 4, 30, 2.0);
        g_assert_true(gb_world_copy_restore(world, copy, &err));
        scene_press(world, 4, 30, 2.0);
        hash[i] = gb_world_hash(world);
    }
    g_assert_cmpuint(hash[0], ==, hash[1]);
    gb_world_copy_destroy(copy);
    gb_world_destroy(world);
}

static void test_not_finite(void)
{
    const struct gb_params params = scene_params(NULL);
    const struct gb_model model = scene_model(&params);
    struct gb_world *world = scene_world(&model);
    struct gb_error err = {0};
    scene_evaluate(world);
    gb_world_bodies(world).rotation[3 * 17] = (double)NAN;
    g_assert_false(gb_world_evaluate(world, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_GUARD);
    g_assert_nonnull(strstr(err.text, "not a finite number"));
    gb_world_destroy(world);

    world = scene_world(&model);
    scene_evaluate(world);
    gb_world_bodies(world).position[3 * 17] = (double)NAN;
    g_assert_false(gb_world_evaluate(world, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_GUARD);
    gb_world_destroy(world);
}

/* The cell shrinks until the list cannot be built any more. */
static void test_small_cell(void)
{
    const struct gb_params params =
        scene_params("contact.bridge_length=1 d", "particles.diameter=38 nm", NULL);
    const struct gb_model model = scene_model(&params);
    struct gb_world *world = scene_world(&model);
    struct gb_error err = {0};
    scene_evaluate(world);
    const double factor[3] = {2.0 * 1.02 / model.edges[0], 1.0, 3.0};
    gb_world_strain(world, factor);
    g_assert_false(gb_world_evaluate(world, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_GUARD);
    gb_world_destroy(world);
}

/* One particle with so many others behind it in one bin or several: 255 are a list, one more is a
 * collapsed packing, and names the particle. */
static void test_collapsed(void)
{
    for (int around = 254; around <= 259; around++) {
        char *count = g_strdup_printf("particles.count=%d", around + 1);
        const struct gb_params params = scene_params(count, NULL);
        const struct gb_model model = scene_model(&params);
        double *position = g_new(double, 3 * (gsize)model.count);
        for (int apart = 0; apart < 2; apart++) {
            struct gb_world *world = NULL;
            struct gb_error err = {0};
            for (int i = 0; i <= around; i++) {
                for (int c = 0; c < 3; c++) {
                    const bool beside = apart && i % 2 != 0 && c == 0;
                    position[3 * i + c] =
                        0.5 * model.edges[c] + 1e-4 * i + (beside ? 0.9 : 0.0);
                }
            }
            g_assert_true(gb_world_create(&world, &model, position, &err));
            const bool evaluated = gb_world_evaluate(world, &err);
            const bool collapsed =
                strstr(err.text, "particle 0 has 256 or more neighbours") != NULL;
            g_assert_true(collapsed == (around >= 256));
            g_assert_true(!collapsed || (!evaluated && err.code == GB_ERR_GUARD));
            gb_world_destroy(world);
        }
        g_free(position);
        g_free(count);
    }
}

/* The k-th allocation fails, for every k until all pass. */
static void test_memory(const void *data)
{
    const struct precision *precision = data;
    const struct gb_params params = scene_params(precision->setting, NULL);
    const struct gb_model model = scene_model(&params);
    double *position = scene_positions(&model);
    const size_t before = gb_alloc_bytes();
    bool passed = false;
    int k = 0;
    while (!passed) {
        struct gb_world *world = NULL;
        struct gb_world_copy *copy = NULL;
        struct gb_error err = {0};
        gb_alloc_fail_after(++k);
        passed = gb_world_create(&world, &model, position, &err) &&
                 gb_world_evaluate(world, &err) &&
                 gb_world_copy_save(world, &copy, &err) &&
                 gb_world_copy_restore(world, copy, &err);
        gb_alloc_fail_after(0);
        g_assert_true(passed || err.code == GB_ERR_MEMORY);
        gb_world_copy_destroy(copy);
        gb_world_destroy(world);
        g_assert_cmpuint(gb_alloc_bytes(), ==, before);
    }
    g_assert_cmpint(k, >, 15);
    gb_alloc_free(position);
}

/* Single precision is refused where it has no sweep; auto is double there, and where the
 * tolerance is too tight. */
static void test_precision(void)
{
    const char *const without[] = {"scene.kind=dynamic", "scene.kind=die",
                                   "scene.dimension=2"};
    for (size_t i = 0; i < G_N_ELEMENTS(without); i++) {
        struct gb_params params = scene_params("particles.count=1000", without[i], NULL);
        struct gb_model model;
        struct gb_error err = {0};
        params.precision = GB_PRECISION_SINGLE;
        g_assert_false(gb_model_init(&model, &params, &err));
        g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
        g_assert_nonnull(strstr(err.text, "numerics.precision = single"));
        params.precision = GB_PRECISION_AUTO;
        if (!gb_model_init(&model, &params, &err)) {
            g_error("%s: %s", without[i], err.text);
        }
        g_assert_false(model.numerics.single);
    }
    const struct gb_params loose = scene_params("numerics.tolerance=0.01", NULL);
    const struct gb_params tight = scene_params("numerics.tolerance=0.001", NULL);
    g_assert_true(scene_model(&loose).numerics.single);
    g_assert_false(scene_model(&tight).numerics.single);
}

/* A filled cell has density 1, not one that rounding makes a little larger. */
static void test_filled(void)
{
    int filled = 0;
    for (int s = 0; s < 40; s++) {
        const struct gb_params params = scene_params("structure.density=0.3", NULL);
        const struct gb_model model = scene_model(&params);
        struct gb_world *world = scene_world(&model);
        const double part = cbrt(pow(gb_observe_density(world), 1.0 / (s + 1)));
        for (int k = 0; k <= s; k++) {
            gb_world_strain(world, (const double[3]){part, part, part});
        }
        g_assert_cmpfloat_with_epsilon(gb_observe_density(world), 1.0, 1e-12);
        g_assert_cmpfloat(gb_observe_density(world), <=, 1.0);
        filled += gb_observe_density(world) == 1.0;
        gb_world_destroy(world);
    }
    g_assert_cmpint(filled, >, 5);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/world/blocks", test_blocks);
    g_test_add_func("/world/pairs", test_pairs);
    g_test_add_data_func("/world/coordination", &precisions[0], test_coordination);
    g_test_add_data_func("/world/coordination-single", &precisions[1], test_coordination);
    g_test_add_data_func("/world/skin", &precisions[0], test_skin);
    g_test_add_data_func("/world/skin-single", &precisions[1], test_skin);
    g_test_add_data_func("/world/threads", &precisions[0], test_threads);
    g_test_add_data_func("/world/threads-single", &precisions[1], test_threads);
    g_test_add_data_func("/world/copy", &precisions[0], test_copy);
    g_test_add_data_func("/world/copy-single", &precisions[1], test_copy);
    g_test_add_func("/world/filled", test_filled);
    g_test_add_func("/world/not-finite", test_not_finite);
    g_test_add_func("/world/collapsed", test_collapsed);
    g_test_add_func("/world/small-cell", test_small_cell);
    g_test_add_data_func("/world/memory", &precisions[0], test_memory);
    g_test_add_data_func("/world/memory-single", &precisions[1], test_memory);
    g_test_add_func("/world/precision", test_precision);
    return g_test_run();
}
