#include <math.h>
#include <string.h>

#include <glib.h>

#include "pack/structure/chain_growth.h"
#include "pack/structure/random.h"

static gsl_rng opened(uint64_t seed, enum gb_random_stream stream)
{
    struct gb_error err = {0};
    gsl_rng random;
    g_assert_true(gb_random_open(&random, seed, stream, &err));
    return random;
}

/* Words of 64 bits from two of 32: the upper half is what gsl_rng_get returns, the whole
 * decides the 53 bits of a uniform number. */
static void test_published(void)
{
    /* philox4x32-10 with key 0 and counter 0, known-answer test of its authors:
     * 6627e8d5 e169c58d bc57ac4c 9b00dbd8 */
    gsl_rng random = opened(0, GB_RANDOM_POSITIONS);
    g_assert_cmpuint(gsl_rng_get(&random), ==, 0xe169c58d);
    g_assert_true(gsl_rng_uniform(&random) ==
                  (double)(UINT64_C(0x9b00dbd8bc57ac4c) >> 11) * 0x1p-53);
    gb_random_close(&random);
}

static uint64_t first_of(uint64_t seed, enum gb_random_stream stream)
{
    gsl_rng random = opened(seed, stream);
    const uint64_t first = gsl_rng_get(&random);
    const uint64_t number = first << 32 | gsl_rng_get(&random);
    gb_random_close(&random);
    return number;
}

static void test_bits(void)
{
    for (int k = 0; k < 64; k++) {
        const uint64_t seed = UINT64_C(0x0123456789abcdef);
        g_assert_true(first_of(seed, GB_RANDOM_POSITIONS) !=
                      first_of(seed ^ UINT64_C(1) << k, GB_RANDOM_POSITIONS));
    }
    g_assert_true(first_of(0, GB_RANDOM_POSITIONS) !=
                  first_of(4357, GB_RANDOM_POSITIONS));
    g_assert_true(first_of(1, GB_RANDOM_POSITIONS) != first_of(1, GB_RANDOM_SIZES));
}

/* Mean, variance and serial correlation of 10^6 numbers within 4.5 standard errors. */
static void test_uniform(void)
{
    enum { COUNT = 1000000 };
    gsl_rng random = opened(7, GB_RANDOM_POSITIONS);
    double sum = 0.0, squares = 0.0, products = 0.0, before = 0.5;
    for (int i = 0; i < COUNT; i++) {
        const double x = gsl_rng_uniform(&random);
        g_assert_true(x >= 0.0 && x < 1.0);
        sum += x - 0.5;
        squares += (x - 0.5) * (x - 0.5);
        products += (x - 0.5) * (before - 0.5);
        before = x;
    }
    gb_random_close(&random);
    g_assert_cmpfloat(fabs(sum / COUNT), <, 4.5 * sqrt(1.0 / 12.0 / COUNT));
    g_assert_cmpfloat(fabs(squares / COUNT - 1.0 / 12.0), <,
                      4.5 * sqrt(1.0 / 180.0 / COUNT));
    g_assert_cmpfloat(fabs(products / COUNT), <, 4.5 / 12.0 / sqrt(COUNT));
}

/* All of these seeds are one when their halves are folded to 32 bits. */
static uint64_t colliding(uint64_t k)
{
    return k << 32 | (k ^ 0x5eed);
}

static int compare(const void *a, const void *b)
{
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

/* FNV-1a over the bytes of the positions. */
static uint64_t packing_hash(uint64_t seed)
{
    enum { COUNT = 3 };
    const struct gb_chain_growth grow = {.dimension = 3,
                                         .count = COUNT,
                                         .edges = {3.0, 3.0, 3.0},
                                         .r_eq = 1.0,
                                         .r_meso = 2.0,
                                         .seed = seed};
    double position[3 * COUNT];
    struct gb_error err = {0};
    g_assert_true(gb_chain_growth_run(&grow, position, &err));
    guint8 bytes[sizeof position];
    memcpy(bytes, position, sizeof bytes);
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    for (size_t i = 0; i < sizeof bytes; i++) {
        hash = (hash ^ bytes[i]) * UINT64_C(0x100000001b3);
    }
    return hash;
}

static size_t equal_packings(size_t count)
{
    uint64_t *hash = g_new(uint64_t, count);
    for (size_t k = 0; k < count; k++) {
        hash[k] = packing_hash(colliding(k));
    }
    qsort(hash, count, sizeof *hash, compare);
    size_t equal = 0;
    for (size_t k = 1; k < count; k++) {
        equal += hash[k] == hash[k - 1];
    }
    g_free(hash);
    return equal;
}

static void test_million_seeds(void)
{
    g_assert_cmpuint(equal_packings(1000000), ==, 0);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/random/published", test_published);
    g_test_add_func("/random/bits", test_bits);
    g_test_add_func("/random/uniform", test_uniform);
    g_test_add_func("/random/million-seeds", test_million_seeds);
    return g_test_run();
}
