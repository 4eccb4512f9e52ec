#include <glib.h>
#include <math.h>
#include <stdlib.h>

#include "base/vec.h"
#include "common/scene.h"
#include "law/law_hertz.h"
#include "measure/observe.h"
#include "pack/cell/integrate_f32.h"
#include "pack/cell/list_patch.h"
#include "pack/cell/world_private.h"
#include "pack/cell/world_record.h"

/* What a world is good for in each precision. */
struct precision {
    const char *setting;
    double momentum; /* left over, per particle, over the largest force */
    double gradient; /* of the energy against a force, E d^2 */
    double skin;     /* in a pressure after 360 moves, over it */
    double lattice;  /* of forces on a site, over a contact's */
};

static const struct precision precisions[] = {
    {"numerics.precision=double", 1e-13, 1e-8, 1e-6, 1e-10},
    {"numerics.precision=single", 1e-7, 1e-7, 1e-3, 2e-5},
};

static double distance_of(const struct gb_world *world, int64_t i, int64_t j)
{
    const double *x = gb_world_position(world);
    double r[3] = {x[3 * i] - x[3 * j], x[3 * i + 1] - x[3 * j + 1],
                   x[3 * i + 2] - x[3 * j + 2]};
    gb_cell_nearest(gb_world_cell(world), r);
    return gb_vec_length(r);
}

static int64_t brute_pairs(const struct gb_world *world, double reach)
{
    int64_t found = 0;
    for (int64_t i = 0; i < gb_world_model(world)->count; i++) {
        for (int64_t j = 0; j < i; j++) {
            found += distance_of(world, i, j) < reach;
        }
    }
    return found;
}

/* Pairs in order, block by block, and free slots behind them. */
static void check_slots(const struct gb_world *world, const struct gb_pair_list *list)
{
    const int64_t count = world->count;
    int64_t pairs = 0, left = 0;
    for (int64_t b = 0; b < gb_sweep_blocks(count); b++) {
        const int64_t end = gb_sweep_block_end(count, b);
        int64_t k = list->start[gb_sweep_block_begin(count, b)];
        for (int64_t i = gb_sweep_block_begin(count, b); i < end; i++) {
            g_assert_cmpint(list->start[i], ==, k);
            while (k < list->stop[b] && list->first[k] == i) {
                g_assert_cmpint(list->other[k], >, i);
                g_assert_true(k == list->start[i] || list->other[k - 1] < list->other[k]);
                k++;
                pairs++;
            }
        }
        g_assert_cmpint(k, ==, list->stop[b]);
        for (; k < list->start[end]; k++) {
            double r[3];
            g_assert_cmpint(list->first[k], ==, end - 1);
            g_assert_cmpint(list->other[k], ==, end - 1);
            g_assert_cmpfloat(gb_world_arm_of(world, list, end - 1, k, r), >, 6.0);
            g_assert_true(list != &world->pairs.near ||
                          !gb_contacts_touch(&world->contacts, k));
            left++;
        }
    }
    g_assert_cmpint(pairs, ==, list->pair_count);
    g_assert_cmpint(pairs + left, ==, gb_neighbour_list_slots(&world->pairs, list));
    g_assert_cmpint(left, >, 0);
}

/* Pairs in order. */
static void check_order(const struct gb_pair_list *list, int64_t count)
{
    for (int64_t i = 0; i < count; i++) {
        for (int64_t k = list->start[i]; k < list->start[i + 1]; k++) {
            g_assert_cmpint(list->other[k], >, i);
            g_assert_true(k == list->start[i] || list->other[k - 1] < list->other[k]);
        }
    }
}

/* The list holds just the pairs that a scan of all finds, in order, in 3D and 2D, also in
 * cells barely wider than twice the reach. */
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
        if (world->in_single) {
            check_slots(world, &pairs->near);
        } else {
            check_order(&pairs->near, model.count);
        }
        gb_world_destroy(world);
    }
}

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
            const double distance = distance_of(world, i, j);
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

/* The deepest contact that has its first particle well inside the cell. */
static int64_t deepest_pair(const struct gb_world *world, int64_t *first)
{
    const struct gb_pair_list *near = &gb_world_pairs(world)->near;
    int64_t best = -1;
    double least = 1.0;
    for (int64_t i = 0; i < gb_world_model(world)->count; i++) {
        for (int64_t k = near->start[i]; k < near->start[i + 1]; k++) {
            const double distance = distance_of(world, i, near->other[k]);
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
            scene_force(world, true, k, force);
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
    scene_force(world, true, k, before);
    gb_vec_add(gb_world_bodies(world).position + 3 * i, step / gb_vec_length(across),
               across);
    scene_evaluate(world);
    scene_force(world, true, k, force);
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

/* In the list, with the image that is the nearest one. */
static bool listed(const struct gb_world *world, const struct gb_pair_list *list,
                   int64_t i, int64_t j, double distance)
{
    for (int64_t k = list->start[i]; k < list->start[i + 1]; k++) {
        double r[3];
        if (list->other[k] == j) {
            gb_world_branch_vector(world, list, i, k, r);
            return fabs(gb_vec_length(r) - distance) < 1e-9;
        }
    }
    return false;
}

/* Every pair within the cutoff is in a list, every one that touches in that of the near
 * ones. */
static void check_listed(const struct gb_world *world)
{
    const struct gb_neighbour_list *pairs = gb_world_pairs(world);
    const double gap = gb_world_model(world)->numerics.cutoff - 1.0;
    for (int64_t j = 0; j < pairs->count; j++) {
        for (int64_t i = 0; i < j; i++) {
            const double distance = distance_of(world, i, j);
            const double touch =
                0.5 * (gb_world_diameter(world, i) + gb_world_diameter(world, j));
            const bool near = listed(world, &pairs->near, i, j, distance);
            g_assert_true(near || distance >= touch);
            g_assert_true(near || distance >= touch + gap ||
                          listed(world, &pairs->far, i, j, distance));
        }
    }
}

/* A few run through the others, up to the whole reach of the list and beyond: no pair is
 * missed, and yet the list outlives many that ran further than half its margin. */
static void test_strays(void)
{
    const char *scene[][3] = {{"particles.count=150", "structure.seed=3", NULL},
                              {"particles.count=600", "structure.seed=4", NULL},
                              {"scene.dimension=2", "particles.count=300", NULL},
                              {"particles.distribution=lognormal", "particles.sigma=0.2",
                               "particles.count=400"}};
    const double paces[] = {0.01, 0.06, 0.15};
    for (int s = 0; s < 12; s++) {
        const char *const *keys = scene[s / 3];
        const double pace = paces[s % 3];
        const struct gb_params params = scene_params(keys[0], keys[1], keys[2], NULL);
        const struct gb_model model = scene_model(&params);
        struct gb_world *world = scene_world(&model);
        const struct gb_bodies b = gb_world_bodies(world);
        GRand *dice = g_rand_new_with_seed((guint32)s);
        int outlived = 0;
        int64_t amended = 0;
        scene_evaluate(world);
        for (int step = 0; step < 200; step++) {
            if (step % 20 == 19) {
                scene_squeeze(world, 0.002);
            }
            for (int64_t i = 0; i < b.count; i++) {
                const double way = i % 41 == 0 ? pace : 1e-4;
                for (int k = 0; k < 3; k++) {
                    const bool flat = model.dimension == 2 && k == 1;
                    b.position[3 * i + k] +=
                        flat ? 0.0 : way * g_rand_double_range(dice, -0.5, 1.0);
                }
            }
            const int64_t before = gb_world_rebuilds(world);
            const double travel =
                gb_neighbour_list_travel(gb_world_pairs(world), b.position, 0, b.count);
            struct gb_error err = {0};
            if (!gb_world_evaluate(world, &err)) { /* ran into another: go on */
                g_assert_cmpint(err.code, ==, GB_ERR_GUARD);
            }
            outlived +=
                gb_world_rebuilds(world) == before && 2.0 * travel >= model.numerics.skin;
            amended += gb_world_pairs(world)->amended_count;
            check_listed(world);
        }
        g_assert_true(gb_world_rebuilds(world) > 1 || amended > 0);
        g_assert_true(pace < 0.15 || gb_world_rebuilds(world) > 1);
        g_assert_cmpint(outlived, >, 0);
        g_rand_free(dice);
        gb_world_destroy(world);
    }
}

static void evaluate_or_meet(struct gb_world *world)
{
    struct gb_error err = {0};
    if (!gb_world_evaluate(world, &err)) { /* ran into another: go on */
        g_assert_cmpint(err.code, ==, GB_ERR_GUARD);
    }
}

/* Longest way since the lists were built, also of a drive that nobody has settled. */
static double travel_of(const struct gb_world *world)
{
    double longest = 0.0;
    for (int64_t i = 0; i < world->count; i++) {
        double way[3];
        gb_world_at(world, i, way);
        for (int c = 0; c < 3; c++) {
            way[c] -= world->pairs.built_at[3 * i + c] * world->pairs.stretch[c];
        }
        longest = fmax(longest, gb_vec_length(way));
    }
    return longest;
}

/* The same of a world that drives its particles itself: one in 41 at such a pace (d). */
static void check_driven(double pace, int *outlived, int64_t *amended)
{
    const struct gb_params params =
        scene_params("particles.count=600", "numerics.precision=single", NULL);
    const struct gb_model model = scene_model(&params);
    struct gb_world *world = scene_world(&model);
    const struct gb_integrate_f32 by = {
        .keep = 1.0, .step = 1.0, .inertia = 0.4, .most = 1.0};
    const struct gb_neighbour_list *pairs = gb_world_pairs(world);
    GRand *dice = g_rand_new_with_seed(13);
    scene_press(world, 100, 3, 2.0);
    gb_integrate_f32_reset(world);
    for (int step = 0; step < 200; step++) {
        const int64_t before = gb_world_rebuilds(world);
        for (int64_t k = 0; k < 3 * pairs->count; k++) {
            const double way = k / 3 % 41 == 0 ? pace : 1e-4;
            world->single.velocity[k] =
                (float)(way * g_rand_double_range(dice, -0.5, 1.0));
        }
        gb_integrate_f32_step(world, &by, NULL);
        const double travel = travel_of(world);
        evaluate_or_meet(world);
        *outlived +=
            gb_world_rebuilds(world) == before && 2.0 * travel >= model.numerics.skin;
        *amended += pairs->amended_count;
        check_listed(world);
    }
    g_rand_free(dice);
    gb_world_destroy(world);
}

/* Somebody else moves a few of them, as a prediction does, after a drive that moved
 * nobody and before one that alone would make nobody stray. */
static void check_driven_on(void)
{
    const struct gb_params params =
        scene_params("particles.count=600", "numerics.precision=single", NULL);
    const struct gb_model model = scene_model(&params);
    struct gb_world *world = scene_world(&model);
    struct gb_world_copy *copy = NULL;
    struct gb_error err = {0};
    const struct gb_integrate_f32 by = {
        .keep = 0.45, .step = 1.0, .inertia = 0.4, .most = 1.0};
    GRand *dice = g_rand_new_with_seed(19);
    scene_press(world, 100, 3, 2.0);
    g_assert_true(gb_world_copy_save(world, &copy, &err));
    for (int round = 0; round < 40; round++) {
        g_assert_true(gb_world_copy_restore(world, copy, &err));
        scene_evaluate(world);
        gb_integrate_f32_reset(world);
        gb_integrate_f32_step(world, &by, NULL);
        scene_evaluate(world);
        const double pace = 2.0 * gb_list_check_fresh(world) / sqrt(3.0);
        struct gb_bodies b = gb_world_movable(world);
        for (int64_t k = 0; k < 3 * b.count; k++) {
            const bool runs = k / 3 % 40 == round;
            const double way = runs ? g_rand_boolean(dice) ? pace : -pace : 0.0;
            b.position[k] += way;
            world->single.velocity[k] = (float)way;
        }
        evaluate_or_meet(world);
        gb_integrate_f32_step(world, &by, NULL);
        evaluate_or_meet(world);
        check_listed(world);
    }
    g_rand_free(dice);
    gb_world_copy_destroy(copy);
    gb_world_destroy(world);
}

static void test_strays_driven(void)
{
    const double paces[] = {0.01, 0.06, 0.15};
    int outlived = 0;
    int64_t amended = 0;
    for (int p = 0; p < 3; p++) {
        check_driven(paces[p], &outlived, &amended);
    }
    check_driven_on();
    g_assert_cmpint(outlived, >, 0);
    g_assert_cmpint(amended, >, 0);
}

/* As many pairs as a block has free slots may be added to it, and no more. */
static void test_amended_full(void)
{
    const struct gb_params params =
        scene_params("particles.count=6000", "numerics.precision=single", NULL);
    const struct gb_model model = scene_model(&params);
    struct gb_world *world = scene_world(&model);
    struct gb_amendment kept[200];
    struct gb_error err = {0};
    scene_evaluate(world);
    const struct gb_pair_list *near = &world->pairs.near;
    const int64_t end = gb_sweep_block_end(world->count, 0);
    const int64_t slots = near->start[end] - near->stop[0], before = near->pair_count;
    int64_t count = 0;
    for (int32_t i = 0; i < end && count <= slots; i += 3) { /* with somebody far off */
        for (int32_t j = i + 1; j < 6000; j++) {
            if (distance_of(world, i, j) > 3.0) {
                kept[count++] = (struct gb_amendment){i, j, 13, 1};
                break;
            }
        }
    }
    g_assert_cmpint(count, ==, slots + 1);
    g_assert_cmpint(count, <=, world->pairs.amended_most);
    g_assert_false(gb_list_patch_again(world, kept, count, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    g_assert_cmpint(near->pair_count, ==, before);
    check_slots(world, near);
    g_assert_true(gb_list_patch_again(world, kept, count - 1, &err));
    g_assert_cmpint(near->pair_count, ==, before + slots);
    g_assert_cmpint(near->stop[0], ==, near->start[end]);
    scene_evaluate(world);
    g_assert_cmpint(gb_world_tally(world)->contacts, >, 10000);
    gb_world_destroy(world);
}

/* An amendment without memory is an error, and the next evaluation makes up for it. */
static void test_amended_memory(void)
{
    const struct gb_params params =
        scene_params("particles.count=600", "numerics.precision=single", NULL);
    const struct gb_model model = scene_model(&params);
    struct gb_world *world = scene_world(&model);
    const struct gb_bodies b = gb_world_bodies(world);
    GRand *dice = g_rand_new_with_seed(17);
    int failed = 0;
    scene_press(world, 100, 3, 2.0);
    for (int step = 0; step < 200; step++) {
        for (int64_t i = 0; i < 3 * b.count; i++) {
            const double way = i / 3 % 199 == 0 ? 0.02 : 1e-4;
            b.position[i] += way * g_rand_double_range(dice, -0.5, 1.0);
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
        /* or one ran into another: go on */
        g_assert_true(err.code == GB_OK || err.code == GB_ERR_GUARD);
        check_listed(world);
    }
    g_assert_cmpint(failed, >, 0);
    g_rand_free(dice);
    gb_world_destroy(world);
}

/* Blocks hold every particle once, whatever their size. */
static void test_blocks(void)
{
    const int64_t counts[] = {1,      1024,   1025,   8000,    131071,
                              131072, 131073, 262144, 1000000, 10000000};
    for (size_t i = 0; i < G_N_ELEMENTS(counts); i++) {
        const int64_t count = counts[i], blocks = gb_sweep_blocks(count);
        int64_t end = 0;
        for (int64_t b = 0; b < blocks; b++) {
            g_assert_cmpint(gb_sweep_block_begin(count, b), ==, end);
            g_assert_cmpint(gb_sweep_block_end(count, b), >, end);
            end = gb_sweep_block_end(count, b);
        }
        g_assert_cmpint(end, ==, count);
        g_assert_true(count < 131072 || blocks >= GB_SWEEP_BLOCKS_SHARED);
    }
}

/* Half the force of pair k onto both its particles; returns how large it is. */
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

/* The forces of the pairs, asked for in any order, make up those on every particle. */
static void check_forces(const char *precision, const char *scene, const char *law)
{
    const struct gb_params params = scene_params(precision, scene, law, NULL);
    const struct gb_model model = scene_model(&params);
    struct gb_world *world = scene_world(&model);
    scene_press(world, 100, 10, 2.0);
    const struct gb_bodies b = gb_world_bodies(world);
    const struct gb_neighbour_list *pairs = gb_world_pairs(world);
    double *sum = g_new0(double, 3 * b.count), largest = 0.0;
    for (int l = 0; l < 2; l++) {
        const struct gb_pair_list *list = l == 0 ? &pairs->near : &pairs->far;
        struct gb_pair_forces forward, backward;
        gb_pair_forces_init(&forward, world, l == 0);
        gb_pair_forces_init(&backward, world, l == 0);
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

/* A drive at random velocities and the evaluation after it. */
static void drive_anywhere(struct gb_world *world, GRand *dice)
{
    const struct gb_integrate_f32 by = {
        .keep = 1.0, .step = 1.0, .inertia = 0.4, .most = 1.0};
    struct gb_error err = {0};
    for (int64_t k = 0; k < 3 * world->count; k++) {
        world->single.velocity[k] = (float)g_rand_double_range(dice, -5e-3, 5e-3);
        world->single.spin[k] = (float)g_rand_double_range(dice, -5e-3, 5e-3);
    }
    gb_integrate_f32_step(world, &by, NULL);
    if (!gb_world_evaluate_along(world, NULL, NULL, &err)) {
        g_assert_cmpint(err.code, ==, GB_ERR_GUARD);
    }
}

/* Whether and when positions follow the places changes no bit: in three worlds on the
 * same way they follow at the end only, after every evaluation, or somebody asks for them
 * who might move the particles; a fourth one is loaded from the first on the way. */
static void test_settled(void)
{
    const struct gb_params params =
        scene_params("particles.count=600", "numerics.precision=single", NULL);
    const struct gb_model model = scene_model(&params);
    struct gb_world *world[4];
    struct gb_world_copy *copy = NULL;
    struct gb_record record = {0};
    struct gb_error err = {0};
    GRand *dice[4];
    for (int w = 0; w < 4; w++) {
        dice[w] = g_rand_new_with_seed(23);
        world[w] = scene_world(&model);
    }
    scene_press(world[0], 120, 10, 2.0);
    g_assert_true(gb_world_copy_save(world[0], &copy, &err));
    for (int w = 0; w < 3; w++) {
        g_assert_true(gb_world_copy_restore(world[w], copy, &err));
        scene_evaluate(world[w]);
        gb_integrate_f32_reset(world[w]);
    }
    for (int step = 0; step < 60; step++) {
        const double factor[3] = {1.0, 0.9995, 0.9995};
        if (step == 30) {
            g_assert_true(gb_world_record(world[0], &record, &err));
            record.loading = true;
            g_assert_true(gb_world_record(world[3], &record, &err));
            g_rand_free(dice[3]);
            dice[3] = g_rand_copy(dice[0]);
        }
        for (int w = 0; w < (step < 30 ? 3 : 4); w++) {
            if (step % 10 == 5) {
                gb_world_strain(world[w], factor);
                g_assert_true(gb_world_evaluate_along(world[w], NULL, NULL, &err));
            }
            drive_anywhere(world[w], dice[w]);
        }
        gb_world_synchronise(world[1]);
        (void)gb_world_bodies(world[2]);
    }
    for (int w = 0; w < 4; w++) {
        gb_world_synchronise(world[w]);
        g_assert_cmpuint(gb_world_hash(world[w]), ==, gb_world_hash(world[0]));
    }
    g_assert_cmpint(gb_world_rebuilds(world[0]), >, 2);
    for (int w = 0; w < 4; w++) {
        g_rand_free(dice[w]);
        gb_world_destroy(world[w]);
    }
    gb_record_finish(&record);
    gb_world_copy_destroy(copy);
}

/* Whom somebody moves by hand between an evaluation and a drive goes on from there; to
 * half a unit of place. */
static void test_moved_by_hand(void)
{
    const struct gb_params params =
        scene_params("particles.count=300", "numerics.precision=single", NULL);
    const struct gb_model model = scene_model(&params);
    const struct gb_integrate_f32 by = {
        .keep = 1.0, .step = 1.0, .inertia = 0.4, .most = 1.0};
    struct gb_world *world = scene_world(&model);
    scene_evaluate(world);
    gb_integrate_f32_reset(world);
    gb_integrate_f32_step(world, &by, NULL);
    scene_evaluate(world);
    double *position = gb_world_bodies(world).position;
    double *before = g_memdup2(position, 3 * (size_t)model.count * sizeof *before);
    position[3 * 17 + 1] += 0.02;
    world->single.velocity[3 * 17 + 1] = 0.01F;
    world->single.velocity[3 * 18 + 2] = -0.01F;
    gb_integrate_f32_step(world, &by, NULL);
    gb_world_synchronise(world);
    for (int64_t k = 0; k < 3 * model.count; k++) {
        const double way = k == 3 * 17 + 1 ? 0.03 : k == 3 * 18 + 2 ? -0.01 : 0.0;
        g_assert_cmpfloat_with_epsilon(gb_world_position(world)[k] - before[k], way,
                                       1e-8);
    }
    g_free(before);
    gb_world_destroy(world);
}

/* Contacts of every particle, against what its distances say. */
static void test_degrees(gconstpointer data)
{
    const struct precision *precision = data;
    const struct gb_params params = scene_params(precision->setting, NULL);
    const struct gb_model model = scene_model(&params);
    struct gb_world *world = scene_world(&model);
    scene_press(world, 150, 10, 2.0);
    const int32_t *degree = gb_world_coordination(world);
    int64_t most = 0;
    for (int64_t i = 0; i < model.count; i++) {
        int touching = 0, hairs = 0;
        for (int64_t j = 0; j < model.count; j++) {
            const double gap = i == j ? 1.0 : distance_of(world, i, j) - 1.0;
            touching += gap < 0.0;
            hairs += fabs(gap) < 1e-6;
        }
        g_assert_cmpint(abs(degree[i] - touching), <=, hairs);
        most = degree[i] > most ? degree[i] : most;
    }
    g_assert_cmpint(most, >, 3);
    gb_world_destroy(world);
}

/* Some run ahead until the list is amended, by near pairs and by far ones, of each one at
 * least of particles in two blocks. */
static void stray_until_amended(struct gb_world *world)
{
    const struct gb_neighbour_list *pairs = gb_world_pairs(world);
    const struct gb_bodies b = gb_world_bodies(world);
    GRand *dice = g_rand_new_with_seed(11);
    int apart[2] = {0, 0};
    for (int step = 0; step < 400 && (apart[0] == 0 || apart[1] == 0); step++) {
        for (int64_t i = 0; i < 3 * b.count; i++) {
            const double way = i / 3 % 199 == 0 ? 0.02 : 1e-4;
            b.position[i] += way * g_rand_double_range(dice, -0.5, 1.0);
        }
        scene_evaluate(world);
        apart[0] = apart[1] = 0;
        check_slots(world, &pairs->near);
        check_slots(world, &pairs->far);
        for (int64_t k = 0; k < pairs->amended_count; k++) {
            const struct gb_amendment *pair = &pairs->amended[k];
            apart[pair->near] +=
                pair->first / GB_SWEEP_BLOCK != pair->other / GB_SWEEP_BLOCK;
        }
    }
    g_rand_free(dice);
    g_assert_cmpint(apart[0], >, 0);
    g_assert_cmpint(apart[1], >, 0);
}

static void assert_same_lists(const struct gb_pair_list *a, const struct gb_pair_list *b,
                              int64_t count)
{
    g_assert_cmpint(a->pair_count, ==, b->pair_count);
    for (int64_t i = 0; i <= count; i++) {
        g_assert_cmpint(a->start[i], ==, b->start[i]);
    }
    for (int64_t block = 0; block < gb_sweep_blocks(count); block++) {
        g_assert_cmpint(a->stop[block], ==, b->stop[block]);
    }
    for (int64_t k = 0; k < a->start[count]; k++) {
        g_assert_cmpint(a->first[k], ==, b->first[k]);
        g_assert_cmpint(a->other[k], ==, b->other[k]);
        g_assert_cmpint(a->image[k], ==, b->image[k]);
    }
}

/* Lists that were amended give the forces of lists built anew; a checkpoint has them, and
 * goes on with the same bits; one whose amendments make no sense is refused. */
static void test_amended(void)
{
    const struct gb_params params =
        scene_params("particles.count=6000", "numerics.precision=single", NULL);
    const struct gb_model model = scene_model(&params);
    struct gb_world *world = scene_world(&model), *fresh = NULL, *loaded = NULL;
    struct gb_world_copy *copy = NULL;
    struct gb_record record = {0};
    struct gb_error err = {0};
    scene_press(world, 150, 10, 2.0);
    stray_until_amended(world);
    const int64_t rebuilds = gb_world_rebuilds(world);
    g_assert_true(gb_world_copy_save(world, &copy, &err));
    g_assert_true(gb_world_create(&fresh, &model, gb_world_position(world), &err));
    g_assert_true(gb_world_copy_restore(fresh, copy, &err));
    g_assert_true(gb_world_record(world, &record, &err));
    record.loading = true;
    g_assert_true(gb_world_create(&loaded, &model, gb_world_position(world), &err));
    g_assert_true(gb_world_record(loaded, &record, &err));
    assert_same_lists(&gb_world_pairs(world)->near, &gb_world_pairs(loaded)->near,
                      model.count);
    assert_same_lists(&gb_world_pairs(world)->far, &gb_world_pairs(loaded)->far,
                      model.count);
    scene_evaluate(world);
    scene_evaluate(fresh);
    scene_evaluate(loaded);
    g_assert_cmpint(gb_world_rebuilds(world), ==, rebuilds);
    const struct gb_bodies w = gb_world_bodies(world), f = gb_world_bodies(fresh);
    const struct gb_bodies l = gb_world_bodies(loaded);
    for (int64_t i = 0; i < 3 * w.count; i++) {
        g_assert_cmpfloat_with_epsilon(w.force[i], f.force[i], 1e-7);
        g_assert_cmpfloat_with_epsilon(w.torque[i], f.torque[i], 1e-7);
        g_assert_true(w.force[i] == l.force[i] && w.torque[i] == l.torque[i]);
    }
    g_assert_cmpuint(gb_world_hash(world), ==, gb_world_hash(loaded));
    struct gb_amendment *kept = gb_record_find(&record, "world/amended")->data;
    kept[0].other = kept[0].first;
    g_assert_false(gb_world_record(loaded, &record, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    g_assert_nonnull(strstr(err.text, "world/amended"));
    gb_record_finish(&record);
    gb_world_copy_destroy(copy);
    gb_world_destroy(world);
    gb_world_destroy(fresh);
    gb_world_destroy(loaded);
}

/* Two alone in the void fly at each other from afar, while the cell is strained: the list
 * they are not in lasts until they come within the cutoff. */
static void test_meeting(void)
{
    const struct gb_params params = scene_params("particles.count=90", NULL);
    struct gb_model model = scene_model(&params);
    GRand *dice = g_rand_new_with_seed(7);
    int outlived = 0, met = 0;
    for (int trial = 0; trial < 800; trial++) {
        double x[90][3], unit[3];
        struct gb_error err = {0};
        struct gb_world *world = NULL;
        const bool narrow = trial >= 400; /* nearest images change under way */
        for (int k = 0; k < 3; k++) {
            model.edges[k] =
                g_rand_double_range(dice, narrow ? 2.9 : 6.0, narrow ? 3.5 : 12.0);
            /* often along an edge, where the grid cells end soonest */
            unit[k] = pow(g_rand_double_range(dice, -1.0, 1.0), 9.0);
            x[0][k] = g_rand_double_range(dice, 0.0, model.edges[k]);
        }
        const double length = gb_vec_length(unit);
        const double far = g_rand_double_range(dice, 1.4, 3.6);
        for (int k = 0; k < 3; k++) {
            unit[k] /= length;
            x[1][k] = x[0][k] + far * unit[k];
            for (int i = 2; i < 90; i++) { /* one on another, so out of the way */
                x[i][k] = x[0][k] + 0.5 * model.edges[k];
            }
        }
        for (int i = 0; i < 90; i++) {
            gb_cell_wrap(
                &(struct gb_cell){{model.edges[0], model.edges[1], model.edges[2]},
                                  {true, true, true}},
                x[i]);
        }
        g_assert_true(gb_world_create(&world, &model, x[0], &err));
        const double pace = trial % 2 ? 0.03 : g_rand_double_range(dice, 0.0, 0.06);
        const struct gb_bodies b = gb_world_bodies(world);
        for (int step = 0; step < 100; step++) {
            const int64_t before = gb_world_rebuilds(world);
            (void)gb_world_evaluate(world, &err); /* the others overlap */
            const struct gb_neighbour_list *pairs = gb_world_pairs(world);
            const double distance = distance_of(world, 0, 1);
            const bool near = listed(world, &pairs->near, 0, 1, distance);
            g_assert_true(near || distance >= 1.0);
            g_assert_true(near || distance >= model.numerics.cutoff ||
                          listed(world, &pairs->far, 0, 1, distance));
            if (distance < 1.0) {
                met += !narrow;
                break;
            }
            outlived += gb_world_rebuilds(world) == before && step * 0.03 > 0.1;
            for (int k = 0; k < 3; k++) {
                b.position[k] += pace * unit[k];
                b.position[3 + k] -= (0.06 - pace) * unit[k];
            }
            scene_squeeze(world, trial % 3 == 0 ? 0.001 : trial % 3 == 1 ? -0.002 : 0.0);
        }
        gb_world_destroy(world);
    }
    g_rand_free(dice);
    g_assert_cmpint(met, ==, 400);
    g_assert_cmpint(outlived, >, 400);
}

/* The skin decides when lists are rebuilt, never what comes out: histories are carried
 * over. */
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
    g_assert_cmpint(gb_sweep_blocks(9000), >, 4);
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

/* Going back to a copy and repeating gives the same bits as the first time. */
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

/* Single precision where there is no sweep for it is refused, whoever asks; auto is
 * double there, and where a tolerance is too tight. */
static void test_precision(void)
{
    const char *const without[] = {"scene.kind=dynamic", "scene.kind=die",
                                   "scene.dimension=2",
                                   "particles.distribution=lognormal"};
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

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/world/pairs", test_pairs);
    g_test_add_func("/world/strays", test_strays);
    g_test_add_func("/world/strays-driven", test_strays_driven);
    g_test_add_func("/world/settled", test_settled);
    g_test_add_func("/world/moved-by-hand", test_moved_by_hand);
    g_test_add_func("/world/amended", test_amended);
    g_test_add_func("/world/amended-full", test_amended_full);
    g_test_add_func("/world/amended-memory", test_amended_memory);
    g_test_add_func("/world/blocks", test_blocks);
    g_test_add_data_func("/world/degrees", &precisions[0], test_degrees);
    g_test_add_data_func("/world/degrees-single", &precisions[1], test_degrees);
    g_test_add_data_func("/world/forces", &precisions[0], test_forces);
    g_test_add_data_func("/world/forces-single", &precisions[1], test_forces);
    g_test_add_func("/world/meeting", test_meeting);
    g_test_add_data_func("/world/momentum", &precisions[0], test_momentum);
    g_test_add_data_func("/world/momentum-single", &precisions[1], test_momentum);
    g_test_add_data_func("/world/gradient", &precisions[0], test_gradient);
    g_test_add_data_func("/world/gradient-single", &precisions[1], test_gradient);
    g_test_add_data_func("/world/dry", &precisions[0], test_dry);
    g_test_add_data_func("/world/dry-single", &precisions[1], test_dry);
    g_test_add_data_func("/world/skin", &precisions[0], test_skin);
    g_test_add_data_func("/world/skin-single", &precisions[1], test_skin);
    g_test_add_data_func("/world/threads", &precisions[0], test_threads);
    g_test_add_data_func("/world/threads-single", &precisions[1], test_threads);
    g_test_add_data_func("/world/copy", &precisions[0], test_copy);
    g_test_add_data_func("/world/copy-single", &precisions[1], test_copy);
    g_test_add_func("/world/not-finite", test_not_finite);
    g_test_add_func("/world/small-cell", test_small_cell);
    g_test_add_data_func("/world/memory", &precisions[0], test_memory);
    g_test_add_data_func("/world/memory-single", &precisions[1], test_memory);
    g_test_add_func("/world/precision", test_precision);
    g_test_add_data_func("/world/lattice", &precisions[0], test_lattice);
    g_test_add_data_func("/world/lattice-single", &precisions[1], test_lattice);
    return g_test_run();
}
