#include <glib.h>
#include <math.h>
#include <string.h>

#include "base/vec.h"
#include "common/bed.h"
#include "common/mindlin.h"
#include "law/real_f64.h"
#include "pack/kernel/bed_batch.h"

/* Batches of a bed's contacts: the laws, and the transfer between particles and batch. */

static const int widths[] = {128, 256, 512};

/* The power behind Storakers' law, against the library's over all ratios that can occur.
 */
static void test_power(void)
{
    double worst = 0.0;
    for (double lg = -250.0; lg < 12.0; lg += 0.00137) {
        const double u = pow(10.0, lg);
        for (double share = 2.0 / 3.0; share < 0.84; share += 0.041) {
            const double exact = pow(u, share);
            worst = fmax(worst, fabs(exp2_of(share * log2_of(u)) / exact - 1.0));
        }
    }
    g_test_message("largest relative error of the power: %.2g", worst);
    g_assert_cmpfloat(worst, <, 3e-13); /* |t| up to 700: its rounding dominates */
    worst = 0.0;
    for (double u = 1e-3; u < 1e3; u *= 1.0007) {
        const double exact = pow(u, 0.7);
        worst = fmax(worst, fabs(exp2_of(0.7 * log2_of(u)) / exact - 1.0));
    }
    g_test_message("the same between 0.001 and 1000: %.2g", worst);
    g_assert_cmpfloat(worst, <, 4e-15);
}

/* One contact, by the scalar laws. */
struct scalar {
    double deepest, shear[3];
};

struct motion {
    double radius[2], mass[2];
    double branch[3], slip[3], spin[2][3];
    double held[2]; /* stiffness over mass of either body */
};

static void advance_scalar(const struct gb_bed_law *law, const struct motion *m,
                           double step, double mu, struct scalar *state, double force[3],
                           double torque[2][3])
{
    double n[3], slip[3];
    const double r = gb_vec_length(m->branch);
    memcpy(n, m->branch, sizeof n);
    gb_vec_scale(n, 1.0 / r);
    const double reach = m->radius[0] + m->radius[1], h = reach - r;
    const double rr = gb_law_hertz_radius(m->radius[0], m->radius[1]);
    const struct gb_law_hertz *hertz = &law->normal.hertz;
    struct gb_law_branch branch = {gb_law_hertz_force(hertz, rr, h),
                                   gb_law_hertz_stiffness(hertz, rr, h)};
    if (law->storakers) {
        branch = gb_law_storakers_update(&law->normal, rr, h, &state->deepest);
    }
    const double reduced = m->mass[0] * m->mass[1] / (m->mass[0] + m->mass[1]);
    const double factor = 4.0 / 3.0 * hertz->modulus * sqrt(rr); /* F = factor part^1.5 */
    const double unloading = 1.5 * factor * cbrt(branch.force / factor);
    const double square = (2.0 * unloading / reduced + m->held[0] + m->held[1]) / 3.0;
    const double damping = gb_law_hertz_damping_borne(
        gb_law_hertz_damping(branch.stiffness, reduced, law->damping), unloading, square,
        step);
    const double fn = h > 0.0 ? gb_law_hertz_damped_force(branch.force, damping,
                                                          -gb_vec_dot(m->slip, n))
                              : 0.0;
    const double lever_length[2] = {m->radius[0] * r / reach, m->radius[1] * r / reach};
    const double still[3] = {0.0, 0.0, 0.0};
    mindlin_slip(n, m->slip, still, m->spin[0], m->spin[1], lever_length[0],
                 lever_length[1], slip);
    mindlin_rotate(state->shear, n);
    mindlin_advance(state->shear, slip, law->shear * branch.stiffness, step, mu, fn);
    for (int k = 0; k < 3; k++) {
        state->shear[k] = h > 0.0 ? state->shear[k] : 0.0;
        force[k] = fn * n[k] + state->shear[k];
    }
    for (int b = 0; b < 2; b++) {
        double lever[3] = {-lever_length[b] * n[0], -lever_length[b] * n[1],
                           -lever_length[b] * n[2]};
        gb_vec_cross(lever, state->shear, torque[b]);
    }
}

static struct motion random_motion(GRand *rand, double phase)
{
    struct motion m;
    const double reach = 0.6 + 0.4 * sin((double)g_rand_int_range(rand, 0, 3));
    m.radius[0] = 0.35 * reach + 0.3 * reach * g_rand_double(rand);
    m.radius[1] = reach - m.radius[0];
    for (int b = 0; b < 2; b++) {
        m.mass[b] = 8.0 * m.radius[b] * m.radius[b] * m.radius[b];
        m.held[b] = 0.5 * g_rand_double(rand);
        for (int k = 0; k < 3; k++) {
            m.spin[b][k] = 2e-3 * (g_rand_double(rand) - 0.5);
        }
    }
    for (int k = 0; k < 3; k++) {
        m.branch[k] = g_rand_double(rand) - 0.5;
        m.slip[k] = 2e-3 * (g_rand_double(rand) - 0.5);
    }
    /* in and out of contact, elastic and plastic */
    const double h = 0.01 * reach * sin(phase) * g_rand_double(rand);
    gb_vec_scale(m.branch, (reach - h) / gb_vec_length(m.branch));
    return m;
}

static void check_close(double a, double b, double scale)
{
    if (!(fabs(a - b) <= 2e-11 * scale)) {
        g_error("%.17g, expected %.17g", a, b);
    }
}

enum { N = 53, STEPS = 40 };

/* N contacts with their motions, at every vector width and by the scalar laws. */
struct contact_set {
    const struct gb_bed_law *law;
    double mu;
    struct gb_bed_batch batch[G_N_ELEMENTS(widths)];
    struct gb_bed_contacts contacts[G_N_ELEMENTS(widths)];
    struct scalar state[N];
    struct motion motion[N];
};

/* New motions of the same bodies. */
static void move_all(struct contact_set *set, GRand *rand, int step)
{
    for (int k = 0; k < N; k++) {
        struct motion *m = &set->motion[k];
        const struct motion before = *m;
        *m = random_motion(rand, 0.4 * step + k);
        if (step > 0) {
            const double ratio =
                (before.radius[0] + before.radius[1]) / (m->radius[0] + m->radius[1]);
            gb_vec_scale(m->branch, ratio);
            memcpy(m->radius, before.radius, sizeof before.radius);
            memcpy(m->mass, before.mass, sizeof before.mass);
        }
    }
}

static void evaluate(struct contact_set *set, size_t w, int step)
{
    struct gb_bed_batch *b = &set->batch[w];
    b->n = N;
    b->step = 0.5;
    b->mu = set->mu;
    b->stiffest = b->impact = 0.0;
    gb_bed_row position[2 * N], velocity[2 * N], roll[2 * N]; /* of pair k: k and N + k */
    int32_t first[N], other[N];
    for (int k = 0; k < N; k++) {
        const struct motion *m = &set->motion[k];
        if (step == 0) {
            gb_bed_batch_set(&set->contacts[w], k, set->law, m->radius, m->mass);
        }
        first[k] = k;
        other[k] = N + k;
        for (int side = 0; side < 2; side++) {
            const int i = k + side * N;
            for (int c = 0; c < 3; c++) {
                position[i][c] = side ? 0.0 : m->branch[c];
                velocity[i][c] = side ? 0.0 : m->slip[c];
                roll[i][c] = m->radius[side] * m->spin[side][c];
            }
            position[i][3] = m->radius[side];
            velocity[i][3] = m->held[side];
            roll[i][3] = 0.0;
        }
    }
    const struct gb_bed_rows rows = {.position = (const gb_bed_row *)position,
                                     .velocity = (const gb_bed_row *)velocity,
                                     .roll = (const gb_bed_row *)roll,
                                     .first = first,
                                     .other = other,
                                     .friction = set->mu > 0.0};
    gb_bed_transfer_pick(widths[w]).gather_pairs(&rows, b);
    gb_bed_batch_pick(set->law, GB_BED_PARTNER_PARTICLE, widths[w])(set->law, b,
                                                                    &set->contacts[w], 0);
}

static void check_scalar(struct contact_set *set)
{
    const struct gb_bed_batch *b = &set->batch[0];
    for (int k = 0; k < N; k++) {
        const struct motion *m = &set->motion[k];
        double force[3], torque[2][3];
        advance_scalar(set->law, m, 0.5, set->mu, &set->state[k], force, torque);
        const double scale = gb_vec_length(force) + 1e-9;
        for (int c = 0; c < 3; c++) {
            check_close(b->force[c][k], force[c], scale);
            if (set->mu > 0.0) {
                check_close(m->radius[0] * b->moment[c][k], torque[0][c], scale);
                check_close(m->radius[1] * b->moment[c][k], torque[1][c], scale);
            }
        }
    }
}

static void check_widths(const struct contact_set *set)
{
    const struct gb_bed_batch *first = &set->batch[0];
    for (size_t w = 1; w < G_N_ELEMENTS(widths); w++) {
        const struct gb_bed_batch *b = &set->batch[w];
        for (int k = 0; k < N; k++) {
            for (int c = 0; c < 3; c++) {
                g_assert_true(b->force[c][k] == first->force[c][k]);
            }
            g_assert_true(b->holds[k] == first->holds[k]);
        }
        g_assert_true(b->stiffest == first->stiffest);
        g_assert_true(b->impact == first->impact);
    }
}

/* Contacts of many histories through the batches, against the scalar laws; then every
 * vector width against the first, to the bit. */
static void check_law(const struct gb_bed_law *law, double mu)
{
    struct gb_error err = {0};
    static struct contact_set storage; /* aligned for the vectors */
    struct contact_set *set = &storage;
    GRand *rand = g_rand_new_with_seed(7);
    memset(set, 0, sizeof *set);
    set->law = law;
    set->mu = mu;
    for (size_t w = 0; w < G_N_ELEMENTS(widths); w++) {
        g_assert_true(gb_bed_batch_init(&set->contacts[w], N, &err));
    }
    for (int step = 0; step < STEPS; step++) {
        move_all(set, rand, step);
        for (size_t w = 0; w < G_N_ELEMENTS(widths); w++) {
            evaluate(set, w, step);
        }
        check_scalar(set);
        check_widths(set);
    }
    for (size_t w = 0; w < G_N_ELEMENTS(widths); w++) {
        gb_bed_batch_finish(&set->contacts[w]);
    }
    g_rand_free(rand);
}

static void test_laws(void)
{
    for (int friction = 0; friction < 2; friction++) {
        const double mu = 0.2 * friction;
        struct gb_bed_law laws[] = {bed_law(), bed_storakers(0.0, false),
                                    bed_storakers(0.1, false), bed_storakers(0.2, false),
                                    bed_storakers(0.2, true)};
        for (size_t k = 0; k < G_N_ELEMENTS(laws); k++) {
            laws[k].damping = 0.9;
            laws[k].mu = mu;
            check_law(&laws[k], mu);
        }
    }
}

/* What is gathered for pairs against their branch vectors, to the bit. */
static void check_pairs(const struct gb_bed_transfer *transfer,
                        const struct gb_bed_rows *rows, const struct gb_bed_batch *batch)
{
    static struct gb_bed_batch pairs;
    memset(&pairs, 0, sizeof pairs);
    pairs.n = batch->n;
    transfer->gather_pairs(rows, &pairs);
    for (int k = 0; k < batch->n; k++) {
        const double x = batch->branch[0][k], y = batch->branch[1][k];
        const double z = batch->branch[2][k], r = sqrt(x * x + y * y + z * z);
        for (int c = 0; c < 3; c++) {
            g_assert_cmpfloat(pairs.unit[c][k], ==, batch->branch[c][k] * (1.0 / r));
            g_assert_cmpfloat(pairs.slip[c][k], ==, batch->slip[c][k]);
            g_assert_cmpfloat(pairs.roll[c][k], ==, batch->roll[c][k]);
        }
        g_assert_cmpfloat(pairs.overlap[k], ==, batch->reach[k] - r);
        g_assert_cmpfloat(pairs.lever[k], ==, r / batch->reach[k]);
        g_assert_cmpfloat(pairs.held[k], ==, batch->held[k]);
    }
}

/* Gather and scatter of batches of any length have the same bits at every vector width. */
static void test_transfer(void)
{
    enum { ROWS = 40, COLUMNS = 5 };
    gb_bed_row row[COLUMNS][ROWS], out[2][2][ROWS];
    int32_t first[GB_BED_BATCH], other[GB_BED_BATCH], target[GB_BED_BATCH];
    struct gb_bed_batch batch[2];
    for (int c = 0; c < COLUMNS; c++) {
        for (int i = 0; i < ROWS; i++) {
            for (int k = 0; k < 4; k++) {
                const bool unused = k == 3 && (c == 2 || c == 4);
                row[c][i][k] = unused ? 0.0 : sin(1.0 + 4.0 * i + 160.0 * c + k);
            }
        }
    }
    for (int k = 0; k < GB_BED_BATCH; k++) {
        first[k] = k * 7 % ROWS;
        other[k] = (k * 11 + 3) % ROWS;
        target[k] = (k * 13 + 1) % ROWS;
    }
    for (int n = 1; n <= GB_BED_BATCH; n++) {
        for (int friction = 0; friction < 2; friction++) {
            memset(batch, 0, sizeof batch);
            for (int wide = 0; wide < 2; wide++) {
                const struct gb_bed_transfer transfer =
                    gb_bed_transfer_pick(wide ? 0 : 128);
                memcpy(out[wide][0], row[3], sizeof row[3]);
                memcpy(out[wide][1], row[4], sizeof row[4]);
                const struct gb_bed_rows rows = {.position = (const gb_bed_row *)row[0],
                                                 .velocity = (const gb_bed_row *)row[1],
                                                 .roll = (const gb_bed_row *)row[2],
                                                 .force = out[wide][0],
                                                 .moment = out[wide][1],
                                                 .first = first,
                                                 .other = other,
                                                 .target = target,
                                                 .friction = friction};
                batch[wide].n = n;
                transfer.gather(&rows, &batch[wide]);
                check_pairs(&transfer, &rows, &batch[wide]);
                for (int c = 0; c < 3; c++) {
                    for (int k = 0; k < GB_BED_BATCH; k++) {
                        batch[wide].force[c][k] = cos(0.3 * k + c);
                        batch[wide].moment[c][k] = cos(0.7 * k + c);
                    }
                }
                for (int k = 0; k < GB_BED_BATCH; k++) {
                    batch[wide].holds[k] = 1.5 + cos(0.2 * k);
                }
                transfer.scatter(&rows, &batch[wide]);
            }
            g_assert_true(memcmp(&batch[0], &batch[1], sizeof batch[0]) == 0);
            g_assert_true(memcmp(out[0], out[1], sizeof out[0]) == 0);
            const int last = n - 1;
            const double *xi = row[0][first[last]], *xj = row[0][other[last]];
            g_assert_cmpfloat(batch[0].reach[last], ==, xi[3] + xj[3]);
            g_assert_cmpfloat(batch[0].branch[2][last], ==, xi[2] - xj[2]);
            g_assert_cmpfloat(batch[0].held[last], ==,
                              row[1][first[last]][3] + row[1][other[last]][3]);
            g_assert_cmpfloat(batch[0].roll[1][last], ==,
                              friction ? row[2][first[last]][1] + row[2][other[last]][1]
                                       : 0.0);
        }
    }
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/bed/power", test_power);
    g_test_add_func("/bed/laws", test_laws);
    g_test_add_func("/bed/transfer", test_transfer);
    return g_test_run();
}
