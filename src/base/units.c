#include "base/units.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include <glib.h>

/* Enough for every double in plain decimals; a longer number is an error. */
enum { NUMBER_MAX = 400, EXPONENT_MAX = 9999, DIGITS_EXACT = 17 };

/* value in SI = number * 10^exponent * factor.  Powers of ten are applied to the decimal
 * text, so that "10.4 nm" is the double nearest to 1.04e-8. */
struct unit {
    enum gb_dimension dimension;
    const char *name;
    int exponent;
    double factor;
    bool shown; /* used for writing; smallest first within a dimension */
};

static const struct unit units[] = {
    {GB_DIM_NONE, "", 0, 1.0, true},
    {GB_DIM_FRACTION, "%", -2, 1.0, true},
    {GB_DIM_FRACTION, "", 0, 1.0, false},
    {GB_DIM_LENGTH, "pm", -12, 1.0, false},
    {GB_DIM_LENGTH, "A", -10, 1.0, false},
    {GB_DIM_LENGTH, "\xc3\x85", -10, 1.0, false}, /* A with ring */
    {GB_DIM_LENGTH, "nm", -9, 1.0, true},
    {GB_DIM_LENGTH, "um", -6, 1.0, true},
    {GB_DIM_LENGTH, "\xc2\xb5m", -6, 1.0, false}, /* micro sign */
    {GB_DIM_LENGTH, "\xce\xbcm", -6, 1.0, false}, /* Greek mu */
    {GB_DIM_LENGTH, "mm", -3, 1.0, true},
    {GB_DIM_LENGTH, "m", 0, 1.0, true},
    {GB_DIM_PRESSURE, "Pa", 0, 1.0, true},
    {GB_DIM_PRESSURE, "kPa", 3, 1.0, true},
    {GB_DIM_PRESSURE, "MPa", 6, 1.0, true},
    {GB_DIM_PRESSURE, "GPa", 9, 1.0, true},
    {GB_DIM_TIME, "fs", -15, 1.0, true},
    {GB_DIM_TIME, "ps", -12, 1.0, true},
    {GB_DIM_TIME, "ns", -9, 1.0, true},
    {GB_DIM_TIME, "us", -6, 1.0, true},
    {GB_DIM_TIME, "\xc2\xb5s", -6, 1.0, false},
    {GB_DIM_TIME, "\xce\xbcs", -6, 1.0, false},
    {GB_DIM_TIME, "ms", -3, 1.0, true},
    {GB_DIM_TIME, "s", 0, 1.0, true},
    {GB_DIM_TIME, "min", 0, 60.0, false},
    {GB_DIM_TIME, "h", 0, 3600.0, false},
    {GB_DIM_RATE, "1/s", 0, 1.0, true},
    {GB_DIM_RATE, "1/ms", 3, 1.0, true},
    {GB_DIM_RATE, "1/us", 6, 1.0, true},
    {GB_DIM_RATE, "1/ns", 9, 1.0, true},
    {GB_DIM_RATE, "1/ps", 12, 1.0, true},
    {GB_DIM_MASS_DENSITY, "kg/m3", 0, 1.0, true},
    {GB_DIM_MASS_DENSITY, "kg/m^3", 0, 1.0, false},
    {GB_DIM_MASS_DENSITY, "g/cm3", 3, 1.0, false},
    {GB_DIM_MASS_DENSITY, "g/cm^3", 3, 1.0, false},
    {GB_DIM_ENERGY, "kB", 0, GB_BOLTZMANN_J_K, true},
    {GB_DIM_ENERGY, "eV", 0, 1.602176634e-19, false},
    {GB_DIM_ENERGY, "J", 0, 1.0, true},
    {GB_DIM_VISCOSITY, "mPa s", -3, 1.0, true},
    {GB_DIM_VISCOSITY, "Pa s", 0, 1.0, true},
    {GB_DIM_FORCE, "nN", -9, 1.0, true},
    {GB_DIM_FORCE, "uN", -6, 1.0, true},
    {GB_DIM_FORCE, "mN", -3, 1.0, true},
    {GB_DIM_FORCE, "N", 0, 1.0, true},
    {GB_DIM_FORCE, "kN", 3, 1.0, false},
    {GB_DIM_FORCE, "MN", 6, 1.0, false},
    {GB_DIM_SPEED, "mm/s", -3, 1.0, true},
    {GB_DIM_SPEED, "m/s", 0, 1.0, true},
    {GB_DIM_MASS, "mg", -6, 1.0, true},
    {GB_DIM_MASS, "g", -3, 1.0, true},
    {GB_DIM_MASS, "kg", 0, 1.0, true},
    {GB_DIM_AREA, "mm2", -6, 1.0, true},
    {GB_DIM_AREA, "mm^2", -6, 1.0, false},
    {GB_DIM_AREA, "cm2", -4, 1.0, false},
    {GB_DIM_AREA, "cm^2", -4, 1.0, false},
    {GB_DIM_AREA, "m2", 0, 1.0, true},
    {GB_DIM_AREA, "m^2", 0, 1.0, false},
    {GB_DIM_COMPLIANCE, "um/kN", -9, 1.0, true},
    {GB_DIM_COMPLIANCE, "mm/kN", -6, 1.0, true},
    {GB_DIM_COMPLIANCE, "um/N", -6, 1.0, false},
    {GB_DIM_COMPLIANCE, "mm/N", -3, 1.0, true},
    {GB_DIM_COMPLIANCE, "m/N", 0, 1.0, true},
};

const char *gb_units_accepted(enum gb_dimension dimension)
{
    switch (dimension) {
    case GB_DIM_NONE:
        return "none";
    case GB_DIM_FRACTION:
        return "none or %";
    case GB_DIM_LENGTH:
        return "nm, um, mm, m, A, pm";
    case GB_DIM_PRESSURE:
        return "Pa, kPa, MPa, GPa";
    case GB_DIM_TIME:
        return "s, ms, us, ns, ps, fs, min, h";
    case GB_DIM_RATE:
        return "1/s, 1/ms, 1/us, 1/ns, 1/ps";
    case GB_DIM_MASS_DENSITY:
        return "kg/m3, g/cm3";
    case GB_DIM_ENERGY:
        return "J, eV, kB";
    case GB_DIM_VISCOSITY:
        return "Pa s, mPa s";
    case GB_DIM_FORCE:
        return "nN, uN, mN, N, kN, MN";
    case GB_DIM_SPEED:
        return "m/s, mm/s";
    case GB_DIM_MASS:
        return "mg, g, kg";
    case GB_DIM_AREA:
        return "mm2, cm2, m2";
    case GB_DIM_COMPLIANCE:
        return "um/kN, mm/kN, um/N, mm/N, m/N";
    }
    return "none";
}

static const char *skip_blanks(const char *text)
{
    while (*text == ' ' || *text == '\t') {
        text++;
    }
    return text;
}

static const char *skip_digits(const char *text)
{
    while (g_ascii_isdigit(*text)) {
        text++;
    }
    return text;
}

/* A decimal number, split into the text of its mantissa and its power of ten. */
struct literal {
    const char *start;
    size_t length; /* of sign and mantissa */
    int exponent;
    const char *end;
};

/* Scans a complete exponent at text: "0.018 E" and "1e" have none. */
static const char *scan_exponent(const char *text, int *exponent)
{
    *exponent = 0;
    if (*text != 'e' && *text != 'E') {
        return text;
    }
    const char *at = text + 1;
    const bool negative = *at == '-';
    if (*at == '-' || *at == '+') {
        at++;
    }
    if (!g_ascii_isdigit(*at)) {
        return text;
    }
    int value = 0;
    for (; g_ascii_isdigit(*at); at++) {
        value = value > EXPONENT_MAX ? value : value * 10 + (*at - '0');
    }
    *exponent = negative ? -value : value;
    return at;
}

static bool scan(const char *text, struct literal *out)
{
    out->start = skip_blanks(text);
    const char *at = out->start;
    if (*at == '-' || *at == '+') {
        at++;
    }
    const char *whole = at;
    at = skip_digits(at);
    ptrdiff_t digits = at - whole;
    if (*at == '.') {
        const char *part = at + 1;
        at = skip_digits(part);
        digits += at - part;
    }
    if (digits == 0) {
        return false;
    }
    out->length = (size_t)(at - out->start);
    out->end = scan_exponent(at, &out->exponent);
    return out->length < NUMBER_MAX;
}

/* The double nearest to the literal times 10^shift. */
static bool evaluate(const struct literal *literal, int shift, double *value)
{
    char text[NUMBER_MAX + 16];
    char *end = NULL;
    double read = g_ascii_strtod(literal->start, &end);
    if (shift != 0 || end != literal->end) { /* as in 0x10, which is 0 with a unit */
        snprintf(text, sizeof text, "%.*se%d", (int)literal->length, literal->start,
                 literal->exponent + shift);
        read = g_ascii_strtod(text, NULL);
    }
    if (!isfinite(read)) {
        return false;
    }
    *value = read;
    return true;
}

bool gb_units_number(const char *text, const char **end, double *value)
{
    struct literal literal;
    if (!scan(text, &literal) || !evaluate(&literal, 0, value)) {
        return false;
    }
    if (end) {
        *end = literal.end;
    }
    return true;
}

/* Compares a unit as typed with a name; a run of blanks counts as one. */
static bool same_unit(const char *typed, const char *name)
{
    while (*name != '\0') {
        if (*name == ' ') {
            typed = skip_blanks(typed);
        } else if (*typed++ != *name) {
            return false;
        }
        name++;
    }
    return *skip_blanks(typed) == '\0';
}

static const struct unit *find_unit(const char *typed, enum gb_dimension dimension)
{
    for (size_t i = 0; i < G_N_ELEMENTS(units); i++) {
        if (units[i].dimension == dimension && same_unit(typed, units[i].name)) {
            return &units[i];
        }
    }
    return NULL;
}

char *gb_units_comma(const char *text, char *buffer, size_t size)
{
    struct literal literal;
    buffer[0] = '\0';
    if (scan(text, &literal) && literal.end[0] == ',' &&
        g_ascii_isdigit(literal.end[1])) {
        const bool once = strchr(literal.end + 1, ',') == NULL &&
                          memchr(literal.start, '.', literal.length) == NULL;
        snprintf(buffer, size, "decimals have a point, thousands no mark%s%.*s%s%.40s",
                 once ? ": " : "", once ? (int)literal.length : 0, literal.start,
                 once ? "." : "", once ? literal.end + 1 : "");
    }
    return buffer;
}

bool gb_units_parse(const char *text, enum gb_dimension dimension, double *value_si,
                    struct gb_error *err)
{
    struct literal literal;
    char advice[128];
    double value = 0.0;
    const bool read = scan(text, &literal);
    const struct unit *unit =
        read ? find_unit(skip_blanks(literal.end), dimension) : NULL;
    if (unit && evaluate(&literal, unit->exponent, &value) &&
        isfinite(value * unit->factor)) {
        *value_si = value * unit->factor;
        return true;
    }
    if (*gb_units_comma(text, advice, sizeof advice) != '\0') {
        return gb_error_set(err, GB_ERR_INPUT, "'%.60s': %s", text, advice);
    }
    /* the number alone may overflow although its value with the unit does not: "1e309
     * %" */
    if (!read || !evaluate(&literal, 0, &value)) {
        return gb_error_set(err, GB_ERR_INPUT, "'%.60s' is not a number", text);
    }
    return dimension == GB_DIM_NONE
               ? gb_error_set(err, GB_ERR_INPUT, "'%.60s': must have no unit", text)
               : gb_error_set(err, GB_ERR_INPUT, "'%.60s': unit must be one of: %s", text,
                              gb_units_accepted(dimension));
}

/* A decimal number d.ddd times 10^exponent. */
struct decimal {
    bool negative;
    char digits[24];
    int count;
    int exponent;
};

/* Rounds value to `count` significant digits. */
static void decimal_round(double value, int count, struct decimal *out)
{
    char format[16], text[40];
    snprintf(format, sizeof format, "%%.%de", count - 1);
    g_ascii_formatd(text, sizeof text, format, value);
    const char *at = text;
    out->negative = *at == '-';
    out->count = 0;
    for (; *at != '\0' && *at != 'e'; at++) {
        if (g_ascii_isdigit(*at)) {
            out->digits[out->count++] = *at;
        }
    }
    scan_exponent(at, &out->exponent);
    while (out->count > 1 && out->digits[out->count - 1] == '0') {
        out->count--;
    }
    out->digits[out->count] = '\0';
}

static double decimal_value(const struct decimal *decimal)
{
    char text[48];
    snprintf(text, sizeof text, "%s%se%d", decimal->negative ? "-" : "", decimal->digits,
             decimal->exponent - decimal->count + 1);
    return g_ascii_strtod(text, NULL);
}

/* Divides value_si by the factor of a unit.  Uses the fewest digits that read back to
 * value_si, or exactly `digits`.  False if 17 digits are not enough, which is possible
 * if the factor is not a power of ten. */
static bool decimal_of(double value_si, double factor, int digits, struct decimal *out)
{
    const double number = value_si / factor;
    if (digits < DIGITS_EXACT) {
        decimal_round(number, digits, out);
        return true;
    }
    for (int count = 1; count <= DIGITS_EXACT; count++) {
        decimal_round(number, count, out);
        if (decimal_value(out) * factor == value_si) {
            return true;
        }
    }
    return false;
}

/* Writes plain decimals if they are readable, else an exponent. */
static void decimal_write(const struct decimal *decimal, int exponent, char *out,
                          size_t size)
{
    static const char zeros[] = "0000000000000000";
    const char *sign = decimal->negative ? "-" : "";
    const char *digits = decimal->digits;
    const int whole = exponent + 1; /* digits before the point */
    if (exponent < -5 || exponent > 15) {
        snprintf(out, size, "%s%c%s%se%d", sign, digits[0], digits[1] ? "." : "",
                 digits + 1, exponent);
    } else if (whole <= 0) {
        snprintf(out, size, "%s0.%.*s%s", sign, -whole, zeros, digits);
    } else if (decimal->count <= whole) {
        snprintf(out, size, "%s%s%.*s", sign, digits, whole - decimal->count, zeros);
    } else {
        snprintf(out, size, "%s%.*s.%s", sign, whole, digits, digits + whole);
    }
}

/* How well a unit fits: 0 for a mantissa in [1, 1000), negative for a smaller one,
 * positive for a larger one.  Units without multiples (kB) allow longer mantissas. */
static int misfit(const struct unit *unit, const struct decimal *decimal)
{
    const int lead = decimal->exponent - unit->exponent;
    const int longest = unit->factor == 1.0 ? 2 : 5;
    return lead < 0 ? lead : lead > longest ? lead - longest : 0;
}

static char *format_digits(double value_si, enum gb_dimension dimension, int digits,
                           char *buffer, size_t size)
{
    if (!isfinite(value_si)) {
        snprintf(buffer, size, "%s",
                 isnan(value_si) ? "nan"
                 : value_si > 0  ? "inf"
                                 : "-inf");
        return buffer;
    }
    const struct unit *best = NULL;
    struct decimal best_decimal = {0};
    for (size_t i = 0; i < G_N_ELEMENTS(units); i++) {
        const struct unit *unit = &units[i];
        struct decimal decimal;
        if (unit->dimension != dimension || !unit->shown ||
            !decimal_of(value_si, unit->factor, digits, &decimal)) {
            continue;
        }
        /* Smallest unit first; take a larger one only if the mantissa is too long. */
        if (!best || (misfit(best, &best_decimal) > 0 && value_si != 0.0)) {
            best = unit;
            best_decimal = decimal;
        }
    }
    char number[80] = "0";
    if (value_si != 0.0) {
        decimal_write(&best_decimal, best_decimal.exponent - best->exponent, number,
                      sizeof number);
    }
    snprintf(buffer, size, "%s%s%s", number, *best->name ? " " : "", best->name);
    return buffer;
}

char *gb_units_format(double value_si, enum gb_dimension dimension, char *buffer,
                      size_t size)
{
    return format_digits(value_si, dimension, DIGITS_EXACT, buffer, size);
}

char *gb_units_format_short(double value_si, enum gb_dimension dimension, int digits,
                            char *buffer, size_t size)
{
    const int count = digits < 1 ? 1 : digits >= DIGITS_EXACT ? DIGITS_EXACT - 1 : digits;
    return format_digits(value_si, dimension, count, buffer, size);
}
