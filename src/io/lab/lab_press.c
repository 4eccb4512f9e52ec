#include "io/lab/lab_private.h"

#include <math.h>
#include <string.h>

static const double pascal_per_mpa = 1e6;

static bool has(const struct gb_lab_reading *reading, enum gb_lab_role role)
{
    return reading->column[role].index != GB_LAB_NONE;
}

/* Value of a column in SI. */
static double si(const struct gb_lab_reading *reading, enum gb_lab_role role, size_t row)
{
    return reading->value[role][row] * reading->column[role].unit->si;
}

static double largest(const double *value, size_t count)
{
    double most = 0.0;
    for (size_t i = 0; i < count; i++) {
        most = fmax(most, value[i]);
    }
    return most;
}

/* Compression may count as negative: the sign of the value farthest from 0. */
static void correct_sign(struct gb_lab_reading *reading, enum gb_lab_role role)
{
    double *value = reading->value[role];
    const double most = largest(value, reading->count);
    double least = 0.0;
    for (size_t i = 0; i < reading->count; i++) {
        least = fmin(least, value[i]);
    }
    if (-least > most) {
        for (size_t i = 0; i < reading->count; i++) {
            value[i] = -value[i];
        }
        g_string_append_printf(reading->said, ", compression negative in column %d",
                               reading->column[role].index + 1);
    }
}

static void convert_pressure(struct gb_lab_reading *reading)
{
    const bool force = has(reading, GB_LAB_ROLE_FORCE);
    const enum gb_lab_role role = force ? GB_LAB_ROLE_FORCE : GB_LAB_ROLE_PRESSURE;
    const double area = force ? reading->options->die_area_m2 : 1.0;
    correct_sign(reading, role);
    for (size_t i = 0; i < reading->count; i++) {
        reading->pressure[i] = reading->value[role][i] *
                               (reading->column[role].unit->si / pascal_per_mpa) / area;
    }
}

/* Direction of the travel on compression: from the first row to the largest pressure. */
static double direction(const struct gb_lab_reading *reading)
{
    size_t most = 0;
    for (size_t i = 0; i < reading->count; i++) {
        most = reading->pressure[i] > reading->pressure[most] ? i : most;
    }
    const double *travel = reading->value[GB_LAB_ROLE_TRAVEL];
    return travel[most] > travel[0] ? 1.0 : travel[most] < travel[0] ? -1.0 : 0.0;
}

/* Height of the compact from the travel, without the deflection of the machine:
 * h0 - s + C F, or (s0 - s) + C F where the punches touch at s0. */
static enum gb_lab_outcome convert_travel(struct gb_lab_reading *reading)
{
    const struct gb_lab_options *options = reading->options;
    const double sense = direction(reading);
    const double compliance =
        isnan(options->compliance_m_n) ? 0.0 : options->compliance_m_n;
    if (!(fabs(sense) > 0.0)) {
        return gb_lab_question_fail(reading,
                                    "%.200s: the travel is the same at the first row and "
                                    "at the largest pressure",
                                    reading->path);
    }
    if (sense < 0.0) {
        g_string_append(reading->said, ", travel decreasing on compression");
    }
    const double start = isnan(options->zero_travel_m) ? options->initial_height_m
                                                       : sense * options->zero_travel_m;
    for (size_t i = 0; i < reading->count; i++) {
        const double force = reading->pressure[i] * pascal_per_mpa * options->die_area_m2;
        const double travel = si(reading, GB_LAB_ROLE_TRAVEL, i);
        reading->density[i] = start - sense * travel + compliance * force;
    }
    return GB_LAB_READ;
}

/* Heights become densities: m / (rho A h). */
static void divide_by_height(struct gb_lab_reading *reading)
{
    const struct gb_lab_options *options = reading->options;
    const double full =
        options->powder_mass_kg / (options->true_density_kg_m3 * options->die_area_m2);
    for (size_t i = 0; i < reading->count; i++) {
        reading->density[i] = full / reading->density[i];
    }
}

static enum gb_lab_outcome convert_density(struct gb_lab_reading *reading)
{
    const struct gb_lab_unit *unit = reading->column[GB_LAB_ROLE_DENSITY].unit;
    if (has(reading, GB_LAB_ROLE_TRAVEL)) {
        const enum gb_lab_outcome outcome = convert_travel(reading);
        divide_by_height(reading);
        return outcome;
    }
    for (size_t i = 0; i < reading->count; i++) {
        if (has(reading, GB_LAB_ROLE_HEIGHT)) {
            reading->density[i] = si(reading, GB_LAB_ROLE_HEIGHT, i);
        } else if (has(reading, GB_LAB_ROLE_POROSITY)) {
            reading->density[i] = 1.0 - si(reading, GB_LAB_ROLE_POROSITY, i);
        } else {
            reading->density[i] = si(reading, GB_LAB_ROLE_DENSITY, i);
            reading->density[i] /= unit->dimension == GB_DIM_MASS_DENSITY
                                       ? reading->options->true_density_kg_m3
                                       : 1.0;
        }
    }
    if (has(reading, GB_LAB_ROLE_HEIGHT)) {
        divide_by_height(reading);
    }
    return GB_LAB_READ;
}

/* Standard errors in the units of the results; a head without unit has that of its
 * quantity. */
static void convert_errors(struct gb_lab_reading *reading)
{
    static const enum gb_lab_role pairs[][2] = {
        {GB_LAB_ROLE_PRESSURE, GB_LAB_ROLE_PRESSURE_ERROR},
        {GB_LAB_ROLE_DENSITY, GB_LAB_ROLE_DENSITY_ERROR}};
    for (size_t k = 0; k < G_N_ELEMENTS(pairs); k++) {
        const struct gb_lab_column *of = &reading->column[pairs[k][0]];
        struct gb_lab_column *column = &reading->column[pairs[k][1]];
        if (column->index == GB_LAB_NONE || of->index == GB_LAB_NONE) {
            continue;
        }
        if (column->unit == NULL) {
            column->unit = of->unit;
        }
        if (column->unit->dimension == GB_DIM_MASS_DENSITY &&
            isnan(reading->options->true_density_kg_m3)) {
            column->index = GB_LAB_NONE; /* among the columns not read */
            continue;
        }
        double scale = k == 0 ? column->unit->si / pascal_per_mpa : column->unit->si;
        scale /= column->unit->dimension == GB_DIM_MASS_DENSITY
                     ? reading->options->true_density_kg_m3
                     : 1.0;
        for (size_t i = 0; i < reading->count; i++) {
            reading->value[pairs[k][1]][i] *= scale;
        }
    }
}

/* Rows before the contact and behind it: no pressure. */
static void drop_unloaded(struct gb_lab_reading *reading)
{
    bool *kept = g_new0(bool, reading->count);
    for (size_t i = 0; i < reading->count; i++) {
        kept[i] = reading->pressure[i] > 0.0;
        if (!kept[i]) {
            gb_lab_rows_leave_out(reading, "without pressure", reading->line[i]);
        }
    }
    gb_lab_rows_keep(reading, kept);
    g_free(kept);
}

static enum gb_lab_outcome check_densities(struct gb_lab_reading *reading)
{
    for (size_t i = 0; i < reading->count; i++) {
        const double density = reading->density[i];
        if (!(density > 0.0 && density <= 1.0)) {
            return gb_lab_question_fail(
                reading,
                "%.200s:%d: a relative density of %.4g: expected above 0, up to 1; see "
                "columns, units and, of a travel, masses and heights",
                reading->path, reading->line[i], density);
        }
    }
    return reading->count > 0
               ? GB_LAB_READ
               : gb_lab_question_fail(reading, "%.200s: no row with a pressure above 0",
                                      reading->path);
}

enum gb_lab_outcome gb_lab_press_convert(struct gb_lab_reading *reading)
{
    convert_pressure(reading);
    const enum gb_lab_outcome outcome = convert_density(reading);
    if (outcome != GB_LAB_READ) {
        return outcome;
    }
    convert_errors(reading);
    drop_unloaded(reading);
    return check_densities(reading);
}
