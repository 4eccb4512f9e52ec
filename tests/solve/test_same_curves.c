/* Random packings seen otherwise are pressed to the same curve: rotated, mirrored, in another
 * order of particles, in a doubled cell.  Strain by strain, each relaxed to equilibrium. */
#include <glib.h>
#include <math.h>

#include "common/transform.h"
#include "pack/cell/world.h"
#include "solve/relax/relax.h"

enum { STRAINS = 4 };

/* Difference of the pressures over the largest: equilibria are found to the tolerance of the
 * relaxation, by a way that rounding changes.  400 cases differ by 1e-6 at most. */
static const double tolerance = 2e-5;

/* A crystal, whose particles are shaken, or a loose grown packing with adhesion. */
static struct gb_model random_model(GRand *random)
{
    static const char *const laws[] = {
        "contact.bridge_length=0.008 d",
        "contact.bridge_length=1 d",
        "contact.normal=hertz",
    };
    static const char *const relaxers[] = {"numerics.relaxer=fire",
                                           "numerics.relaxer=predict"};
    static const struct {
        const char *dimension, *structure, *count;
    } shapes[] = {
        {"scene.dimension=3", "structure.kind=grown", "particles.count=120"},
        {"scene.dimension=3", "structure.kind=fcc", "particles.count=108"},
        {"scene.dimension=2", "structure.kind=hexagonal", "particles.count=72"},
    };
    char mu[48], seed[48];
    const int shape = cases_choice(random, G_N_ELEMENTS(shapes));
    const int law = cases_choice(random, shape == 0 ? 2 : 3);
    g_snprintf(mu, sizeof mu, "contact.mu=%.3f", cases_between(random, 0.0, 0.5));
    g_snprintf(seed, sizeof seed, "structure.seed=%d", cases_choice(random, 1000000));
    const struct gb_params params = scene_params(
        shapes[shape].dimension, shapes[shape].structure, shapes[shape].count, mu, seed,
        laws[law], relaxers[cases_choice(random, G_N_ELEMENTS(relaxers))],
        "numerics.precision=double", "numerics.tolerance=1e-8", "numerics.cutoff=1.1 d",
        NULL);
    return scene_model(&params);
}

static void relax(struct packed *packed, struct gb_relax *relax)
{
    struct gb_error err = {0};
    gb_relax_start(relax, packed->world);
    const enum gb_relax_outcome outcome =
        gb_relax_advance(relax, packed->world, INT64_MAX, &err);
    g_test_message("%" G_GINT64_FORMAT " evaluations, residual %.2g, outcome %d %s",
                   relax->evaluations, relax->residual, (int)outcome, err.text);
    g_assert_cmpint(outcome, !=, GB_RELAX_FAILED);
}

/* A packing near equilibrium without history: the long way from the initial structure into
 * it would part by rounding. */
static void settle(struct packed *packed, const struct gb_model *model, GRand *random)
{
    struct gb_relax *method = NULL;
    struct gb_error err = {0};
    packed_init(packed, model, 0.98, model->structure == GB_STRUCTURE_GROWN ? 1e-3 : 5e-3,
                random);
    g_assert_true(gb_relax_create(&method, &packed->model, &err));
    relax(packed, method);
    gb_relax_destroy(method);
    memcpy(packed->position, gb_world_position(packed->world),
           3 * sizeof(double) * (size_t)model->count);
    for (int64_t i = 0; i < model->count; i++) {
        gb_cell_wrap(gb_world_cell(packed->world), packed->position + 3 * i);
    }
    gb_world_destroy(packed->world);
    packed_create(packed);
}

/* Pressure tensors of the relaxed states, each after a strain along old axis z. */
static void press(struct packed *packed, const struct transform *t,
                  double (*pressure)[3][3])
{
    struct gb_relax *method = NULL;
    struct gb_error err = {0};
    double factor[3];
    if (!gb_relax_create(&method, &packed->model, &err)) {
        g_error("%s", err.text);
    }
    for (int k = 0; k < 3; k++) {
        factor[k] = t->axis[k] == 2 ? 1.0 - 1e-3 : 1.0;
    }
    for (int s = 0; s < STRAINS; s++) {
        if (s > 0) {
            gb_world_strain(packed->world, factor);
        }
        relax(packed, method);
        gb_world_pressure(packed->world, pressure[s]);
    }
    gb_relax_destroy(method);
}

static void check_curves(GRand *random, const struct gb_model *model,
                         const struct transform *t)
{
    struct packed old, new;
    settle(&old, model, random);
    double first[STRAINS][3][3], second[STRAINS][3][3], want[3][3];
    packed_transform(&new, &old, t);
    press(&old, &transform_none, first);
    press(&new, t, second);
    for (int s = 0; s < STRAINS; s++) {
        double size = 0.0;
        transform_tensor(t, first[s], want);
        for (int k = 0; k < 9; k++) {
            size = fmax(size, fabs((&want[0][0])[k]));
        }
        g_assert_cmpfloat(size, >, 1e-7); /* pressed, not loose */
        for (int k = 0; k < 9; k++) {
            g_assert_cmpfloat(fabs((&second[s][0][0])[k] - (&want[0][0])[k]), <=,
                              tolerance * size);
        }
    }
    packed_finish(&old);
    packed_finish(&new);
}

static void check_rotated(GRand *random)
{
    const struct gb_model model = random_model(random);
    struct transform t = transform_none;
    transform_rotate(&t, model.dimension, random);
    check_curves(random, &model, &t);
}

static void check_mirrored(GRand *random)
{
    const struct gb_model model = random_model(random);
    struct transform t = transform_none;
    t.sign[2 * cases_choice(random, 2)] = -1.0;
    check_curves(random, &model, &t);
}

static void check_ordered(GRand *random)
{
    const struct gb_model model = random_model(random);
    struct transform t = transform_none;
    t.order = transform_random_order(model.count, random);
    check_curves(random, &model, &t);
    g_free(t.order);
}

static void check_doubled(GRand *random)
{
    const struct gb_model model = random_model(random);
    struct transform t = transform_none;
    t.repeat[2 * cases_choice(random, 2)] = 2;
    check_curves(random, &model, &t);
}

static void test_rotated(void)
{
    cases_run(8, 100, check_rotated);
}

static void test_mirrored(void)
{
    cases_run(8, 100, check_mirrored);
}

static void test_ordered(void)
{
    cases_run(8, 100, check_ordered);
}

static void test_doubled(void)
{
    cases_run(8, 100, check_doubled);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/curves/rotated", test_rotated);
    g_test_add_func("/curves/mirrored", test_mirrored);
    g_test_add_func("/curves/ordered", test_ordered);
    g_test_add_func("/curves/doubled", test_doubled);
    return g_test_run();
}
