#include "io/lab/lab_unit.h"

#include <stdbool.h>
#include <string.h>

#include <glib.h>

static const double gravity_m_s2 = 9.80665; /* standard */
static const double inch_m = 0.0254;
static const double pound_force_n = 4.4482216152605;

enum { TEXT_MAX = 24 };

/* The first name of a unit is its own, the others are its aliases. */
struct row {
    struct gb_lab_unit unit;
    const char *alias[9];
};

static const struct row *table(size_t *count)
{
    static const struct row rows[] = {
        {{"1", GB_DIM_FRACTION, 1.0}, {"-", "\xe2\x80\x93", "fraction"}},
        {{"%", GB_DIM_FRACTION, 0.01},
         {"%TD", "%th", "percent", "pct", "%ofTD", "%TheoreticalDensity", "Prozent",
          "vol%", "Vol.%"}},
        {{"Pa", GB_DIM_PRESSURE, 1.0}, {"N/m2", "Nm-2"}},
        {{"kPa", GB_DIM_PRESSURE, 1e3}, {NULL}},
        {{"MPa", GB_DIM_PRESSURE, 1e6},
         {"N/mm2", "Nmm-2", "MN/m2", "\xd0\x9c\xd0\x9f\xd0\xb0"}},
        {{"GPa", GB_DIM_PRESSURE, 1e9}, {"kN/mm2", "\xd0\x93\xd0\x9f\xd0\xb0"}},
        {{"bar", GB_DIM_PRESSURE, 1e5}, {NULL}},
        {{"kbar", GB_DIM_PRESSURE, 1e8}, {NULL}},
        {{"kN/cm2", GB_DIM_PRESSURE, 1e7}, {"kNcm-2"}},
        {{"kgf/cm2", GB_DIM_PRESSURE, gravity_m_s2 * 1e4}, {"kp/cm2", "kgfcm-2"}},
        {{"psi", GB_DIM_PRESSURE, pound_force_n / (inch_m * inch_m)}, {"lbf/in2"}},
        {{"ksi", GB_DIM_PRESSURE, 1e3 * pound_force_n / (inch_m * inch_m)}, {NULL}},
        {{"g/cm3", GB_DIM_MASS_DENSITY, 1e3},
         {"gcm-3", "g/cc", "g/ml", "g/mL", "kg/dm3", "Mg/m3", "t/m3", "kg/l",
          "\xd0\xb3/\xd1\x81\xd0\xbc"
          "3"}},
        {{"kg/m3", GB_DIM_MASS_DENSITY, 1.0}, {"kgm-3", "g/l", "g/L"}},
        {{"N", GB_DIM_FORCE, 1.0}, {"\xd0\x9d"}},
        {{"kN", GB_DIM_FORCE, 1e3}, {"\xd0\xba\xd0\x9d"}},
        {{"MN", GB_DIM_FORCE, 1e6}, {NULL}},
        {{"kgf", GB_DIM_FORCE, gravity_m_s2}, {"kp", "\xd0\xba\xd0\xb3\xd1\x81"}},
        {{"lbf", GB_DIM_FORCE, pound_force_n}, {NULL}},
        {{"mm", GB_DIM_LENGTH, 1e-3}, {"\xd0\xbc\xd0\xbc"}},
        {{"um", GB_DIM_LENGTH, 1e-6}, {"\xd0\xbc\xd0\xba\xd0\xbc"}},
        {{"cm", GB_DIM_LENGTH, 1e-2}, {NULL}},
        {{"m", GB_DIM_LENGTH, 1.0}, {NULL}},
        {{"in", GB_DIM_LENGTH, inch_m}, {"inch"}},
        {{"s", GB_DIM_NONE, 0.0},
         {"sec", "min", "h", "ms", "Hz", "mm/min", "mm/s", "1/s",
          "\xc2\xb0"
          "C"}},
        {{"g", GB_DIM_NONE, 0.0},
         {"mg", "kg", "J", "N/s", "kN/s", "MPa/s", "mm2", "cm2", "cm3"}},
    };
    *count = G_N_ELEMENTS(rows);
    return rows;
}

/* Writes superscripts as digits, drops blanks, signs of products and powers, and has one
 * letter for both signs of micro. */
static void normalise(const char *text, char out[TEXT_MAX])
{
    static const struct {
        const char *from, *to;
    } changes[] = {
        {"\xc2\xb2", "2"},
        {"\xc2\xb3", "3"},
        {"\xe2\x81\xbb", "-"},
        {"\xe2\x88\x92", "-"},
        {"\xc2\xb9", "1"},
        {"\xc2\xb5", "u"},
        {"\xce\xbc", "u"},
        {"\xc2\xb7", ""},
        {"\xe2\x8b\x85", ""},
        {" ", ""},
        {"\xc2\xa0", ""},
        {"^", ""},
        {"*", ""},
    };
    size_t used = 0;
    while (*text != '\0' && used + 2 < TEXT_MAX) {
        size_t k = 0;
        while (k < G_N_ELEMENTS(changes) && !g_str_has_prefix(text, changes[k].from)) {
            k++;
        }
        if (k < G_N_ELEMENTS(changes)) {
            const char *to = changes[k].to;
            text += strlen(changes[k].from);
            if (*to != '\0') {
                out[used++] = *to;
            }
        } else {
            out[used++] = *text++;
        }
    }
    out[*text == '\0' ? used : 0] = '\0';
}

static bool same(const char *typed, const char *name, bool exactly)
{
    return exactly ? strcmp(typed, name) == 0 : g_ascii_strcasecmp(typed, name) == 0;
}

static const struct gb_lab_unit *find(const char *typed, bool exactly)
{
    size_t count = 0;
    const struct row *rows = table(&count);
    for (size_t i = 0; i < count; i++) {
        bool found = same(typed, rows[i].unit.name, exactly);
        for (size_t k = 0; k < G_N_ELEMENTS(rows[i].alias) && !found; k++) {
            found = rows[i].alias[k] != NULL && same(typed, rows[i].alias[k], exactly);
        }
        if (found) {
            return &rows[i].unit;
        }
    }
    return NULL;
}

const struct gb_lab_unit *gb_lab_unit_find(const char *text)
{
    char typed[TEXT_MAX];
    normalise(text, typed);
    if (*typed == '\0') {
        return NULL;
    }
    const struct gb_lab_unit *unit = find(typed, true);
    /* milli and mega differ by the case of one letter */
    const bool milli = typed[0] == 'm' && strlen(typed) < 4 && strcmp(typed, "mpa") != 0;
    return unit != NULL || milli ? unit : find(typed, false);
}

const char *gb_lab_unit_accepted(enum gb_dimension dimension)
{
    switch (dimension) {
    case GB_DIM_FRACTION:
        return "%, 1";
    case GB_DIM_PRESSURE:
        return "MPa, Pa, kPa, GPa, bar, kbar, kN/cm2, kgf/cm2, psi, ksi";
    case GB_DIM_MASS_DENSITY:
        return "%, 1, g/cm3, kg/m3";
    case GB_DIM_FORCE:
        return "N, kN, MN, kgf, lbf";
    case GB_DIM_LENGTH:
        return "mm, um, cm, m, in";
    default:
        return "none";
    }
}
