#include <glib.h>
#include <math.h>
#include <string.h>

#include "base/vec.h"
#include "common/bed.h"
#include "pack/die/bed_sweep.h"
#include "pack/die/bed_record.h"
#include "pack/die/filling.h"

/* A cluster of overlapping spheres far from all walls, in motion and rotation. */
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
            bed->roll[i][k] = 1e-2 * (g_rand_double(rand) - 0.5);
        }
    }
    g_rand_free(rand);
    g_free(radius);
    return bed;
}

/* Momentum and angular momentum: the sum of the forces is 0, and that of the torques and
 * of the moments of the forces. */
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
        gb_vec_add(torque, bed->position[i][3], bed->moment[i]);
        sum += gb_vec_length(bed->force[i]);
    }
    g_assert_cmpfloat(sum, >, 1.0);
    g_assert_cmpfloat(gb_vec_length(force), <, 1e-13 * sum);
    g_assert_cmpfloat(gb_vec_length(torque), <, 1e-12 * sum * 20.0);
    gb_bed_destroy(bed);
}

/* The deepest pair, in diameters of the smaller one. */
static void test_deepest(void)
{
    const struct gb_bed_law law = bed_storakers(0.1, false);
    const struct gb_die die = bed_die(20.0);
    for (double ratio = 1.0; ratio < 9.0; ratio *= 2.0) {
        const double radius[3] = {0.5 * ratio, 0.5, 0.5};
        int64_t pair[2] = {-1, -1};
        struct gb_bed *bed = bed_create(3, radius, &die, &law);
        bed_set_position(bed, 0, 0.0, 0.0, 10.0);
        bed_set_position(bed, 1, 0.5 * ratio + 0.5 - 0.6, 0.0, 10.0);
        bed_set_position(bed, 2, 0.0, 0.0, 10.0 + 0.5 * ratio + 0.45);
        bed_evaluate(bed, 0.0);
        g_assert_cmpfloat_with_epsilon(gb_bed_deepest(bed, pair), 0.6, 1e-12);
        g_assert_cmpint(pair[0] + pair[1], ==, 1);
        gb_bed_destroy(bed);
    }
}

static struct gb_record_item *item_of(struct gb_record *record, const char *name)
{
    int k = 0;
    while (strcmp(record->item[k].name, name) != 0) {
        k++;
    }
    return &record->item[k];
}

/* Records give the bed back to the last bit, or name what does not fit. */
static void test_records(void)
{
    static struct gb_record record;
    struct gb_bed_law law = bed_storakers(0.1, false);
    struct gb_error err = {0};
    law.mu = 0.3;
    struct gb_bed *bed = cluster(&law, 200), *same = cluster(&law, 200);
    bed_evaluate(bed, 0.3);
    bed_evaluate(bed, 0.3);
    g_assert_true(gb_bed_record(bed, &record, &err));
    record.loading = true;
    g_assert_true(gb_bed_record(same, &record, &err));
    const size_t bytes = 200 * sizeof *bed->roll;
    g_assert_true(memcmp(same->roll, bed->roll, bytes) == 0);
    g_assert_true(memcmp(same->moment, bed->moment, bytes) == 0);
    item_of(&record, "bed/moment")->rows = 199;
    g_assert_false(gb_bed_record(same, &record, &err));
    g_assert_nonnull(strstr(err.text, "bed/moment"));
    item_of(&record, "bed/moment")->rows = 200;
    g_assert_true(gb_bed_record(same, &record, &err));
    *(double *)item_of(&record, "bed/skin")->data = (double)NAN;
    g_assert_false(gb_bed_record(same, &record, &err));
    g_assert_nonnull(strstr(err.text, "bed/skin"));
    gb_record_finish(&record);
    gb_bed_destroy(same);
    gb_bed_destroy(bed);
}

/* The list has the contacts that a scan of all pairs finds; returns their number. */
static int64_t check_list(const struct gb_bed *bed)
{
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
    return touching;
}

static void test_list(void)
{
    const struct gb_bed_law law = bed_law();
    struct gb_bed *bed = cluster(&law, 300);
    bed_evaluate(bed, 0.0);
    g_assert_cmpint(check_list(bed), >, 300);
    gb_bed_destroy(bed);
}

/* The same at every step of particles that fly apart and come back faster: the list of pairs is
 * drawn often, from candidates that are built rarely. */
static void test_moving_list(void)
{
    enum { STEPS = 3280, PERIOD = 410, SLOW = 307 };
    const struct gb_bed_law law = bed_law();
    struct gb_error err = {0};
    struct gb_bed *bed = cluster(&law, 200);
    int64_t drawn = 0, least = INT64_MAX, most = 0;
    for (int step = 0; step < STEPS; step++) {
        const double factor = step % PERIOD == SLOW            ? -3.0
                              : step > 0 && step % PERIOD == 0 ? -1.0 / 3.0
                                                               : 1.0;
        const int64_t listed = bed->listed_evaluation;
        for (int64_t i = 0; i < bed->count; i++) {
            gb_vec_scale(bed->velocity[i], factor);
        }
        g_assert_true(gb_bed_evaluate(bed, 1.0, gb_bed_sweep_drift(bed, 1.0), &err));
        drawn += bed->listed_evaluation != listed;
        const int64_t touching = check_list(bed);
        least = MIN(least, touching);
        most = MAX(most, touching);
    }
    g_test_message("%d steps, %lld lists from %lld builds, %lld to %lld contacts", STEPS,
                   (long long)drawn, (long long)bed->rebuilds, (long long)least,
                   (long long)most);
    g_assert_cmpint(most, >, least + 50);
    g_assert_cmpint(drawn, >, bed->rebuilds + bed->rebuilds / 2);
    g_assert_cmpint(bed->rebuilds, >, 3);
    gb_bed_destroy(bed);
}

/* A sphere and the punch that come closer, the sphere by a share of the way: in contact as
 * soon as they overlap. */
static void test_moving_punch(void)
{
    const double radius = 0.5, step = 0.003;
    const struct gb_bed_law law = bed_law();
    struct gb_error err = {0};
    for (int pass = 0; pass < 400; pass++) {
        const int share = pass % 11;
        struct gb_die die = bed_die(4.0);
        die.punch = true;
        die.punch_position = 5.0 + 0.00731 * pass;
        struct gb_bed *bed = bed_create(1, &radius, &die, &law);
        bed_set_position(bed, 0, 0.0, 0.0, 2.0);
        double overlap = -1.0;
        while (overlap < 0.1) {
            const double by = 0.1 * share * step;
            bed->velocity[0][2] = by;
            bed->die.punch_position -= step - by;
            g_assert_true(gb_bed_evaluate(bed, 1.0, gb_bed_sweep_drift(bed, 1.0), &err));
            overlap = bed->position[0][2] + radius - bed->die.punch_position;
            g_assert_cmpint(overlap > 0.0, ==, bed->tally.punch > 0.0);
        }
        gb_bed_destroy(bed);
    }
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

/* The overlap is the radius minus the distance to the nearest wall point, found by trying
 * many; unit points from there to the centre. */
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
        for (int k = 0; k < 3; k++) { /* the nearest point lies on the wall */
            foot[k] = x[k] - (1.0 - h) * unit[k];
        }
        g_assert_cmpfloat(fabs(gb_die_overlap(&die, GB_DIE_FUNNEL, foot, 0.0, unit)), <,
                          1e-9);
    }
    g_rand_free(rand);
}

/* A run continued from a copy has the same bits, also with another skin. */
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
    g_assert_true(gb_bed_record_take(bed, &copy, &err));
    for (int pass = 0; pass < 2; pass++) {
        if (pass == 1) {
            g_assert_true(gb_bed_record_restore(bed, copy, &err));
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
        hash[pass] = gb_bed_record_hash(bed);
    }
    g_assert_true(hash[0] == hash[1]);
    gb_bed_record_destroy(copy);
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
    const uint64_t seeds[] = {1, 1, 2};
    for (int i = 0; i < 3; i++) {
        g_assert_true(gb_filling_fill(bed, seeds[i], 0.2, NULL, NULL, &err));
        g_assert_true(i == 0 || (first == bed->position[7][0]) == (i == 1));
        first = bed->position[7][0];
        bed_evaluate(bed, 0.0);
        g_assert_cmpfloat(bed->tally.stiffest, ==, 0.0); /* nothing touches */
        g_assert_cmpint(gb_bed_escaped(bed), ==, -1);
        for (int k = 0; k < N; k++) {
            g_assert_cmpfloat(bed->position[k][2], >, die.height);
        }
    }
    g_assert_false(gb_filling_fill(bed, seeds[0], 0.2, stop, NULL, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_CANCELLED);
    g_assert_false(
        gb_filling_fill(bed, seeds[0], 0.7, NULL, NULL, &err)); /* too dense */
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    gb_bed_destroy(bed);
}

/* The floor's contact of the only sphere, at a height and a speed along x, after a step. */
static double shear_at(struct gb_bed *bed, double height, double speed)
{
    struct gb_error err = {0};
    bed->position[0][2] = height;
    bed->velocity[0][0] = speed;
    g_assert_true(gb_bed_evaluate(bed, 0.1, 1e-4, &err));
    g_assert_cmpint(bed->walls.count, ==, 1);
    return bed->walls.contacts.shear[0][0];
}

/* A contact that opens and closes again between two list builds begins as one that has never
 * been listed, to the sign of a zero: states of a resumed run have the same bits. */
static void test_reopened(void)
{
    const double radius = 0.5;
    const struct gb_die die = bed_die(50.0);
    struct gb_bed_law law = bed_law();
    law.mu_wall = 0.3;
    struct gb_bed *listed = bed_create(1, &radius, &die, &law);
    struct gb_bed *fresh = bed_create(1, &radius, &die, &law);
    for (int sign = -1; sign <= 1; sign += 2) {
        g_assert_cmpfloat(sign * shear_at(listed, 0.49, sign * 1e-3), <, 0.0);
        g_assert_false(signbit(shear_at(listed, 0.501, sign * 1e-3)));
        gb_bed_set_law(fresh, &law);
        const double again = shear_at(listed, 0.49, 0.0),
                     first = shear_at(fresh, 0.49, 0.0);
        g_assert_cmpfloat(again, ==, 0.0);
        g_assert_cmpint(signbit(again), ==, signbit(first));
    }
    g_assert_cmpint(listed->rebuilds, ==, 1);
    gb_bed_destroy(listed);
    gb_bed_destroy(fresh);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/bed/momentum", test_momentum);
    g_test_add_func("/bed/deepest", test_deepest);
    g_test_add_func("/bed/records", test_records);
    g_test_add_func("/bed/list", test_list);
    g_test_add_func("/bed/moving-list", test_moving_list);
    g_test_add_func("/bed/moving-punch", test_moving_punch);
    g_test_add_func("/bed/walls", test_walls);
    g_test_add_func("/bed/funnel", test_funnel);
    g_test_add_func("/bed/copy", test_copy);
    g_test_add_func("/bed/reopened", test_reopened);
    g_test_add_func("/bed/pour", test_pour);
    return g_test_run();
}
