#include <glib.h>

#include "common/world.h"
#include "pack/cell/world_record.h"
#include "pack/list/list_patch.h"

/* A few particles move until pairs have been inserted into both lists, of each at least one
 * between two blocks. */
static void move_until_inserted(struct gb_world *world)
{
    const struct gb_neighbour_list *pairs = gb_world_pairs(world);
    const struct gb_bodies b = gb_world_bodies(world);
    GRand *random = g_rand_new_with_seed(11);
    int across[2] = {0, 0};
    for (int step = 0; step < 400 && (across[0] == 0 || across[1] == 0); step++) {
        for (int64_t i = 0; i < 3 * b.count; i++) {
            const double length = i / 3 % 199 == 0 ? 0.02 : 1e-4;
            b.position[i] += length * g_rand_double_range(random, -0.5, 1.0);
        }
        scene_evaluate(world);
        across[0] = across[1] = 0;
        world_check_slots(world, &pairs->near);
        world_check_slots(world, &pairs->far);
        for (int64_t k = 0; k < pairs->inserted_count; k++) {
            const struct gb_inserted_pair *pair = &pairs->inserted[k];
            across[pair->near] +=
                pair->first / GB_BLOCKS_SIZE != pair->other / GB_BLOCKS_SIZE;
        }
    }
    g_rand_free(random);
    g_assert_cmpint(across[0], >, 0);
    g_assert_cmpint(across[1], >, 0);
}

static void assert_same_lists(const struct gb_pair_list *a, const struct gb_pair_list *b,
                              int64_t count)
{
    g_assert_cmpint(a->pair_count, ==, b->pair_count);
    for (int64_t i = 0; i <= count; i++) {
        g_assert_cmpint(a->start[i], ==, b->start[i]);
    }
    for (int64_t block = 0; block < gb_blocks_count(count); block++) {
        g_assert_cmpint(a->stop[block], ==, b->stop[block]);
    }
    for (int64_t k = 0; k < a->start[count]; k++) {
        g_assert_cmpint(a->first[k], ==, b->first[k]);
        g_assert_cmpint(a->other[k], ==, b->other[k]);
        g_assert_cmpint(a->image[k], ==, b->image[k]);
    }
}

/* Lists with inserted pairs give the forces of rebuilt lists; a checkpoint holds the pairs
 * and continues with the same bits; a checkpoint with invalid pairs is refused. */
static void test_inserted(void)
{
    const struct gb_params params =
        scene_params("particles.count=6000", "numerics.precision=single", NULL);
    const struct gb_model model = scene_model(&params);
    struct gb_world *world = scene_world(&model), *rebuilt = NULL, *loaded = NULL;
    struct gb_world_copy *copy = NULL;
    struct gb_record record = {0};
    struct gb_error err = {0};
    scene_press(world, 150, 10, 2.0);
    move_until_inserted(world);
    const int64_t rebuilds = gb_world_rebuilds(world);
    g_assert_true(gb_world_copy_save(world, &copy, &err));
    g_assert_true(gb_world_create(&rebuilt, &model, gb_world_position(world), &err));
    g_assert_true(gb_world_copy_restore(rebuilt, copy, &err));
    g_assert_true(gb_world_record(world, &record, &err));
    record.loading = true;
    g_assert_true(gb_world_create(&loaded, &model, gb_world_position(world), &err));
    g_assert_true(gb_world_record(loaded, &record, &err));
    assert_same_lists(&gb_world_pairs(world)->near, &gb_world_pairs(loaded)->near,
                      model.count);
    assert_same_lists(&gb_world_pairs(world)->far, &gb_world_pairs(loaded)->far,
                      model.count);
    scene_evaluate(world);
    scene_evaluate(rebuilt);
    scene_evaluate(loaded);
    g_assert_cmpint(gb_world_rebuilds(world), ==, rebuilds);
    const struct gb_bodies w = gb_world_bodies(world), f = gb_world_bodies(rebuilt);
    const struct gb_bodies l = gb_world_bodies(loaded);
    for (int64_t i = 0; i < 3 * w.count; i++) {
        g_assert_cmpfloat_with_epsilon(w.force[i], f.force[i], 1e-7);
        g_assert_cmpfloat_with_epsilon(w.torque[i], f.torque[i], 1e-7);
        g_assert_true(w.force[i] == l.force[i] && w.torque[i] == l.torque[i]);
    }
    g_assert_cmpuint(gb_world_hash(world), ==, gb_world_hash(loaded));
    struct gb_inserted_pair *inserted = gb_record_find(&record, "world/amended")->data;
    inserted[0].other = inserted[0].first;
    g_assert_false(gb_world_record(loaded, &record, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    g_assert_nonnull(strstr(err.text, "world/amended"));
    gb_record_finish(&record);
    gb_world_copy_destroy(copy);
    gb_world_destroy(world);
    gb_world_destroy(rebuilt);
    gb_world_destroy(loaded);
}

/* A copy in double precision inserts no pairs: it builds its lists from the positions, and has
 * the forces, contacts and histories of the run. */
static void test_double_copy(void)
{
    const struct gb_params params =
        scene_params("particles.count=6000", "numerics.precision=single", NULL);
    const struct gb_params fine =
        scene_params("particles.count=6000", "numerics.precision=double", NULL);
    const struct gb_model model = scene_model(&params), fine_model = scene_model(&fine);
    struct gb_world *world = scene_world(&model), *copy = NULL;
    struct gb_record record = {0};
    struct gb_error err = {0};
    scene_press(world, 150, 10, 2.0);
    move_until_inserted(world);
    g_assert_true(gb_world_record(world, &record, &err));
    record.loading = true;
    g_assert_true(gb_world_create(&copy, &fine_model, gb_world_position(world), &err));
    g_assert_true(gb_world_record(copy, &record, &err));
    g_assert_cmpint(gb_world_pairs(copy)->inserted_count, ==, 0);
    g_assert_cmpint(gb_world_tally(copy)->contacts, ==, gb_world_tally(world)->contacts);
    scene_evaluate(copy);
    const struct gb_bodies w = gb_world_bodies(world), c = gb_world_bodies(copy);
    for (int64_t i = 0; i < 3 * w.count; i++) {
        g_assert_cmpfloat_with_epsilon(w.force[i], c.force[i], 1e-6);
        g_assert_cmpfloat_with_epsilon(w.torque[i], c.torque[i], 1e-6);
    }
    gb_record_finish(&record);
    gb_world_destroy(world);
    gb_world_destroy(copy);
}

/* As many pairs as a block has free slots can be inserted, and no more. */
static void test_full(void)
{
    const struct gb_params params =
        scene_params("particles.count=6000", "numerics.precision=single", NULL);
    const struct gb_model model = scene_model(&params);
    struct gb_world *world = scene_world(&model);
    struct gb_inserted_pair inserted[200];
    struct gb_error err = {0};
    scene_evaluate(world);
    const struct gb_pair_list *near = &world->engine.list.near;
    const int64_t end = gb_blocks_end(world->engine.particles.count, 0);
    const int64_t slots = near->start[end] - near->stop[0], before = near->pair_count;
    int64_t count = 0;
    for (int32_t i = 0; i < end && count <= slots;
         i += 3) { /* with a particle far away */
        for (int32_t j = i + 1; j < 6000; j++) {
            if (world_distance(world, i, j) > 3.0) {
                inserted[count++] = (struct gb_inserted_pair){i, j, 13, 1};
                break;
            }
        }
    }
    g_assert_cmpint(count, ==, slots + 1);
    g_assert_cmpint(count, <=, world->engine.list.inserted_max);
    g_assert_false(gb_list_patch_load(&world->engine, inserted, count, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    g_assert_cmpint(near->pair_count, ==, before);
    world_check_slots(world, near);
    g_assert_true(gb_list_patch_load(&world->engine, inserted, count - 1, &err));
    g_assert_cmpint(near->pair_count, ==, before + slots);
    g_assert_cmpint(near->stop[0], ==, near->start[end]);
    scene_evaluate(world);
    g_assert_cmpint(gb_world_tally(world)->contacts, >, 10000);
    gb_world_destroy(world);
}

/* An insertion without memory is an error, and the next evaluation recovers from it. */
static void test_memory(void)
{
    const struct gb_params params =
        scene_params("particles.count=600", "numerics.precision=single", NULL);
    const struct gb_model model = scene_model(&params);
    struct gb_world *world = scene_world(&model);
    const struct gb_bodies b = gb_world_bodies(world);
    GRand *random = g_rand_new_with_seed(17);
    int failed = 0;
    scene_press(world, 100, 3, 2.0);
    for (int step = 0; step < 200; step++) {
        for (int64_t i = 0; i < 3 * b.count; i++) {
            const double length = i / 3 % 199 == 0 ? 0.02 : 1e-4;
            b.position[i] += length * g_rand_double_range(random, -0.5, 1.0);
        }
        struct gb_error err = {0};
        gb_alloc_fail_after(1 + step % 8);
        const bool done = gb_world_evaluate(world, &err);
        gb_alloc_fail_after(0);
        if (!done && err.code == GB_ERR_MEMORY) {
            failed++;
            err = (struct gb_error){0};
            (void)gb_world_evaluate(world, &err);
        }
        /* particles moved at random may overlap */
        g_assert_true(err.code == GB_OK || err.code == GB_ERR_GUARD);
        world_check_lists(world);
    }
    g_assert_cmpint(failed, >, 0);
    g_rand_free(random);
    gb_world_destroy(world);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/list_patch/inserted", test_inserted);
    g_test_add_func("/list_patch/double-copy", test_double_copy);
    g_test_add_func("/list_patch/full", test_full);
    g_test_add_func("/list_patch/memory", test_memory);
    return g_test_run();
}
