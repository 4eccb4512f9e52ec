/* Blocks of a bed on threads, and its numbering. */
#include <glib.h>
#include <math.h>
#include <string.h>

#include "base/vec.h"
#include "common/bed.h"
#include "pack/die/bed_list.h"
#include "pack/die/bed_record.h"
#include "pack/die/bed_sweep.h"

enum { COUNT = 700, STEPS = 300 };

static struct gb_bed_law rough(void)
{
    struct gb_bed_law law = bed_storakers(0.1, false);
    law.damping = 0.9;
    law.mu = 0.3;
    law.mu_wall = 0.2;
    return law;
}

/* Overlapping spheres of many sizes on the floor of a die, under a punch, in motion. */
static struct gb_bed *powder(void)
{
    double radius[COUNT];
    GRand *rand = g_rand_new_with_seed(5);
    struct gb_bed_law law = rough();
    struct gb_die die = bed_die(4.5);
    die.punch = true;
    die.punch_position = 12.0;
    die.punch_velocity = -0.02;
    for (int i = 0; i < COUNT; i++) {
        radius[i] = 0.2 + 0.4 * g_rand_double(rand);
    }
    struct gb_bed *bed = bed_create(COUNT, radius, &die, &law);
    for (int i = 0; i < COUNT; i++) {
        const double angle = 2.0 * M_PI * g_rand_double(rand);
        const double rho = 4.1 * sqrt(g_rand_double(rand));
        bed_set_position(bed, i, rho * cos(angle), rho * sin(angle),
                         0.4 + 11.2 * g_rand_double(rand));
        for (int k = 0; k < 3; k++) {
            bed->velocity[i][k] = 1e-2 * (g_rand_double(rand) - 0.5);
            bed->roll[i][k] = 1e-2 * (g_rand_double(rand) - 0.5);
        }
    }
    g_rand_free(rand);
    return bed;
}

/* The blocks have every particle once, and are enough for threads. */
static void test_sizes(void)
{
    static const struct {
        int64_t particles, size;
    } want[] = {{1, 128},    {128, 128},  {1751, 128}, {3071, 128},  {3072, 256},
                {6143, 256}, {6144, 512}, {8000, 512}, {100000, 512}};
    for (size_t k = 0; k < G_N_ELEMENTS(want); k++) {
        struct gb_bed_blocks blocks;
        struct gb_error err = {0};
        int64_t end = 0;
        g_assert_true(gb_bed_blocks_init(&blocks, want[k].particles, &err));
        g_assert_cmpint(blocks.size, ==, want[k].size);
        for (int64_t b = 0; b < blocks.count; b++) {
            g_assert_cmpint(gb_bed_blocks_begin(want[k].particles, b), ==, end);
            end = gb_bed_blocks_end(want[k].particles, b);
        }
        g_assert_cmpint(end, ==, want[k].particles);
        gb_bed_blocks_finish(&blocks);
    }
}

/* Steps of central differences with a drag that keeps the powder together. */
static void move(struct gb_bed *bed, int steps)
{
    const double step = 0.02;
    struct gb_error err = {0};
    for (int n = 0; n < steps; n++) {
        const double deviation2 = gb_bed_sweep_drift(bed, step);
        bed->die.punch_position += step * bed->die.punch_velocity;
        g_assert_true(gb_bed_evaluate_blocks(bed, step, deviation2, &err));
        const struct gb_bed_batch_kick by = {.force = (const gb_bed_row *)bed->force,
                                             .moment = (const gb_bed_row *)bed->moment,
                                             .inverse_mass = bed->inverse_mass,
                                             .inertia = bed->inertia,
                                             .step = step,
                                             .drag = 2.0};
        gb_bed_sweep_kick(bed, &by);
    }
}

/* The same bits, forces on the walls included, for any number of threads. */
static void test_threads(void)
{
    static const int threads[] = {1, 2, 3, 7};
    uint64_t first = 0;
    struct gb_bed_tally tally = {0};
    for (size_t t = 0; t < G_N_ELEMENTS(threads); t++) {
        struct gb_error err = {0};
        struct gb_bed *bed = powder();
        g_assert_true(gb_bed_use_threads(bed, threads[t], &err));
        move(bed, STEPS);
        const uint64_t hash = gb_bed_record_hash(bed);
        g_assert_cmpint(bed->blocks.crossing[bed->blocks.count], >, COUNT / 10);
        g_assert_cmpfloat(bed->tally.floor, >, 0.0);
        g_assert_cmpfloat(bed->tally.punch, >, 0.0);
        if (t == 0) {
            first = hash;
            tally = bed->tally;
        }
        g_assert_cmpuint(hash, ==, first);
        g_assert_true(memcmp(&bed->tally, &tally, sizeof tally) == 0);
        gb_bed_destroy(bed);
    }
}

/* Forces by blocks are those of a sum over all contacts. */
static void test_crossings(void)
{
    struct gb_bed *bed = powder();
    struct gb_error err = {0};
    move(bed, 20);
    g_assert_true(gb_bed_evaluate(bed, 0.02, HUGE_VAL, &err));
    double sum[COUNT][3] = {{0.0}}, largest = 0.0;
    for (int64_t slot = 0; slot < bed->pairs.count; slot++) {
        const struct gb_bed_contacts *c = &bed->pairs.contacts;
        const int32_t i = bed->pairs.first[slot], j = bed->pairs.other[slot];
        double unit[3];
        for (int k = 0; k < 3; k++) {
            unit[k] = bed->position[i][k] - bed->position[j][k];
        }
        gb_vec_scale(unit, 1.0 / gb_vec_length(unit));
        for (int k = 0; k < 3 && c->normal[slot] >= 0.0; k++) {
            const double force = c->normal[slot] * unit[k] + c->shear[k][slot];
            sum[i][k] += force;
            sum[j][k] -= force;
        }
    }
    for (int64_t slot = 0; slot < bed->walls.count; slot++) {
        const struct gb_bed_contacts *c = &bed->walls.contacts;
        const int32_t i = bed->walls.first[slot];
        double unit[3];
        gb_die_overlap(&bed->die, (enum gb_die_wall)bed->walls.other[slot],
                       bed->position[i], bed->position[i][3], unit);
        for (int k = 0; k < 3 && c->normal[slot] >= 0.0; k++) {
            sum[i][k] += c->normal[slot] * unit[k] + c->shear[k][slot];
        }
    }
    for (int i = 0; i < COUNT; i++) {
        largest = fmax(largest, gb_vec_length(sum[i]));
    }
    for (int i = 0; i < COUNT; i++) {
        for (int k = 0; k < 3; k++) {
            g_assert_cmpfloat_with_epsilon(bed->force[i][k], sum[i][k], 1e-13 * largest);
        }
    }
    gb_bed_destroy(bed);
}

/* Sums that no numbering changes but for rounding. */
struct sums {
    double force, moment, shear, deepest, x, roll;
    int64_t touching;
};

static void add_list(struct sums *sums, const struct gb_bed_list *list)
{
    const struct gb_bed_contacts *c = &list->contacts;
    for (int64_t slot = 0; slot < list->count; slot++) {
        if (c->normal[slot] >= 0.0) {
            const double shear[3] = {c->shear[0][slot], c->shear[1][slot],
                                     c->shear[2][slot]};
            sums->shear += gb_vec_length(shear);
            sums->deepest += c->deepest[slot];
            sums->touching++;
        }
    }
}

static struct sums sums_of(struct gb_bed *bed)
{
    struct sums sums = {0};
    struct gb_error err = {0};
    g_assert_true(gb_bed_evaluate(bed, 0.02, HUGE_VAL, &err));
    for (int64_t i = 0; i < bed->count; i++) {
        sums.force += gb_vec_length(bed->force[i]) / bed->mass[i];
        sums.moment += gb_vec_length(bed->moment[i]) * bed->inverse_mass[i];
        sums.x += gb_vec_length(bed->position[i]) * bed->position[i][3];
        sums.roll += gb_vec_length(bed->roll[i]);
    }
    add_list(&sums, &bed->pairs);
    add_list(&sums, &bed->walls);
    return sums;
}

static double mean_stride(const struct gb_bed *bed)
{
    double sum = 0.0;
    for (int64_t slot = 0; slot < bed->pairs.count; slot++) {
        sum += bed->pairs.other[slot] - bed->pairs.first[slot];
    }
    return sum / (double)bed->pairs.count;
}

/* New numbers keep particles and histories: shear springs point the other way where the first
 * particle of a pair has become the second. */
static void test_numbers(void)
{
    struct gb_bed *bed = powder(), *other = powder();
    struct gb_error err = {0};
    move(bed, 40);
    move(other, 40);
    g_assert_true(gb_bed_list_renumber(bed, &err));
    for (int n = 0; n < 3; n++) {
        const struct sums a = sums_of(bed), b = sums_of(other);
        const double *x = &a.force, *y = &b.force;
        for (int k = 0; k < 6; k++) {
            g_assert_cmpfloat(y[k], >, 0.0);
            g_assert_cmpfloat_with_epsilon(x[k], y[k], 1e-11 * y[k]);
        }
        g_assert_cmpint(a.touching, ==, b.touching);
        g_assert_cmpint(a.touching, >, COUNT);
    }
    g_assert_cmpfloat(mean_stride(bed), <, 0.5 * mean_stride(other));
    gb_bed_destroy(bed);
    gb_bed_destroy(other);
}

/* A copy from before restores the old numbers. */
static void test_numbers_copy(void)
{
    struct gb_bed *bed = powder();
    struct gb_bed_copy *copy = NULL;
    struct gb_error err = {0};
    move(bed, 40);
    const struct sums before = sums_of(bed);
    g_assert_true(gb_bed_record_take(bed, &copy, &err));
    const uint64_t hash = gb_bed_record_hash(bed);
    g_assert_true(gb_bed_list_renumber(bed, &err));
    g_assert_cmpuint(gb_bed_record_hash(bed), !=, hash);
    g_assert_true(gb_bed_record_restore(bed, copy, &err));
    g_assert_cmpuint(gb_bed_record_hash(bed), ==, hash);
    g_assert_cmpfloat_with_epsilon(sums_of(bed).x, before.x, 1e-12 * before.x);
    for (int64_t i = 0; i < bed->count; i++) {
        const double d = 2.0 * bed->position[i][3];
        g_assert_cmpfloat(bed->mass[i], ==, d * d * d);
    }
    gb_bed_record_destroy(copy);
    gb_bed_destroy(bed);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/bed-blocks/sizes", test_sizes);
    g_test_add_func("/bed-blocks/threads", test_threads);
    g_test_add_func("/bed-blocks/crossings", test_crossings);
    g_test_add_func("/bed-blocks/numbers", test_numbers);
    g_test_add_func("/bed-blocks/numbers-copy", test_numbers_copy);
    return g_test_run();
}
