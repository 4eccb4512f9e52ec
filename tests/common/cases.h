#ifndef GB_TESTS_CASES_H
#define GB_TESTS_CASES_H

#include <math.h>

#include <glib.h>

/* Properties at random parameters.  Every case has a seed of its own, told before it runs:
 * the last one in the output of a failure repeats it alone, GB_TEST_CASE=SEED. */

typedef void cases_check(GRand *random);

/* Seeds 1 .. quick, or 1 .. slow with `-m slow`. */
static inline void cases_run(unsigned quick, unsigned slow, cases_check *check)
{
    const char *only = g_getenv("GB_TEST_CASE");
    const unsigned first = only ? (unsigned)g_ascii_strtoull(only, NULL, 10) : 1;
    const unsigned count = only ? 1 : g_test_slow() ? slow : quick;
    for (unsigned seed = first; seed < first + count; seed++) {
        g_test_message("GB_TEST_CASE=%u", seed);
        GRand *random = g_rand_new_with_seed(seed);
        check(random);
        g_rand_free(random);
        if (g_test_failed()) {
            break;
        }
    }
}

/* Uniform in the number, and in its logarithm. */
static inline double cases_between(GRand *random, double low, double high)
{
    return g_rand_double_range(random, low, high);
}

static inline double cases_scale(GRand *random, double low, double high)
{
    return exp(g_rand_double_range(random, log(low), log(high)));
}

/* A number out of 0 .. count - 1. */
static inline int cases_choice(GRand *random, int count)
{
    return (int)g_rand_int_range(random, 0, (gint32)count);
}

#endif
