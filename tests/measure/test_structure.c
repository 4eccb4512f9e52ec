#include "common/packing.h"

/* Simple cubic lattice of n x n x n points, a apart. */
static double *cubic(int n, double a)
{
    double *position = g_new(double, (gsize)(3 * n * n * n));
    for (int i = 0; i < n * n * n; i++) {
        position[3 * i] = a * (i % n);
        position[3 * i + 1] = a * (i / n % n);
        position[3 * i + 2] = a * (i / n / n);
    }
    return position;
}

static struct gb_cell make_cell(int dimension, double x, double y, double z)
{
    const double edges[3] = {x, y, z};
    struct gb_cell cell;
    gb_cell_init(&cell, dimension, edges);
    return cell;
}

/* Pairs in a shell around each point of the lattice: 6 at a, 12 at sqrt(2) a, 8 at
 * sqrt(3) a. */
static void test_lattice(void)
{
    enum { N = 8, BINS = 37 };
    const double a = 1.1;
    const double r_max = 0.5 * N * a;
    const struct gb_cell cell = make_cell(3, N * a, N * a, N * a);
    struct gb_error err = {0};
    double g[BINS];
    double *position = cubic(N, a);
    g_assert_true(gb_structure_rdf(&cell, N * N * N, position, r_max, BINS, g, &err));
    const double squares[] = {1.0, 2.0, 3.0};
    const double pairs[] = {6.0, 12.0, 8.0};
    for (int i = 0; i < 3; i++) {
        const int bin = (int)(a * sqrt(squares[i]) / r_max * BINS);
        const double from = bin * r_max / BINS;
        const double to = (bin + 1) * r_max / BINS;
        const double shell = 4.0 / 3.0 * G_PI * (pow(to, 3.0) - pow(from, 3.0));
        g_assert_cmpfloat_with_epsilon(g[bin] * shell / pow(a, 3.0), pairs[i], 1e-10);
    }
    g_assert_cmpfloat(g[0], ==, 0.0);
    g_free(position);
}

/* An ideal gas has g = 1 everywhere, in space and in the plane. */
static void test_ideal_gas(void)
{
    enum { COUNT = 6000, BINS = 5 };
    GRand *random = g_rand_new_with_seed(11);
    double *position = g_new(double, 3 * COUNT);
    for (int dimension = 2; dimension <= 3; dimension++) {
        const struct gb_cell cell = make_cell(dimension, 20.0, 21.0, 22.0);
        struct gb_error err = {0};
        double g[BINS];
        for (int i = 0; i < COUNT; i++) {
            for (int k = 0; k < 3; k++) {
                position[3 * i + k] = cell.periodic[k]
                                          ? g_rand_double_range(random, 0.0, cell.edge[k])
                                          : 0.0;
            }
        }
        g_assert_true(gb_structure_rdf(&cell, COUNT, position, 8.0, BINS, g, &err));
        for (int k = 0; k < BINS; k++) {
            const double a = 8.0 * k / BINS;
            const double b = 8.0 * (k + 1) / BINS;
            const double shell = dimension == 2
                                     ? G_PI * (b * b - a * a)
                                     : 4.0 / 3.0 * G_PI * (b * b * b - a * a * a);
            const double pairs = 0.5 * COUNT * COUNT * shell / gb_cell_volume(&cell);
            g_assert_cmpfloat_with_epsilon(g[k], 1.0, 5.0 / sqrt(pairs) + 2.0 / COUNT);
        }
    }
    g_free(position);
    g_rand_free(random);
}

/* A packing has the same g(r) and the same contacts in an upright cell and in a tilted one
 * of the same lattice of images. */
static void test_tilted(void)
{
    enum { COUNT = 400, BINS = 40 };
    GRand *random = g_rand_new_with_seed(5);
    for (int dimension = 2; dimension <= 3; dimension++) {
        const struct gb_cell upright = make_cell(dimension, 6.0, 7.0, 8.0);
        struct gb_cell tilted = upright;
        struct gb_error err = {0};
        double position[3 * COUNT], g[2][BINS];
        struct gb_connectivity found[2];
        for (int i = 0; i < 3 * COUNT; i++) {
            position[i] = upright.periodic[i % 3]
                              ? g_rand_double_range(random, 0.0, upright.edge[i % 3])
                              : 0.0;
        }
        tilted.tilt[1] = -6.0;
        if (dimension == 3) {
            tilted.tilt[0] = 6.0;
            tilted.tilt[2] = 7.0;
        }
        const double reach = 0.5 * gb_cell_shortest(&tilted);
        g_assert_cmpfloat(reach, <, 0.5 * gb_cell_shortest(&upright));
        for (int k = 0; k < 2; k++) {
            const struct gb_cell *cell = k == 0 ? &upright : &tilted;
            g_assert_true(
                gb_structure_rdf(cell, COUNT, position, reach, BINS, g[k], &err));
            g_assert_true(gb_structure_connectivity(cell, COUNT, position, NULL, 0.6,
                                                    &found[k], &err));
        }
        for (int k = 0; k < BINS; k++) {
            g_assert_cmpfloat_with_epsilon(g[0][k], g[1][k], 1e-9);
        }
        g_assert_cmpfloat(found[0].coordination, ==, found[1].coordination);
        g_assert_cmpint(found[0].clusters, ==, found[1].clusters);
        g_assert_cmpint(found[0].largest, ==, found[1].largest);
    }
    g_rand_free(random);
}

static void test_rdf_input(void)
{
    const struct gb_cell cell = make_cell(3, 10.0, 12.0, 12.0);
    const double position[6] = {1.0, 1.0, 1.0, 2.0, 2.0, 2.0};
    const double broken[6] = {1.0, 1.0, 1.0, 2.0, (double)NAN, 2.0};
    const double reaches[] = {0.0, -1.0, 5.1, (double)NAN, (double)INFINITY};
    struct gb_error err = {0};
    double g[4];
    for (size_t i = 0; i < G_N_ELEMENTS(reaches); i++) {
        g_assert_false(gb_structure_rdf(&cell, 2, position, reaches[i], 4, g, &err));
        g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    }
    g_assert_true(gb_structure_rdf(&cell, 2, position, 5.0, 4, g, &err));
    g_assert_false(gb_structure_rdf(&cell, 2, broken, 5.0, 4, g, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
}

static struct gb_connectivity connect(const struct gb_cell *cell, int64_t count,
                                      const double *position, double reach)
{
    struct gb_connectivity found;
    struct gb_error err = {0};
    g_assert_true(
        gb_structure_connectivity(cell, count, position, NULL, reach, &found, &err));
    return found;
}

static void expect(const struct gb_connectivity *found, int64_t clusters, int64_t largest,
                   bool x, bool y, bool z)
{
    g_assert_cmpint(found->clusters, ==, clusters);
    g_assert_cmpint(found->largest, ==, largest);
    g_assert_true(found->percolates[0] == x);
    g_assert_true(found->percolates[1] == y);
    g_assert_true(found->percolates[2] == z);
}

/* A straight row that closes through the border, then with one particle taken out. */
static void test_row(void)
{
    enum { N = 10 };
    const struct gb_cell cell = make_cell(3, N, 9.0, 9.0);
    double position[3 * N];
    for (int i = 0; i < N; i++) {
        position[3 * i] = (i * 7 + 3) % N + 0.5;
        position[3 * i + 1] = 8.9;
        position[3 * i + 2] = 0.1;
    }
    struct gb_connectivity found = connect(&cell, N, position, 1.01);
    expect(&found, 1, N, true, false, false);
    g_assert_cmpfloat(found.coordination, ==, 2.0);
    g_assert_cmpint(found.histogram[2], ==, N);
    found = connect(&cell, N - 1, position, 1.01);
    expect(&found, 1, N - 1, false, false, false);
    g_assert_cmpint(found.histogram[1], ==, 2);
    found = connect(&cell, N, position, 0.99);
    expect(&found, N, 1, false, false, false);
    g_assert_cmpint(found.histogram[0], ==, N);
}

/* A closed ring around a corner of the cell crosses every border and spans nothing; a
 * helix that comes back one cell up and one to the side spans both axes. */
static void test_ring_and_diagonal(void)
{
    enum { N = 12 };
    const struct gb_cell cell = make_cell(3, N, N, N);
    double position[3 * N];
    const double radius = 0.5 / sin(G_PI / N);
    for (int i = 0; i < N; i++) {
        position[3 * i] = radius * cos(2.0 * G_PI * i / N);
        position[3 * i + 1] = radius * sin(2.0 * G_PI * i / N);
        position[3 * i + 2] = 0.0;
    }
    struct gb_connectivity found = connect(&cell, N, position, 1.01);
    expect(&found, 1, N, false, false, false);
    g_assert_cmpfloat(found.coordination, ==, 2.0);
    for (int i = 0; i < N; i++) {
        position[3 * i] = i;
        position[3 * i + 1] = 3.0;
        position[3 * i + 2] = N - i;
    }
    found = connect(&cell, N, position, 1.42);
    expect(&found, 1, N, true, false, true);
}

/* One particle in a cell so small that it touches its own images. */
static void test_own_image(void)
{
    const struct gb_cell cell = make_cell(3, 1.0, 3.0, 3.0);
    const double position[3] = {0.2, 0.3, 0.4};
    const struct gb_connectivity found = connect(&cell, 1, position, 1.0 + 1e-9);
    expect(&found, 1, 1, true, false, false);
    g_assert_cmpfloat(found.coordination, ==, 2.0);
}

/* Labels by flooding, as an independent count of clusters. */
static int64_t flood(const struct gb_cell *cell, int64_t count, const double *position,
                     double reach)
{
    int64_t *stack = g_new(int64_t, (gsize)count);
    bool *seen = g_new0(bool, (gsize)count);
    int64_t clusters = 0;
    for (int64_t start = 0; start < count; start++) {
        int64_t waiting = 0;
        if (seen[start]) {
            continue;
        }
        clusters++;
        seen[start] = true;
        stack[waiting++] = start;
        while (waiting > 0) {
            const int64_t i = stack[--waiting];
            for (int64_t j = 0; j < count; j++) {
                double r[3];
                for (int k = 0; k < 3; k++) {
                    r[k] = position[3 * i + k] - position[3 * j + k];
                }
                gb_cell_nearest(cell, r);
                if (!seen[j] && sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]) <= reach) {
                    seen[j] = true;
                    stack[waiting++] = j;
                }
            }
        }
    }
    g_free(seen);
    g_free(stack);
    return clusters;
}

static void test_random_clusters(void)
{
    enum { COUNT = 300 };
    GRand *random = g_rand_new_with_seed(3);
    double position[3 * COUNT];
    struct gb_cell cell = make_cell(3, 7.0, 8.0, 9.0);
    for (int round = 0; round < 40; round++) {
        const double reach = 0.5 + 0.05 * (round % 20);
        if (round == 20) {
            memcpy(cell.tilt, (const double[3]){3.4, -3.2, 3.9}, sizeof cell.tilt);
        }
        for (int i = 0; i < 3 * COUNT; i++) {
            position[i] = g_rand_double_range(random, 0.0, cell.edge[i % 3]);
        }
        const struct gb_connectivity found = connect(&cell, COUNT, position, reach);
        g_assert_cmpint(found.clusters, ==, flood(&cell, COUNT, position, reach));
    }
    g_rand_free(random);
}

static void test_memory(void)
{
    const struct gb_cell cell = make_cell(3, 9.0, 9.0, 9.0);
    const double position[6] = {1.0, 1.0, 1.0, 2.0, 1.0, 1.0};
    const size_t held = gb_alloc_bytes();
    struct gb_error err = {0};
    bool done = false;
    for (long k = 1; !done; k++) {
        double g[4];
        struct gb_connectivity found;
        gb_alloc_fail_after(k);
        done = gb_structure_rdf(&cell, 2, position, 4.0, 4, g, &err) &&
               gb_structure_connectivity(&cell, 2, position, NULL, 1.1, &found, &err);
        gb_alloc_fail_after(0);
        g_assert_true(done || err.code == GB_ERR_MEMORY);
        g_assert_cmpuint(gb_alloc_bytes(), ==, held);
    }
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/structure/lattice", test_lattice);
    g_test_add_func("/structure/ideal-gas", test_ideal_gas);
    g_test_add_func("/structure/tilted", test_tilted);
    g_test_add_func("/structure/rdf-input", test_rdf_input);
    g_test_add_func("/structure/row", test_row);
    g_test_add_func("/structure/ring-and-diagonal", test_ring_and_diagonal);
    g_test_add_func("/structure/own-image", test_own_image);
    g_test_add_func("/structure/random-clusters", test_random_clusters);
    g_test_add_func("/structure/memory", test_memory);
    return g_test_run();
}
