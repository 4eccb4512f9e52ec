#include <glib.h>
#include <math.h>

#include "base/vec.h"
#include "common/unequal.h"
#include "measure/observe.h"
#include "pack/list/neighbour_list.h"
#include "scene/tolerances.h"
#include "scene/unequal_pair.h"

/* The sweep over packings of unequal spheres. */

static double largest_of(const double *v, int64_t count)
{
    double most = 0.0;
    for (int64_t i = 0; i < 3 * count; i++) {
        most = fmax(most, fabs(v[i]));
    }
    return most;
}

/* The sweep of unequal sizes with a table of one size agrees with the sweep of equal sizes:
 * forces, torques and histories up to rounding, with bridges, with friction, with neither. */
static void test_one_size(void)
{
    static const char *const scenes[][2] = {
        {"contact.mu=0.1", "contact.alpha=0.24"},
        {"contact.bridge_length=1 d", "contact.mu=0.4"},
        {"contact.bridge_radius=current", "contact.relative_motion=full"},
        {"contact.bridge_length=1 d", "contact.mu=0"},
        {"material.epsilon=0 kB", "contact.mu=0.1"}};
    for (size_t s = 0; s < G_N_ELEMENTS(scenes); s++) {
        const struct gb_params plain =
            scene_params(scenes[s][0], scenes[s][1], "numerics.precision=double", NULL);
        const struct gb_params table = scene_params(
            scenes[s][0], scenes[s][1], "particles.distribution=table",
            "particles.table=number: 9.7 nm 1", "numerics.precision=double", NULL);
        const struct gb_model one = scene_model(&plain), many = scene_model(&table);
        double *position = scene_positions(&one);
        struct gb_world *world[2];
        struct gb_error err = {0};
        g_assert_true(gb_world_create(&world[0], &one, position, &err));
        g_assert_true(gb_world_create(&world[1], &many, position, &err));
        gb_alloc_free(position);
        scene_press(world[0], 4, 20, 1.5);
        scene_press(world[1], 4, 20, 1.5);
        const struct gb_bodies a = gb_world_bodies(world[0]);
        const struct gb_bodies b = gb_world_bodies(world[1]);
        const double force = largest_of(a.force, a.count);
        const double torque = fmax(largest_of(a.torque, a.count), force);
        for (int64_t i = 0; i < 3 * a.count; i++) {
            g_assert_cmpfloat(fabs(a.position[i] - b.position[i]), <, 1e-8);
            g_assert_cmpfloat(fabs(a.force[i] - b.force[i]), <, 1e-5 * force);
            g_assert_cmpfloat(fabs(a.torque[i] - b.torque[i]), <, 1e-5 * torque);
        }
        const struct gb_tally *first = gb_world_tally(world[0]);
        const struct gb_tally *second = gb_world_tally(world[1]);
        g_assert_cmpint(first->contacts, >, one.count);
        g_assert_cmpint(first->contacts, ==, second->contacts);
        g_assert_cmpint(first->sliding, ==, second->sliding);
        unequal_close(first->normal_sum, second->normal_sum, 1e-6);
        unequal_close(first->deepest, second->deepest, 1e-6);
        unequal_close(gb_world_residual(world[0]), gb_world_residual(world[1]), 1e-5);
        unequal_close(gb_observe_elastic(world[0]), gb_observe_elastic(world[1]), 1e-6);
        unequal_close(gb_observe_density(world[0]), gb_observe_density(world[1]), 1e-12);
        gb_world_destroy(world[0]);
        gb_world_destroy(world[1]);
    }
}

/* Moments about a point balance: each pair balances alone, so the sum of the moments
 * (torque times diameter) and of branch vector x force over all pairs is 0. */
static void check_balance(const struct gb_world *world)
{
    const struct gb_neighbour_list *pairs = gb_world_pairs(world);
    double torque[3] = {0.0, 0.0, 0.0}, moment[3] = {0.0, 0.0, 0.0}, size = 0.0;
    const struct gb_bodies b = gb_world_bodies((struct gb_world *)world);
    double force[3] = {0.0, 0.0, 0.0};
    for (int64_t i = 0; i < b.count; i++) {
        gb_vec_add(torque, gb_world_diameter(world, i), b.torque + 3 * i);
        gb_vec_add(force, 1.0, b.force + 3 * i);
        size += gb_vec_length(b.force + 3 * i);
    }
    for (int64_t i = 0; i < b.count; i++) {
        for (int64_t k = pairs->near.start[i]; k < pairs->near.start[i + 1]; k++) {
            double r[3], f[3];
            gb_world_branch_vector(world, &pairs->near, i, k, r);
            scene_force(world, GB_PAIR_FORCES_NEAR, k, f);
            for (int c = 0; c < 3; c++) {
                const int u = (c + 1) % 3, v = (c + 2) % 3;
                moment[c] += r[u] * f[v] - r[v] * f[u];
            }
            size += gb_vec_length(f);
        }
    }
    for (int c = 0; c < 3; c++) {
        g_assert_cmpfloat(fabs(force[c]), <, 1e-12 * size);
        g_assert_cmpfloat(fabs(torque[c] + moment[c]), <, 1e-11 * size);
    }
    g_assert_cmpfloat(gb_vec_length(moment), >, 1e-8 * size); /* there are some */
}

/* Sizes as drawn, no overlaps at the start beyond the equilibrium of each pair, every
 * particle touching two; momentum, angular momentum and the neighbour lists. */
static void test_packing(void)
{
    const struct gb_params params =
        scene_params(UNEQUAL_LOGNORMAL, "particles.sigma=0.3", "particles.largest=20 nm",
                     "particles.count=400", "numerics.precision=double", NULL);
    const struct gb_model model = scene_model(&params);
    g_assert_true(model.polydisperse);
    struct gb_world *world = scene_world(&model);
    scene_evaluate(world);
    struct gb_contact_counts counts;
    gb_observe_contacts(world, &counts, NULL, 0, NULL);
    g_assert_cmpfloat(counts.coordination, >, 3.9);
    g_assert_cmpint(counts.rattlers, ==, 0);
    g_assert_cmpfloat(gb_observe_density(world), >, 0.2399);
    g_assert_cmpfloat(gb_observe_density(world), <, 0.2401);
    double cube = 0.0, sum = 0.0;
    for (int64_t i = 0; i < model.count; i++) {
        const double d = gb_world_diameter(world, i);
        sum += d;
        cube += d * d * d;
        g_assert_cmpfloat(d, >=, model.diameter_min);
        g_assert_cmpfloat(d, <=, model.diameter_max);
    }
    unequal_close(sum / (double)model.count, 1.0, 1e-3);
    unequal_close(cube / (double)model.count, model.mean_power, 1e-9);
    /* no force at the start: every contact is at its equilibrium */
    g_assert_cmpfloat(gb_world_residual(world), <, 1.0);
    for (int i = 0; i < 5; i++) {
        scene_press(world, 3, 20, 1.5);
        check_balance(world);
    }
    gb_world_destroy(world);
}

static double pull_of(const struct gb_world *world, int64_t k)
{
    double f[3];
    scene_force(world, GB_PAIR_FORCES_FAR, k, f);
    return gb_vec_length(f);
}

/* The lists hold the pairs that a scan of all pairs finds. */
static void check_lists(const char *precision)
{
    const struct gb_model model = unequal_model("particles.count=300", precision);
    struct gb_world *world = scene_world(&model);
    scene_press(world, 3, 20, 1.5);
    const double *x = gb_world_position(world);
    int64_t touching = 0, pulling = 0;
    for (int64_t i = 0; i < model.count; i++) {
        for (int64_t j = 0; j < i; j++) {
            double r[3] = {x[3 * i] - x[3 * j], x[3 * i + 1] - x[3 * j + 1],
                           x[3 * i + 2] - x[3 * j + 2]};
            gb_cell_nearest(gb_world_cell(world), r);
            const double gap = gb_vec_length(r) - 0.5 * (gb_world_diameter(world, i) +
                                                         gb_world_diameter(world, j));
            touching += gap < 0.0;
            pulling += gap >= 0.0 && gap < model.numerics.cutoff - 1.0;
        }
    }
    const struct gb_neighbour_list *pairs = gb_world_pairs(world);
    int64_t pulled = 0;
    for (int64_t k = 0; k < pairs->far.pair_count; k++) {
        pulled += pull_of(world, k) > 0.0;
    }
    for (int64_t k = 0; k < pairs->near.pair_count; k++) {
        double f[3];
        scene_force(world, GB_PAIR_FORCES_NEAR, k, f);
        pulled +=
            !gb_contacts_touch(gb_world_contacts(world), k) && gb_vec_length(f) > 0.0;
    }
    g_assert_cmpint(gb_world_tally(world)->contacts, ==, touching);
    g_assert_cmpint(pulled, ==, pulling);
    gb_world_destroy(world);
}

static void test_lists(void)
{
    check_lists("numerics.precision=double");
    check_lists("numerics.precision=single");
}

/* Small spheres in a shell around one twenty times as large: `count` with it. */
static void surround(int64_t count, double edge, double *position, double *diameter)
{
    GRand *random = g_rand_new_with_seed(5);
    for (int64_t i = 0; i < count; i++) {
        const double z = g_rand_double_range(random, -1.0, 1.0);
        const double angle = g_rand_double_range(random, 0.0, 2.0 * M_PI);
        const double far = i == 0 ? 0.0 : g_rand_double_range(random, 10.5, 13.0);
        const double across = far * sqrt(1.0 - z * z), half = 0.5 * edge;
        diameter[i] = i == 0 ? 20.0 : g_rand_double_range(random, 0.8, 1.2);
        position[3 * i] = half + across * cos(angle);
        position[3 * i + 1] = half + across * sin(angle);
        position[3 * i + 2] = half + far * z;
    }
    g_rand_free(random);
}

/* Sizes of a ratio of 20: more neighbours around a particle than bins are scanned for, and
 * the pairs of a scan of all. */
static void test_wide(void)
{
    enum { COUNT = 3000 };
    const struct gb_neighbour_list_range range = {1.2, 0.1};
    const double edge = 46.0, gap = range.cutoff - 1.0 + range.skin;
    double *x = g_new(double, 3 * COUNT), *d = g_new(double, COUNT);
    struct gb_neighbour_list list;
    struct gb_cell cell;
    struct gb_error err = {0};
    int64_t within = 0, near = 0;
    surround(COUNT, edge, x, d);
    gb_cell_init(&cell, 3, (const double[3]){edge, edge, edge});
    g_assert_true(
        gb_neighbour_list_init(&list, COUNT, GB_NEIGHBOUR_LIST_TRANSPOSED, &err));
    list.diameter = d;
    list.largest = 20.0;
    g_assert_true(gb_neighbour_list_build(&list, &cell, x, range, NULL, &err));
    for (int64_t i = 0; i < COUNT; i++) {
        for (int64_t j = 0; j < i; j++) {
            double r[3] = {x[3 * i] - x[3 * j], x[3 * i + 1] - x[3 * j + 1],
                           x[3 * i + 2] - x[3 * j + 2]};
            gb_cell_nearest(&cell, r);
            const double apart = gb_vec_length(r) - 0.5 * (d[i] + d[j]);
            within += apart < gap;
            near += apart < range.skin;
        }
    }
    const int64_t around = list.near.start[1] + list.far.start[1];
    g_test_message("%d pairs, %d around the large sphere", (int)within, (int)around);
    g_assert_cmpint(around, >, GB_NEIGHBOUR_LIST_SCAN_MAX);
    g_assert_cmpint(list.near.pair_count, ==, near);
    g_assert_cmpint(list.far.pair_count, ==, within - near);
    gb_neighbour_list_finish(&list);
    g_free(x);
    g_free(d);
}

/* Several blocks of particles. */
static void check_threads(const char *precision)
{
    uint64_t hash = 0;
    for (int threads = 1; threads <= 4; threads++) {
        struct gb_model model = unequal_model("particles.count=4000", precision);
        model.numerics.threads = threads;
        struct gb_world *world = scene_world(&model);
        scene_press(world, 3, 20, 1.5);
        g_assert_true(threads == 1 || gb_world_hash(world) == hash);
        hash = gb_world_hash(world);
        gb_world_destroy(world);
    }
}

static void test_threads(void)
{
    check_threads("numerics.precision=double");
    check_threads("numerics.precision=single");
}

/* Two spheres of 0.6 and 1.7 d: pressed and pulled back, the force is the law's, over the
 * bridge and after it has been peeled. */
static struct gb_world *pair(struct gb_model *model, double d[2])
{
    const struct gb_params params = scene_params(
        "particles.distribution=table", "particles.table=number: 6 nm 0.5; 17 nm 0.5",
        "numerics.precision=double", NULL);
    *model = scene_model(&params);
    model->count = 2;
    model->edges[0] = model->edges[1] = model->edges[2] = 12.0;
    struct gb_world *world = NULL;
    struct gb_error err = {0};
    const double position[6] = {5.0, 5.0, 5.0, 5.0, 5.0, 8.0};
    g_assert_true(gb_world_create(&world, model, position, &err));
    d[0] = gb_world_diameter(world, 0);
    d[1] = gb_world_diameter(world, 1);
    return world;
}

static void test_pair(void)
{
    struct gb_model model;
    struct gb_law_unequal law;
    double d[2], deepest = 0.0;
    struct gb_world *world = pair(&model, d);
    gb_unequal_pair_init(&law, &model, d[0], d[1]);
    const struct gb_bodies b = gb_world_bodies(world);
    static const double path[] = {0.5,   0.05,  -0.005, -0.02, -0.05,
                                  -0.04, -0.03, -0.01,  0.01,  -0.005};
    for (size_t s = 0; s < G_N_ELEMENTS(path); s++) {
        const double h = -path[s] * law.mean_diameter;
        b.position[5] = 5.0 + law.mean_diameter - h;
        scene_evaluate(world);
        struct gb_law_bridge bridge = model.bridge;
        bridge.length = law.bridge_length;
        deepest = gb_law_bridge_deepest(&bridge, deepest, h);
        const double reach = model.numerics.cutoff - 1.0;
        const double expected =
            h > 0.0      ? gb_law_unequal_elastic(&law, deepest, h, NULL) - law.adhesion
            : -h < reach ? -gb_law_unequal_attraction(&law, law.mean_diameter - h)
                         : 0.0;
        unequal_close(b.force[5], expected, 1e-9);
        g_assert_cmpfloat(b.force[2], ==, -b.force[5]);
        g_assert_cmpfloat(b.force[0], ==, 0.0);
    }
    gb_world_destroy(world);
}

/* The same pair sheared: the force is that of the spring, half of the displacement times
 * the stiffness, and the moments follow from its lever arms. */
static void test_pair_shear(void)
{
    struct gb_model model;
    struct gb_law_unequal law;
    double d[2];
    struct gb_world *world = pair(&model, d);
    gb_unequal_pair_init(&law, &model, d[0], d[1]);
    const struct gb_bodies b = gb_world_bodies(world);
    const double h = 0.03 * law.mean_diameter, r = law.mean_diameter - h, roll = 1e-5;
    b.position[5] = 5.0 + r;
    scene_evaluate(world);
    /* both rotate about y in the same sense: the surfaces slide by r_i w + r_j w = r w */
    b.rotation[1] = roll * d[0];
    b.rotation[4] = roll * d[1];
    scene_evaluate(world);
    const double a = gb_law_unequal_radius(&law, h);
    const double shear =
        gb_law_slip_shear_stiffness(&model.slip, a) * model.slip.motion * r * roll;
    unequal_close(fabs(b.force[0]), shear, 1e-6);
    unequal_close(b.force[0], -b.force[3], 1e-12);
    /* no rolling: the angles are equal */
    unequal_close(fabs(b.torque[1]) * d[0], shear * r * d[0] / (d[0] + d[1]), 1e-6);
    unequal_close(fabs(b.torque[4]) * d[1], shear * r * d[1] / (d[0] + d[1]), 1e-6);
    g_assert_cmpfloat(b.torque[1] * roll, <, 0.0); /* against the rotation */
    /* opposite rotations: surfaces roll without sliding, but the bridge bends */
    struct gb_world *other = pair(&model, d);
    const struct gb_bodies o = gb_world_bodies(other);
    o.position[5] = 5.0 + r;
    scene_evaluate(other);
    o.rotation[1] = roll * d[1] / (d[0] + d[1]) * d[0];
    o.rotation[4] = -roll * d[0] / (d[0] + d[1]) * d[1];
    scene_evaluate(other);
    const double bend =
        gb_law_slip_roll_stiffness(&model.slip, a) * model.slip.motion * roll;
    g_assert_cmpfloat(fabs(o.force[0]), <, 1e-9 * shear);
    unequal_close(fabs(o.torque[1]) * d[0], bend, 1e-6);
    unequal_close(o.torque[1] * d[0], -o.torque[4] * d[1], 1e-9);
    gb_world_destroy(world);
    gb_world_destroy(other);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/sized/pair", test_pair);
    g_test_add_func("/sized/pair-shear", test_pair_shear);
    g_test_add_func("/sized/one-size", test_one_size);
    g_test_add_func("/sized/packing", test_packing);
    g_test_add_func("/sized/lists", test_lists);
    g_test_add_func("/sized/wide", test_wide);
    g_test_add_func("/sized/threads", test_threads);
    return g_test_run();
}
