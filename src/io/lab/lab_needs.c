#include "io/lab/lab_private.h"

#include <math.h>

static bool has(const struct gb_lab_reading *reading, enum gb_lab_role role)
{
    return reading->column[role].index != GB_LAB_NONE;
}

static double largest(const double *value, size_t count)
{
    double most = 0.0;
    for (size_t i = 0; i < count; i++) {
        most = fmax(most, value[i]);
    }
    return most;
}

struct needed {
    const char *key, *example;
    bool missing;
};

/* Numbers that force, travel and mass densities need, in one question. */
static enum gb_lab_outcome check_numbers(struct gb_lab_reading *reading)
{
    const struct gb_lab_options *options = reading->options;
    const bool height = has(reading, GB_LAB_ROLE_HEIGHT);
    const bool travel = has(reading, GB_LAB_ROLE_TRAVEL);
    const struct gb_lab_unit *unit = reading->column[GB_LAB_ROLE_DENSITY].unit;
    const bool mass = has(reading, GB_LAB_ROLE_DENSITY) && unit != NULL &&
                      unit->dimension == GB_DIM_MASS_DENSITY;
    const struct needed needed[] = {
        {"die-area", "1.33 cm2",
         isnan(options->die_area_m2) &&
             (has(reading, GB_LAB_ROLE_FORCE) || height || travel)},
        {"powder-mass", "2 g", isnan(options->powder_mass_kg) && (height || travel)},
        {"true-density", "3.99 g/cm3",
         isnan(options->true_density_kg_m3) && (height || travel || mass)},
        {"initial-height", "12 mm",
         isnan(options->initial_height_m) && isnan(options->zero_travel_m) && travel},
    };
    GString *keys = g_string_new(NULL);
    GString *items = g_string_new(NULL);
    for (size_t i = 0; i < G_N_ELEMENTS(needed); i++) {
        if (needed[i].missing) {
            g_string_append_printf(keys, "%s%s", keys->len > 0 ? ", " : "",
                                   needed[i].key);
            g_string_append_printf(items, "%s%s=? (%s)", items->len > 0 ? "," : "",
                                   needed[i].key, needed[i].example);
        }
    }
    const bool missing = keys->len > 0;
    if (missing) {
        gb_lab_question_choice(reading, items->str);
        gb_lab_question_ask(reading, "%s needs %s%s",
                            travel   ? "punch travel"
                            : height ? "a height"
                            : mass   ? "a density in g/cm3 or kg/m3"
                                     : "a force",
                            keys->str,
                            needed[3].missing
                                ? " (at travel 0; or zero-travel, where the "
                                  "punches touch without powder)"
                                : "");
    }
    g_string_free(keys, TRUE);
    g_string_free(items, TRUE);
    return missing ? GB_LAB_QUESTION : GB_LAB_READ;
}

/* Numbers that nothing of the file is converted by are a mistake. */
static enum gb_lab_outcome check_unused(struct gb_lab_reading *reading)
{
    const struct gb_lab_options *options = reading->options;
    const bool travel = has(reading, GB_LAB_ROLE_TRAVEL);
    const bool volume = travel || has(reading, GB_LAB_ROLE_HEIGHT);
    const struct gb_lab_unit *unit = reading->column[GB_LAB_ROLE_DENSITY].unit;
    const bool mass = unit != NULL && unit->dimension == GB_DIM_MASS_DENSITY;
    const struct {
        const char *key;
        double value;
        bool used;
    } given[] = {
        {"die-area", options->die_area_m2, volume || has(reading, GB_LAB_ROLE_FORCE)},
        {"powder-mass", options->powder_mass_kg, volume},
        {"true-density", options->true_density_kg_m3, volume || mass},
        {"compliance", options->compliance_m_n, travel},
        {"initial-height", options->initial_height_m, travel},
        {"zero-travel", options->zero_travel_m, travel},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(given); i++) {
        if (!isnan(given[i].value) && !given[i].used) {
            char pressure[GB_LAB_LAYOUT_COLUMN];
            char density[GB_LAB_LAYOUT_COLUMN];
            const int p = has(reading, GB_LAB_ROLE_PRESSURE) ? GB_LAB_ROLE_PRESSURE
                                                             : GB_LAB_ROLE_FORCE;
            const int d = volume ? (travel ? GB_LAB_ROLE_TRAVEL : GB_LAB_ROLE_HEIGHT)
                          : has(reading, GB_LAB_ROLE_POROSITY) ? GB_LAB_ROLE_POROSITY
                                                               : GB_LAB_ROLE_DENSITY;
            return gb_lab_question_fail(
                reading,
                "%.200s: %s has no use: %s is read from %s, %s from %s; --columns names "
                "others",
                reading->path, given[i].key, gb_lab_role_name((enum gb_lab_role)p),
                gb_lab_layout_column(reading, reading->column[p].index, pressure),
                gb_lab_role_name((enum gb_lab_role)d),
                gb_lab_layout_column(reading, reading->column[d].index, density));
        }
    }
    if (!isnan(options->initial_height_m) && !isnan(options->zero_travel_m)) {
        return gb_lab_question_fail(
            reading, "initial-height, zero-travel: expected one of the two");
    }
    return GB_LAB_READ;
}

/* A density or porosity without unit: a fraction if it can be one. */
static enum gb_lab_outcome check_fraction(struct gb_lab_reading *reading,
                                          enum gb_lab_role role)
{
    struct gb_lab_column *column = &reading->column[role];
    if (column->index == GB_LAB_NONE || column->unit != NULL) {
        return GB_LAB_READ;
    }
    const double most = largest(reading->value[role], reading->count);
    const bool mass = role == GB_LAB_ROLE_DENSITY;
    if (most <= 1.0 && (!mass || isnan(reading->options->true_density_kg_m3))) {
        column->unit = gb_lab_unit_find("1");
        column->unit_said = true;
        column->guessed = true;
        return GB_LAB_READ;
    }
    const char *const units[] = {most <= 1.0 ? "1" : "%", mass ? "g/cm3" : NULL,
                                 mass && most > 100.0 ? "kg/m3" : NULL};
    for (size_t i = most > 100.0 ? 1 : 0; i < G_N_ELEMENTS(units); i++) {
        if (units[i] != NULL) {
            char *item = g_strdup_printf("%s=%d:%s", gb_lab_role_name(role),
                                         column->index + 1, units[i]);
            gb_lab_question_choice(reading, item);
            g_free(item);
        }
    }
    char shown[GB_LAB_LAYOUT_COLUMN];
    return gb_lab_question_ask(reading, "%s from %s, up to %.6g: in which unit? (%s)",
                               gb_lab_role_name(role),
                               gb_lab_layout_column(reading, column->index, shown), most,
                               mass ? gb_lab_unit_accepted(GB_DIM_MASS_DENSITY) : "%, 1");
}

enum gb_lab_outcome gb_lab_needs_check(struct gb_lab_reading *reading)
{
    enum gb_lab_outcome outcome = check_fraction(reading, GB_LAB_ROLE_DENSITY);
    if (outcome == GB_LAB_READ) {
        outcome = check_fraction(reading, GB_LAB_ROLE_POROSITY);
    }
    if (outcome == GB_LAB_READ) {
        outcome = check_numbers(reading);
    }
    return outcome == GB_LAB_READ ? check_unused(reading) : outcome;
}
