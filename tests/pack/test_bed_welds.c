#include <math.h>
#include <string.h>

#include <glib.h>

#include "base/vec.h"
#include "common/bed.h"
#include "pack/die/bed_record.h"
#include "pack/die/bed_welds.h"

/* Cold welds of two spheres in a wide die without gravity. */

static const double overlap = 0.01, strength = 0.01;

/* Two spheres of radius 0.5 and 0.4 along x, welded at the overlap. */
static struct gb_bed *welded_pair(const struct gb_bed_law *law)
{
    const struct gb_die die = bed_die(10.0);
    const double radius[2] = {0.5, 0.4};
    struct gb_error err = {0};
    struct gb_bed *bed = bed_create(2, radius, &die, law);
    bed_set_position(bed, 0, 0.0, 0.0, 5.0);
    bed_set_position(bed, 1, 0.9 - overlap, 0.0, 5.0);
    bed_evaluate(bed, 0.0);
    if (!gb_bed_welds_form(bed, strength, &err)) {
        g_error("%s", err.text);
    }
    g_assert_cmpint((int)bed->welds->count, ==, 1);
    return bed;
}

static double radius_of(const struct gb_bed_law *law, double h)
{
    const double star = gb_law_hertz_radius(0.5, 0.4);
    const double m = law->normal.exponent;
    const double c = pow(1.43 * exp(-0.97 * m), 1.0 / (2.0 + m)); /* P3 (17) */
    return law->storakers ? c * sqrt(2.0 * star * h) : sqrt(star * h);
}

static double pull(struct gb_bed *bed, double gap)
{
    bed_set_position(bed, 1, 0.9 + gap, 0.0, 5.0);
    bed_evaluate(bed, 0.0);
    return bed->force[0][0];
}

/* Nothing while the contact is pressed; a flat punch beyond; gone for good above its
 * strength. */
static void test_tension(void)
{
    const struct gb_bed_law law = bed_law();
    struct gb_bed *bed = welded_pair(&law);
    const double a = radius_of(&law, overlap);
    const double stiffness = 2.0 * law.normal.hertz.modulus * a;
    const double limit = strength * M_PI * a * a / stiffness;
    const double star = gb_law_hertz_radius(0.5, 0.4);
    g_assert_cmpfloat_with_epsilon(bed->welds->radius[0], a, 1e-9);
    g_assert_cmpfloat_with_epsilon(
        pull(bed, -0.004) / -gb_law_hertz_force(&law.normal.hertz, star, 0.004), 1.0,
        1e-9);
    g_assert_cmpfloat(fabs(pull(bed, 0.0)), <, 1e-12);
    g_assert_cmpfloat_with_epsilon(pull(bed, 0.5 * limit) / (0.5 * limit * stiffness),
                                   1.0, 1e-9);
    g_assert_cmpfloat(bed->force[1][0], ==, -bed->force[0][0]);
    g_assert_cmpfloat_with_epsilon(gb_bed_welds_energy(bed),
                                   0.5 * stiffness * 0.25 * limit * limit, 1e-12);
    g_assert_cmpfloat(pull(bed, 0.99 * limit), >, 0.0);
    g_assert_cmpfloat(gb_bed_welds_share(bed), ==, 1.0);
    g_assert_cmpfloat(pull(bed, 1.01 * limit), ==, 0.0);
    g_assert_cmpfloat(gb_bed_welds_share(bed), ==, 0.0);
    g_assert_cmpfloat(pull(bed, 0.5 * limit), ==, 0.0);
    gb_bed_destroy(bed);
}

/* A plastic contact opens at its permanent overlap: tension begins there. */
static void test_plastic(void)
{
    const struct gb_bed_law law = bed_storakers(0.0, false);
    struct gb_bed *bed = welded_pair(&law);
    const double rest = bed->pairs.contacts.permanent[0];
    g_assert_cmpfloat(rest, >, 0.1 * overlap);
    g_assert_cmpfloat_with_epsilon(bed->welds->radius[0], radius_of(&law, overlap), 1e-9);
    g_assert_cmpfloat(fabs(pull(bed, -rest)), <, 1e-9);
    g_assert_cmpfloat(pull(bed, -rest + 1e-5), >, 0.0);
    gb_bed_destroy(bed);
}

/* Across: Mindlin's spring up to its plastic limit, with torques on both that keep the
 * angular momentum. */
static void test_shear(void)
{
    const struct gb_bed_law law = bed_law();
    struct gb_bed *bed = welded_pair(&law);
    const double a = radius_of(&law, overlap), step = 1e-3;
    const double stiffness = 8.0 * law.normal.hertz.shear * a;
    const double limit = strength * M_PI * a * a / sqrt(3.0);
    bed->velocity[0][1] = 0.3 * limit / stiffness / step;
    bed_evaluate(bed, step);
    g_assert_cmpfloat_with_epsilon(bed->force[0][1] / (-0.3 * limit), 1.0, 1e-9);
    double total[3] = {0.0, 0.0, 0.0};
    for (int i = 0; i < 2; i++) {
        double moment[3];
        gb_vec_cross(bed->position[i], bed->force[i], moment);
        gb_vec_add(total, 1.0, moment);
        gb_vec_add(total, bed->position[i][3], bed->moment[i]);
    }
    g_assert_cmpfloat(gb_vec_length(total), <, 1e-12);
    for (int k = 0; k < 10; k++) {
        bed_evaluate(bed, step);
    }
    g_assert_cmpfloat_with_epsilon(bed->force[0][1] / -limit, 1.0, 1e-9);
    g_assert_cmpfloat(gb_bed_welds_share(bed), ==, 1.0);
    /* rolling like gears slides nowhere */
    const double held = bed->force[0][1];
    bed->velocity[0][1] = 0.0;
    bed->roll[0][2] = 0.01;
    bed->roll[1][2] = -0.01;
    bed_evaluate(bed, step);
    g_assert_cmpfloat_with_epsilon(bed->force[0][1] / held, 1.0, 1e-9);
    gb_bed_destroy(bed);
}

/* Copies and records give the welds back. */
static void test_copies(void)
{
    static struct gb_record record;
    const struct gb_bed_law law = bed_law();
    struct gb_error err = {0};
    struct gb_bed *bed = welded_pair(&law);
    struct gb_bed_copy *copy = NULL;
    pull(bed, 1e-5);
    const uint64_t hash = gb_bed_record_hash(bed);
    g_assert_true(gb_bed_record_take(bed, &copy, &err));
    g_assert_true(gb_bed_welds_record(bed, &record, &err));
    pull(bed, 0.1);
    g_assert_cmpint((int)bed->welds->count, ==, 0);
    g_assert_true(gb_bed_record_restore(bed, copy, &err));
    g_assert_true(gb_bed_record_hash(bed) == hash);
    gb_bed_welds_destroy(bed->welds);
    bed->welds = NULL;
    g_assert_true(gb_bed_record_hash(bed) != hash);
    record.loading = true;
    g_assert_true(gb_bed_welds_record(bed, &record, &err));
    g_assert_true(gb_bed_record_hash(bed) == hash);
    ((int32_t *)gb_record_find(&record, "welds/second")->data)[0] = 7;
    g_assert_false(gb_bed_welds_record(bed, &record, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    gb_record_finish(&record);
    gb_bed_record_destroy(copy);
    gb_bed_destroy(bed);
}

/* The open end of a bore: from its wall over the rim to the top of the block without a
 * step in overlap or direction. */
static void test_bore(void)
{
    struct gb_die die = bed_die(3.0);
    double unit[3], before[3] = {0.0, 0.0, 0.0}, last = 0.0;
    die.bore = GB_DIE_BORE_OPEN;
    die.top = 2.0;
    for (int k = 0; k <= 400; k++) { /* an arc about the rim */
        const double angle = M_PI + -1.9 * M_PI / 2.0 * k / 400.0;
        const double x[3] = {3.0 + 0.3 * cos(angle), 0.0, 2.0 + 0.3 * sin(angle)};
        const double h = gb_die_overlap(&die, GB_DIE_SIDE, x, 0.4, unit);
        if (k > 0 && x[2] > 2.0) {
            const double change[3] = {unit[0] - before[0], unit[1] - before[1],
                                      unit[2] - before[2]};
            g_assert_cmpfloat(gb_vec_length(change), <, 0.02);
            g_assert_cmpfloat(fabs(h - last), <, 0.01);
        }
        last = h;
        memcpy(before, unit, sizeof before);
    }
    g_assert_true(gb_die_contains(&die, (double[3]){5.0, 0.0, 2.1}));
    g_assert_false(gb_die_contains(&die, (double[3]){5.0, 0.0, 1.9}));
    die.bore = GB_DIE_BORE_GONE;
    g_assert_true(gb_die_contains(&die, (double[3]){5.0, 0.0, 1.9}));
    g_assert_cmpfloat(
        gb_die_overlap(&die, GB_DIE_SIDE, (double[3]){2.9, 0.0, 1.0}, 0.4, unit), ==,
        -INFINITY);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/welds/tension", test_tension);
    g_test_add_func("/welds/plastic", test_plastic);
    g_test_add_func("/welds/shear", test_shear);
    g_test_add_func("/welds/copies", test_copies);
    g_test_add_func("/welds/bore", test_bore);
    return g_test_run();
}
