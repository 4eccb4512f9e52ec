#include "base/units.h"

#include <locale.h>
#include <math.h>
#include <string.h>

#include <glib.h>

struct reading {
    const char *text;
    enum gb_dimension dimension;
    double value; /* NaN: refused */
    const char *written;
};

static const struct reading readings[] = {
    {"10.4 nm", GB_DIM_LENGTH, 1.04e-8, "10.4 nm"},
    {"  9.7nm ", GB_DIM_LENGTH, 9.7e-9, "9.7 nm"},
    {"1e-8 m", GB_DIM_LENGTH, 1e-8, "10 nm"},
    {"0.392 nm", GB_DIM_LENGTH, 3.92e-10, "0.392 nm"},
    {"5 A", GB_DIM_LENGTH, 5e-10, "0.5 nm"},
    {"0.3 \xc2\xb5m", GB_DIM_LENGTH, 3e-7, "300 nm"},
    {".5 mm", GB_DIM_LENGTH, 5e-4, "500 um"},
    {"1. um", GB_DIM_LENGTH, 1e-6, "1 um"},
    {"-3 um", GB_DIM_LENGTH, -3e-6, "-3 um"},
    {"382 GPa", GB_DIM_PRESSURE, 382e9, "382 GPa"},
    {"1000 MPa", GB_DIM_PRESSURE, 1e9, "1 GPa"},
    {"1224 kB", GB_DIM_ENERGY, 1224 * GB_BOLTZMANN_J_K, "1224 kB"},
    {"0.1 %", GB_DIM_FRACTION, 0.001, "0.1 %"},
    {"0.001", GB_DIM_FRACTION, 0.001, "0.1 %"},
    {"60 s", GB_DIM_TIME, 60.0, "60 s"},
    {"2 min", GB_DIM_TIME, 120.0, "120 s"},
    {"3990 kg/m3", GB_DIM_MASS_DENSITY, 3990.0, "3990 kg/m3"},
    {"3.99 g/cm3", GB_DIM_MASS_DENSITY, 3990.0, "3990 kg/m3"},
    {"1 mPa s", GB_DIM_VISCOSITY, 1e-3, "1 mPa s"},
    {"1 mPas", GB_DIM_VISCOSITY, 1e-3, "1 mPa s"},
    {"6.8e8 1/s", GB_DIM_RATE, 6.8e8, "680 1/us"},
    {"2 nN", GB_DIM_FORCE, 2e-9, "2 nN"},
    {"0.25", GB_DIM_NONE, 0.25, "0.25"},
    {"+1e-7", GB_DIM_NONE, 1e-7, "1e-7"},
    {"0.00001", GB_DIM_NONE, 1e-5, "0.00001"},
    {"0", GB_DIM_NONE, 0.0, "0"},
    {"1e-400", GB_DIM_NONE, 0.0, "0"},
    {"10", GB_DIM_LENGTH, NAN, NULL},
    {"10 MPa", GB_DIM_LENGTH, NAN, NULL},
    {"10 nm", GB_DIM_PRESSURE, NAN, NULL},
    {"10 NM", GB_DIM_LENGTH, NAN, NULL},
    {"10 nm nm", GB_DIM_LENGTH, NAN, NULL},
    {"10 mpa", GB_DIM_PRESSURE, NAN, NULL},
    {"0.1 %", GB_DIM_NONE, NAN, NULL},
    {"nan", GB_DIM_NONE, NAN, NULL},
    {"inf", GB_DIM_NONE, NAN, NULL},
    {"-inf m", GB_DIM_LENGTH, NAN, NULL},
    {"1e999", GB_DIM_NONE, NAN, NULL},
    {"1e300 GPa", GB_DIM_PRESSURE, NAN, NULL},
    {"1e99999999999999999999 m", GB_DIM_LENGTH, NAN, NULL},
    {"0x10", GB_DIM_NONE, NAN, NULL},
    {"0,5", GB_DIM_NONE, NAN, NULL},
    {"1e", GB_DIM_NONE, NAN, NULL},
    {"1 2", GB_DIM_NONE, NAN, NULL},
    {"--1", GB_DIM_NONE, NAN, NULL},
    {".", GB_DIM_NONE, NAN, NULL},
    {"", GB_DIM_NONE, NAN, NULL},
    {"nm", GB_DIM_LENGTH, NAN, NULL},
};

static void check_readings(void)
{
    for (size_t i = 0; i < G_N_ELEMENTS(readings); i++) {
        const struct reading *r = &readings[i];
        struct gb_error err = {0};
        double value = 77.0;
        const bool good = gb_units_parse(r->text, r->dimension, &value, &err);
        g_test_message("%s", r->text);
        if (isnan(r->value)) {
            g_assert_false(good);
            g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
            g_assert_nonnull(strstr(err.text, r->text));
            g_assert_cmpfloat(value, ==, 77.0);
        } else {
            char buffer[64];
            g_assert_true(good);
            g_assert_cmpfloat(value, ==, r->value);
            g_assert_cmpstr(gb_units_format(value, r->dimension, buffer, sizeof buffer),
                            ==, r->written);
        }
    }
}

static void test_readings(void)
{
    check_readings();
}

/* Decimal commas of the user's locale stay out.  Where no such locale is installed this
 * repeats the test above. */
static void test_locale(void)
{
    static const char *const names[] = {"de_DE.UTF-8", "ru_RU.UTF-8", "fr_FR.UTF-8"};
    for (size_t i = 0; i < G_N_ELEMENTS(names); i++) {
        if (setlocale(LC_ALL, names[i])) {
            break;
        }
    }
    check_readings();
    setlocale(LC_ALL, "C");
}

/* Any double that is written is read back to the same bits, in every dimension. */
static void test_round_trip(void)
{
    for (int dimension = GB_DIM_NONE; dimension <= GB_DIM_COMPLIANCE; dimension++) {
        for (int i = 0; i < 3000; i++) {
            const double magnitude = pow(10.0, g_test_rand_double_range(-40.0, 40.0));
            const double value = i % 2 ? magnitude : -magnitude;
            char buffer[80];
            double back = 0.0;
            gb_units_format(value, (enum gb_dimension)dimension, buffer, sizeof buffer);
            g_assert_true(
                gb_units_parse(buffer, (enum gb_dimension)dimension, &back, NULL));
            g_assert_cmpfloat(back, ==, value);
        }
    }
}

static void test_short(void)
{
    static const struct {
        double value;
        enum gb_dimension dimension;
        int digits;
        const char *text;
    } rows[] = {
        {123.456e6, GB_DIM_PRESSURE, 3, "123 MPa"},
        {999.96e6, GB_DIM_PRESSURE, 4, "1 GPa"}, /* rounding changes the unit */
        {1.04e-8, GB_DIM_LENGTH, 4, "10.4 nm"},
        {0.38712, GB_DIM_NONE, 3, "0.387"},
        {0.0, GB_DIM_PRESSURE, 3, "0 Pa"},
        {-2.5e-9, GB_DIM_FORCE, 2, "-2.5 nN"},
        {HUGE_VAL, GB_DIM_NONE, 3, "inf"},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        char buffer[64];
        g_assert_cmpstr(gb_units_format_short(rows[i].value, rows[i].dimension,
                                              rows[i].digits, buffer, sizeof buffer),
                        ==, rows[i].text);
    }
}

static void test_number(void)
{
    const char *end = NULL;
    double value = 0.0;
    static const char text[] = "0.018 E";
    g_assert_true(gb_units_number(text, &end, &value));
    g_assert_cmpfloat(value, ==, 0.018);
    g_assert_cmpstr(end, ==, " E");
    g_assert_true(gb_units_number("0.018E", &end, &value));
    g_assert_cmpstr(end, ==, "E");
    g_assert_true(gb_units_number("1e3d", &end, &value));
    g_assert_cmpfloat(value, ==, 1000.0);
    g_assert_false(gb_units_number("d", &end, &value));
    char *digits = g_strnfill(100000, '9');
    g_assert_false(gb_units_number(digits, &end, &value));
    g_free(digits);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/units/readings", test_readings);
    g_test_add_func("/units/locale", test_locale);
    g_test_add_func("/units/round-trip", test_round_trip);
    g_test_add_func("/units/short", test_short);
    g_test_add_func("/units/number", test_number);
    return g_test_run();
}
