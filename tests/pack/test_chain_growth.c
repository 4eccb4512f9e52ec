#include "common/packing.h"

/* Twice the number of contacts, exactly. */
static int64_t contact_ends(const struct gb_connectivity *found, int64_t count)
{
    return llround(found->coordination * (double)count);
}

/* The second particle brings one contact, every later one two. */
static void test_contacts_exact(void)
{
    const int64_t counts[] = {2, 3, 10, 200, 500};
    for (size_t i = 0; i < G_N_ELEMENTS(counts); i++) {
        struct packing packing;
        /* a cube of 6 d, or higher where the particles are many */
        const double density = fmin(0.24, (double)counts[i] * G_PI / 6.0 / 216.0);
        packing_make(&packing, 3, counts[i], 6.0, density, 0.0, i);
        const struct gb_connectivity found = packing_contacts(&packing);
        g_assert_cmpint(contact_ends(&found, counts[i]), ==, 4 * counts[i] - 6);
        g_assert_cmpint(found.clusters, ==, 1);
        packing_finish(&packing);
    }
}

/* With single contacts fewer: each particle brings one at least, and none overlaps. */
static void test_single_contacts(void)
{
    const int64_t count = 400;
    for (int dimension = 2; dimension <= 3; dimension++) {
        double before = INFINITY;
        for (double share = 0.0; share <= 1.0; share += 0.25) {
            struct packing packing;
            packing_init(&packing, dimension, count, 7.0, dimension == 3 ? 0.24 : 0.4,
                         0.0, 3);
            packing.grow.single_contact = share;
            g_assert_true(gb_chain_growth_run(&packing.grow, packing.position, NULL));
            const struct gb_connectivity found = packing_contacts(&packing);
            const double expected = 2.0 * (2.0 - share);
            g_test_message("%dD, share %g: coordination %.3f", dimension, share,
                           found.coordination);
            g_assert_cmpint(found.clusters, ==, 1);
            g_assert_cmpint(contact_ends(&found, count), >=, 2 * (count - 1));
            g_assert_cmpfloat(found.coordination, <, before);
            /* in the plane hexagons close */
            g_assert_cmpfloat(found.coordination, >, expected - 0.15);
            g_assert_cmpfloat(found.coordination, <,
                              expected + (dimension == 3 ? 0.15 : 0.6));
            before = found.coordination;
            packing_finish(&packing);
        }
    }
}

/* Shortest distance of two particles, images included. */
static double nearest(const struct packing *packing)
{
    double least = INFINITY;
    for (int64_t i = 0; i < packing->grow.count; i++) {
        for (int64_t j = 0; j < i; j++) {
            double r[3];
            for (int k = 0; k < 3; k++) {
                r[k] = packing->position[3 * i + k] - packing->position[3 * j + k];
            }
            gb_cell_nearest(&packing->cell, r);
            least = fmin(least, sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]));
        }
    }
    return least;
}

static void test_no_overlap(void)
{
    for (int dimension = 2; dimension <= 3; dimension++) {
        struct packing packing;
        packing_make(&packing, dimension, 400, 7.0, dimension == 3 ? 0.3 : 0.5,
                     packing_h_eq, 5);
        const double r_eq = packing.grow.r_eq;
        g_assert_cmpfloat(nearest(&packing), >=, r_eq * (1.0 - 1e-9));
        g_assert_cmpfloat(nearest(&packing), <=, r_eq * (1.0 + 1e-9));
        for (int64_t i = 0; i < 3 * packing.grow.count; i++) {
            g_assert_cmpfloat(packing.position[i], >=, 0.0);
            g_assert_cmpfloat(packing.position[i], <, packing.cell.edge[i % 3]);
            g_assert_true(dimension == 3 || i % 3 != 1 || packing.position[i] == 0.0);
        }
        packing_finish(&packing);
    }
}

static bool same_bits(const struct packing *a, const struct packing *b)
{
    return memcmp(a->position, b->position, (size_t)a->grow.count * 3 * sizeof(double)) ==
           0;
}

static void test_seed(void)
{
    const uint64_t seeds[] = {1, 2, 1u + (UINT64_C(1) << 40)};
    for (int dimension = 2; dimension <= 3; dimension++) {
        struct packing first, again, other;
        packing_make(&first, dimension, 300, 6.0, 0.24, 0.0, seeds[0]);
        packing_make(&again, dimension, 300, 6.0, 0.24, 0.0, seeds[0]);
        g_assert_true(same_bits(&first, &again));
        for (size_t i = 1; i < G_N_ELEMENTS(seeds); i++) {
            packing_make(&other, dimension, 300, 6.0, 0.24, 0.0, seeds[i]);
            g_assert_false(same_bits(&first, &other));
            packing_finish(&other);
        }
        packing_finish(&again);
        packing_finish(&first);
    }
}

static void test_too_dense(void)
{
    for (int dimension = 2; dimension <= 3; dimension++) {
        struct packing packing;
        struct gb_error err = {0};
        packing_init(&packing, dimension, 500, 6.0, dimension == 3 ? 0.7 : 0.9, 0.0, 1);
        g_assert_false(gb_chain_growth_run(&packing.grow, packing.position, &err));
        g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
        g_assert_true(g_str_has_prefix(err.text, dimension == 3
                                                     ? "structure.density = 0.7: "
                                                     : "structure.density = 0.9: "));
        g_assert_nonnull(strstr(err.text, "stopped at 0."));
        packing_finish(&packing);
    }
}

static void test_bad_input(void)
{
    struct packing packing;
    struct gb_error err = {0};
    packing_init(&packing, 3, 10, 1.9, 0.1, 0.0, 1);
    g_assert_false(gb_chain_growth_run(&packing.grow, packing.position, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    g_assert_true(g_str_has_prefix(err.text, "structure.base"));
    packing.grow.count = 0;
    g_assert_false(gb_chain_growth_run(&packing.grow, packing.position, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    packing_finish(&packing);
}

static bool after_some(void *data)
{
    int *polls = data;
    return ++*polls > 3;
}

static void test_cancel(void)
{
    struct packing packing;
    struct gb_error err = {0};
    int polls = 0;
    packing_init(&packing, 3, 1000, 9.0, 0.24, 0.0, 1);
    packing.grow.cancelled = after_some;
    packing.grow.data = &polls;
    g_assert_false(gb_chain_growth_run(&packing.grow, packing.position, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_CANCELLED);
    g_assert_cmpint(polls, ==, 4);
    packing_finish(&packing);
}

/* Every allocation may fail; nothing leaks. */
static void test_memory(void)
{
    struct packing packing;
    struct gb_error err = {0};
    packing_init(&packing, 3, 50, 6.0, 0.2, 0.0, 1);
    const size_t held = gb_alloc_bytes();
    long k = 0;
    bool done = false;
    while (!done) {
        gb_alloc_fail_after(++k);
        done = gb_chain_growth_run(&packing.grow, packing.position, &err);
        gb_alloc_fail_after(0);
        g_assert_true(done || err.code == GB_ERR_MEMORY);
        g_assert_cmpuint(gb_alloc_bytes(), ==, held);
    }
    g_assert_cmpint(k, >, 3);
    packing_finish(&packing);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/grow/contacts-exact", test_contacts_exact);
    g_test_add_func("/grow/single-contacts", test_single_contacts);
    g_test_add_func("/grow/no-overlap", test_no_overlap);
    g_test_add_func("/grow/seed", test_seed);
    g_test_add_func("/grow/too-dense", test_too_dense);
    g_test_add_func("/grow/bad-input", test_bad_input);
    g_test_add_func("/grow/cancel", test_cancel);
    g_test_add_func("/grow/memory", test_memory);
    return g_test_run();
}
