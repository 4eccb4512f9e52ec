#include <float.h>
#include <glib.h>
#include <math.h>

#include "common/scalar_contact.h"
#include "common/scene.h"

/* The batches of unequal sizes against the scalar laws, pair by pair. */

enum { PAIRS = 101, STEPS = 600, FIRST = 3 };

static const char *const scenes[][2] = {
    {"contact.mu=0.1", "contact.bridge_length=0.008 d"},
    {"contact.mu=0.4", "contact.bridge_radius=current"},
    {"contact.mu=0.1", "contact.bridge_length=1 d"},
    {"contact.mu=0", "contact.bridge_length=1 d"},
    {"contact.mu=0.1", "material.epsilon=0 kB"},
    {"contact.mu=0.1", "contact.relative_motion=full"},
};

struct walk {
    struct gb_model model;
    struct gb_batch batch;
    struct gb_contacts contacts;
    struct scalar_contact pair[PAIRS];
    double r[PAIRS][3];
    GRand *random;
    int held, slid, opened, broken;
};

static double draw(struct walk *walk, double most)
{
    return g_rand_double_range(walk->random, -most, most);
}

static void begin(struct walk *walk, size_t scene, bool viscous)
{
    struct gb_error err = {0};
    const struct gb_params params =
        scene_params(scenes[scene][0], scenes[scene][1], NULL);
    const struct gb_contacts_shape shape = {3, viscous, GB_REAL_F64};
    memset(walk, 0, sizeof *walk);
    walk->model = scene_model(&params);
    walk->model.polydisperse = true;
    walk->model.kind = viscous ? GB_KIND_DYNAMIC : GB_KIND_QUASISTATIC;
    walk->random = g_rand_new_with_seed((guint32)scene);
    walk->batch.n = PAIRS;
    walk->batch.damp = 0.2;
    g_assert_true(gb_contacts_init(&walk->contacts, shape, 128, &err));
    for (int k = 0; k < PAIRS; k++) {
        const double first = exp(draw(walk, 1.0)), second = exp(draw(walk, 1.0));
        double length;
        scalar_contact_init(&walk->pair[k], &walk->model, first, second);
        walk->pair[k].viscous = viscous;
        walk->pair[k].damp = walk->batch.damp;
        gb_contacts_clear(&walk->contacts, FIRST + k);
        walk->batch.diameter[0][k] = first;
        walk->batch.diameter[1][k] = second;
        for (int c = 0; c < 3; c++) {
            walk->r[k][c] = draw(walk, 1.0);
        }
        length = gb_vec_length(walk->r[k]);
        for (int c = 0; c < 3; c++) {
            walk->r[k][c] *= 0.5 * (first + second) *
                             g_rand_double_range(walk->random, 0.93, 1.01) / length;
        }
    }
}

static void assert_vector(const double (*batch)[GB_BATCH], int k,
                          const double expected[3], double scale)
{
    for (int c = 0; c < 3; c++) {
        g_assert_cmpfloat_with_epsilon(batch[c][k], expected[c], 1e-9 * scale + DBL_MIN);
    }
}

static void step(struct walk *walk, const struct gb_batch_kernel *kernel)
{
    struct gb_batch *batch = &walk->batch;
    struct gb_tally tally = {0};
    double absorbed = 0.0, normal = 0.0;
    int64_t contacts = 0, sliding = 0;
    for (int k = 0; k < PAIRS; k++) {
        double arc_i[3], arc_j[3];
        const double size = walk->pair[k].law.mean_diameter;
        const int before = walk->pair[k].deepest > 0.0 ? 2 : walk->pair[k].deepest >= 0.0;
        for (int c = 0; c < 3; c++) {
            walk->r[k][c] += draw(walk, 1e-3 * size);
            arc_i[c] = draw(walk, 8e-4);
            arc_j[c] = draw(walk, 8e-4);
            batch->r[c][k] = walk->r[k][c];
            batch->rotation_sum[c][k] = arc_i[c] + arc_j[c];
            batch->rotation_difference[c][k] = arc_i[c] - arc_j[c];
        }
        scalar_contact_move(&walk->pair[k], walk->r[k], arc_i, arc_j);
        absorbed += walk->pair[k].absorbed;
        normal += walk->pair[k].normal;
        contacts += walk->pair[k].deepest >= 0.0;
        sliding += walk->pair[k].slides;
        walk->held += walk->pair[k].deepest > 0.0;
        walk->opened += before > 0 && walk->pair[k].deepest < 0.0;
        walk->broken += before == 2 && !(walk->pair[k].deepest > 0.0);
    }
    walk->slid += (int)sliding;
    kernel->advance(&walk->model, batch, &walk->contacts, FIRST);
    for (int k = 0; k < PAIRS; k++) {
        const struct scalar_contact *pair = &walk->pair[k];
        const double scale = fmax(gb_vec_length(pair->force), pair->law.adhesion);
        assert_vector((const double(*)[GB_BATCH])batch->force, k, pair->force, scale);
        assert_vector((const double(*)[GB_BATCH])batch->torque_i, k, pair->torque_i,
                      scale);
        assert_vector((const double(*)[GB_BATCH])batch->torque_j, k, pair->torque_j,
                      scale);
        g_assert_cmpfloat_with_epsilon(gb_contacts_deepest(&walk->contacts, FIRST + k),
                                       pair->deepest, 1e-12);
        g_assert_cmpint(batch->sliding[k] > 0.0, ==, pair->slides);
    }
    kernel->tally(batch, &walk->contacts, FIRST, &tally);
    g_assert_cmpint(tally.contacts, ==, contacts);
    g_assert_cmpint(tally.sliding, ==, sliding);
    g_assert_cmpfloat_with_epsilon(tally.normal_sum, normal, 1e-9 * normal);
    g_assert_cmpfloat_with_epsilon(tally.absorbed, absorbed, 1e-9 * normal);
}

/* Random motions of pairs with diameters from 1/e to e. */
static void test_history(void)
{
    static struct walk walk;
    for (size_t s = 0; s < G_N_ELEMENTS(scenes); s++) {
        for (int viscous = 0; viscous < 2; viscous++) {
            begin(&walk, s, viscous != 0);
            const struct gb_batch_kernel kernel = gb_batch_pick(&walk.model, 0);
            for (int i = 0; i < STEPS; i++) {
                step(&walk, &kernel);
            }
            g_assert_cmpint(walk.opened, >, 20);
            g_assert_true(!walk.model.terms.friction || walk.slid > 200);
            g_assert_true(!walk.model.terms.bridges ||
                          (walk.held > 1000 && walk.broken > 20));
            g_rand_free(walk.random);
            gb_contacts_finish(&walk.contacts);
        }
    }
}

/* Attraction across gaps, to the cutoff and behind it. */
static void test_attraction(void)
{
    static struct walk walk;
    for (int s = 0; s < 2; s++) {
        begin(&walk, s == 0 ? 0 : 4, false);
        const struct gb_batch_kernel kernel = gb_batch_pick(&walk.model, 0);
        struct gb_tally tally = {0};
        int pulled = 0;
        for (int k = 0; k < PAIRS; k++) {
            const double apart = 1.0 + g_rand_double_range(walk.random, 0.0, 0.4);
            const double wide = gb_vec_length(walk.r[k]);
            for (int c = 0; c < 3; c++) {
                walk.r[k][c] *= walk.pair[k].law.mean_diameter * apart / wide;
                walk.batch.r[c][k] = walk.r[k][c];
            }
            scalar_contact_move(&walk.pair[k], walk.r[k], (double[3]){0}, (double[3]){0});
            pulled += gb_vec_length(walk.pair[k].force) > 0.0;
        }
        kernel.attract(&walk.model, &walk.batch, NULL, NULL, &tally);
        for (int k = 0; k < PAIRS; k++) {
            const double scale = gb_vec_length(walk.pair[k].force);
            assert_vector((const double(*)[GB_BATCH])walk.batch.force, k,
                          walk.pair[k].force, scale);
        }
        g_assert_true(s == 0 ? pulled > 20 && pulled < PAIRS : pulled == 0);
        g_rand_free(walk.random);
        gb_contacts_finish(&walk.contacts);
    }
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/unequal-batch/history", test_history);
    g_test_add_func("/unequal-batch/attraction", test_attraction);
    return g_test_run();
}
