/* Random packings seen otherwise, with histories: rotated, mirrored, in another order of
 * particles, their cell repeated, discs as spheres in a plane.  Forces, torques, virial and
 * contacts are the same ones. */
#include <glib.h>
#include <math.h>

#include "base/vec.h"
#include "common/transform.h"
#include "measure/observe.h"
#include "pack/cell/world.h"

enum { MOVES = 6 };

/* Rounding of a law that is summed in another order, over the largest force; in single
 * precision also that of positions. */
static const double rounding_double = 1e-10, rounding_single = 1e-4;

static const char *const laws[] = {
    "contact.bridge_length=0.008 d", "contact.bridge_radius=current",
    "contact.bridge_length=1 d",     "contact.normal=hertz",
    "material.epsilon=0 kB",
};

/* Parameters of a case: a law, its friction, a precision, one size or many. */
static struct gb_model random_model(GRand *random, const char *dimension)
{
    char mu[48], pivot[48], seed[48], count[48];
    const bool plane = g_str_has_suffix(dimension, "2");
    const char *law = laws[cases_choice(random, G_N_ELEMENTS(laws))];
    const bool sizes = cases_choice(random, 2) == 1 && !g_str_has_suffix(law, "hertz");
    const bool single = !plane && cases_choice(random, 3) == 0;
    g_snprintf(mu, sizeof mu, "contact.mu=%.3f", cases_between(random, 0.0, 0.6));
    g_snprintf(pivot, sizeof pivot, "contact.mu_pivot=%.3f",
               cases_between(random, 0.0, 0.3));
    g_snprintf(seed, sizeof seed, "structure.seed=%d", cases_choice(random, 1000000));
    g_snprintf(count, sizeof count, "particles.count=%d",
               plane ? 60 + cases_choice(random, 60) : 200 + cases_choice(random, 200));
    const struct gb_params params = scene_params(
        dimension, law, mu, pivot, seed, count,
        single ? "numerics.precision=single" : "numerics.precision=double",
        sizes ? "particles.distribution=lognormal" : "particles.distribution=mono",
        "particles.median=9.7 nm", "particles.sigma=0.2", "particles.largest=16 nm",
        "numerics.cutoff=1.1 d", NULL);
    return scene_model(&params);
}

/* Displacements and rotations of one move: those of the old packing. */
struct moves {
    double *shift, *rotation; /* count x 3 */
};

static void moves_draw(struct moves *moves, const struct gb_model *model, GRand *random)
{
    const bool plane = model->dimension == 2;
    const double far = 2e-3;
    for (int64_t i = 0; i < 3 * model->count; i++) {
        const bool out = plane && i % 3 == 1, in = plane && !out;
        moves->shift[i] = out ? 0.0 : cases_between(random, -far, far);
        moves->rotation[i] = in ? 0.0 : cases_between(random, -far, far);
    }
}

static void moves_apply(const struct moves *moves, const struct transform *t,
                        int64_t count, struct packed *packed)
{
    const struct gb_bodies b = gb_world_bodies(packed->world);
    for (int c = 0; c < transform_copies(t); c++) {
        for (int64_t i = 0; i < count; i++) {
            const int64_t to = transform_particle(t, count, i, c);
            double shift[3], rotation[3];
            transform_vector(t, false, moves->shift + 3 * i, shift);
            transform_vector(t, true, moves->rotation + 3 * i, rotation);
            gb_vec_add(b.position + 3 * to, 1.0, shift);
            gb_vec_add(b.rotation + 3 * to, 1.0, rotation);
        }
    }
    scene_evaluate(packed->world);
}

static double largest_of(const double *v, int64_t count)
{
    double most = 0.0;
    for (int64_t i = 0; i < 3 * count; i++) {
        most = fmax(most, fabs(v[i]));
    }
    return most;
}

static void check_vector(const double old[3], const double new[3],
                         const struct transform *t, bool axial, double bound)
{
    double want[3];
    transform_vector(t, axial, old, want);
    for (int k = 0; k < 3; k++) {
        g_assert_cmpfloat(fabs(new[k] - want[k]), <=, bound);
    }
}

/* Virial sum, its kernel and the counts of contacts; `copies` times those of the old one. */
static void check_sums(struct packed *old, struct packed *new, const struct transform *t,
                       double rounding)
{
    const struct gb_tally *a = gb_world_tally(old->world),
                          *b = gb_world_tally(new->world);
    const double copies = transform_copies(t), scale = a->normal_sum;
    double sum[3][3], want[3][3], got[3][3];
    struct gb_contact_counts first, second;
    g_assert_cmpint(a->contacts, >, old->model.count);
    g_assert_cmpint(b->contacts, ==, (int64_t)copies * a->contacts);
    g_assert_cmpint(b->sliding, ==, (int64_t)copies * a->sliding);
    g_assert_cmpfloat(fabs(b->normal_sum - copies * scale), <=,
                      rounding * copies * scale);
    gb_world_virial(old->world, sum);
    gb_world_virial(new->world, got);
    transform_tensor(t, sum, want);
    for (int k = 0; k < 9; k++) {
        g_assert_cmpfloat(fabs((&got[0][0])[k] - copies * (&want[0][0])[k]), <=,
                          rounding * copies * scale);
    }
    gb_observe_contacts(old->world, &first, NULL, 0, NULL);
    gb_observe_contacts(new->world, &second, NULL, 0, NULL);
    g_assert_cmpint(second.bridged, ==, (int64_t)copies * first.bridged);
    g_assert_cmpint(second.rattlers, ==, (int64_t)copies * first.rattlers);
    const double energy = gb_observe_elastic(old->world);
    g_assert_cmpfloat(fabs(gb_observe_elastic(new->world) - copies * energy), <=,
                      rounding * copies * (fabs(energy) + scale));
}

static void check_same(struct packed *old, struct packed *new, const struct transform *t)
{
    const struct gb_bodies a = gb_world_bodies(old->world),
                           b = gb_world_bodies(new->world);
    const double rounding =
        old->model.numerics.single ? rounding_single : rounding_double;
    const double force = largest_of(a.force, a.count),
                 torque = fmax(largest_of(a.torque, a.count), force);
    for (int c = 0; c < transform_copies(t); c++) {
        for (int64_t i = 0; i < a.count; i++) {
            const int64_t to = 3 * transform_particle(t, a.count, i, c);
            check_vector(a.force + 3 * i, b.force + to, t, false, rounding * force);
            check_vector(a.torque + 3 * i, b.torque + to, t, true, rounding * torque);
        }
    }
    check_sums(old, new, t, rounding);
}

/* Both packings through the same moves. */
static void check_moves(GRand *random, const struct gb_model *model,
                        const struct transform *t)
{
    struct packed old, new;
    packed_init(&old, model, 0.99, 1e-3, random);
    packed_transform(&new, &old, t);
    scene_evaluate(old.world);
    scene_evaluate(new.world);
    check_same(&old, &new, t);
    struct moves moves = {g_new0(double, (gsize)(3 * model->count)),
                          g_new0(double, (gsize)(3 * model->count))};
    for (int k = 0; k < MOVES; k++) {
        moves_draw(&moves, model, random);
        moves_apply(&moves, &transform_none, model->count, &old);
        moves_apply(&moves, t, model->count, &new);
        check_same(&old, &new, t);
    }
    g_free(moves.shift);
    g_free(moves.rotation);
    packed_finish(&old);
    packed_finish(&new);
}

static const char *random_dimension(GRand *random)
{
    return cases_choice(random, 3) == 0 ? "scene.dimension=2" : "scene.dimension=3";
}

/* A quarter rotation about an axis of the cell; discs about theirs. */
static void check_rotated(GRand *random)
{
    const struct gb_model model = random_model(random, random_dimension(random));
    struct transform t = transform_none;
    transform_rotate(&t, model.dimension, random);
    g_assert_cmpfloat(transform_parity(&t), ==, 1.0);
    check_moves(random, &model, &t);
}

static void check_mirrored(GRand *random)
{
    const struct gb_model model = random_model(random, random_dimension(random));
    struct transform t = transform_none;
    t.sign[model.dimension == 2 ? 2 * cases_choice(random, 2) : cases_choice(random, 3)] =
        -1.0;
    g_assert_cmpfloat(transform_parity(&t), ==, -1.0);
    check_moves(random, &model, &t);
}

static void check_ordered(GRand *random)
{
    const struct gb_model model = random_model(random, random_dimension(random));
    struct transform t = transform_none;
    t.order = transform_random_order(model.count, random);
    check_moves(random, &model, &t);
    g_free(t.order);
}

/* The same pressure per volume, whichever way the cell is doubled. */
static void check_doubled(GRand *random)
{
    const struct gb_model model = random_model(random, random_dimension(random));
    struct transform t = transform_none;
    t.repeat[model.dimension == 2 ? 2 * cases_choice(random, 2)
                                  : cases_choice(random, 3)] = 2;
    check_moves(random, &model, &t);
}

/* Discs and the spheres of their radius in a plane of a wide cell: where springs lie in the
 * plane and rotations about its normal, the laws are the same. */
static void check_plane(GRand *random)
{
    const struct gb_model model = random_model(random, "scene.dimension=2");
    struct packed old, new;
    packed_init(&old, &model, 0.99, 1e-3, random);
    new.model = old.model;
    new.model.dimension = new.model.record_dimension = 3;
    new.model.edges[1] = 6.0;
    new.diameter = g_memdup2(old.diameter, sizeof(double) * (gsize)model.count);
    new.position = g_memdup2(old.position, sizeof(double) * (gsize)(3 * model.count));
    for (int64_t i = 0; i < model.count; i++) {
        new.position[3 * i + 1] = 3.0;
    }
    packed_create(&new);
    scene_evaluate(old.world);
    scene_evaluate(new.world);
    check_same(&old, &new, &transform_none);
    struct moves moves = {g_new0(double, (gsize)(3 * model.count)),
                          g_new0(double, (gsize)(3 * model.count))};
    for (int k = 0; k < MOVES; k++) {
        moves_draw(&moves, &model, random);
        moves_apply(&moves, &transform_none, model.count, &old);
        moves_apply(&moves, &transform_none, model.count, &new);
        check_same(&old, &new, &transform_none);
    }
    g_free(moves.shift);
    g_free(moves.rotation);
    packed_finish(&old);
    packed_finish(&new);
}

static void test_rotated(void)
{
    cases_run(24, 1000, check_rotated);
}

static void test_mirrored(void)
{
    cases_run(24, 1000, check_mirrored);
}

static void test_ordered(void)
{
    cases_run(24, 1000, check_ordered);
}

static void test_doubled(void)
{
    cases_run(24, 1000, check_doubled);
}

static void test_plane(void)
{
    cases_run(24, 1000, check_plane);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/symmetries/rotated", test_rotated);
    g_test_add_func("/symmetries/mirrored", test_mirrored);
    g_test_add_func("/symmetries/ordered", test_ordered);
    g_test_add_func("/symmetries/doubled", test_doubled);
    g_test_add_func("/symmetries/plane", test_plane);
    return g_test_run();
}
