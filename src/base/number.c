#include "base/number.h"

#include <float.h>
#include <glib.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* Relative tolerance for a value that is already round. */
static const double rounding = 1e-9;

double gb_number_round_below(double max)
{
    static const double steps[] = {5.0, 2.0};
    const double decade = pow(10.0, floor(log10(max) + rounding));
    for (size_t k = 0; k < sizeof steps / sizeof steps[0]; k++) {
        if (steps[k] * decade <= max * (1.0 + rounding)) {
            return steps[k] * decade;
        }
    }
    return decade;
}

double gb_number_round_above(double min)
{
    static const double steps[] = {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0};
    const double decade = pow(10.0, floor(log10(min) + rounding));
    for (size_t k = 0; k < sizeof steps / sizeof steps[0]; k++) {
        if (steps[k] * decade >= min * (1.0 - rounding)) {
            return steps[k] * decade;
        }
    }
    return 10.0 * decade;
}

double gb_number_nearest_step(double rough)
{
    const double decade = pow(10.0, floor(log10(rough)));
    const double share = rough / decade;
    return (share < 1.5 ? 1.0 : share < 3.5 ? 2.0 : share < 7.5 ? 5.0 : 10.0) * decade;
}

/* The fast method needs a type with a 64-bit mantissa: numbers of 17 decimal digits
 * have 57 bits. */
#if LDBL_MANT_DIG >= 64
enum { FAST = 1 };
#else
enum { FAST = 0 };
#endif

enum { DIGITS = 17, POWER_MOST = 27 }; /* 5^27 has 63 bits */

/* 10^power, exact. */
static long double power_of_ten(int power)
{
    static const long double ten[POWER_MOST + 1] = {
        1e0L,  1e1L,  1e2L,  1e3L,  1e4L,  1e5L,  1e6L,  1e7L,  1e8L,  1e9L,
        1e10L, 1e11L, 1e12L, 1e13L, 1e14L, 1e15L, 1e16L, 1e17L, 1e18L, 1e19L,
        1e20L, 1e21L, 1e22L, 1e23L, 1e24L, 1e25L, 1e26L, 1e27L};
    return ten[power];
}

static long double scale(long double value, int power)
{
    return power >= 0 ? value * power_of_ten(power) : value / power_of_ten(-power);
}

/* The next positive number, above or below. */
static double neighbour(double positive, bool above)
{
    uint64_t bits;
    memcpy(&bits, &positive, sizeof bits);
    bits += above ? 1 : UINT64_MAX;
    memcpy(&positive, &bits, sizeof bits);
    return positive;
}

/* The nearest integer, halves upwards: roundl for numbers from 0 to below 2^62. */
static uint64_t nearest(long double value)
{
    const long long even = llrintl(value);
    return (uint64_t)(even + (value - (long double)even == 0.5L));
}

enum answer { NO, YES, UNSURE };

/* Does digits x 10^power read as value?  One correctly rounded 64-bit operation decides
 * it, unless the result is so close to the middle of two doubles that double rounding
 * could matter. */
static enum answer reads_as(uint64_t digits, int power, double value)
{
    const long double near = scale((long double)digits, power);
    const double read = (double)near;
    const long double off = near - (long double)read; /* exact */
    const double next = neighbour(read, off > 0.0L);
    const long double half = 0.5L * fabsl((long double)next - (long double)read);
    if (read != value && next != value) {
        return NO;
    }
    if (fabsl(off) >= half * (1.0L - 0x1p-8L)) {
        return UNSURE;
    }
    return read == value ? YES : NO;
}

/* Finds the digits of a positive number and the power of the last one.  Returns their
 * number, or 0 if printf must do it. */
static int find_digits(double value, uint64_t *digits, int *power)
{
    int exponent = (int)floor(log10(value));
    if (exponent < -10 || exponent > 40) {
        return 0;
    }
    *power = exponent - (DIGITS - 1);
    const long double whole = scale((long double)value, -*power);
    if (!(whole >= 1e16L && whole < 1e17L)) { /* log10 was rounded to the wrong decade */
        return 0;
    }
    for (int more = 2; more >= 0; more--) {
        const long double unit = power_of_ten(more);
        const uint64_t some = nearest(whole / unit);
        /* off by more than the last bit of a double: another number */
        if (fabsl((long double)some * unit - whole) > whole * 0x1p-52L) {
            continue;
        }
        const enum answer answer = reads_as(some, *power + more, value);
        if (answer != NO) {
            *digits = some;
            *power += more;
            return answer == YES ? DIGITS - more : 0;
        }
    }
    return 0;
}

static char *put(char *to, const char *from, int count, char fill)
{
    for (int k = 0; k < count; k++) {
        *to++ = from ? from[k] : fill;
    }
    return to;
}

/* Writes the digits like %g, with an exponent below -4 or beyond the precision. */
static void lay_out(const char *digit, int count, int exponent, int precision, char *to)
{
    const bool plain = exponent >= -4 && exponent < precision;
    const int before =
        !plain ? 1 : MIN(count, MAX(exponent + 1, 0)); /* left of the point */
    to = before > 0 ? put(to, digit, before, 0) : put(to, NULL, 1, '0');
    to = put(to, NULL, plain && exponent >= count ? exponent + 1 - count : 0, '0');
    if (count > before) {
        *to++ = '.';
        to = put(to, NULL, plain && exponent < 0 ? -exponent - 1 : 0, '0');
        to = put(to, digit + before, count - before, 0);
    }
    *to = '\0';
    if (!plain) {
        g_snprintf(to, 8, "e%c%02d", exponent < 0 ? '-' : '+', ABS(exponent));
    }
}

static char *write_slowly(double value, char *buffer)
{
    for (int digits = DIGITS - 2; digits <= DIGITS; digits++) {
        char format[8];
        g_snprintf(format, sizeof format, "%%.%dg", digits);
        g_ascii_formatd(buffer, GB_NUMBER_MAX, format, value);
        if (g_ascii_strtod(buffer, NULL) == value) {
            break;
        }
    }
    return buffer;
}

char *gb_number_write(double value, char buffer[GB_NUMBER_MAX])
{
    uint64_t digits = 0;
    int power = 0;
    const int precision =
        FAST && isnormal(value) ? find_digits(fabs(value), &digits, &power) : 0;
    if (precision == 0) {
        return write_slowly(value, buffer);
    }
    char digit[DIGITS + 1];
    int count =
        precision + (digits >= (uint64_t)power_of_ten(precision)); /* rounded up */
    for (int k = count; k > 0; digits /= 10) {
        digit[--k] = (char)('0' + digits % 10);
    }
    const int exponent = power + count - 1;
    while (count > 1 && digit[count - 1] == '0') {
        count--;
    }
    buffer[0] = '-';
    lay_out(digit, count, exponent, precision, buffer + (value < 0.0));
    return buffer;
}

/* Range of exponents in which a value with an error has no power of ten: 1e-4 to below
 * 1e6, as in %g. */
enum { PLAIN_LOWEST = -4, PLAIN_HIGHEST = 5 };

/* Number of decimals that shows `digits` significant digits of a positive error after
 * rounding.  Negative: zeros before the point. */
static int decimals_of(double error, int digits)
{
    char text[GB_NUMBER_MAX];
    g_snprintf(text, sizeof text, "%.*e", digits - 1, error);
    return digits - 1 - (int)g_ascii_strtoll(strchr(text, 'e') + 1, NULL, 10);
}

/* Rounds to a decimal place, which may be before the point; avoids "-0". */
static double round_to(double value, int decimals)
{
    const double unit = pow(10.0, -decimals);
    const double rounded = decimals < 0 ? unit * round(value / unit) : value;
    return fabs(rounded) < 0.5 * unit ? 0.0 : rounded;
}

char *gb_number_shown(const char *format, double value, char buffer[GB_NUMBER_MAX])
{
    if (isfinite(value)) {
        g_snprintf(buffer, GB_NUMBER_MAX, format, value);
    } else {
        g_strlcpy(buffer, "-", GB_NUMBER_MAX);
    }
    return buffer;
}

char *gb_number_error(double value, double error, int digits, const char *sign,
                      char buffer[GB_NUMBER_ERROR_MAX])
{
    if (!isfinite(value)) {
        g_strlcpy(buffer, "-", GB_NUMBER_ERROR_MAX);
        return buffer;
    }
    if (!(error > 0.0) || isinf(error)) {
        g_snprintf(buffer, GB_NUMBER_ERROR_MAX, "%.*g", digits + 2, value);
        return buffer;
    }
    const int exponent = (int)floor(log10(fmax(fabs(value), error)));
    const bool plain = exponent >= PLAIN_LOWEST && exponent <= PLAIN_HIGHEST;
    const double unit = plain ? 1.0 : pow(10.0, exponent);
    const int decimals = decimals_of(error / unit, digits);
    const int shown = CLAMP(decimals, 0, DIGITS);
    const int length = g_snprintf(
        buffer, GB_NUMBER_ERROR_MAX, "%s%.*f%s%.*f", plain ? "" : "(", shown,
        round_to(value / unit, decimals), sign, shown, round_to(error / unit, decimals));
    if (!plain && length < GB_NUMBER_ERROR_MAX) {
        g_snprintf(buffer + length, (gulong)(GB_NUMBER_ERROR_MAX - length), ")e%+03d",
                   exponent);
    }
    return buffer;
}
