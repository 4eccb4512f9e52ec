#include <glib.h>
#include <math.h>

#include "common/world.h"
#include "pack/f32/integrate_f32.h"
#include "pack/list/list_check.h"

/* A few particles move through the others, up to the whole reach of the list and beyond: no
 * pair is missed, and yet the list outlives many displacements larger than its margin. */
static void test_escaped(void)
{
    const char *scene[][3] = {{"particles.count=150", "structure.seed=3", NULL},
                              {"particles.count=600", "structure.seed=4", NULL},
                              {"scene.dimension=2", "particles.count=300", NULL},
                              {"particles.distribution=lognormal", "particles.sigma=0.2",
                               "particles.count=400"}};
    const double steps_max[] = {0.01, 0.06, 0.15};
    for (int s = 0; s < 12; s++) {
        const char *const *keys = scene[s / 3];
        const double step_max = steps_max[s % 3];
        const struct gb_params params = scene_params(keys[0], keys[1], keys[2], NULL);
        const struct gb_model model = scene_model(&params);
        struct gb_world *world = scene_world(&model);
        const struct gb_bodies b = gb_world_bodies(world);
        GRand *random = g_rand_new_with_seed((guint32)s);
        int outlived = 0;
        int64_t inserted = 0;
        scene_evaluate(world);
        for (int step = 0; step < 200; step++) {
            if (step % 20 == 19) {
                scene_squeeze(world, 0.002);
            }
            for (int64_t i = 0; i < b.count; i++) {
                const double length = i % 41 == 0 ? step_max : 1e-4;
                for (int k = 0; k < 3; k++) {
                    const bool flat = model.dimension == 2 && k == 1;
                    b.position[3 * i + k] +=
                        flat ? 0.0 : length * g_rand_double_range(random, -0.5, 1.0);
                }
            }
            const int64_t before = gb_world_rebuilds(world);
            const double displacement = gb_neighbour_list_displacement(
                gb_world_pairs(world), b.position, 0, b.count);
            world_evaluate_any(world);
            outlived += gb_world_rebuilds(world) == before &&
                        2.0 * displacement >= model.numerics.skin;
            inserted += gb_world_pairs(world)->inserted_count;
            world_check_lists(world);
        }
        g_assert_true(gb_world_rebuilds(world) > 1 || inserted > 0);
        g_assert_true(step_max < 0.15 || gb_world_rebuilds(world) > 1);
        g_assert_cmpint(outlived, >, 0);
        g_rand_free(random);
        gb_world_destroy(world);
    }
}

/* Largest displacement since the lists were built, also before a synchronisation. */
static double largest_displacement(const struct gb_world *world)
{
    double longest = 0.0;
    for (int64_t i = 0; i < world->engine.particles.count; i++) {
        double r[3];
        gb_engine_position(&world->engine, i, r);
        for (int c = 0; c < 3; c++) {
            r[c] -= world->engine.list.built_position[3 * i + c] *
                    world->engine.list.unit.edge[c];
        }
        longest = fmax(longest, gb_vec_length(r));
    }
    return longest;
}

/* The same by velocity updates in single precision: one particle in 41 moves up to step_max
 * (d) at a time. */
static void check_velocity_updates(double step_max, int *outlived, int64_t *inserted)
{
    const struct gb_params params =
        scene_params("particles.count=600", "numerics.precision=single", NULL);
    const struct gb_model model = scene_model(&params);
    struct gb_world *world = scene_world(&model);
    const struct gb_integrate_f32 by = {
        .keep = 1.0, .step = 1.0, .inertia = 0.4, .displacement_max = 1.0};
    const struct gb_neighbour_list *pairs = gb_world_pairs(world);
    GRand *random = g_rand_new_with_seed(13);
    scene_press(world, 100, 3, 2.0);
    gb_integrate_f32_reset(world);
    for (int step = 0; step < 200; step++) {
        const int64_t before = gb_world_rebuilds(world);
        for (int64_t k = 0; k < 3 * pairs->count; k++) {
            const double length = k / 3 % 41 == 0 ? step_max : 1e-4;
            world->engine.f32.velocity[k / 3][k % 3] =
                (float)(length * g_rand_double_range(random, -0.5, 1.0));
        }
        gb_integrate_f32_step(world, &by, NULL);
        const double displacement = largest_displacement(world);
        world_evaluate_any(world);
        *outlived += gb_world_rebuilds(world) == before &&
                     2.0 * displacement >= model.numerics.skin;
        *inserted += pairs->inserted_count;
        world_check_lists(world);
    }
    g_rand_free(random);
    gb_world_destroy(world);
}

/* A few particles are moved by a caller, as a prediction does, between two velocity updates
 * of which none alone lets a particle escape. */
enum moved_by { BEFORE_EVALUATION, BEFORE_UPDATE };
static void check_moved_between_updates(enum moved_by moved_by)
{
    const struct gb_params params =
        scene_params("particles.count=600", "numerics.precision=single", NULL);
    const struct gb_model model = scene_model(&params);
    struct gb_world *world = scene_world(&model);
    struct gb_world_copy *copy = NULL;
    struct gb_error err = {0};
    const struct gb_integrate_f32 by = {
        .keep = 0.45, .step = 1.0, .inertia = 0.4, .displacement_max = 1.0};
    GRand *random = g_rand_new_with_seed(19);
    scene_press(world, 100, 3, 2.0);
    g_assert_true(gb_world_copy_save(world, &copy, &err));
    for (int round = 0; round < 40; round++) {
        g_assert_true(gb_world_copy_restore(world, copy, &err));
        scene_evaluate(world);
        gb_integrate_f32_reset(world);
        gb_integrate_f32_step(world, &by, NULL);
        scene_evaluate(world);
        const double length = 2.0 * gb_list_check_margin(&world->engine) / sqrt(3.0);
        struct gb_bodies b = gb_world_movable(world);
        for (int64_t k = 0; k < 3 * b.count; k++) {
            const bool escapes = k / 3 % 40 == round;
            const double moved =
                escapes ? g_rand_boolean(random) ? length : -length : 0.0;
            b.position[k] += moved;
            world->engine.f32.velocity[k / 3][k % 3] = (float)moved;
        }
        if (moved_by == BEFORE_EVALUATION) {
            world_evaluate_any(world);
        }
        gb_integrate_f32_step(world, &by, NULL);
        world_evaluate_any(world);
        world_check_lists(world);
    }
    g_rand_free(random);
    gb_world_copy_destroy(copy);
    gb_world_destroy(world);
}

static void test_escaped_velocity_update(void)
{
    const double steps_max[] = {0.01, 0.06, 0.15};
    int outlived = 0;
    int64_t inserted = 0;
    for (int p = 0; p < 3; p++) {
        check_velocity_updates(steps_max[p], &outlived, &inserted);
    }
    check_moved_between_updates(BEFORE_EVALUATION);
    check_moved_between_updates(BEFORE_UPDATE);
    g_assert_cmpint(outlived, >, 0);
    g_assert_cmpint(inserted, >, 0);
}

enum { MEETING_COUNT = 90 };

/* Two isolated particles in a cell of random size.  unit: direction from particle 0 to 1. */
static struct gb_world *meeting_world(struct gb_model *model, GRand *random,
                                      const double edge_range[2], double unit[3])
{
    double x[MEETING_COUNT][3];
    struct gb_error err = {0};
    struct gb_world *world = NULL;
    for (int k = 0; k < 3; k++) {
        model->edges[k] = g_rand_double_range(random, edge_range[0], edge_range[1]);
        /* often along an edge, where the bins end soonest */
        unit[k] = pow(g_rand_double_range(random, -1.0, 1.0), 9.0);
        x[0][k] = g_rand_double_range(random, 0.0, model->edges[k]);
    }
    const double length = gb_vec_length(unit);
    const double far = g_rand_double_range(random, 1.4, 3.6);
    for (int k = 0; k < 3; k++) {
        unit[k] /= length;
        x[1][k] = x[0][k] + far * unit[k];
        for (int i = 2; i < MEETING_COUNT; i++) { /* all in one point, far from both */
            x[i][k] = x[0][k] + 0.5 * model->edges[k];
        }
    }
    struct gb_cell cell;
    gb_cell_init(&cell, 3, model->edges);
    for (int i = 0; i < MEETING_COUNT; i++) {
        gb_cell_wrap(&cell, x[i]);
    }
    g_assert_true(gb_world_create(&world, model, x[0], &err));
    return world;
}

/* True when the particles touch; until then a list holds the pair within the cutoff. */
static bool check_meeting(struct gb_world *world, const struct gb_model *model)
{
    struct gb_error err = {0};
    (void)gb_world_evaluate(world, &err); /* the other particles overlap */
    const struct gb_neighbour_list *pairs = gb_world_pairs(world);
    const double distance = world_distance(world, 0, 1);
    const bool near = world_holds_pair(world, &pairs->near, 0, 1, distance);
    g_assert_true(near || distance >= 1.0);
    g_assert_true(near || distance >= model->numerics.cutoff ||
                  world_holds_pair(world, &pairs->far, 0, 1, distance));
    return distance < 1.0;
}

/* Two isolated particles approach each other from a distance while the cell is strained:
 * the lists, which do not hold the pair, last until it comes within the cutoff. */
static void test_meeting(void)
{
    /* in small cells nearest images change during the approach */
    static const double edge_range[2][2] = {{6.0, 12.0}, {2.9, 3.5}};
    static const double strain[3] = {0.001, -0.002, 0.0};
    const struct gb_params params = scene_params("particles.count=90", NULL);
    struct gb_model model = scene_model(&params);
    GRand *random = g_rand_new_with_seed(7);
    int outlived = 0, met = 0;
    for (int round = 0; round < 800; round++) {
        const bool small_cell = round >= 400;
        double unit[3];
        struct gb_world *world =
            meeting_world(&model, random, edge_range[small_cell], unit);
        const double step_max = round % 2 ? 0.03 : g_rand_double_range(random, 0.0, 0.06);
        const struct gb_bodies b = gb_world_bodies(world);
        for (int step = 0; step < 100; step++) {
            const int64_t before = gb_world_rebuilds(world);
            if (check_meeting(world, &model)) {
                met += !small_cell;
                break;
            }
            outlived += gb_world_rebuilds(world) == before && step * 0.03 > 0.1;
            for (int k = 0; k < 3; k++) {
                b.position[k] += step_max * unit[k];
                b.position[3 + k] -= (0.06 - step_max) * unit[k];
            }
            scene_squeeze(world, strain[round % 3]);
        }
        gb_world_destroy(world);
    }
    g_rand_free(random);
    g_assert_cmpint(met, ==, 400);
    g_assert_cmpint(outlived, >, 400);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/list_check/escaped", test_escaped);
    g_test_add_func("/list_check/escaped-velocity-update", test_escaped_velocity_update);
    g_test_add_func("/list_check/meeting", test_meeting);
    return g_test_run();
}
