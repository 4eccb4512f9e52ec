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

/* The error with its digits, the value to the same place. */
static void test_error(void)
{
    static const struct {
        double value, error;
        int digits;
        const char *text;
    } rows[] = {
        {0.40621, 0.00651, 2, "0.4062 +- 0.0065"},
        {0.40621, 0.00651, 1, "0.406 +- 0.007"},
        {0.40621, 0.00996, 2, "0.406 +- 0.010"}, /* rounding adds a digit */
        {0.40621, 0.00996, 1, "0.41 +- 0.01"},
        {12345.0, 678.0, 2, "12350 +- 680"},
        {12345.0, 678.0, 1, "12300 +- 700"},
        {99.96, 12.0, 2, "100 +- 12"},
        {-0.0004, 0.12, 2, "0.00 +- 0.12"}, /* no "-0.00" */
        {-0.3, 0.12, 2, "-0.30 +- 0.12"},
        {0.0, 0.012, 2, "0.000 +- 0.012"},
        {1.2345e-9, 5e-11, 1, "(1.23 +- 0.05)e-09"},
        {1.5e12, 2.5e10, 2, "(1.500 +- 0.025)e+12"},
        {0.40621, 0.0, 2, "0.4062"},
        {0.40621, -1.0, 1, "0.406"},
    };
    char buffer[GB_NUMBER_ERROR_MAX];
    for (size_t k = 0; k < G_N_ELEMENTS(rows); k++) {
        gb_number_error(rows[k].value, rows[k].error, rows[k].digits, " +- ", buffer);
        g_assert_cmpstr(buffer, ==, rows[k].text);
    }
    g_assert_cmpstr(gb_number_error(3.14159, NAN, 2, "+-", buffer), ==, "3.142");
    g_assert_cmpstr(gb_number_error(3.14159, INFINITY, 2, "+-", buffer), ==, "3.142");
    g_assert_cmpstr(gb_number_error(NAN, 0.1, 2, "+-", buffer), ==, "-");
    g_assert_cmpstr(gb_number_error(-INFINITY, 0.1, 2, "+-", buffer), ==, "-");
    g_assert_cmpstr(gb_number_error(7.0, 0.25, 2, "\u00b1", buffer), ==,
                    "7.00\u00b1"
                    "0.25");
    /* the longest text fits */
    gb_number_error(-DBL_MAX, 1e-300, 17, "+-", buffer);
    g_assert_cmpuint(strlen(buffer), <, GB_NUMBER_ERROR_MAX);
}

/* A number that is not there is a dash, whatever its sign. */
static void test_shown(void)
{
    char buffer[GB_NUMBER_MAX];
    g_assert_cmpstr(gb_number_shown("%.3f", 1.23456, buffer), ==, "1.235");
    g_assert_cmpstr(gb_number_shown("%.3f", NAN, buffer), ==, "-");
    g_assert_cmpstr(gb_number_shown("%.3f", -sqrt(-1.0), buffer), ==, "-");
    g_assert_cmpstr(gb_number_shown("%g", -INFINITY, buffer), ==, "-");
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/number/texts", test_texts);
    g_test_add_func("/number/error", test_error);
    g_test_add_func("/number/shown", test_shown);
    g_test_add_func("/number/reads-back", test_reads_back);
    return g_test_run();
}
