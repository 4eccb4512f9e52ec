#include <glib.h>
#include <math.h>

#include "base/alloc.h"
#include "greenbody/curve.h"

/* Enough points to need several chunks. */
enum { MANY = 5000 };

static struct gb_point numbered(size_t index)
{
    return (struct gb_point){.step = (int64_t)index, .density = (double)index / MANY};
}

static struct gb_curve *filled(size_t count)
{
    struct gb_curve *curve = NULL;
    struct gb_error err = {0};
    g_assert_true(gb_curve_create(&curve, &err));
    for (size_t i = 0; i < count; i++) {
        const struct gb_point point = numbered(i);
        g_assert_true(gb_curve_append(curve, &point, &err));
    }
    return curve;
}

static void test_append(void)
{
    struct gb_curve *curve = filled(MANY);
    g_assert_cmpuint(gb_curve_count(curve), ==, MANY);
    for (size_t i = 0; i < MANY; i++) {
        g_assert_cmpint(gb_curve_at(curve, i)->step, ==, (int64_t)i);
    }
    gb_curve_destroy(curve);
    gb_curve_destroy(NULL);
}

static void test_points_stay(void)
{
    struct gb_curve *curve = filled(1);
    const struct gb_point *first = gb_curve_at(curve, 0);
    for (size_t i = 1; i < MANY; i++) {
        const struct gb_point point = numbered(i);
        g_assert_true(gb_curve_append(curve, &point, NULL));
    }
    g_assert_true(first == gb_curve_at(curve, 0));
    g_assert_cmpint(first->step, ==, 0);
    gb_curve_destroy(curve);
}

static gpointer read_along(gpointer data)
{
    const struct gb_curve *curve = data;
    size_t seen = 0;
    while (seen < MANY) {
        const size_t count = gb_curve_count(curve);
        g_assert_cmpuint(count, >=, seen);
        for (; seen < count; seen++) {
            g_assert_cmpint(gb_curve_at(curve, seen)->step, ==, (int64_t)seen);
        }
    }
    return NULL;
}

static void test_two_threads(void)
{
    struct gb_curve *curve = filled(0);
    GThread *reader = g_thread_new("reader", read_along, curve);
    for (size_t i = 0; i < MANY; i++) {
        const struct gb_point point = numbered(i);
        g_assert_true(gb_curve_append(curve, &point, NULL));
    }
    g_thread_join(reader);
    gb_curve_destroy(curve);
}

/* A failed append changes nothing and can be repeated. */
static void test_out_of_memory(void)
{
    struct gb_error err = {0};
    struct gb_curve *curve = NULL;
    gb_alloc_fail_after(1);
    g_assert_false(gb_curve_create(&curve, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_MEMORY);
    curve = filled(256);
    const struct gb_point point = numbered(256);
    gb_alloc_fail_after(1);
    g_assert_false(gb_curve_append(curve, &point, &err));
    g_assert_cmpuint(gb_curve_count(curve), ==, 256);
    gb_alloc_fail_after(0);
    g_assert_true(gb_curve_append(curve, &point, &err));
    g_assert_cmpint(gb_curve_at(curve, 256)->step, ==, 256);
    gb_curve_destroy(curve);
}

static void test_branch_name(void)
{
    char name[64];
    const struct gb_point load = {.branch = 0};
    const struct gb_point relax = {.branch = GB_BRANCH_RELAX};
    const struct gb_point hold = {.branch = GB_BRANCH_HOLD};
    const struct gb_point unload = {.branch = 2, .branch_from_pa = 1e8};
    g_assert_cmpstr(gb_curve_branch_name(&load, name, sizeof name), ==, "load");
    g_assert_cmpstr(gb_curve_branch_name(&relax, name, sizeof name), ==, "relax");
    g_assert_cmpstr(gb_curve_branch_name(&hold, name, sizeof name), ==, "hold");
    g_assert_cmpstr(gb_curve_branch_name(&unload, name, sizeof name), ==,
                    "unload:100MPa");
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/run/curve/append", test_append);
    g_test_add_func("/run/curve/points-stay", test_points_stay);
    g_test_add_func("/run/curve/two-threads", test_two_threads);
    g_test_add_func("/run/curve/out-of-memory", test_out_of_memory);
    g_test_add_func("/run/curve/branch-name", test_branch_name);
    return g_test_run();
}
