/* Cost of the initial structure against the count, on one core. */

#include "base/clock.h"
#include "common/packing.h"

static double seconds(int64_t count)
{
    struct packing packing;
    const double start = gb_clock_process_s();
    packing_make(&packing, 3, count, 18.0 * cbrt((double)count / 8000.0), 0.24, 0.0, 1);
    const double spent = gb_clock_process_s() - start;
    packing_finish(&packing);
    return spent;
}

static void test_time(void)
{
    const int64_t counts[] = {1000, 8000, 100000};
    double spent[G_N_ELEMENTS(counts)];
    for (size_t i = 0; i < G_N_ELEMENTS(counts); i++) {
        spent[i] = seconds(counts[i]);
        g_test_message("%7" G_GINT64_FORMAT " particles: %.3f s", counts[i], spent[i]);
    }
    const double power = log(spent[2] / spent[1]) / log(100000.0 / 8000.0);
    g_test_message("time grows as count^%.2f from 8000 to 100000", power);
    g_assert_cmpfloat(spent[2], <, 20.0);
    g_assert_cmpfloat(power, <, 1.5);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/grow-time/linear", test_time);
    return g_test_run();
}
