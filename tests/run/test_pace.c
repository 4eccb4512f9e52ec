#include <glib.h>
#include <math.h>

#include "run/cost.h"

static void test_rate(void)
{
    struct gb_pace pace;
    gb_cost_pace_init(&pace);
    g_assert_cmpfloat(gb_cost_pace_rate(&pace), ==, 0.0);
    g_assert_cmpfloat(gb_cost_pace_left(&pace), <, 0.0);
    for (int i = 0; i <= 200; i++) {
        gb_cost_pace_add(&pace, 0.05 * i, 100 * i, 0.001 * i);
    }
    g_assert_cmpfloat_with_epsilon(gb_cost_pace_rate(&pace), 2000.0, 1e-6);
    g_assert_cmpfloat_with_epsilon(gb_cost_pace_left(&pace), 40.0, 1e-3);
}

/* The rate follows a change within the window; an old rate is forgotten. */
static void test_window_slides(void)
{
    struct gb_pace pace;
    gb_cost_pace_init(&pace);
    int64_t evaluations = 0;
    for (int i = 0; i < 400; i++) {
        evaluations += i < 200 ? 100 : 10;
        gb_cost_pace_add(&pace, 0.05 * i, evaluations, 0.0);
    }
    g_assert_cmpfloat_with_epsilon(gb_cost_pace_rate(&pace), 200.0, 1e-6);
    g_assert_cmpfloat(gb_cost_pace_left(&pace), <, 0.0);
}

static void test_end(void)
{
    struct gb_pace pace;
    gb_cost_pace_init(&pace);
    gb_cost_pace_add(&pace, 0.1, 1, 0.5);
    gb_cost_pace_add(&pace, 0.2, 2, 1.0);
    g_assert_cmpfloat(gb_cost_pace_left(&pace), ==, 0.0);
}

/* A run that says nothing of its time left for 40 s, as a die that is filled: then the rate
 * is that from there on, and the time falls as time passes. */
static void test_begins_late(void)
{
    struct gb_pace pace;
    gb_cost_pace_init(&pace);
    for (int i = 0; i <= 400; i++) {
        gb_cost_pace_add(&pace, 0.1 * i, i, NAN);
        g_assert_cmpfloat(gb_cost_pace_left(&pace), <, 0.0);
    }
    for (int i = 1; i <= 200; i++) {
        gb_cost_pace_add(&pace, 40.0 + 0.1 * i, 400 + i, 0.001 * i);
        if (i >= 10) {
            g_assert_cmpfloat_with_epsilon(gb_cost_pace_left(&pace), 0.1 * (1000 - i),
                                           1.0);
        }
    }
    gb_cost_pace_init(&pace); /* one that is resumed at half of its way */
    for (int i = 0; i <= 20; i++) {
        gb_cost_pace_add(&pace, 0.1 * i, i, 0.5 + 0.001 * i);
    }
    g_assert_cmpfloat_with_epsilon(gb_cost_pace_left(&pace), 48.0, 1.0);
}

static void test_slice(void)
{
    struct gb_pace pace;
    gb_cost_pace_init(&pace);
    const int64_t first = gb_cost_pace_slice(&pace);
    g_assert_cmpint(first, >=, 1);
    gb_cost_pace_sliced(&pace, 0.001, true);
    g_assert_cmpint(gb_cost_pace_slice(&pace), >, first);
    /* a slice that a point cut short says nothing about the bound */
    const int64_t grown = gb_cost_pace_slice(&pace);
    gb_cost_pace_sliced(&pace, 0.001, false);
    g_assert_cmpint(gb_cost_pace_slice(&pace), ==, grown);
    for (int i = 0; i < 100; i++) {
        gb_cost_pace_sliced(&pace, 1.0, true);
    }
    g_assert_cmpint(gb_cost_pace_slice(&pace), ==, 1);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/run/pace/rate", test_rate);
    g_test_add_func("/run/pace/window-slides", test_window_slides);
    g_test_add_func("/run/pace/end", test_end);
    g_test_add_func("/run/pace/begins-late", test_begins_late);
    g_test_add_func("/run/pace/slice", test_slice);
    return g_test_run();
}
