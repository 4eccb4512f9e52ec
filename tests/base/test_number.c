#include "base/number.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#include <glib.h>

static const char *write(double value)
{
    static char text[GB_NUMBER_MAX];
    return gb_number_write(value, text);
}

static void test_texts(void)
{
    static const struct {
        double value;
        const char *text;
    } rows[] = {{0.0, "0"},
                {-0.0, "-0"},
                {1.0, "1"},
                {-1.5, "-1.5"},
                {0.1, "0.1"},
                {1234567.0, "1234567"},
                {120.0, "120"},
                {0.0001, "0.0001"},
                {0.00012345, "0.00012345"},
                {0.00001, "1e-05"},
                {1.25e-7, "1.25e-07"},
                {1e14, "100000000000000"},
                {1e15, "1e+15"},
                {1.5e20, "1.5e+20"},
                {1e-300, "1e-300"},
                {DBL_MAX, "1.7976931348623157e+308"},
                {5e-324, "4.94065645841247e-324"},
                {1.0 / 3.0, "0.3333333333333333"},
                {0.3, "0.3"},
                {0.1 + 0.2, "0.30000000000000004"},
                {9007199254740993.0, "9007199254740992"},
                {0.99999999999999989, "0.9999999999999999"}};
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        g_assert_cmpstr(write(rows[i].value), ==, rows[i].text);
    }
}

/* What printf would need for as many digits. */
static size_t shortest(double value)
{
    char text[GB_NUMBER_MAX];
    for (int digits = 15; digits <= 17; digits++) {
        char format[8];
        g_snprintf(format, sizeof format, "%%.%dg", digits);
        g_ascii_formatd(text, sizeof text, format, value);
        if (g_ascii_strtod(text, NULL) == value) {
            break;
        }
    }
    return strlen(text);
}

static void check(double value)
{
    const char *text = write(value);
    g_assert_cmpfloat(g_ascii_strtod(text, NULL), ==, value);
    g_assert_cmpuint(strlen(text), <=, shortest(value));
}

/* Of all sizes, and next to those with few digits. */
static void test_reads_back(void)
{
    GRand *random = g_rand_new_with_seed(1);
    for (int i = 0; i < 100000; i++) {
        const double size = pow(10.0, g_rand_double_range(random, -14.0, 25.0));
        check(size * g_rand_double_range(random, -1.0, 1.0));
        const double plain = g_rand_int_range(random, 1, 1000000) * 1e-4;
        check(plain);
        check(nextafter(plain, HUGE_VAL));
        check(nextafter(plain, 0.0));
    }
    for (int power = -1000; power <= 1000; power++) {
        check(ldexp(1.0, power));
        check(nextafter(ldexp(1.0, power), 0.0));
        check(-nextafter(ldexp(1.0, power), HUGE_VAL));
    }
    for (int i = 0; i < 100000; i++) {
        uint64_t bits = (uint64_t)g_rand_int(random) << 32 | g_rand_int(random);
        double value;
        memcpy(&value, &bits, sizeof value);
        if (isfinite(value)) {
            check(value);
        }
    }
    g_rand_free(random);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/number/texts", test_texts);
    g_test_add_func("/number/reads-back", test_reads_back);
    return g_test_run();
}
