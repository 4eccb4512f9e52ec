#include <glib.h>
#include <math.h>

#include "base/vec.h"
#include "common/scene.h"
#include "scene/loading_kind.h"
#include "scene/normal_law.h"

static const struct gb_contacts_shape f64 = {.dimension = 3, .real = GB_REAL_F64};

/* Two particles with prescribed motion: a batch of one. */
struct history {
    double deepest, shear[3], roll[3], pivot;
};

struct pair {
    struct gb_model model;
    struct gb_batch_kernel kernel;
    struct gb_contacts contacts;
    struct gb_batch batch;
    struct history contact;
    double r[3], rotation_i[3], rotation_j[3];
    double force[3], torque_i[3], torque_j[3];
    int sliding;
};

static void start(struct pair *pair, const struct gb_params *params, double h)
{
    struct gb_error err = {0};
    gb_contacts_finish(&pair->contacts);
    memset(pair, 0, sizeof *pair);
    pair->model = scene_model(params);
    pair->kernel = gb_batch_pick(&pair->model, 0);
    g_assert_true(gb_contacts_init(&pair->contacts, f64, 1, &err));
    gb_contacts_clear(&pair->contacts, 0);
    pair->batch.n = 1;
    pair->batch.cutoff2 = 1.44;
    pair->r[2] = 1.0 - h;
}

static void advance(struct pair *pair)
{
    for (int c = 0; c < 3; c++) {
        pair->batch.r[c][0] = pair->r[c];
        pair->batch.rotation_sum[c][0] = pair->rotation_i[c] + pair->rotation_j[c];
        pair->batch.rotation_difference[c][0] = pair->rotation_i[c] - pair->rotation_j[c];
        pair->rotation_i[c] = pair->rotation_j[c] = 0.0;
    }
    pair->kernel.advance(&pair->model, &pair->batch, &pair->contacts, 0);
    for (int c = 0; c < 3; c++) {
        pair->force[c] = pair->batch.force[c][0];
        pair->torque_i[c] = pair->batch.torque_i[c][0];
        pair->torque_j[c] = pair->batch.torque_j[c][0];
        pair->contact.shear[c] =
            gb_contacts_value(&pair->contacts, pair->contacts.shear[c], 0);
        pair->contact.roll[c] =
            gb_contacts_value(&pair->contacts, pair->contacts.roll[c], 0);
    }
    pair->contact.deepest = gb_contacts_deepest(&pair->contacts, 0);
    pair->contact.pivot = gb_contacts_value(&pair->contacts, pair->contacts.pivot, 0);
    pair->sliding += pair->batch.sliding[0] > 0.0;
}

static void assert_near(double a, double b, double scale)
{
    g_assert_cmpfloat_with_epsilon(a / scale, b / scale, 1e-10);
}

/* delta is half of the relative displacement, (4). */
static void test_half_motion(void)
{
    const struct gb_params params =
        scene_params("contact.bridge_length=1 d", "contact.mu=1", NULL);
    struct pair pair = {0};
    start(&pair, &params, 0.02);
    advance(&pair);
    pair.r[0] = 1e-6;
    advance(&pair);
    const double a = 0.5 * sqrt(0.02);
    const double stiffness = gb_law_slip_shear_stiffness(&pair.model.slip, a);
    const double normal = gb_law_rod_force(&pair.model.rod, 0.02) - pair.model.adhesion;
    /* the axis has rotated by 1e-6 / r, and the normal force with it */
    assert_near(pair.force[0], -stiffness * 0.5e-6 + normal * 1e-6 / 0.98, 1e-7);
    gb_contacts_finish(&pair.contacts);
}

/* A pair that rotates as a rigid body keeps its forces: springs rotate with it. */
static void test_rigid_rotation(void)
{
    const struct gb_params params = scene_params(NULL);
    struct pair pair = {0};
    start(&pair, &params, 0.02);
    advance(&pair);
    pair.r[0] = 1e-5;          /* load the shear spring, */
    pair.rotation_i[2] = 1e-5; /* the pivot */
    pair.rotation_j[0] = 1e-5; /* and, with shear, the roll */
    advance(&pair);
    const double load = gb_vec_length(pair.force);
    const double before_shear = gb_vec_length(pair.contact.shear);
    const double before_roll = gb_vec_length(pair.contact.roll);
    const double before_pivot = pair.contact.pivot;
    const int steps = 2000;
    const double angle = 1.0 / steps;
    for (int i = 0; i < steps; i++) {
        const double x = pair.r[0], z = pair.r[2];
        pair.r[0] = cos(angle) * x + sin(angle) * z;
        pair.r[2] = -sin(angle) * x + cos(angle) * z;
        pair.rotation_i[1] = pair.rotation_j[1] = angle;
        advance(&pair);
    }
    /* the increment of a finite rotation is exact to second order in the angle */
    g_assert_cmpfloat_with_epsilon(gb_vec_length(pair.contact.shear) / before_shear, 1.0,
                                   2e-2);
    g_assert_cmpfloat_with_epsilon(gb_vec_length(pair.contact.roll) / before_roll, 1.0,
                                   1e-6);
    g_assert_cmpfloat_with_epsilon(pair.contact.pivot / before_pivot, 1.0, 1e-6);
    g_assert_cmpfloat_with_epsilon(gb_vec_length(pair.force) / load, 1.0, 1e-4);
    gb_contacts_finish(&pair.contacts);
}

/* Forces and torques on the pair balance whatever the springs do. */
static void test_balance(void)
{
    const struct gb_params params = scene_params(NULL);
    struct pair pair = {0};
    start(&pair, &params, 0.02);
    GRand *random = g_rand_new_with_seed(7);
    for (int i = 0; i < 500; i++) {
        for (int k = 0; k < 3; k++) {
            pair.r[k] += g_rand_double_range(random, -1e-4, 1e-4);
            pair.rotation_i[k] = g_rand_double_range(random, -1e-3, 1e-3);
            pair.rotation_j[k] = g_rand_double_range(random, -1e-3, 1e-3);
        }
        if (gb_vec_length(pair.r) >= 1.0) {
            pair.r[2] = 0.98;
        }
        advance(&pair);
        /* angular momentum about the centre of j: r x f_i + t_i + t_j = 0 */
        double moment[3];
        gb_vec_cross(pair.r, pair.force, moment);
        for (int k = 0; k < 3; k++) {
            assert_near(moment[k] + pair.torque_i[k] + pair.torque_j[k], 0.0, 1e-3);
        }
    }
    g_rand_free(random);
    gb_contacts_finish(&pair.contacts);
}

/* Without a bridge the shear force stops at mu f_e and a closed cycle dissipates. */
static void test_coulomb(void)
{
    const struct gb_params params =
        scene_params("contact.bridge_length=1 d", "contact.mu=0.1", NULL);
    struct pair pair = {0};
    start(&pair, &params, 0.02);
    advance(&pair);
    const double cap = 0.1 * gb_law_rod_force(&pair.model.rod, 0.02);
    double work = 0.0;
    const double dx = 1e-5;
    for (int i = 0; i < 4000; i++) {
        const double move = (i / 1000) % 2 == 0 ? dx : -dx;
        /* both rotate so that the contact slides while the axis stays */
        pair.rotation_i[1] = pair.rotation_j[1] = -move / 0.98;
        advance(&pair);
        g_assert_cmpfloat(fabs(pair.force[0]), <=, cap * (1.0 + 1e-12));
        work -= pair.force[0] * move;
    }
    g_assert_cmpfloat(fabs(pair.force[0]), >, 0.999 * cap);
    g_assert_cmpfloat(work, >, 0.5 * cap * 4000 * dx);
    g_assert_cmpint(pair.sliding, >, 1000);
    gb_contacts_finish(&pair.contacts);
}

/* A bridge sheared to pi a_ch^2 sigma_b shrinks to the present overlap (deep contact) or
 * is gone (shallow one). */
static void test_bridge_failure(void)
{
    const struct gb_params params = scene_params(NULL);
    struct pair pair = {0};
    start(&pair, &params, 0.03);
    advance(&pair);
    pair.r[2] = 1.0 - 0.026; /* opened a little: h_min stays at 0.03 */
    advance(&pair);
    g_assert_cmpfloat_with_epsilon(pair.contact.deepest, 0.03, 1e-12);
    for (int i = 0; i < 400; i++) {
        pair.rotation_i[1] = pair.rotation_j[1] = -1e-4;
        advance(&pair);
    }
    g_assert_cmpfloat_with_epsilon(pair.contact.deepest, 0.026, 1e-12);
    const double a = 0.5 * sqrt(0.026);
    const double cap = gb_law_slip_bridge_shear_cap(&pair.model.slip, a);
    g_assert_cmpfloat_with_epsilon(fabs(pair.force[0]) / cap, 1.0, 1e-9);

    start(&pair, &params, 0.010);
    advance(&pair);
    pair.r[2] = 1.0 - 0.006; /* below drch: the next failure ends the bridge */
    advance(&pair);
    g_assert_cmpfloat(pair.contact.deepest, >, 0.0);
    for (int i = 0; i < 400; i++) {
        pair.rotation_i[1] = pair.rotation_j[1] = -1e-4;
        advance(&pair);
    }
    g_assert_cmpfloat(pair.contact.deepest, ==, 0.0);
    const double coulomb = 0.1 * gb_law_rod_force(&pair.model.rod, 0.006);
    g_assert_cmpfloat_with_epsilon(fabs(pair.force[0]) / coulomb, 1.0, 1e-9);
    gb_contacts_finish(&pair.contacts);
}

/* Reaching the rolling cap a_ch f_e / 3 breaks nothing. */
static void test_rolling_cap(void)
{
    const struct gb_params params = scene_params(NULL);
    struct pair pair = {0};
    start(&pair, &params, 0.03);
    advance(&pair);
    for (int i = 0; i < 500; i++) {
        pair.rotation_i[0] = 1e-3; /* equal and opposite: rolling without sliding */
        pair.rotation_j[0] = -1e-3;
        advance(&pair);
    }
    g_assert_cmpfloat_with_epsilon(pair.contact.deepest, 0.03, 1e-12);
    const double a = 0.5 * sqrt(0.03);
    const double cap = a * gb_law_rod_force(&pair.model.rod, 0.03) / 3.0;
    g_assert_cmpfloat_with_epsilon(fabs(pair.torque_i[0]) / cap, 1.0, 1e-9);
    g_assert_cmpfloat_with_epsilon(fabs(pair.torque_j[0]) / cap, 1.0, 1e-9);
    gb_contacts_finish(&pair.contacts);
}

/* `full` doubles the increments of the springs, `current` takes the printed radius. */
static void test_switches(void)
{
    const struct gb_params params = scene_params("contact.relative_motion=full",
                                                 "contact.bridge_radius=current", NULL);
    struct pair pair = {0};
    start(&pair, &params, 0.03);
    advance(&pair);
    pair.rotation_i[2] = 1e-6;
    advance(&pair);
    const double a = 0.5 * sqrt(0.03 + 0.008);
    assert_near(pair.torque_i[2],
                -gb_law_slip_pivot_stiffness(&pair.model.slip, a) * 1e-6, 1e-9);
    gb_contacts_finish(&pair.contacts);
}

/* The laws as the batch computes them, against the laws as they are published: every
 * overlap, with and without a bridge, and across a gap. */
static void test_laws(void)
{
    const struct gb_params params = scene_params(NULL);
    struct pair pair = {0};
    for (int i = -399; i <= 480; i++) {
        const double h = i <= 0 ? i * 5e-4 : i * 1e-3;
        start(&pair, &params, h);
        advance(&pair);
        const double expected = gb_law_rod_force(&pair.model.rod, h) -
                                gb_law_dispersion_force(&pair.model.dispersion, 1.0 - h);
        g_assert_cmpfloat_with_epsilon(pair.force[2] / expected, 1.0, 1e-11);
        if (h > 0.008) {
            pair.r[2] += 0.006; /* along the line of the bridge */
            advance(&pair);
            const double line =
                gb_law_bridge_force(&pair.model.rod, h, h - 0.006) - pair.model.adhesion;
            g_assert_cmpfloat_with_epsilon((pair.force[2] - line) / pair.model.adhesion,
                                           0.0, 1e-10);
        }
    }
    gb_contacts_finish(&pair.contacts);
}

/* The same in single precision; the shear springs are at rest. */
static double force_f32(const struct gb_model *model, double h)
{
    static struct gb_batch_f32 batch;
    struct gb_contacts contacts;
    struct gb_error err = {0};
    const struct gb_contacts_shape f32 = {.dimension = 3, .real = GB_REAL_F32};
    memset(&batch, 0, sizeof batch);
    g_assert_true(gb_contacts_init(&contacts, f32, 1, &err));
    gb_contacts_clear(&contacts, 0);
    batch.n = 1;
    batch.cutoff2 = 1.44F;
    batch.r[2][0] = (float)(1.0 - h);
    gb_batch_f32_pick(model, 0).advance(model, &batch, &contacts, 0);
    gb_contacts_finish(&contacts);
    return (double)batch.force[2][0];
}

/* Every normal law of a periodic cell, with and without friction, as the batches of both
 * precisions compute it. */
static void test_normal_laws(void)
{
    static const char *const friction[] = {"contact.mu=0.1", "contact.mu=0"};
    const unsigned normals = gb_loading_kind_at(GB_KIND_QUASISTATIC)->normals;
    struct pair pair = {0};
    for (int i = 0; i < 2 * GB_NORMAL_LAWS; i++) {
        struct gb_params params =
            scene_params(friction[i % 2], "contact.bridge_length=1 d", NULL);
        params.normal = i / 2;
        for (double h = 0x1p-12; h < 0.4 && (normals >> i / 2 & 1u) != 0; h *= 1.25) {
            const double overlap = 1.0 - (double)(float)(1.0 - h);
            start(&pair, &params, overlap);
            advance(&pair);
            const double expected =
                gb_normal_law_force(&pair.model, overlap) - pair.model.adhesion;
            g_assert_cmpfloat_with_epsilon(pair.force[2], expected,
                                           1e-12 * pair.model.force_floor + 1e-13);
            g_assert_cmpfloat_with_epsilon(force_f32(&pair.model, overlap), expected,
                                           2e-6 * fabs(expected) +
                                               1e-6 * pair.model.force_floor);
        }
    }
    gb_contacts_finish(&pair.contacts);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/contact/half-motion", test_half_motion);
    g_test_add_func("/contact/rigid-rotation", test_rigid_rotation);
    g_test_add_func("/contact/balance", test_balance);
    g_test_add_func("/contact/coulomb", test_coulomb);
    g_test_add_func("/contact/bridge-failure", test_bridge_failure);
    g_test_add_func("/contact/rolling-cap", test_rolling_cap);
    g_test_add_func("/contact/switches", test_switches);
    g_test_add_func("/contact/laws", test_laws);
    g_test_add_func("/contact/normal-laws", test_normal_laws);
    return g_test_run();
}
