/* What P1, section III, says about its initial structures: 8000 particles on a base of
 * 18 d x 18 d.  Means over independent cells. */
#include "common/packing.h"

enum { CELLS = 12, COUNT = 8000 };
static const double base = 18.0;
static const double half = 9.0; /* L/2 */

/* "The average coordination number is exactly 4 in the absence of the dispersion forces."
 */
static void test_coordination_exact(void)
{
    for (uint64_t seed = 1; seed <= 2; seed++) {
        struct packing packing;
        packing_make(&packing, 3, COUNT, base, 0.24, 0.0, seed);
        const struct gb_connectivity found = packing_contacts(&packing);
        g_assert_cmpint(llround(found.coordination * COUNT), ==, 4 * COUNT - 6);
        packing_finish(&packing);
    }
}

/* "At d = 9.7 nm the numerical experiments give k = 4.0062 +- 0.0007."  One connected
 * cluster that spans the cell along every axis. */
static void test_adhesion(void)
{
    struct sample k = {0};
    for (uint64_t seed = 1; seed <= 2 * CELLS; seed++) {
        struct packing packing;
        packing_make(&packing, 3, COUNT, base, 0.24, packing_h_eq, seed);
        const struct gb_connectivity found = packing_contacts(&packing);
        sample_add(&k, found.coordination);
        g_assert_cmpint(found.clusters, ==, 1);
        g_assert_true(found.percolates[0] && found.percolates[1] && found.percolates[2]);
        packing_finish(&packing);
    }
    g_test_message("k = %.5f +- %.5f", sample_mean(&k), sample_error(&k));
    g_assert_cmpfloat(fabs(sample_mean(&k) - 4.0062), <, 0.0007 + 3.0 * sample_error(&k));
    g_assert_cmpfloat(sample_error(&k), <, 0.0005);
}

/* g(L/2): the mean over the last diameter before half the cell. */
static void sample_g_end(double density, struct sample *g_end)
{
    enum { BINS = 9 };
    for (uint64_t seed = 1; seed <= CELLS; seed++) {
        struct packing packing;
        struct gb_error err = {0};
        double g[BINS];
        packing_make(&packing, 3, COUNT, base, density, 0.0, 100 + seed);
        g_assert_true(gb_structure_rdf(&packing.cell, COUNT, packing.position, half, BINS,
                                       g, &err));
        sample_add(g_end, g[BINS - 1]);
        packing_finish(&packing);
    }
    g_test_message("density %.2f: g(L/2) = %.5f +- %.5f", density, sample_mean(g_end),
                   sample_error(g_end));
}

/* "At densities below 0.22 the radial functions do not achieve the asymptotic value ...
 * starting with the density 0.24 g(L/2) = 1 within the statistical error."  The means are
 * about 1.045, 1.006, 1.0015 and 1.0002 at 0.18, 0.20, 0.22 and 0.24. */
static void test_homogeneous(void)
{
    struct sample chosen = {0};
    struct sample thin = {0};
    sample_g_end(0.24, &chosen);
    sample_g_end(0.20, &thin);
    g_assert_cmpfloat(fabs(sample_mean(&chosen) - 1.0), <, 0.001);
    g_assert_cmpfloat(sample_mean(&thin) - 1.0, >, 0.003);
    g_assert_cmpfloat(sample_mean(&thin) - 1.0, >, 4.0 * sample_error(&thin));
}

/* Mean of g over bins that cover [from, to). */
static double mean_g(const double *g, double width, double from, double to)
{
    double sum = 0.0;
    int bins = 0;
    for (int k = (int)lround(from / width); k < (int)lround(to / width); k++) {
        sum += g[k];
        bins++;
    }
    return sum / bins;
}

/* Touching particles are a delta peak; the second peak is split, with edges at sqrt(3)
 * and 2 distances: farther apart, two particles cannot touch the same two, or the same
 * one. */
static void test_peaks(void)
{
    enum { BINS = 900 };
    const double width = half / BINS;
    struct packing packing;
    struct gb_error err = {0};
    double g[BINS];
    packing_make(&packing, 3, COUNT, base, 0.24, packing_h_eq, 3);
    g_assert_true(
        gb_structure_rdf(&packing.cell, COUNT, packing.position, half, BINS, g, &err));
    const double r_eq = packing.grow.r_eq;
    const int first = (int)(r_eq / width);
    for (int k = 0; k < first; k++) {
        g_assert_cmpfloat(g[k], ==, 0.0);
    }
    g_assert_cmpfloat(g[first], >, 50.0);
    g_assert_cmpfloat(g[first + 1], <, 1.0);
    const double split = sqrt(3.0) * r_eq;
    const double twice = 2.0 * r_eq;
    const double before_split = mean_g(g, width, split - 0.04, split - 0.01);
    const double after_split = mean_g(g, width, split + 0.01, split + 0.04);
    const double before_twice = mean_g(g, width, twice - 0.04, twice - 0.01);
    const double after_twice = mean_g(g, width, twice + 0.01, twice + 0.04);
    g_test_message("g: %.1f at r_eq; sqrt(3): %.3f to %.3f; 2: %.3f to %.3f", g[first],
                   before_split, after_split, before_twice, after_twice);
    g_assert_cmpfloat(before_split, >, 1.3 * after_split);
    g_assert_cmpfloat(before_twice, >, 1.5 * after_twice);
    packing_finish(&packing);
}

/* Discs close to hexagons: about 4.47 contacts at density 0.5. */
static void test_plane(void)
{
    struct sample k = {0};
    for (uint64_t seed = 1; seed <= 40; seed++) {
        struct packing packing;
        packing_make(&packing, 2, 1000, 0.0, 0.5, 1.539e-2, seed);
        const struct gb_connectivity found = packing_contacts(&packing);
        g_assert_cmpint(found.clusters, ==, 1);
        sample_add(&k, found.coordination);
        packing_finish(&packing);
    }
    g_test_message("2D k = %.4f +- %.4f", sample_mean(&k), sample_error(&k));
    g_assert_cmpfloat(fabs(sample_mean(&k) - 4.47), <, 0.08);
}

/* How many of the particles, in their order, it takes to span both axes. */
static int64_t count_to_span(const struct packing *packing)
{
    int64_t few = 2;
    int64_t enough = packing->grow.count + 1;
    while (enough - few > 1) {
        struct packing part = *packing;
        part.grow.count = (few + enough) / 2;
        const struct gb_connectivity found = packing_contacts(&part);
        if (found.percolates[0] && found.percolates[2]) {
            enough = part.grow.count;
        } else {
            few = part.grow.count;
        }
    }
    return enough;
}

/* P1's figure 3 shows a cell of 30 d x 30 d at the moment when the discs join into an
 * infinite cluster: 600 of them. */
static void test_span_in_plane(void)
{
    struct sample n1 = {0};
    for (uint64_t seed = 1; seed <= 40; seed++) {
        struct packing packing;
        packing_make(&packing, 2, 750, 0.0, 750.0 * G_PI / 4.0 / 900.0, 0.0, seed);
        sample_add(&n1, (double)count_to_span(&packing));
        packing_finish(&packing);
    }
    g_test_message("2D: %.0f +- %.0f discs span 30 d x 30 d", sample_mean(&n1),
                   sample_error(&n1));
    g_assert_cmpfloat(fabs(sample_mean(&n1) - 600.0), <, 50.0);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/generator/coordination-exact", test_coordination_exact);
    g_test_add_func("/generator/adhesion", test_adhesion);
    g_test_add_func("/generator/homogeneous", test_homogeneous);
    g_test_add_func("/generator/peaks", test_peaks);
    g_test_add_func("/generator/plane", test_plane);
    g_test_add_func("/generator/span-in-plane", test_span_in_plane);
    return g_test_run();
}
