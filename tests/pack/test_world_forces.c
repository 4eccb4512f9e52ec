#include <glib.h>
#include <math.h>
#include <string.h>

#include "common/world.h"
#include "law/law_hertz.h"
#include "measure/observe.h"
#include "pack/cell/world.h"
#include "pack/kernel/fabric_sums.h"

static void sum_forces(struct gb_world *world, double force[3], double *largest)
{
    const struct gb_bodies b = gb_world_bodies(world);
    *largest = 0.0;
    force[0] = force[1] = force[2] = 0.0;
    for (int64_t i = 0; i < b.count; i++) {
        gb_vec_add(force, 1.0, b.force + 3 * i);
        *largest = fmax(*largest, gb_vec_length(b.force + 3 * i));
    }
}

static void test_momentum(const void *data)
{
    const struct precision *precision = data;
    const struct gb_params params = scene_params(precision->setting, NULL);
    const struct gb_model model = scene_model(&params);
    struct gb_world *world = scene_world(&model);
    for (int i = 0; i < 10; i++) {
        scene_press(world, 3, 30, 2.0);
        double force[3], largest;
        sum_forces(world, force, &largest);
        g_assert_cmpfloat(gb_vec_length(force), <,
                          precision->momentum * (double)model.count * largest);
    }
    gb_world_destroy(world);
}

/* Potential energy of a frictionless, unbridged packing, with the attraction cut off
 * where the sweep cuts it. */
static double energy(const struct gb_world *world)
{
    const struct gb_model *model = gb_world_model(world);
    double sum = 0.0;
    for (int64_t i = 0; i < model->count; i++) {
        for (int64_t j = 0; j < i; j++) {
            const double distance = world_distance(world, i, j);
            if (distance < model->numerics.cutoff) {
                sum +=
                    gb_law_rod_energy(&model->rod, 1.0 - distance) +
                    gb_law_dispersion_energy(&model->dispersion, distance) -
                    gb_law_dispersion_energy(&model->dispersion, model->numerics.cutoff);
            }
        }
    }
    return sum;
}

/* Forces are minus the gradient of the energy, the pressure minus its derivative by
 * volume. */
static void test_gradient(const void *data)
{
    const struct precision *precision = data;
    const struct gb_params params =
        scene_params(precision->setting, "contact.bridge_length=1 d", "contact.mu=0",
                     "contact.mu_pivot=0", NULL);
    const struct gb_model model = scene_model(&params);
    struct gb_world *world = scene_world(&model);
    scene_press(world, 5, 30, 2.0);
    const struct gb_bodies b = gb_world_bodies(world);
    const double step = 1e-5;
    for (int64_t i = 0; i < b.count; i += 17) {
        for (int k = 0; k < 3; k++) {
            const double keep = b.position[3 * i + k];
            b.position[3 * i + k] = keep + step;
            const double up = energy(world);
            b.position[3 * i + k] = keep - step;
            const double down = energy(world);
            b.position[3 * i + k] = keep;
            g_assert_cmpfloat_with_epsilon(
                b.force[3 * i + k], -(up - down) / (2.0 * step), precision->gradient);
        }
    }
    double pressure[3][3];
    gb_observe_pressure(world, pressure);
    const double volume = gb_cell_volume(gb_world_cell(world));
    scene_squeeze(world, step);
    const double squeezed = energy(world);
    scene_squeeze(world, -2.0 * step);
    const double widened = energy(world);
    g_assert_cmpfloat_with_epsilon(pressure[2][2],
                                   (squeezed - widened) / (2.0 * step * volume),
                                   precision->gradient);
    gb_world_destroy(world);
}

/* The contact with the largest overlap. */
static int64_t deepest_pair(const struct gb_world *world, int64_t *first)
{
    const struct gb_pair_list *near = &gb_world_pairs(world)->near;
    int64_t best = -1;
    double least = 1.0;
    for (int64_t i = 0; i < gb_world_model(world)->count; i++) {
        for (int64_t k = near->start[i]; k < near->start[i + 1]; k++) {
            const double distance = world_distance(world, i, near->other[k]);
            if (gb_contacts_touch(gb_world_contacts(world), k) && distance < least) {
                least = distance;
                best = k;
                *first = i;
            }
        }
    }
    return best;
}

/* Dry grains: Hertz along the normal, Coulomb's bound across it. */
static void check_dry(const struct gb_world *world, const struct gb_law_hertz *law,
                      double radius, double precision)
{
    const struct gb_pair_list *near = &gb_world_pairs(world)->near;
    const double mu = gb_world_model(world)->slip.mu;
    int64_t touching = 0, sliding = 0;
    for (int64_t i = 0; i < gb_world_model(world)->count; i++) {
        for (int64_t k = near->start[i]; k < near->start[i + 1]; k++) {
            double r[3], force[3];
            gb_world_branch_vector(world, near, i, k, r);
            scene_force(world, GB_PAIR_FORCES_NEAR, k, force);
            const double distance = gb_vec_length(r);
            const double normal = gb_vec_dot(force, r) / distance;
            const double hertz =
                distance < 1.0 ? gb_law_hertz_force(law, radius, 1.0 - distance) : 0.0;
            g_assert_cmpfloat_with_epsilon(normal, hertz, precision);
            gb_vec_add(force, -normal / distance, r);
            const double shear = gb_vec_length(force);
            g_assert_cmpfloat(shear, <=, mu * hertz + precision);
            touching += distance < 1.0;
            sliding += hertz > 0.0 && shear > 0.99 * mu * hertz;
        }
    }
    g_assert_cmpint(touching, >, 300);
    g_assert_cmpint(sliding, >, 0);
    g_assert_cmpint(sliding, <, touching);
}

/* A step across the normal from a state without springs: Mindlin. */
static void check_mindlin(const struct gb_model *model, const double *position,
                          const struct gb_law_hertz *law, double radius, double precision)
{
    struct gb_world *world = NULL;
    struct gb_error err = {0};
    g_assert_true(gb_world_create(&world, model, position, &err));
    scene_evaluate(world);
    int64_t i = 0;
    const int64_t k = deepest_pair(world, &i);
    double r[3], across[3], before[3], force[3];
    gb_world_branch_vector(world, &gb_world_pairs(world)->near, i, k, r);
    const double distance = gb_vec_length(r), step = 1e-4;
    const double axis[3] = {fabs(r[0]) < 0.5 ? 1.0 : 0.0, fabs(r[0]) < 0.5 ? 0.0 : 1.0,
                            0.0};
    gb_vec_cross(r, axis, across);
    scene_force(world, GB_PAIR_FORCES_NEAR, k, before);
    gb_vec_add(gb_world_bodies(world).position + 3 * i, step / gb_vec_length(across),
               across);
    scene_evaluate(world);
    scene_force(world, GB_PAIR_FORCES_NEAR, k, force);
    const double shear =
        (gb_vec_dot(force, across) - gb_vec_dot(before, across)) / gb_vec_length(across);
    const double expected =
        -step * gb_law_hertz_shear_stiffness(law, radius, 1.0 - distance) +
        step * gb_law_hertz_force(law, radius, 1.0 - distance) / distance;
    g_assert_cmpfloat_with_epsilon(shear, expected, precision * fabs(expected));
    gb_world_destroy(world);
}

static void test_dry(const void *data)
{
    const struct precision *precision = data;
    struct gb_params params =
        scene_params(precision->setting, "contact.normal=hertz", "contact.mu=0.2", NULL);
    struct gb_model model = scene_model(&params);
    g_assert_false(model.terms.bridges || model.terms.attraction);
    const struct gb_elastic elastic = {1.0, params.poisson};
    struct gb_law_hertz law;
    gb_law_hertz_init(&law, &elastic, &elastic);
    const double radius = gb_law_hertz_radius(0.5, 0.5);
    struct gb_world *world = scene_world(&model);
    scene_press(world, 250, 20, 2.0);
    check_dry(world, &law, radius, 100.0 * precision->gradient);
    memcpy(model.edges, gb_world_cell(world)->edge, sizeof model.edges);
    check_mindlin(&model, gb_world_position(world), &law, radius, 0.01);
    gb_world_destroy(world);
}

/* Adds half the force of pair k to both its particles; returns its magnitude. */
static double half_to_both(struct gb_pair_forces *forces, const struct gb_pair_list *list,
                           int64_t k, double *sum)
{
    double force[3];
    if (list->first[k] == list->other[k]) { /* free */
        return 0.0;
    }
    gb_pair_forces_at(forces, k, force);
    gb_vec_add(sum + 3 * (int64_t)list->first[k], 0.5, force);
    gb_vec_add(sum + 3 * (int64_t)list->other[k], -0.5, force);
    return gb_vec_length(force);
}

/* The forces of the pairs, read in any order, add up to those on every particle. */
static void check_forces(const char *precision, const char *scene, const char *law)
{
    const struct gb_params params = scene_params(precision, scene, law, NULL);
    const struct gb_model model = scene_model(&params);
    struct gb_world *world = scene_world(&model);
    scene_press(world, 100, 10, 2.0);
    const struct gb_bodies b = gb_world_bodies(world);
    const struct gb_neighbour_list *pairs = gb_world_pairs(world);
    double *sum = g_new0(double, (gsize)(3 * b.count)), largest = 0.0;
    for (int l = 0; l < 2; l++) {
        const enum gb_pair_forces_list which =
            l == 0 ? GB_PAIR_FORCES_NEAR : GB_PAIR_FORCES_FAR;
        const struct gb_pair_list *list = l == 0 ? &pairs->near : &pairs->far;
        struct gb_pair_forces forward, backward;
        gb_pair_forces_init(&forward, world, which);
        gb_pair_forces_init(&backward, world, which);
        const int64_t slots = gb_neighbour_list_slots(pairs, list);
        for (int64_t k = 0; k < slots; k++) {
            largest = fmax(largest, half_to_both(&forward, list, k, sum));
            (void)half_to_both(&backward, list, slots - 1 - k, sum);
        }
    }
    for (int64_t i = 0; i < 3 * b.count; i++) {
        g_assert_cmpfloat_with_epsilon(sum[i], b.force[i], 3e-6 * largest);
    }
    g_assert_cmpint(gb_world_tally(world)->sliding, >, 0);
    g_free(sum);
    gb_world_destroy(world);
}

static void test_forces(const void *data)
{
    const struct precision *precision = data;
    check_forces(precision->setting, "particles.count=300", "contact.mu=0.1");
    check_forces(precision->setting, "contact.bridge_radius=current", "contact.mu=0.1");
    check_forces(precision->setting, "contact.normal=hertz", "contact.mu=0.05");
}

/* Equal normal forces in all directions: a simple cubic crystal under pressure. */
static void test_lattice(const void *data)
{
    const struct precision *precision = data;
    const struct gb_params params = scene_params(
        precision->setting, "particles.count=125", "contact.bridge_length=1 d", NULL);
    struct gb_model model = scene_model(&params);
    const double h = 0.02, r = 1.0 - h;
    double position[3 * 125];
    for (int i = 0; i < 125; i++) {
        position[3 * i] = r * (i % 5 + 0.5);
        position[3 * i + 1] = r * (i / 5 % 5 + 0.5);
        position[3 * i + 2] = r * (i / 25 + 0.5);
    }
    model.edges[0] = model.edges[1] = model.edges[2] = 5.0 * r;
    model.numerics.cutoff = 1.2;
    struct gb_world *world = NULL;
    struct gb_error err = {0};
    g_assert_true(gb_world_create(&world, &model, position, &err));
    scene_evaluate(world);
    double pressure[3][3];
    gb_observe_pressure(world, pressure);
    const double expected = (gb_law_rod_force(&model.rod, h) - model.adhesion) / (r * r);
    double rose[9];
    struct gb_contact_counts counts;
    gb_observe_contacts(world, &counts, NULL, 0, NULL);
    gb_observe_rose(world, 9, rose);
    g_assert_cmpfloat(counts.coordination, ==, 6.0);
    for (int k = 0; k < 3; k++) {
        g_assert_cmpfloat_with_epsilon(pressure[k][k] / expected, 1.0,
                                       precision->lattice);
    }
    g_assert_cmpfloat_with_epsilon(rose[0] / rose[8], 1.0, precision->lattice);
    g_assert_true(isnan(rose[4]));
    g_assert_cmpfloat(gb_world_residual(world), <, 1e-2 * precision->lattice);
    gb_world_destroy(world);
}

/* The sum of an evaluation is computed once: every later one is of the state that it is asked of. */
static void check_virial(const struct gb_world *world, double sum[3][3])
{
    struct gb_fabric_sums fabric = {.weight = {0}};
    double again[3][3];
    gb_world_virial(world, sum);
    gb_world_virial_fabric(world, again, &fabric); /* computes it anew */
    g_assert_true(memcmp(sum, again, sizeof again) == 0);
}

/* Moved, strained, moved without an evaluation, and back in a copy. */
static void follow_virial(struct gb_world *world)
{
    static const double factor[3] = {1.0, 1.0, 0.999};
    struct gb_world_copy *copy = NULL;
    struct gb_error err = {0};
    double pressed[3][3], moved[3][3], strained[3][3], restored[3][3];
    g_assert_true(gb_world_copy_save(world, &copy, &err));
    scene_evaluate(world);
    check_virial(world, pressed);

    gb_world_bodies(world).position[3 * 17] += 1e-3;
    scene_evaluate(world);
    check_virial(world, moved);
    g_assert_false(memcmp(moved, pressed, sizeof moved) == 0);

    gb_world_strain(world, factor);
    scene_evaluate(world);
    check_virial(world, strained);
    g_assert_false(memcmp(strained, moved, sizeof moved) == 0);

    const struct gb_bodies b = gb_world_bodies(world);
    check_virial(world, restored);
    b.position[3 * 17] += 1e-3; /* no evaluation between */
    check_virial(world, restored);

    g_assert_true(gb_world_copy_restore(world, copy, &err));
    scene_evaluate(world);
    check_virial(world, restored);
    g_assert_false(memcmp(restored, strained, sizeof moved) == 0);
    gb_world_copy_destroy(copy);
}

static void test_virial(const void *data)
{
    const struct precision *precision = data;
    const struct gb_params params = scene_params(precision->setting, NULL);
    const struct gb_model model = scene_model(&params);
    struct gb_world *world = scene_world(&model);
    scene_press(world, 5, 30, 2.0);
    follow_virial(world);
    gb_world_destroy(world);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_data_func("/world/momentum", &precisions[0], test_momentum);
    g_test_add_data_func("/world/momentum-single", &precisions[1], test_momentum);
    g_test_add_data_func("/world/gradient", &precisions[0], test_gradient);
    g_test_add_data_func("/world/gradient-single", &precisions[1], test_gradient);
    g_test_add_data_func("/world/dry", &precisions[0], test_dry);
    g_test_add_data_func("/world/dry-single", &precisions[1], test_dry);
    g_test_add_data_func("/world/forces", &precisions[0], test_forces);
    g_test_add_data_func("/world/forces-single", &precisions[1], test_forces);
    g_test_add_data_func("/world/virial", &precisions[0], test_virial);
    g_test_add_data_func("/world/virial-single", &precisions[1], test_virial);
    g_test_add_data_func("/world/lattice", &precisions[0], test_lattice);
    g_test_add_data_func("/world/lattice-single", &precisions[1], test_lattice);
    return g_test_run();
}
