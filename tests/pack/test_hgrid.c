#include "pack/structure/hgrid.h"

#include <math.h>
#include <string.h>

#include <glib.h>

#include "base/alloc.h"
#include "base/team.h"

typedef double row[4];

struct cloud {
    int64_t count;
    row *sphere;
    double *margin;
    struct gb_hgrid_box box;
};

static struct cloud make(int64_t count, double side)
{
    struct cloud cloud = {.count = count, .box.high = {side, side, side}};
    cloud.sphere = g_new0(row, (gsize)count + 1);
    cloud.margin = g_new0(double, (gsize)count + 1);
    return cloud;
}

static void drop(struct cloud *cloud)
{
    g_free(cloud->sphere);
    g_free(cloud->margin);
}

/* Radii between 1/ratio and 1, as many on each scale. */
static double radius_of(double ratio)
{
    return pow(ratio, -g_test_rand_double());
}

static double nearest(const struct cloud *cloud, int k, double a, double b)
{
    const struct gb_hgrid_box *box = &cloud->box;
    const double edge = box->high[k] - box->low[k];
    return box->periodic[k] ? remainder(a - b, edge) : a - b;
}

/* Gap over what the skin leaves; pairs within rounding of it may be listed or not. */
static double gap(const struct cloud *cloud, double skin, int64_t i, int64_t j)
{
    const double *a = cloud->sphere[i], *b = cloud->sphere[j];
    double square = 0.0;
    for (int k = 0; k < 3; k++) {
        const double r = nearest(cloud, k, a[k], b[k]);
        square += r * r;
    }
    return sqrt(square) - a[3] - b[3] - skin - cloud->margin[i] - cloud->margin[j];
}

/* Every pair against the definition. */
static void check_list(const struct cloud *cloud, double skin,
                       const struct gb_hgrid *hgrid)
{
    int64_t k = 0;
    for (int64_t i = 0; i < cloud->count; i++) {
        g_assert_cmpint(hgrid->start[i], ==, k);
        for (int64_t j = i + 1; j < cloud->count; j++) {
            const bool listed = k < hgrid->start[i + 1] && hgrid->other[k] == j;
            const double g = gap(cloud, skin, i, j);
            if (fabs(g) > 1e-9 && listed != (g < 0.0)) {
                g_error("pair %ld %ld: gap %g, %s", (long)i, (long)j, g,
                        listed ? "listed" : "not listed");
            }
            k += listed;
        }
        g_assert_cmpint(hgrid->start[i + 1], ==, k);
    }
    g_assert_cmpint(hgrid->pair_count, ==, k);
}

static void check(const struct cloud *cloud, double skin, struct gb_hgrid *hgrid)
{
    struct gb_error err = {0};
    for (int pass = 0; pass < 2; pass++) {
        hgrid->levels = pass == 0 ? 16 : 1;
        if (!gb_hgrid_build(hgrid, &cloud->box, cloud->count,
                            (const double(*)[4])cloud->sphere, cloud->margin, skin,
                            &err)) {
            g_error("%s", err.text);
        }
        check_list(cloud, skin, hgrid);
    }
    hgrid->levels = 16;
}

static void fill(struct cloud *cloud, double ratio)
{
    for (int64_t i = 0; i < cloud->count; i++) {
        for (int k = 0; k < 3; k++) {
            cloud->sphere[i][k] =
                g_test_rand_double_range(cloud->box.low[k], cloud->box.high[k]);
        }
        cloud->sphere[i][3] = radius_of(ratio);
    }
}

/* Random clouds: ratios of 1 to 1e6, all combinations of periodic axes, flat and long
 * boxes, skins that depend on the pair. */
static void test_random(void)
{
    static const double ratios[] = {1.0, 2.0, 12.0, 1e3, 1e6};
    struct gb_hgrid hgrid;
    g_assert_true(gb_hgrid_init(&hgrid, 0, NULL)); /* grows */
    for (int round = 0; round < 160; round++) {
        struct cloud cloud = make(g_test_rand_int_range(0, 400), 1.0);
        for (int k = 0; k < 3; k++) {
            cloud.box.low[k] = g_test_rand_double_range(-50.0, 50.0);
            cloud.box.high[k] = cloud.box.low[k] + g_test_rand_double_range(6.0, 30.0);
            cloud.box.periodic[k] = round >> k & 1;
        }
        fill(&cloud, ratios[round % 5]);
        for (int64_t i = 0; i < cloud.count && round % 3 == 0; i++) {
            cloud.margin[i] = 0.2 * g_test_rand_double();
        }
        check(&cloud, round % 2 ? 0.1 : 0.0, &hgrid);
        drop(&cloud);
    }
    gb_hgrid_finish(&hgrid);
}

static double random_normal(void)
{
    return sqrt(-2.0 * log(1.0 - g_test_rand_double())) *
           cos(2.0 * G_PI * g_test_rand_double());
}

/* Clusters, lines, planes, coincident points, spheres outside of the box, far away, with
 * no radius, as large as the box. */
static void test_degenerate(void)
{
    struct gb_hgrid hgrid;
    g_assert_true(gb_hgrid_init(&hgrid, 300, NULL));
    for (int shape = 0; shape < 9; shape++) {
        struct cloud cloud = make(250, 30.0);
        fill(&cloud, 12.0);
        for (int64_t i = 0; i < cloud.count; i++) {
            double *s = cloud.sphere[i];
            switch (shape) {
            case 0: /* two clusters far apart */
                for (int k = 0; k < 3; k++) {
                    s[k] = (i % 2 ? 1e-3 : 29.0) + 1e-2 * random_normal();
                }
                s[3] *= 1e-2;
                break;
            case 1:
                s[0] = s[1] = 7.0;
                break;
            case 2:
                s[2] = 30.0;
                break;
            case 3: /* coincident */
                s[0] = s[1] = s[2] = 15.0;
                break;
            case 4: /* outside, on all sides */
                for (int k = 0; k < 3; k++) {
                    s[k] = 15.0 + 30.0 * random_normal();
                }
                break;
            case 5: /* one far away */
                s[0] = i == 7 ? 1e12 : s[0];
                s[1] = i == 9 ? -1e100 : s[1];
                break;
            case 6:
                s[3] = i < 5 ? 1.0 : 0.0;
                break;
            case 7:
                s[3] = 0.0;
                break;
            default:
                s[3] = i == 0 ? 40.0 : s[3];
                break;
            }
        }
        check(&cloud, shape == 7 ? 0.0 : 1e-3, &hgrid);
        for (int k = 0; k < 3; k++) { /* a box without bounds */
            cloud.box.low[k] = -INFINITY;
            cloud.box.high[k] = INFINITY;
        }
        check(&cloud, 0.5, &hgrid);
        drop(&cloud);
    }
    gb_hgrid_finish(&hgrid);
}

/* A periodic box just wide enough, spheres on its faces and periods away. */
static void test_periodic(void)
{
    struct gb_hgrid hgrid;
    g_assert_true(gb_hgrid_init(&hgrid, 200, NULL));
    for (int round = 0; round < 40; round++) {
        struct cloud cloud = make(200, 4.2);
        fill(&cloud, 12.0);
        for (int k = 0; k < 3; k++) {
            cloud.box.periodic[k] = true;
        }
        for (int64_t i = 0; i < cloud.count; i++) {
            const int k = (int)(i % 3);
            cloud.sphere[i][k] = i % 2 ? 0.0 : 4.2;
            cloud.sphere[i][(k + 1) % 3] += 4.2 * g_test_rand_int_range(-3, 4);
            cloud.sphere[i][3] *= round % 4 ? 0.5 : 0.999;
        }
        check(&cloud, 0.02, &hgrid);
        drop(&cloud);
    }
    gb_hgrid_finish(&hgrid);
}

/* Two sizes so far apart that no sphere is of the levels between, and so many of the large ones
 * that their level takes no more; the small ones in a heap. */
static void test_far_sizes(void)
{
    struct gb_hgrid hgrid;
    g_assert_true(gb_hgrid_init(&hgrid, 0, NULL));
    struct cloud cloud = make(4000, 10.0);
    fill(&cloud, 1.0);
    for (int64_t i = 0; i < cloud.count; i += 2) {
        for (int k = 0; k < 3; k++) {
            cloud.sphere[i][k] = 4.0 + 0.2 * cloud.sphere[i][k];
        }
        cloud.sphere[i][3] = 0.01;
    }
    check(&cloud, 0.05, &hgrid);
    drop(&cloud);
    gb_hgrid_finish(&hgrid);
}

/* Any number of threads finds the same pairs, however many parts there are. */
static void test_threads(void)
{
    struct gb_error err = {0};
    for (int64_t count = 100; count < 20000; count *= 5) {
        struct cloud cloud = make(count, cbrt((double)count));
        struct gb_hgrid alone, shared;
        struct gb_team *team = NULL;
        fill(&cloud, 6.0);
        g_assert_true(gb_hgrid_init(&alone, count, &err));
        g_assert_true(gb_hgrid_init(&shared, count, &err));
        g_assert_true(gb_team_create(&team, 3, &err));
        shared.team = team;
        for (int round = 0; round < 3; round++) {
            const double skin = 0.1 * (round + 1);
            struct gb_hgrid *const both[] = {&alone, &shared};
            for (size_t k = 0; k < G_N_ELEMENTS(both); k++) {
                g_assert_true(gb_hgrid_build(both[k], &cloud.box, count,
                                             (const double(*)[4])cloud.sphere, NULL, skin,
                                             &err));
            }
            g_assert_cmpint(alone.pair_count, >, count);
            g_assert_cmpint(alone.pair_count, ==, shared.pair_count);
            g_assert_cmpint(memcmp(alone.start, shared.start,
                                   ((size_t)count + 1) * sizeof *alone.start),
                            ==, 0);
            g_assert_cmpint(memcmp(alone.other, shared.other,
                                   (size_t)alone.pair_count * sizeof *alone.other),
                            ==, 0);
        }
        gb_team_destroy(team);
        gb_hgrid_finish(&alone);
        gb_hgrid_finish(&shared);
        drop(&cloud);
    }
}

static void expect(struct cloud *cloud, double skin, enum gb_status code,
                   const char *said)
{
    struct gb_hgrid hgrid;
    struct gb_error err = {0};
    g_assert_true(gb_hgrid_init(&hgrid, cloud->count, NULL));
    g_assert_false(gb_hgrid_build(&hgrid, &cloud->box, cloud->count,
                                  (const double(*)[4])cloud->sphere, cloud->margin, skin,
                                  &err));
    g_test_message("%s", err.text);
    g_assert_cmpint(err.code, ==, code);
    g_assert_nonnull(strstr(err.text, said));
    g_assert_cmpint(hgrid.pair_count, ==, 0);
    gb_hgrid_finish(&hgrid);
}

static void test_guards(void)
{
    static const double bad[] = {NAN, INFINITY, -INFINITY, 1e200};
    struct cloud cloud = make(3000, 30.0);
    fill(&cloud, 12.0);
    for (size_t i = 0; i < G_N_ELEMENTS(bad); i++) {
        const double kept = cloud.sphere[17][1];
        cloud.sphere[17][1] = bad[i];
        expect(&cloud, 0.0, GB_ERR_GUARD, "sphere 17: must be finite");
        cloud.sphere[17][1] = kept;
    }
    cloud.sphere[4][3] = -1.0;
    expect(&cloud, 0.0, GB_ERR_GUARD, "sphere 4: must be finite");
    cloud.sphere[4][3] = 1.0;
    cloud.margin[5] = NAN;
    expect(&cloud, 0.0, GB_ERR_GUARD, "sphere 5: must be finite");
    cloud.margin[5] = 0.0;
    cloud.box.periodic[2] = true;
    cloud.box.high[2] = 3.9;
    expect(&cloud, 0.1, GB_ERR_GUARD, "the box is 3.9 wide along z");
    cloud.box.periodic[2] = false;
    for (int64_t i = 0; i < cloud.count; i++) {
        cloud.sphere[i][0] = cloud.sphere[i][1] = cloud.sphere[i][2] = 1.0;
    }
    expect(&cloud, 0.0, GB_ERR_GUARD, "they overlap too much");
    drop(&cloud);
    struct gb_hgrid hgrid;
    struct gb_error err = {0};
    g_assert_false(gb_hgrid_init(&hgrid, INT32_MAX, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
}

/* Every allocation may fail; with room, none is made. */
static void test_memory(void)
{
    struct gb_hgrid hgrid;
    struct gb_error err = {0};
    struct cloud cloud = make(500, 12.0);
    fill(&cloud, 12.0);
    bool done = false;
    for (long k = 1; !done; k++) {
        gb_alloc_fail_after(k);
        done = gb_hgrid_init(&hgrid, 100, &err);
        if (done) {
            done = gb_hgrid_build(&hgrid, &cloud.box, cloud.count,
                                  (const double(*)[4])cloud.sphere, NULL, 0.1, &err);
            gb_hgrid_finish(&hgrid);
        }
        gb_alloc_fail_after(0);
        g_assert_true(done || err.code == GB_ERR_MEMORY);
        g_assert_cmpint(k, <, 100);
    }
    g_assert_true(gb_hgrid_init(&hgrid, cloud.count, NULL));
    check(&cloud, 0.1, &hgrid);
    gb_alloc_fail_after(1);
    check(&cloud, 0.1, &hgrid);
    check(&cloud, 0.05, &hgrid);
    gb_alloc_fail_after(0);
    gb_hgrid_finish(&hgrid);
    drop(&cloud);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/hgrid/random", test_random);
    g_test_add_func("/hgrid/degenerate", test_degenerate);
    g_test_add_func("/hgrid/periodic", test_periodic);
    g_test_add_func("/hgrid/far-sizes", test_far_sizes);
    g_test_add_func("/hgrid/threads", test_threads);
    g_test_add_func("/hgrid/guards", test_guards);
    g_test_add_func("/hgrid/memory", test_memory);
    return g_test_run();
}
