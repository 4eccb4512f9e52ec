#include <glib.h>
#include <math.h>

#include "base/vec.h"
#include "common/scene.h"
#include "measure/observe.h"
#include "pack/cell/world_private.h"
#include "scene/tolerances.h"
#include "solve/loading/strain_step.h"
#include "solve/relax/relax.h"
#include "solve/relax/relax_fire.h"

/* Every relaxer brings every small problem to the same stopping rule, in both precisions. */
static void test_all(void)
{
    static const char *const problem[][3] = {
        {"particles.diameter=9.7 nm", "contact.mu=0.1", "contact.bridge_length=0.008 d"},
        {"particles.diameter=38 nm", "contact.mu=0.1", "contact.bridge_length=0.008 d"},
        {"particles.diameter=10.4 nm", "contact.mu=0.13", "contact.bridge_length=1 d"},
        {"particles.diameter=10.4 nm", "contact.mu=0", "contact.bridge_length=1 d"},
        {"scene.dimension=2", "contact.mu=0.5", "contact.bridge_length=0.008 d"},
    };
    static const char *const precision[] = {"numerics.precision=auto",
                                            "numerics.precision=double"};
    for (int m = 0; gb_relax_table()[m]; m++) {
        for (size_t p = 0; p < 2 * G_N_ELEMENTS(problem); p++) {
            const char *const *set = problem[p / 2];
            char relaxer[64];
            g_snprintf(relaxer, sizeof relaxer, "numerics.relaxer=%s",
                       gb_relax_table()[m]->name);
            const struct gb_params params =
                scene_params(relaxer, set[0], set[1], set[2], precision[p % 2],
                             "numerics.tolerance=5e-3", NULL);
            const struct gb_model model = scene_model(&params);
            struct gb_world *world = scene_world(&model);
            struct gb_relax *relax = NULL;
            struct gb_error err = {0};
            g_assert_true(gb_relax_create(&relax, &model, &err));
            for (int step = 0; step < 5; step++) {
                gb_relax_start(relax, world);
                g_assert_cmpint(gb_relax_advance(relax, world, 500000, &err), ==,
                                GB_RELAX_DONE);
                g_assert_cmpfloat(gb_world_residual(world), <=, 5e-3);
                const double factor[3] = {1.0, 1.0, 0.998};
                gb_world_strain(world, factor);
            }
            gb_relax_destroy(relax);
            gb_world_destroy(world);
        }
    }
}

/* A packing out of equilibrium, and a relaxation of it that is about to begin. */
static struct gb_world *squeezed(const struct gb_model *model, struct gb_relax **relax)
{
    static const double factor[3] = {1.0, 1.0, 0.99};
    struct gb_error err = {0};
    struct gb_world *world = scene_world(model);
    g_assert_true(gb_relax_create(relax, model, &err));
    gb_world_strain(world, factor);
    gb_relax_start(*relax, world);
    return world;
}

/* Evaluations of fifty equal strain steps and ten back, and the contacts per particle
 * they end with. */
static int64_t pressed(const char *relaxer, const char *sizes, double factor_z,
                       double *contacts)
{
    char assignment[64];
    g_snprintf(assignment, sizeof assignment, "numerics.relaxer=%s", relaxer);
    const struct gb_params params =
        scene_params(assignment, sizes, "particles.sigma=0.4", "particles.count=400",
                     "numerics.tolerance=1e-2", NULL);
    const struct gb_model model = scene_model(&params);
    struct gb_world *world = scene_world(&model);
    struct gb_relax *relax = NULL;
    struct gb_error err = {0};
    int64_t spent = 0;
    g_assert_true(gb_relax_create(&relax, &model, &err));
    struct gb_relaxer even = *relax->method; /* the same rule for all under light loads */
    even.light = 1.0;
    relax->method = &even;
    for (int step = 0; step < 60; step++) {
        const double along = step < 50 ? factor_z : 1.0 / factor_z;
        const double factor[3] = {1.0, 1.0, along};
        gb_world_strain(world, factor);
        gb_relax_start(relax, world);
        g_assert_cmpint(gb_relax_advance(relax, world, 100000, &err), ==, GB_RELAX_DONE);
        spent += relax->evaluations;
    }
    *contacts = (double)gb_world_tally(world)->contacts / (double)model.count;
    gb_relax_destroy(relax);
    gb_world_destroy(world);
    return spent;
}

/* The prediction from the last step: fewer evaluations, the same packing. */
static void test_predict(void)
{
    double plain = 0.0, predicted = 0.0;
    const int64_t many = pressed("fire", "particles.distribution=mono", 0.998, &plain);
    const int64_t few =
        pressed("predict", "particles.distribution=mono", 0.998, &predicted);
    g_test_message("fire %" G_GINT64_FORMAT ", predict %" G_GINT64_FORMAT " evaluations",
                   many, few);
    g_assert_cmpint(4 * few, <, 3 * many);
    g_assert_cmpfloat_with_epsilon(predicted, plain, 0.05);
}

/* Particles of many sizes, whose mass is their diameter, take few evaluations more than
 * those of one. */
static void test_sizes(void)
{
    double contacts = 0.0;
    const int64_t one =
        pressed("predict", "particles.distribution=mono", 0.998, &contacts);
    const int64_t many =
        pressed("predict", "particles.distribution=lognormal", 0.998, &contacts);
    g_test_message("one size %" G_GINT64_FORMAT ", many %" G_GINT64_FORMAT " evaluations",
                   one, many);
    g_assert_cmpint(4 * many, <, 5 * one);
}

/* Under light loads predict answers to a share of its tolerance, later to all of it. */
static void test_light(void)
{
    const struct gb_params params =
        scene_params("numerics.relaxer=predict", "numerics.tolerance=2e-2", NULL);
    const struct gb_model model = scene_model(&params);
    struct gb_world *world = scene_world(&model);
    struct gb_relax *relax = NULL;
    struct gb_error err = {0};
    double first = 0.0, last = 0.0;
    g_assert_true(gb_relax_create(&relax, &model, &err));
    for (int step = 0; step < 140; step++) {
        static const double factor[3] = {0.998, 0.998, 0.998};
        gb_relax_start(relax, world);
        g_assert_cmpint(gb_relax_advance(relax, world, 100000, &err), ==, GB_RELAX_DONE);
        last = relax->residual;
        first = step == 0 ? last : first;
        gb_world_strain(world, factor);
    }
    g_assert_cmpfloat(first, <=, GB_PREDICT_TOLERANCE_FRACTION_MIN * 2e-2);
    g_assert_cmpfloat(last, >, GB_PREDICT_TOLERANCE_FRACTION_MIN * 2e-2);
    g_assert_cmpfloat(last, <=, 2e-2);
    gb_relax_destroy(relax);
    gb_world_destroy(world);
}

/* The predicted displacement of a particle is bounded by the strain. */
static void test_predicted(void)
{
    static const double factor[3] = {0.999, 1.0, 0.999};
    const struct gb_params params = scene_params("numerics.relaxer=predict", NULL);
    const struct gb_model model = scene_model(&params);
    struct gb_world *world = scene_world(&model);
    struct gb_relax *relax = NULL;
    struct gb_error err = {0};
    const size_t bytes = 3 * (size_t)model.count * sizeof(double);
    double *before = g_malloc(bytes), farthest = 0.0;
    g_assert_true(gb_relax_create(&relax, &model, &err));
    for (int step = 0; step < 20; step++) {
        gb_relax_start(relax, world);
        g_assert_cmpint(gb_relax_advance(relax, world, 100000, &err), ==, GB_RELAX_DONE);
        gb_world_strain(world, factor);
        memcpy(before, gb_world_position(world), bytes);
    }
    gb_relax_start(relax, world);
    for (int64_t i = 0; i < model.count; i++) {
        gb_vec_add(before + 3 * i, -1.0, gb_world_position(world) + 3 * i);
        farthest = fmax(farthest, gb_vec_length(before + 3 * i));
    }
    const double most = GB_PREDICT_RATIO_MAX * sqrt(2.0) * -log(0.999);
    g_assert_cmpfloat_with_epsilon(farthest, most, 1e-9); /* the limit is reached */
    g_free(before);
    gb_relax_destroy(relax);
    gb_world_destroy(world);
}

/* Rotation increment of particle i for the next evaluation. */
static double rotation_of(const struct gb_world *world, int64_t i, int c)
{
    return gb_engine_is_f32(&world->engine)
               ? (double)world->engine.f32.particle[i].rotation[c]
               : world->engine.particles.rotation[3 * i + c];
}

/* A particle that would move farther than 0.01 d in a step is slowed, its rotation
 * likewise; all others move as they would without the limit. */
static void check_slowed(const char *precision)
{
    const struct gb_params params =
        scene_params("numerics.relaxer=fire", "contact.mu=0.3", precision, NULL);
    const struct gb_model model = scene_model(&params);
    struct gb_world *world = scene_world(&model);
    struct gb_relax *relax = NULL;
    struct gb_error err = {0};
    g_assert_true(gb_relax_create(&relax, &model, &err));
    gb_relax_start(relax, world);
    scene_evaluate(world);
    scene_squeeze(world, 0.14); /* some are pushed hard, most are not */
    scene_evaluate(world);
    relax->evaluations = 1;
    const struct gb_bodies b = gb_world_bodies(world);
    const double step = gb_relax_fire_plain.step_first, most = 0.01;
    double *before = g_memdup2(b.position, 3 * (size_t)b.count * sizeof *before);
    int slowed = 0;
    relax->method->move(relax, world);
    gb_world_synchronise(world);
    for (int64_t i = 0; i < b.count; i++) {
        const double displacement = step * step * gb_vec_length(b.force + 3 * i);
        const double factor =
            step * step * (displacement > most ? most / displacement : 1.0);
        slowed += displacement > most;
        for (int c = 0; c < 3; c++) {
            g_assert_cmpfloat_with_epsilon(b.position[3 * i + c] - before[3 * i + c],
                                           factor * b.force[3 * i + c], 1e-8);
            g_assert_cmpfloat_with_epsilon(
                rotation_of(world, i, c), factor / GB_RELAX_INERTIA * b.torque[3 * i + c],
                1e-8);
        }
    }
    g_test_message("%s: %d of %" G_GINT64_FORMAT " slowed", precision, slowed, b.count);
    g_assert_cmpint(slowed, >, 0);
    g_assert_cmpint(slowed, <, b.count / 2);
    g_free(before);
    gb_relax_destroy(relax);
    gb_world_destroy(world);
}

static void test_slowed(void)
{
    check_slowed("numerics.precision=double");
    check_slowed("numerics.precision=single");
}

/* What a scene gets where its preset leaves it open. */
static void test_picked(void)
{
    static const struct {
        const char *sets[2], *relaxer;
        int parts;
        double tolerance;
    } row[] = {
        {{"numerics.fidelity=fast", "loading.geometry=uniaxial"}, "predict", 1, 0.05},
        {{"numerics.fidelity=balanced", "loading.geometry=uniaxial"}, "predict", 2, 0.03},
        {{"loading.geometry=isotropic", "contact.bridge_length=1 d"}, "predict", 4, 0.02},
        {{"loading.geometry=biaxial", "numerics.strain_part=0.1 %"}, "predict", 1, 0.03},
        {{"numerics.fidelity=balanced", "numerics.relaxer=fire"}, "fire", 1, 0.01},
        {{"numerics.fidelity=reference", "numerics.relaxer=auto"}, "fire", 5, 0.002},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(row); i++) {
        const struct gb_params params =
            scene_params("loading.step=0.1 %", row[i].sets[0], row[i].sets[1], NULL);
        const struct gb_model model = scene_model(&params);
        g_test_message("row %zu", i);
        g_assert_cmpstr(model.numerics.relaxer, ==, row[i].relaxer);
        g_assert_cmpint(model.numerics.parts, ==, row[i].parts);
        g_assert_cmpfloat_with_epsilon(model.numerics.tolerance, row[i].tolerance, 1e-12);
    }
}

/* A slice never runs over, and slices of any length give the same bits. */
static void test_slices(void)
{
    const struct gb_params params = scene_params("numerics.tolerance=1e-3", NULL);
    const struct gb_model model = scene_model(&params);
    uint64_t hash[2];
    for (int s = 0; s < 2; s++) {
        struct gb_relax *relax = NULL;
        struct gb_error err = {0};
        struct gb_world *world = squeezed(&model, &relax);
        int64_t last = 0;
        while (gb_relax_advance(relax, world, s == 0 ? 1 : 7, &err) == GB_RELAX_MORE) {
            g_assert_cmpint(relax->evaluations - last, ==, s == 0 ? 1 : 7);
            last = relax->evaluations;
        }
        hash[s] = gb_world_hash(world);
        gb_relax_destroy(relax);
        gb_world_destroy(world);
    }
    g_assert_cmpuint(hash[0], ==, hash[1]);
}

static void test_exhausted(void)
{
    const struct gb_params params =
        scene_params("numerics.tolerance=1e-9", "numerics.max_evaluations=20", NULL);
    const struct gb_model model = scene_model(&params);
    struct gb_relax *relax = NULL;
    struct gb_error err = {0};
    struct gb_world *world = squeezed(&model, &relax);
    g_assert_cmpint(gb_relax_advance(relax, world, 1000, &err), ==, GB_RELAX_EXHAUSTED);
    g_assert_cmpint(relax->evaluations, ==, 20);
    gb_relax_destroy(relax);
    gb_world_destroy(world);
}

/* The choices of numerics.relaxer are auto and the names of the table. */
static void test_choices(void)
{
    const char *const *choices = gb_params_find("numerics", "relaxer")->choices;
    size_t count = 0;
    g_assert_cmpstr(choices[0], ==, "auto");
    for (; gb_relax_table()[count] != NULL; count++) {
        g_assert_true(g_strv_contains(choices, gb_relax_table()[count]->name));
    }
    g_assert_cmpuint(g_strv_length((char **)choices), ==, count + 1);
}

static void test_unknown(void)
{
    struct gb_params params = scene_params(NULL);
    struct gb_model model = scene_model(&params);
    struct gb_relax *relax = NULL;
    struct gb_error err = {0};
    g_strlcpy(model.numerics.relaxer, "fyre", sizeof model.numerics.relaxer);
    g_assert_false(gb_relax_create(&relax, &model, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    g_assert_nonnull(strstr(err.text, "fire"));
    g_assert_nonnull(strstr(err.text, "steepest"));
}

/* What the guard decides in each case. */
static void test_guard(void)
{
    struct gb_guard guard = {0};
    struct gb_error err = {0};
    struct gb_relax relax = {.tolerance = 1e-3, .residual = 2e-3, .evaluations = 100};
    char text[400];
    g_assert_cmpint(
        gb_strain_step_judge(&guard, GB_RELAX_DONE, &relax, text, sizeof text, &err), ==,
        GB_GUARD_ACCEPT);
    g_assert_cmpstr(text, ==, "");
    g_assert_cmpint(
        gb_strain_step_judge(&guard, GB_RELAX_EXHAUSTED, &relax, text, sizeof text, &err), ==,
        GB_GUARD_ACCEPT);
    g_assert_nonnull(strstr(text, "not fully relaxed"));
    relax.residual = 1.0;
    g_assert_cmpint(
        gb_strain_step_judge(&guard, GB_RELAX_EXHAUSTED, &relax, text, sizeof text, &err), ==,
        GB_GUARD_STOP);
    g_assert_cmpint(err.code, ==, GB_ERR_NOT_CONVERGED);
    int retries = 0;
    for (;;) {
        gb_error_set(&err, GB_ERR_GUARD, "made up");
        if (gb_strain_step_judge(&guard, GB_RELAX_FAILED, &relax, text, sizeof text, &err) ==
            GB_GUARD_STOP) {
            break;
        }
        retries++;
    }
    g_assert_cmpint(retries, >, 2);
    g_assert_cmpint(retries, <, 20);
    gb_error_set(&err, GB_ERR_MEMORY, "made up");
    guard.halvings = 0;
    g_assert_cmpint(
        gb_strain_step_judge(&guard, GB_RELAX_FAILED, &relax, text, sizeof text, &err), ==,
        GB_GUARD_STOP);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/relax/all", test_all);
    g_test_add_func("/relax/predict", test_predict);
    g_test_add_func("/relax/sizes", test_sizes);
    g_test_add_func("/relax/light", test_light);
    g_test_add_func("/relax/predicted", test_predicted);
    g_test_add_func("/relax/slowed", test_slowed);
    g_test_add_func("/relax/picked", test_picked);
    g_test_add_func("/relax/slices", test_slices);
    g_test_add_func("/relax/exhausted", test_exhausted);
    g_test_add_func("/relax/choices", test_choices);
    g_test_add_func("/relax/unknown", test_unknown);
    g_test_add_func("/relax/guard", test_guard);
    return g_test_run();
}
