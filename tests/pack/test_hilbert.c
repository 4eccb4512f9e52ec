#include <glib.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "pack/structure/hilbert.h"

/* The curve comes through every cell once, and each step of it leads to a neighbour. */
static void walk(int n, int bits)
{
    const uint32_t edge = 1U << bits;
    const uint64_t cells = n == 3 ? (uint64_t)edge * edge * edge : (uint64_t)edge * edge;
    uint32_t(*at)[3] = g_malloc0(sizeof *at * cells);
    bool *seen = g_malloc0(cells);
    for (uint64_t k = 0; k < cells; k++) {
        const uint32_t cell[3] = {(uint32_t)(k % edge), (uint32_t)(k / edge % edge),
                                  (uint32_t)(k / edge / edge)};
        const uint64_t index = gb_hilbert_index(cell, n, bits);
        g_assert_cmpuint(index, <, cells);
        g_assert_false(seen[index]);
        seen[index] = true;
        memcpy(at[index], cell, sizeof cell);
    }
    for (uint64_t k = 1; k < cells; k++) {
        int moved = 0;
        for (int c = 0; c < 3; c++) {
            moved += at[k][c] > at[k - 1][c] ? (int)(at[k][c] - at[k - 1][c])
                                             : (int)(at[k - 1][c] - at[k][c]);
        }
        g_assert_cmpint(moved, ==, 1);
    }
    g_free(at);
    g_free(seen);
}

static void test_curve(void)
{
    for (int bits = 1; bits <= 5; bits++) {
        walk(2, bits);
        walk(3, bits);
    }
}

static int by_position(const void *a, const void *b)
{
    return memcmp(a, b, 3 * sizeof(double));
}

enum { COUNT = 4096 };

/* Sorting loses no particle and brings neighbours together. */
static void test_sort(void)
{
    const size_t count = COUNT;
    struct gb_model model = {.count = COUNT, .edges = {16.0, 16.0, 32.0}};
    static double position[3 * COUNT], before[3 * COUNT];
    struct gb_error err = {0};
    GRand *random = g_rand_new_with_seed(3);
    for (int dimension = 2; dimension <= 3; dimension++) {
        model.dimension = dimension;
        for (int i = 0; i < COUNT; i++) {
            for (int c = 0; c < 3; c++) {
                position[3 * i + c] =
                    dimension == 2 && c == 1
                        ? 0.0
                        : g_rand_double_range(random, 0.0, model.edges[c]);
            }
        }
        memcpy(before, position, sizeof before);
        g_assert_true(gb_hilbert_sort(&model, position, &err));
        double step_mean = 0.0;
        for (int i = 1; i < COUNT; i++) {
            double squared = 0.0;
            for (int c = 0; c < 3; c++) {
                const double step = position[3 * i + c] - position[3 * i - 3 + c];
                squared += step * step;
            }
            step_mean += sqrt(squared) / (COUNT - 1);
        }
        /* unsorted it would be 14; a particle's share of the space is 1.3 wide, in the
         * plane 0.35 */
        g_assert_cmpfloat(step_mean, <, dimension == 3 ? 2.0 : 0.6);
        qsort(position, count, 3 * sizeof(double), by_position);
        qsort(before, count, 3 * sizeof(double), by_position);
        g_assert_true(memcmp(position, before, sizeof before) == 0);
    }
    /* sizes are assigned in the order in which particles were grown */
    model.polydisperse = true;
    memcpy(before, position, sizeof before);
    for (int c = 0; c < 3; c++) { /* the last one first, which a sort would undo */
        position[c] = before[3 * COUNT - 3 + c];
    }
    memcpy(before, position, sizeof before);
    g_assert_true(gb_hilbert_sort(&model, position, &err));
    g_assert_true(memcmp(position, before, sizeof before) == 0);
    g_rand_free(random);
}

static void test_memory(void)
{
    double position[3] = {0.0, 0.0, 0.0};
    const struct gb_model model = {.count = 1, .dimension = 3, .edges = {1.0, 1.0, 1.0}};
    for (int k = 1; k <= 2; k++) {
        struct gb_error err = {0};
        gb_alloc_fail_after(k);
        g_assert_false(gb_hilbert_sort(&model, position, &err));
        gb_alloc_fail_after(0);
        g_assert_cmpint(err.code, ==, GB_ERR_MEMORY);
    }
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/order/walk", test_curve);
    g_test_add_func("/order/sort", test_sort);
    g_test_add_func("/order/memory", test_memory);
    return g_test_run();
}
