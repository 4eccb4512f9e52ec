/* The number of particles at which a growing cluster percolates. */

#include <glib.h>
#include <math.h>
#include <string.h>

#include "measure/structure.h"

static struct gb_chain_growth growth(int dimension, double edge, int64_t count,
                                     uint64_t seed)
{
    return (struct gb_chain_growth){.dimension = dimension,
                                    .count = count,
                                    .edges = {edge, dimension == 2 ? 1.0 : edge, edge},
                                    .r_eq = 0.99,
                                    .r_meso = 2.0,
                                    .seed = seed};
}

/* Whether a structure of `count` particles, grown for itself, spans every axis. */
static bool spans(const struct gb_chain_growth *from, int64_t count)
{
    struct gb_chain_growth grow = *from;
    struct gb_connectivity found;
    struct gb_error err = {0};
    struct gb_cell cell;
    grow.count = count;
    double *position = g_new(double, (gsize)(3 * count));
    gb_cell_init(&cell, grow.dimension, grow.edges);
    g_assert_true(gb_chain_growth_run(&grow, position, &err));
    g_assert_true(gb_structure_connectivity(&cell, count, position, NULL,
                                            gb_structure_reach(grow.r_eq), &found, &err));
    g_free(position);
    return found.percolates[0] && found.percolates[2] &&
           (grow.dimension == 2 || found.percolates[1]);
}

/* The structure of N_1 spans, that of one particle less does not. */
static void test_least(void)
{
    for (int dimension = 2; dimension <= 3; dimension++) {
        for (uint64_t seed = 1; seed <= 4; seed++) {
            const struct gb_chain_growth grow =
                growth(dimension, dimension == 2 ? 15.0 : 7.0, 150, seed);
            struct gb_error err = {0};
            int64_t found = 0;
            g_assert_true(gb_structure_percolation(&grow, &found, &err));
            g_test_message("%d dimensions, seed %d: %d", dimension, (int)seed,
                           (int)found);
            g_assert_true(spans(&grow, found));
            g_assert_false(spans(&grow, found - 1));
        }
    }
}

/* Wherever the search begins, it ends at the same number. */
static void test_start(void)
{
    struct gb_error err = {0};
    int64_t found[3] = {0};
    static const int64_t counts[3] = {20, 150, 5000};
    for (int k = 0; k < 3; k++) {
        const struct gb_chain_growth grow = growth(2, 15.0, counts[k], 3);
        g_assert_true(gb_structure_percolation(&grow, &found[k], &err));
        g_assert_cmpint(found[k], ==, found[0]);
    }
}

/* Fig. 3 of P1 shows 600 discs on 30 d at that moment: within the scatter of cells. */
static void test_published(void)
{
    double sum = 0.0, squares = 0.0;
    enum { CELLS = 12 };
    for (int k = 0; k < CELLS; k++) {
        const struct gb_chain_growth grow = growth(2, 30.0, 600, (uint64_t)k + 1);
        struct gb_error err = {0};
        int64_t found = 0;
        g_assert_true(gb_structure_percolation(&grow, &found, &err));
        sum += (double)found;
        squares += (double)(found * found);
    }
    const double mean = sum / CELLS;
    const double deviation = sqrt((squares - CELLS * mean * mean) / (CELLS - 1));
    g_test_message("%.1f, standard deviation %.1f", mean, deviation);
    g_assert_cmpfloat(fabs(mean - 600.0), <, 2.0 * deviation);
    g_assert_cmpfloat(deviation, <, 80.0);
}

static bool at_once(void *data)
{
    (void)data;
    return true;
}

static void test_refusals(void)
{
    struct gb_model model = {0};
    struct gb_chain_growth grow = growth(2, 15.0, 100, 1);
    struct gb_error err = {0};
    int64_t found = 0;
    grow.model = &model;
    g_assert_false(gb_structure_percolation(&grow, &found, &err));
    g_assert_nonnull(strstr(err.text, "particles.distribution"));
    grow = growth(2, 15.0, 100, 1);
    grow.cancelled = at_once;
    g_assert_false(gb_structure_percolation(&grow, &found, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_CANCELLED);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/percolation/least", test_least);
    g_test_add_func("/percolation/start", test_start);
    g_test_add_func("/percolation/published", test_published);
    g_test_add_func("/percolation/refusals", test_refusals);
    return g_test_run();
}
