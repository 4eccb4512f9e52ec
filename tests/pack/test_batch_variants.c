#include <glib.h>
#include <math.h>
#include <stdio.h>

#include "base/vec.h"
#include "common/scene.h"

/* Variants of the batches (vector width, precision, dimension) against each other. */

static const struct gb_contacts_shape f64 = {.dimension = 3, .real = GB_REAL_F64};
static const struct gb_contacts_shape f32 = {.dimension = 3, .real = GB_REAL_F32};

static void random_batch(GRand *random, struct gb_batch *batch)
{
    batch->n = 101;
    batch->cutoff2 = 1.44;
    batch->damp = 0.2;
    for (int k = 0; k < batch->n; k++) {
        double r[3], length = 0.0;
        for (int c = 0; c < 3; c++) {
            r[c] = g_rand_double_range(random, -1.0, 1.0);
            batch->rotation_sum[c][k] = g_rand_double_range(random, -1e-2, 1e-2);
            batch->rotation_difference[c][k] = g_rand_double_range(random, -1e-2, 1e-2);
        }
        length = gb_vec_length(r);
        for (int c = 0; c < 3; c++) {
            batch->r[c][k] = r[c] / length * g_rand_double_range(random, 0.93, 1.01);
        }
    }
}

static void round_batch(const struct gb_batch *batch, struct gb_batch_f32 *rounded)
{
    rounded->n = batch->n;
    rounded->cutoff2 = (float)batch->cutoff2;
    for (int s = 0; s < 2; s++) {
        for (int k = 0; k < batch->n; k++) {
            rounded->diameter[s][k] = (float)batch->diameter[s][k];
        }
    }
    for (int c = 0; c < 3; c++) {
        for (int k = 0; k < batch->n; k++) {
            rounded->r[c][k] = (float)batch->r[c][k];
            rounded->rotation_sum[c][k] = (float)batch->rotation_sum[c][k];
            rounded->rotation_difference[c][k] = (float)batch->rotation_difference[c][k];
        }
    }
}

/* Records of pairs not in contact. */
static void open_contacts(struct gb_contacts *contacts, struct gb_contacts_shape shape)
{
    struct gb_error err = {0};
    g_assert_true(gb_contacts_init(contacts, shape, 128, &err));
    for (int64_t k = 0; k < 128; k++) {
        gb_contacts_clear(contacts, k);
    }
}

static void add_to_sum(GChecksum *sum, const void *numbers, size_t count, size_t size)
{
    g_checksum_update(sum, (const guchar *)numbers, (gssize)(count * size));
}

static void add_history(GChecksum *sum, const struct gb_contacts *contacts)
{
    for (int p = 0; p < contacts->planes; p++) {
        add_to_sum(sum, contacts->plane[p], 128, gb_real_size(contacts->real));
    }
}

static uint64_t close_sum(GChecksum *sum)
{
    uint64_t hash = 0;
    sscanf(g_checksum_get_string(sum), "%16" G_GINT64_MODIFIER "x", &hash);
    g_checksum_free(sum);
    return hash;
}

/* Diameters for the pairs, which keep their overlaps over the mean. */
static void random_sizes(GRand *random, struct gb_batch *batch)
{
    for (int k = 0; k < batch->n; k++) {
        const double first = g_rand_double_range(random, 0.5, 2.0);
        const double second = g_rand_double_range(random, 0.5, 2.0);
        batch->diameter[0][k] = first;
        batch->diameter[1][k] = second;
        for (int c = 0; c < 3; c++) {
            batch->r[c][k] *= 0.5 * (first + second);
        }
    }
}

/* dimension: 2, 3, or SIZED for unequal sizes */
enum { SIZED = 4, VARIANTS_EACH = 3 };

static uint64_t walk(const struct gb_params *params, int width, int dimension,
                     enum gb_kind kind)
{
    const bool viscous = kind == GB_KIND_DYNAMIC;
    struct gb_model model = scene_model(params);
    struct gb_contacts contacts;
    const bool sized = dimension == SIZED;
    model.dimension = sized ? 3 : dimension;
    model.polydisperse = sized;
    model.kind = (int)kind;
    const struct gb_batch_kernel kernel = gb_batch_pick(&model, width);
    open_contacts(&contacts,
                  (struct gb_contacts_shape){model.dimension, viscous, GB_REAL_F64});
    GRand *random = g_rand_new_with_seed(5);
    static struct gb_batch batch;
    GChecksum *sum = g_checksum_new(G_CHECKSUM_SHA256);
    for (int i = 0; i < 50; i++) {
        random_batch(random, &batch);
        if (sized) {
            random_sizes(random, &batch);
        }
        kernel.advance(&model, &batch, &contacts, 3);
        add_to_sum(sum, batch.force[0], (size_t)batch.n, sizeof(double));
        add_to_sum(sum, batch.torque_i[0], (size_t)batch.n, sizeof(double));
        add_history(sum, &contacts);
    }
    g_rand_free(random);
    gb_contacts_finish(&contacts);
    return close_sum(sum);
}

static const char *const terms[][2] = {
    {"contact.mu=0.1", "contact.bridge_length=0.008 d"},
    {"contact.mu=0.1", "contact.bridge_length=1 d"},
    {"contact.mu=0", "contact.bridge_length=1 d"},
    {"contact.mu=0.1", "contact.normal=hertz"},
    {"contact.mu=0", "contact.normal=hertz"},
};
/* The cohesionless laws come last; dynamic scenes have none. */
enum { COHESIVE = 3, TERMS = sizeof terms / sizeof terms[0] };

/* Random motions of many contacts give the same bits for every vector width, with every
 * combination of terms. */
static void test_widths(void)
{
    for (int t = 0; t < TERMS; t++) {
        const struct gb_params params = scene_params(terms[t][0], terms[t][1], NULL);
        for (int v = 0; v < (t < COHESIVE ? 2 : 1) * VARIANTS_EACH; v++) {
            const int dimension = 2 + v % VARIANTS_EACH;
            const enum gb_kind kind =
                v >= VARIANTS_EACH ? GB_KIND_DYNAMIC : GB_KIND_QUASISTATIC;
            const uint64_t reference = walk(&params, 128, dimension, kind);
            g_assert_cmpuint(walk(&params, 256, dimension, kind), ==, reference);
            g_assert_cmpuint(walk(&params, 512, dimension, kind), ==, reference);
        }
    }
}

/* Single precision: the same bits for every vector width. */
static uint64_t walk_f32(const struct gb_params *params, int width, bool sized)
{
    struct gb_model model = scene_model(params);
    struct gb_contacts contacts;
    model.polydisperse = sized;
    const struct gb_batch_f32_kernel kernel = gb_batch_f32_pick(&model, width);
    open_contacts(&contacts, f32);
    GRand *random = g_rand_new_with_seed(5);
    static struct gb_batch batch;
    static struct gb_batch_f32 rounded;
    struct gb_tally tally = {0};
    GChecksum *sum = g_checksum_new(G_CHECKSUM_SHA256);
    for (int i = 0; i < 50; i++) {
        random_batch(random, &batch);
        if (sized) {
            random_sizes(random, &batch);
        }
        round_batch(&batch, &rounded);
        kernel.advance(&model, &rounded, &contacts, 3);
        kernel.tally(&rounded, &contacts, 3, &tally);
        add_to_sum(sum, rounded.force[0], (size_t)batch.n, sizeof(float));
        add_to_sum(sum, rounded.torque_i[0], (size_t)batch.n, sizeof(float));
        g_checksum_update(sum, (const guchar *)&tally, sizeof tally);
        add_history(sum, &contacts);
    }
    g_rand_free(random);
    gb_contacts_finish(&contacts);
    return close_sum(sum);
}

static void test_widths_f32(void)
{
    for (int t = 0; t < TERMS; t++) {
        const struct gb_params params = scene_params(terms[t][0], terms[t][1], NULL);
        for (int sized = 0; sized < 2; sized++) {
            const uint64_t reference = walk_f32(&params, 128, sized);
            g_assert_cmpuint(walk_f32(&params, 256, sized), ==, reference);
            g_assert_cmpuint(walk_f32(&params, 512, sized), ==, reference);
        }
    }
}

/* Small random motions of the pairs of a batch. */
static void move_batch(GRand *random, struct gb_batch *batch)
{
    static struct gb_batch step;
    random_batch(random, &step);
    for (int c = 0; c < 3; c++) {
        for (int k = 0; k < batch->n; k++) {
            batch->r[c][k] += 2e-4 * step.r[c][k];
            batch->rotation_sum[c][k] = 0.03 * step.rotation_sum[c][k];
            batch->rotation_difference[c][k] = 0.03 * step.rotation_difference[c][k];
        }
    }
}

static void assert_same_forces(const struct gb_batch *batch,
                               const struct gb_batch_f32 *rounded, double most)
{
    for (int k = 0; k < batch->n; k++) {
        for (int c = 0; c < 3; c++) {
            g_assert_cmpfloat_with_epsilon(batch->force[c][k],
                                           (double)rounded->force[c][k], most);
            g_assert_cmpfloat_with_epsilon(batch->torque_i[c][k],
                                           (double)rounded->torque_i[c][k], most);
            g_assert_cmpfloat_with_epsilon(batch->torque_j[c][k],
                                           (double)rounded->torque_j[c][k], most);
        }
    }
}

/* The same small motion of pairs in both precisions: forces and torques agree within the
 * rounding of an overlap, 1e-7 of the distance. */
static void check_precisions(int t, bool sized)
{
    const struct gb_params params = scene_params(terms[t][0], terms[t][1], NULL);
    struct gb_model model = scene_model(&params);
    model.polydisperse = sized;
    struct gb_contacts fine, coarse;
    static struct gb_batch batch;
    static struct gb_batch_f32 rounded;
    const struct gb_batch_kernel kernel = gb_batch_pick(&model, 0);
    const struct gb_batch_f32_kernel other = gb_batch_f32_pick(&model, 0);
    int held = 0, slid = 0;
    open_contacts(&fine, f64);
    open_contacts(&coarse, f32);
    GRand *random = g_rand_new_with_seed(7);
    random_batch(random, &batch);
    if (sized) {
        random_sizes(random, &batch);
    }
    for (int i = 0; i < 200; i++) {
        move_batch(random, &batch);
        round_batch(&batch, &rounded);
        kernel.advance(&model, &batch, &fine, 0);
        other.advance(&model, &rounded, &coarse, 0);
        assert_same_forces(&batch, &rounded, 3e-4 * model.adhesion);
        for (int k = 0; k < batch.n; k++) {
            held += gb_contacts_deepest(&coarse, k) > 0.0;
            slid += rounded.sliding[k] > 0.0F;
        }
    }
    g_assert_true(t != 0 || held > 1000);
    g_assert_true(t == 2 || slid > 100);
    g_rand_free(random);
    gb_contacts_finish(&fine);
    gb_contacts_finish(&coarse);
}

static void test_f32(void)
{
    for (int t = 0; t < COHESIVE; t++) {
        check_precisions(t, false);
        check_precisions(t, true);
    }
}

/* The same motion of a planar pair in 2D and in 3D gives the same forces. */
static void test_planar(void)
{
    const struct gb_params params = scene_params(NULL);
    struct gb_model solid = scene_model(&params), flat = solid;
    static struct gb_batch a, b;
    struct gb_contacts ca, cb;
    struct gb_error err = {0};
    solid.kind = flat.kind = GB_KIND_DYNAMIC;
    flat.dimension = 2;
    const struct gb_batch_kernel ka = gb_batch_pick(&solid, 0),
                                 kb = gb_batch_pick(&flat, 0);
    const struct gb_contacts_shape in_3d = {3, true, GB_REAL_F64};
    const struct gb_contacts_shape in_2d = {2, true, GB_REAL_F64};
    g_assert_true(gb_contacts_init(&ca, in_3d, 1, &err) &&
                  gb_contacts_init(&cb, in_2d, 1, &err));
    gb_contacts_clear(&ca, 0);
    gb_contacts_clear(&cb, 0);
    GRand *random = g_rand_new_with_seed(11);
    a.n = b.n = 1;
    a.cutoff2 = b.cutoff2 = 1.44;
    a.damp = b.damp = 0.2;
    double x = 0.4, z = 0.89;
    int slid = 0;
    for (int i = 0; i < 3000; i++) {
        x += g_rand_double_range(random, -2e-4, 2e-4);
        z += g_rand_double_range(random, -2e-4, 2e-4);
        const double scale = 0.975 / hypot(x, z);
        x *= i % 100 == 0 ? scale : 1.0;
        z *= i % 100 == 0 ? scale : 1.0;
        a.r[0][0] = b.r[0][0] = x;
        a.r[2][0] = b.r[1][0] = z;
        a.rotation_sum[1][0] = b.rotation_sum[0][0] =
            g_rand_double_range(random, -1e-3, 1e-3);
        a.rotation_difference[1][0] = b.rotation_difference[0][0] =
            g_rand_double_range(random, -1e-3, 1e-3);
        ka.advance(&solid, &a, &ca, 0);
        kb.advance(&flat, &b, &cb, 0);
        g_assert_cmpfloat_with_epsilon(a.force[0][0], b.force[0][0], 1e-9);
        g_assert_cmpfloat_with_epsilon(a.force[2][0], b.force[1][0], 1e-9);
        g_assert_cmpfloat_with_epsilon(a.torque_i[1][0], b.torque_i[0][0], 1e-9);
        g_assert_cmpfloat_with_epsilon(a.torque_j[1][0], b.torque_j[0][0], 1e-9);
        g_assert_cmpfloat(a.force[1][0], ==, 0.0);
        g_assert_cmpfloat_with_epsilon(a.absorbed[0], b.absorbed[0], 1e-11);
        g_assert_cmpfloat(a.sliding[0], ==, b.sliding[0]);
        slid += a.sliding[0] > 0.0;
    }
    g_assert_cmpint(slid, >, 100);
    g_assert_cmpint(slid, <, 2900);
    g_rand_free(random);
    gb_contacts_finish(&ca);
    gb_contacts_finish(&cb);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/contact/widths", test_widths);
    g_test_add_func("/contact/widths-single", test_widths_f32);
    g_test_add_func("/contact/single", test_f32);
    g_test_add_func("/contact/planar", test_planar);
    return g_test_run();
}
