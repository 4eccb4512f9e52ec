#include "many/reading.h"

#include <math.h>
#include <string.h>

#include <glib.h>

#include "base/units.h"

/* Relative tolerance: names of branches contain pressures with few digits. */
static const double same_pressure = 1e-6;

static const char *const names[GB_READING_QUANTITIES] = {
    [GB_READING_DENSITY] = "density", [GB_READING_COORDINATION] = "coordination",
    [GB_READING_BRIDGED] = "bridged", [GB_READING_RATTLERS] = "rattlers",
    [GB_READING_PX] = "px_MPa",       [GB_READING_PY] = "py_MPa",
    [GB_READING_PZ] = "pz_MPa",
};

const char *gb_reading_name(enum gb_reading_quantity quantity)
{
    return names[quantity];
}

bool gb_reading_open(struct gb_table **out, const char *directory, struct gb_error *err)
{
    char *path = g_build_filename(directory, "curve.csv", NULL);
    bool good = gb_table_read(out, path, "branch", err);
    g_free(path);
    if (!good) {
        return false;
    }
    good = gb_table_column(*out, "p_MPa", err) != NULL;
    for (int q = 0; q < GB_READING_QUANTITIES && good; q++) {
        good = gb_table_column(*out, names[q], err) != NULL;
    }
    if (!good) {
        gb_table_destroy(*out);
        *out = NULL;
    }
    return good;
}

/* Interpolates all figures between two rows; share 0 is the first row, 1 the second. */
static void read_between(const struct gb_table *curve, size_t low, size_t high,
                         double share, double values[GB_READING_QUANTITIES])
{
    for (int q = 0; q < GB_READING_QUANTITIES; q++) {
        const double *column = gb_table_column(curve, names[q], NULL);
        values[q] = share < 1.0 ? column[low] + share * (column[high] - column[low])
                                : column[high];
    }
}

bool gb_reading_loaded(const struct gb_table *curve, double pressure_pa,
                       double values[GB_READING_QUANTITIES])
{
    const double *pressure = gb_table_column(curve, "p_MPa", NULL);
    const double level = pressure_pa / 1e6;
    const size_t none = gb_table_rows(curve);
    size_t before = none; /* previous row of loading; others may be between */
    for (size_t i = 0; i < none; i++) {
        if (strcmp(gb_table_word(curve, i), "load") != 0 || isnan(pressure[i])) {
            continue;
        }
        if (before != none && pressure[i] >= level) {
            const double rise = pressure[i] - pressure[before];
            read_between(curve, before, i, (level - pressure[before]) / rise, values);
            return true;
        }
        before = pressure[i] < level ? i : before;
    }
    for (int q = 0; q < GB_READING_QUANTITIES; q++) {
        values[q] = NAN;
    }
    return false;
}

/* Is this the branch that unloads from this pressure: "unload:100MPa"? */
static bool is_unloading(const char *word, double pressure_pa)
{
    double from = 0.0;
    return g_str_has_prefix(word, "unload:") &&
           gb_units_parse(word + strlen("unload:"), GB_DIM_PRESSURE, &from, NULL) &&
           fabs(from - pressure_pa) <= same_pressure * pressure_pa;
}

bool gb_reading_unloaded(const struct gb_table *curve, double pressure_pa,
                         double values[GB_READING_QUANTITIES])
{
    for (size_t i = gb_table_rows(curve); i > 0; i--) {
        if (is_unloading(gb_table_word(curve, i - 1), pressure_pa)) {
            read_between(curve, i - 1, i - 1, 1.0, values);
            return true;
        }
    }
    for (int q = 0; q < GB_READING_QUANTITIES; q++) {
        values[q] = NAN;
    }
    return false;
}

double gb_reading_unloading_modulus(const struct gb_table *curve, double pressure_pa)
{
    const double *pressure = gb_table_column(curve, "p_MPa", NULL);
    const double *density = gb_table_column(curve, names[GB_READING_DENSITY], NULL);
    const double half = 0.5 * pressure_pa / 1e6;
    for (size_t i = 1; i < gb_table_rows(curve); i++) {
        if (!is_unloading(gb_table_word(curve, i), pressure_pa) || pressure[i] > half) {
            continue;
        }
        /* the previous row is of the same branch, or the last row of loading */
        double from[GB_READING_QUANTITIES];
        const double share = (pressure[i - 1] - half) / (pressure[i - 1] - pressure[i]);
        const double at = density[i - 1] + share * (density[i] - density[i - 1]);
        return gb_reading_loaded(curve, pressure_pa, from)
                   ? 0.5 * pressure_pa / log(from[GB_READING_DENSITY] / at)
                   : (double)NAN;
    }
    return NAN;
}
