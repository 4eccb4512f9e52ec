#include <glib.h>
#include <math.h>
#include <string.h>

#include "base/vec.h"
#include "common/bed.h"
#include "law/law_mindlin.h"
#include "pack/die/bed_copy.h"
#include "pack/die/random_insertion.h"
#include "pack/kernel/bed_batch.h"
#include "pack/kernel/bed_laws.h"

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
    g_assert_cmpfloat(worst, <, 3e-13); /* |t| up to 700: its rounding is what counts */
    worst = 0.0;
    for (double u = 1e-3; u < 1e3; u *= 1.0007) {
        const double exact = pow(u, 0.7);
        worst = fmax(worst, fabs(exp2_of(0.7 * log2_of(u)) / exact - 1.0));
    }
    g_test_message("the same between 0.001 and 1000: %.2g", worst);
    g_assert_cmpfloat(worst, <, 4e-15);
}

/* One contact carried by the scalar rules. */
struct scalar {
    double deepest, shear[3];
};

struct motion {
    double radius[2], mass[2];
    double branch[3], slip[3], spin[2][3];
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
    const double damping = gb_law_hertz_damping(branch.stiffness, reduced, law->damping);
    const double fn = h > 0.0 ? gb_law_hertz_damped_force(branch.force, damping,
                                                          -gb_vec_dot(m->slip, n))
                              : 0.0;
    const double lever_length[2] = {m->radius[0] * r / reach, m->radius[1] * r / reach};
    const double still[3] = {0.0, 0.0, 0.0};
    gb_law_mindlin_slip(n, m->slip, still, m->spin[0], m->spin[1], lever_length[0],
                        lever_length[1], slip);
    gb_law_mindlin_rotate(state->shear, n);
    gb_law_mindlin_advance(state->shear, slip, law->shear * branch.stiffness, step, mu,
                           fn);
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

/* Contacts of many histories through the batches, against the scalar laws; then every
 * vector width against the first, to the bit. */
static void check_law(const struct gb_bed_law *law, double mu)
{
    enum { N = 53, STEPS = 40 };
    struct gb_error err = {0};
    static struct gb_bed_batch batch[G_N_ELEMENTS(widths)];
    struct gb_bed_contacts contacts[G_N_ELEMENTS(widths)];
    struct scalar state[N] = {0};
    struct motion m[N];
    GRand *rand = g_rand_new_with_seed(7);
    for (size_t w = 0; w < G_N_ELEMENTS(widths); w++) {
        g_assert_true(gb_bed_contacts_init(&contacts[w], N, &err));
    }
    for (int step = 0; step < STEPS; step++) {
        for (int k = 0; k < N; k++) {
            const struct motion was = m[k];
            m[k] = random_motion(rand, 0.4 * step + k);
            if (step > 0) { /* the bodies stay */
                const double ratio =
                    (was.radius[0] + was.radius[1]) / (m[k].radius[0] + m[k].radius[1]);
                gb_vec_scale(m[k].branch, ratio);
                memcpy(m[k].radius, was.radius, sizeof was.radius);
                memcpy(m[k].mass, was.mass, sizeof was.mass);
            }
        }
        for (size_t w = 0; w < G_N_ELEMENTS(widths); w++) {
            struct gb_bed_batch *b = &batch[w];
            b->n = N;
            b->step = 0.5;
            b->mu = mu;
            b->stiffest = 0.0;
            for (int k = 0; k < N; k++) {
                if (step == 0) {
                    gb_bed_contacts_set(&contacts[w], k, law, m[k].radius, m[k].mass);
                }
                b->reach[k] = m[k].radius[0] + m[k].radius[1];
                for (int c = 0; c < 3; c++) {
                    b->branch[c][k] = m[k].branch[c];
                    b->slip[c][k] = m[k].slip[c];
                    b->roll[c][k] = m[k].radius[0] * m[k].spin[0][c] +
                                    m[k].radius[1] * m[k].spin[1][c];
                }
            }
            gb_bed_batch_pick(law, GB_BED_PARTNER_PARTICLE, widths[w])(law, b,
                                                                       &contacts[w], 0);
        }
        for (int k = 0; k < N; k++) {
            double force[3], torque[2][3];
            advance_scalar(law, &m[k], 0.5, mu, &state[k], force, torque);
            const double scale = gb_vec_length(force) + 1e-9;
            for (int c = 0; c < 3; c++) {
                check_close(batch[0].force[c][k], force[c], scale);
                if (mu > 0.0) {
                    check_close(m[k].radius[0] * batch[0].moment[c][k], torque[0][c],
                                scale);
                    check_close(m[k].radius[1] * batch[0].moment[c][k], torque[1][c],
                                scale);
                }
                for (size_t w = 1; w < G_N_ELEMENTS(widths); w++) {
                    g_assert_true(batch[w].force[c][k] == batch[0].force[c][k]);
                }
            }
        }
        for (size_t w = 1; w < G_N_ELEMENTS(widths); w++) {
            g_assert_true(batch[w].stiffest == batch[0].stiffest);
        }
    }
    for (size_t w = 0; w < G_N_ELEMENTS(widths); w++) {
        gb_bed_contacts_finish(&contacts[w]);
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

/* A cluster of overlapping spheres far from all walls, moving and turning. */
static struct gb_bed *cluster(const struct gb_bed_law *law, int64_t count)
{
    double *radius = g_new(double, (gsize)count);
    GRand *rand = g_rand_new_with_seed(3);
    for (int64_t i = 0; i < count; i++) {
        radius[i] = 0.2 + 0.4 * g_rand_double(rand);
    }
    const struct gb_die die = bed_die(50.0);
    struct gb_bed *bed = bed_create(count, radius, &die, law);
    for (int64_t i = 0; i < count; i++) {
        bed_set_position(bed, i, 4.0 * g_rand_double(rand), 4.0 * g_rand_double(rand),
                         20.0 + 4.0 * g_rand_double(rand));
        for (int k = 0; k < 3; k++) {
            bed->velocity[i][k] = 1e-2 * (g_rand_double(rand) - 0.5);
            bed->spin[i][k] = 1e-2 * (g_rand_double(rand) - 0.5);
        }
    }
    g_rand_free(rand);
    g_free(radius);
    return bed;
}

/* Momentum and angular momentum: forces add up to nothing, torques with the moments of
 * the forces too. */
static void test_momentum(void)
{
    struct gb_bed_law law = bed_storakers(0.1, false);
    law.damping = 0.9;
    law.mu = 0.3;
    struct gb_bed *bed = cluster(&law, 200);
    double force[3] = {0}, torque[3] = {0}, sum = 0.0;
    bed_evaluate(bed, 0.3);
    bed_evaluate(bed, 0.3);
    for (int64_t i = 0; i < bed->count; i++) {
        double moment[3];
        gb_vec_cross(bed->position[i], bed->force[i], moment);
        gb_vec_add(force, 1.0, bed->force[i]);
        gb_vec_add(torque, 1.0, moment);
        gb_vec_add(torque, 1.0, bed->torque[i]);
        sum += gb_vec_length(bed->force[i]);
    }
    g_assert_cmpfloat(sum, >, 1.0);
    g_assert_cmpfloat(gb_vec_length(force), <, 1e-13 * sum);
    g_assert_cmpfloat(gb_vec_length(torque), <, 1e-12 * sum * 20.0);
    gb_bed_destroy(bed);
}

/* The list with its skin sees what all pairs see. */
static void test_list(void)
{
    const struct gb_bed_law law = bed_law();
    struct gb_bed *bed = cluster(&law, 300);
    bed_evaluate(bed, 0.0);
    int64_t touching = 0, listed = 0;
    for (int64_t slot = 0; slot < bed->pairs.count; slot++) {
        listed += bed->pairs.contacts.normal[slot] >= 0.0;
        g_assert_cmpint(bed->pairs.first[slot], <, bed->pairs.other[slot]);
        if (slot > 0 && bed->pairs.first[slot] == bed->pairs.first[slot - 1]) {
            g_assert_cmpint(bed->pairs.other[slot], >, bed->pairs.other[slot - 1]);
        }
    }
    for (int64_t i = 0; i < bed->count; i++) {
        for (int64_t j = i + 1; j < bed->count; j++) {
            double r[3];
            for (int k = 0; k < 3; k++) {
                r[k] = bed->position[i][k] - bed->position[j][k];
            }
            touching += gb_vec_length(r) < bed->position[i][3] + bed->position[j][3];
        }
    }
    g_assert_cmpint(listed, ==, touching);
    g_assert_cmpint(touching, >, 300);
    gb_bed_destroy(bed);
}

/* Signs and sums of the walls: a sphere pressed on each of them by a known overlap. */
static void test_walls(void)
{
    const double radius = 0.5, h = 0.01;
    const struct gb_bed_law law = bed_law();
    const double force = gb_law_hertz_force(&law.normal.hertz, radius, h);
    struct gb_die die = bed_die(4.0);
    die.punch = true;
    die.punch_position = 6.0;
    struct gb_bed *bed = bed_create(1, &radius, &die, &law);
    bed_set_position(bed, 0, 0.0, 0.0, radius - h);
    bed_evaluate(bed, 0.0);
    g_assert_cmpfloat_with_epsilon(bed->force[0][2], force, 1e-13 * force);
    g_assert_cmpfloat(bed->tally.floor, ==, bed->force[0][2]);
    g_assert_cmpfloat(bed->tally.punch, ==, 0.0);
    bed_set_position(bed, 0, 0.0, 0.0, 6.0 - radius + h);
    bed_evaluate(bed, 0.0);
    g_assert_cmpfloat_with_epsilon(bed->force[0][2], -force, 1e-12 * force);
    g_assert_cmpfloat(bed->tally.punch, ==, -bed->force[0][2]);
    bed_set_position(bed, 0, 0.0, -(4.0 - radius + h), 3.0);
    bed_evaluate(bed, 0.0);
    g_assert_cmpfloat_with_epsilon(bed->force[0][1], force, 1e-12 * force);
    g_assert_cmpfloat_with_epsilon(bed->tally.side[1], force * (4.0 - radius + h),
                                   1e-11 * force);
    g_assert_cmpfloat(fabs(bed->force[0][0]) + fabs(bed->force[0][2]), <, 1e-15);
    gb_bed_destroy(bed);
}

/* Overlap is what the radius has more than the distance to the nearest wall point, found
 * by trying many; unit points from there to the centre. */
static void test_funnel(void)
{
    const struct gb_die die = {.radius = 4.0,
                               .funnel = true,
                               .height = 5.0,
                               .outlet = 2.5,
                               .sine = sin(0.6),
                               .cosine = cos(0.6)};
    GRand *rand = g_rand_new_with_seed(1);
    for (int round = 0; round < 500; round++) {
        double x[3], unit[3];
        do {
            x[0] = 8.0 * (g_rand_double(rand) - 0.5);
            x[1] = 8.0 * (g_rand_double(rand) - 0.5);
            x[2] = 12.0 * g_rand_double(rand);
        } while (!gb_die_contains(&die, x));
        const double rho = sqrt(x[0] * x[0] + x[1] * x[1]);
        double nearest = HUGE_VAL;
        for (int k = -2000; k <= 20000; k++) {
            const double s = 1e-3 * k;
            const double wall = s < 0.0 ? fmin(2.5 - s, 4.0) : 2.5 + s * die.sine;
            const double height = s < 0.0 ? 5.0 : 5.0 + s * die.cosine;
            nearest = fmin(nearest, hypot(rho - wall, x[2] - height));
        }
        const double h = gb_die_overlap(&die, GB_DIE_FUNNEL, x, 1.0, unit);
        g_assert_cmpfloat_with_epsilon(1.0 - h, nearest, 2e-3);
        g_assert_cmpfloat_with_epsilon(gb_vec_length(unit), 1.0, 1e-12);
        double foot[3];
        for (int k = 0; k < 3; k++) { /* a step towards the wall meets it there */
            foot[k] = x[k] - (1.0 - h) * unit[k];
        }
        g_assert_cmpfloat(fabs(gb_die_overlap(&die, GB_DIE_FUNNEL, foot, 0.0, unit)), <,
                          1e-9);
    }
    g_rand_free(rand);
}

/* A copy taken in the middle goes on to the same bits, with another skin. */
static void test_copy(void)
{
    struct gb_error err = {0};
    struct gb_bed_law law = bed_storakers(0.2, false);
    law.damping = 0.5;
    law.mu = law.mu_wall = 0.1;
    struct gb_bed *bed = cluster(&law, 100);
    struct gb_bed_copy *copy = NULL;
    uint64_t hash[2];
    bed_evaluate(bed, 0.1);
    g_assert_true(gb_bed_copy_take(bed, &copy, &err));
    for (int pass = 0; pass < 2; pass++) {
        if (pass == 1) {
            g_assert_true(gb_bed_copy_restore(bed, copy, &err));
            bed->skin *= 3.0;
        }
        for (int step = 0; step < 50; step++) {
            for (int64_t i = 0; i < bed->count; i++) {
                gb_vec_add(bed->position[i], 0.1, bed->velocity[i]);
            }
            bed_evaluate(bed, 0.1);
            for (int64_t i = 0; i < bed->count; i++) {
                gb_vec_add(bed->velocity[i], 1e-4, bed->force[i]);
            }
        }
        hash[pass] = gb_bed_copy_hash(bed);
    }
    g_assert_true(hash[0] == hash[1]);
    gb_bed_copy_destroy(copy);
    gb_bed_destroy(bed);
}

static bool stop(void *data)
{
    (void)data;
    return true;
}

/* Loose powder: no overlaps, all in the funnel, the same for the same seed. */
static void test_pour(void)
{
    enum { N = 400 };
    struct gb_error err = {0};
    double radius[N];
    const struct gb_bed_law law = bed_law();
    struct gb_die die = bed_die(6.0);
    die.funnel = true;
    die.height = 10.0;
    die.outlet = 4.0;
    die.sine = die.cosine = M_SQRT1_2;
    for (int i = 0; i < N; i++) {
        radius[i] = 0.2 + 0.9 * i / N;
    }
    struct gb_bed *bed = bed_create(N, radius, &die, &law);
    double first = 0.0;
    for (uint64_t seed = 1; seed < 4; seed++) {
        g_assert_true(
            gb_random_insertion_fill(bed, seed < 3 ? 1 : 2, 0.2, NULL, NULL, &err));
        g_assert_true(seed == 1 || (first == bed->position[7][0]) == (seed == 2));
        first = bed->position[7][0];
        bed_evaluate(bed, 0.0);
        g_assert_cmpfloat(bed->tally.stiffest, ==, 0.0); /* nothing touches */
        g_assert_cmpint(gb_bed_escaped(bed), ==, -1);
        for (int i = 0; i < N; i++) {
            g_assert_cmpfloat(bed->position[i][2], >, die.height);
        }
    }
    g_assert_false(gb_random_insertion_fill(bed, 1, 0.2, stop, NULL, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_CANCELLED);
    g_assert_false(
        gb_random_insertion_fill(bed, 1, 0.7, NULL, NULL, &err)); /* too dense */
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    gb_bed_destroy(bed);
}

/* Batches of any length are filled and spilled to the same bits at every vector width. */
static void test_transfer(void)
{
    enum { ROWS = 40, COLUMNS = 5 };
    gb_bed_row row[COLUMNS][ROWS], out[2][2][ROWS];
    int32_t first[GB_BED_BATCH], other[GB_BED_BATCH];
    struct gb_bed_batch batch[2];
    for (int c = 0; c < COLUMNS; c++) {
        for (int i = 0; i < ROWS; i++) {
            for (int k = 0; k < 4; k++) {
                row[c][i][k] = c > 0 && k == 3 ? 0.0 : sin(1.0 + 4.0 * i + 160.0 * c + k);
            }
        }
    }
    for (int k = 0; k < GB_BED_BATCH; k++) {
        first[k] = k * 7 % ROWS;
        other[k] = (k * 11 + 3) % ROWS;
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
                                                 .spin = (const gb_bed_row *)row[2],
                                                 .force = out[wide][0],
                                                 .torque = out[wide][1],
                                                 .first = first,
                                                 .other = other,
                                                 .friction = friction};
                batch[wide].n = n;
                transfer.gather(&rows, &batch[wide]);
                for (int c = 0; c < 3; c++) {
                    for (int k = 0; k < GB_BED_BATCH; k++) {
                        batch[wide].force[c][k] = cos(0.3 * k + c);
                        batch[wide].moment[c][k] = cos(0.7 * k + c);
                    }
                }
                transfer.scatter(&rows, &batch[wide]);
            }
            g_assert_true(memcmp(&batch[0], &batch[1], sizeof batch[0]) == 0);
            g_assert_true(memcmp(out[0], out[1], sizeof out[0]) == 0);
            const int last = n - 1;
            const double *xi = row[0][first[last]], *xj = row[0][other[last]];
            g_assert_cmpfloat(batch[0].reach[last], ==, xi[3] + xj[3]);
            g_assert_cmpfloat(batch[0].branch[2][last], ==, xi[2] - xj[2]);
            g_assert_cmpfloat(batch[0].roll[1][last], ==,
                              friction ? xi[3] * row[2][first[last]][1] +
                                             xj[3] * row[2][other[last]][1]
                                       : 0.0);
        }
    }
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/bed/power", test_power);
    g_test_add_func("/bed/laws", test_laws);
    g_test_add_func("/bed/momentum", test_momentum);
    g_test_add_func("/bed/transfer", test_transfer);
    g_test_add_func("/bed/list", test_list);
    g_test_add_func("/bed/walls", test_walls);
    g_test_add_func("/bed/funnel", test_funnel);
    g_test_add_func("/bed/copy", test_copy);
    g_test_add_func("/bed/pour", test_pour);
    return g_test_run();
}
