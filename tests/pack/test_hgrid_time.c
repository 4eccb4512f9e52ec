/* Cost of the neighbour search against the count and the spread of sizes, on one core,
 * beside that of a plain grid. */
#include <math.h>
#include <stdlib.h>

#include <glib.h>

#include "base/clock.h"
#include "pack/structure/assign_sizes.h"
#include "pack/structure/hgrid.h"

enum { COUNTS = 3, KINDS = 4, REPEATS = 5 };

static const int64_t counts[COUNTS] = {2000, 20000, 200000};

static const char *const kinds[KINDS] = {"one size", "P3's sizes, 1.5 to 18.5 um",
                                         "radii as many on each scale, 1 to 12",
                                         "1 of 1728 spheres 12 times as large"};

static void p3_sizes(int64_t count, double *diameter)
{
    struct gb_params params;
    struct gb_sizes sizes;
    struct gb_error err = {0};
    gb_params_init(&params);
    params.kind = GB_KIND_DIE; /* no scene is made */
    params.distribution = GB_DISTRIBUTION_TABLE;
    if (!gb_params_assign(&params, "particles.table=" GB_TEST_PRESETS "/nial-sizes.csv",
                          &err) ||
        !gb_sizes_init(&sizes, &params, &err) ||
        !gb_assign_sizes(&sizes, count, 1, diameter, &err)) {
        g_error("%s", err.text);
    }
    for (int64_t i = 0; i < count; i++) {
        diameter[i] *= 1e6;
    }
}

/* Spheres at random places of a cube, density 0.6; returns its edge. */
static double fill(int kind, int64_t count, double (*sphere)[4])
{
    double *diameter = g_new(double, (gsize)count), volume = 0.0;
    if (kind == 1) {
        p3_sizes(count, diameter);
    }
    for (int64_t i = 0; i < count; i++) {
        if (kind != 1) {
            diameter[i] = kind == 2   ? pow(12.0, -g_test_rand_double())
                          : kind == 3 ? (i % 1728 == 0 ? 12.0 : 1.0)
                                      : 1.0;
        }
        volume += G_PI / 6.0 * pow(diameter[i], 3.0);
    }
    const double edge = cbrt(volume / 0.6);
    for (int64_t i = 0; i < count; i++) {
        for (int k = 0; k < 3; k++) {
            sphere[i][k] = g_test_rand_double_range(0.0, edge);
        }
        sphere[i][3] = 0.5 * diameter[i];
    }
    g_free(diameter);
    return edge;
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Median of the time a build takes, over the count. */
static double per_sphere(int64_t count, double (*sphere)[4], double edge, int levels)
{
    struct gb_hgrid hgrid;
    struct gb_error err = {0};
    const struct gb_hgrid_box box = {.high = {edge, edge, edge}};
    double spent[REPEATS];
    g_assert_true(gb_hgrid_init(&hgrid, count, &err));
    hgrid.levels = levels;
    for (int k = 0; k < REPEATS; k++) {
        const double start = gb_clock_process_s();
        if (!gb_hgrid_build(&hgrid, &box, count, (const double(*)[4])sphere, NULL,
                            0.02 * edge / cbrt((double)count), &err)) {
            g_error("%s", err.text);
        }
        spent[k] = (gb_clock_process_s() - start) / (double)count;
    }
    gb_hgrid_finish(&hgrid);
    qsort(spent, REPEATS, sizeof *spent, compare);
    return spent[REPEATS / 2];
}

static void test_time(void)
{
    double(*sphere)[4] = g_malloc_n((gsize)counts[COUNTS - 1], sizeof *sphere);
    for (int kind = 0; kind < KINDS; kind++) {
        double levelled[COUNTS], plain[COUNTS];
        for (int c = 0; c < COUNTS; c++) {
            const double edge = fill(kind, counts[c], sphere);
            levelled[c] = per_sphere(counts[c], sphere, edge, 16);
            plain[c] = per_sphere(counts[c], sphere, edge, 1);
            g_test_message("%s, %6" G_GINT64_FORMAT
                           ": %.3f us a sphere, plain grid %.3f us",
                           kinds[kind], counts[c], 1e6 * levelled[c], 1e6 * plain[c]);
        }
        /* linear: what grows is the share of memory out of the cache */
        g_assert_cmpfloat(levelled[COUNTS - 1], <, 4.0 * levelled[0]);
        g_assert_cmpfloat(levelled[COUNTS - 1], <, 1.5 * plain[COUNTS - 1]);
        g_assert_cmpfloat(levelled[COUNTS - 1], <, 2e-6);
        if (kind == 3) {
            g_assert_cmpfloat(levelled[COUNTS - 1], <, 0.1 * plain[COUNTS - 1]);
        }
    }
    g_free(sphere);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/hgrid-time/linear", test_time);
    return g_test_run();
}
