#include "scene/field.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <glib.h>

#include "base/units.h"
#include "scene/size_table.h"

static const void *member_const(const struct gb_params *params,
                                const struct gb_field *field)
{
    return (const char *)params + field->offset;
}

static enum gb_dimension unit_of(const struct gb_field *field)
{
    return (enum gb_dimension)field->dimension;
}

static bool is_automatic(const struct gb_field *field, double value)
{
    if (!field->auto_allowed) {
        return false;
    }
    return isnan(field->automatic) ? isnan(value) : value == field->automatic;
}

bool gb_field_in_range(const struct gb_field *field, double value)
{
    if (value == INFINITY) {
        return field->infinite != NULL;
    }
    return isfinite(value) && value >= field->min && value <= field->max;
}

static double reference(const struct gb_field *field, const struct gb_params *params)
{
    switch (field->relative[0]) {
    case 'E':
        return params->young_pa;
    case 'T':
        return gb_params_unit_time_s(params);
    default:
        return gb_params_reference_m(params);
    }
}

double gb_field_absolute(const struct gb_field *field, const struct gb_params *params)
{
    const struct gb_relative *value = member_const(params, field);
    return value->relative ? value->value * reference(field, params) : value->value;
}

int gb_field_choice_value(const struct gb_field *field, int index)
{
    const char *name = field->choices[index];
    return g_ascii_isdigit(name[0]) ? atoi(name) : index;
}

int gb_field_find_choice(const struct gb_field *field, const char *text)
{
    for (int i = 0; field->choices[i]; i++) {
        if (strcmp(field->choices[i], text) == 0) {
            return i;
        }
    }
    return -1;
}

static void write_bound(const struct gb_field *field, double bound, char *buffer,
                        size_t size)
{
    char number[64];
    if (field->type == GB_FIELD_RELATIVE) {
        gb_units_format(bound, GB_DIM_NONE, number, sizeof number);
        snprintf(buffer, size, "%s %s", number, field->relative);
    } else if (field->type == GB_FIELD_INTEGER) {
        snprintf(buffer, size, "%.0f", bound);
    } else {
        gb_units_format(bound, unit_of(field), buffer, size);
    }
}

/* "1 nm to 1 mm", or "1e-5 d or more". */
static void write_range(const struct gb_field *field, char *buffer, size_t size)
{
    char low[80], high[80];
    write_bound(field, field->min, low, sizeof low);
    if (isinf(field->max)) {
        snprintf(buffer, size, "%s or more", low);
        return;
    }
    write_bound(field, field->max, high, sizeof high);
    snprintf(buffer, size, "%s to %s", low, high);
}

static void write_choices(const struct gb_field *field, char *buffer, size_t size)
{
    char *joined = g_strjoinv(" or ", (char **)field->choices);
    g_strlcpy(buffer, joined, size);
    g_free(joined);
}

char *gb_field_accepted(const struct gb_field *field, char *buffer, size_t size)
{
    char range[192];
    switch (field->type) {
    case GB_FIELD_NUMBER:
    case GB_FIELD_INTEGER:
    case GB_FIELD_RELATIVE:
        write_range(field, range, sizeof range);
        snprintf(buffer, size, "%s%s%s%s%s", field->auto_allowed ? "auto, or " : "",
                 field->infinite ? field->infinite : "", field->infinite ? ", or " : "",
                 field->type == GB_FIELD_INTEGER && !field->auto_allowed ? "whole number "
                                                                         : "",
                 range);
        break;
    case GB_FIELD_SEED:
        snprintf(buffer, size, "whole number 0 to %" G_GUINT64_FORMAT, UINT64_MAX);
        break;
    case GB_FIELD_CHOICE:
        write_choices(field, buffer, size);
        break;
    case GB_FIELD_TEXT:
        if (field->choices) {
            write_choices(field, buffer, size);
        } else {
            snprintf(buffer, size, "text of at most %zu bytes in UTF-8", field->size - 1);
        }
        break;
    case GB_FIELD_UNTIL:
        write_range(field, range, sizeof range);
        snprintf(buffer, size, "%s, or density = %g to %g", range, GB_FIELD_DENSITY_MIN,
                 GB_FIELD_DENSITY_MAX);
        break;
    case GB_FIELD_PRESSURES:
        write_range(field, range, sizeof range);
        snprintf(buffer, size, "up to %d different pressures separated by ';', %s",
                 GB_UNLOAD_MAX, range);
        break;
    case GB_FIELD_SIZES:
        write_range(field, range, sizeof range);
        snprintf(buffer, size,
                 "a CSV file, or number: 1 um 0.4; 2 um 0.6 (or volume:); up to %d, %s",
                 GB_SIZES_MAX, range);
        break;
    }
    return buffer;
}

bool gb_field_plain_text(const char *text)
{
    if (!g_utf8_validate(text, -1, NULL)) {
        return false;
    }
    for (const char *c = text; *c != '\0'; c = g_utf8_next_char(c)) {
        if (g_unichar_iscntrl(g_utf8_get_char(c))) {
            return false;
        }
    }
    return true;
}

static void write_relative(const struct gb_field *field, const struct gb_relative *value,
                           char *buffer, size_t size)
{
    if (!value->relative) {
        gb_units_format(value->value, unit_of(field), buffer, size);
        return;
    }
    char number[64];
    gb_units_format(value->value, GB_DIM_NONE, number, sizeof number);
    snprintf(buffer, size, "%s %s", number, field->relative);
}

static void write_choice(const struct gb_field *field, int value, char *buffer,
                         size_t size)
{
    for (int i = 0; field->choices[i]; i++) {
        if (gb_field_choice_value(field, i) == value) {
            g_strlcpy(buffer, field->choices[i], size);
            return;
        }
    }
    snprintf(buffer, size, "%d", value);
}

static void write_until(const struct gb_params *params, char *buffer, size_t size)
{
    if (isnan(params->until_density)) {
        gb_units_format(params->until_pressure_pa, GB_DIM_PRESSURE, buffer, size);
        return;
    }
    char number[64];
    gb_units_format(params->until_density, GB_DIM_NONE, number, sizeof number);
    snprintf(buffer, size, "density = %s", number);
}

static void write_pressures(const struct gb_params *params, char *buffer, size_t size)
{
    buffer[0] = '\0';
    for (int i = 0; i < MIN(params->unload_count, GB_UNLOAD_MAX); i++) {
        char number[64];
        gb_units_format(params->unload_from_pa[i], GB_DIM_PRESSURE, number,
                        sizeof number);
        g_strlcat(buffer, i > 0 ? "; " : "", size);
        g_strlcat(buffer, number, size);
    }
}

/* A number that may be "auto"; false for the other types. */
static bool plain_number(const struct gb_field *field, const void *value, double *out)
{
    if (field->type == GB_FIELD_NUMBER) {
        *out = *(const double *)value;
    } else if (field->type == GB_FIELD_RELATIVE) {
        *out = ((const struct gb_relative *)value)->value;
    } else if (field->type == GB_FIELD_INTEGER) {
        *out = (double)*(const int64_t *)value;
    } else {
        return false;
    }
    return true;
}

char *gb_field_write(const struct gb_field *field, const struct gb_params *params,
                     char *buffer, size_t size)
{
    const void *value = member_const(params, field);
    double number = 0.0;
    if (plain_number(field, value, &number) && is_automatic(field, number)) {
        g_strlcpy(buffer, "auto", size);
        return buffer;
    }
    switch (field->type) {
    case GB_FIELD_NUMBER:
        if (isinf(number) && field->infinite) {
            g_strlcpy(buffer, field->infinite, size);
        } else {
            gb_units_format(number, unit_of(field), buffer, size);
        }
        break;
    case GB_FIELD_RELATIVE:
        write_relative(field, value, buffer, size);
        break;
    case GB_FIELD_INTEGER:
        snprintf(buffer, size, "%" G_GINT64_FORMAT, *(const int64_t *)value);
        break;
    case GB_FIELD_SEED:
        snprintf(buffer, size, "%" G_GUINT64_FORMAT, *(const uint64_t *)value);
        break;
    case GB_FIELD_CHOICE:
        write_choice(field, *(const int *)value, buffer, size);
        break;
    case GB_FIELD_TEXT:
        snprintf(buffer, size, "%.*s", (int)field->size, (const char *)value);
        break;
    case GB_FIELD_UNTIL:
        write_until(params, buffer, size);
        break;
    case GB_FIELD_PRESSURES:
        write_pressures(params, buffer, size);
        break;
    case GB_FIELD_SIZES:
        gb_size_table_write(value, buffer, size);
        break;
    }
    return buffer;
}

static bool valid_choice(const struct gb_field *field, int value)
{
    for (int i = 0; field->choices[i]; i++) {
        if (gb_field_choice_value(field, i) == value) {
            return true;
        }
    }
    return false;
}

static bool valid_until(const struct gb_field *field, const struct gb_params *params)
{
    if (isnan(params->until_density)) {
        return gb_field_in_range(field, params->until_pressure_pa);
    }
    return isnan(params->until_pressure_pa) &&
           params->until_density >= GB_FIELD_DENSITY_MIN &&
           params->until_density <= GB_FIELD_DENSITY_MAX;
}

static bool valid_pressures(const struct gb_field *field, const struct gb_params *params)
{
    const double *list = params->unload_from_pa;
    if (params->unload_count < 0 || params->unload_count > GB_UNLOAD_MAX) {
        return false;
    }
    for (int i = 0; i < params->unload_count; i++) {
        if (!gb_field_in_range(field, list[i]) || (i > 0 && !(list[i] > list[i - 1]))) {
            return false;
        }
    }
    return true;
}

bool gb_field_sizes_in_range(const struct gb_field *field,
                             const struct gb_sizetable *table)
{
    return table->count == 0 ||
           (gb_field_in_range(field, table->row[0].diameter_m) &&
            gb_field_in_range(field, table->row[table->count - 1].diameter_m));
}

bool gb_field_valid(const struct gb_field *field, const struct gb_params *params)
{
    const void *value = member_const(params, field);
    double number = 0.0;
    if (plain_number(field, value, &number) && is_automatic(field, number)) {
        return true;
    }
    switch (field->type) {
    case GB_FIELD_NUMBER:
    case GB_FIELD_INTEGER:
        return gb_field_in_range(field, number);
    case GB_FIELD_RELATIVE:
        if (!((const struct gb_relative *)value)->relative) {
            number /= reference(field, params);
        }
        return gb_field_in_range(field, number);
    case GB_FIELD_SEED:
        return true;
    case GB_FIELD_CHOICE:
        return valid_choice(field, *(const int *)value);
    case GB_FIELD_TEXT:
        return memchr(value, '\0', field->size) && gb_field_plain_text(value) &&
               (!field->choices || gb_field_find_choice(field, value) >= 0);
    case GB_FIELD_UNTIL:
        return valid_until(field, params);
    case GB_FIELD_PRESSURES:
        return valid_pressures(field, params);
    case GB_FIELD_SIZES:
        return gb_size_table_check(value, NULL, NULL) &&
               gb_field_sizes_in_range(field, value);
    }
    return false;
}
