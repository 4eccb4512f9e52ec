#include "phys/field.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <glib.h>

#include "base/units.h"

/* Bounds of what the loading fields accept; the table has room for one range a field. */
static const double density_min = 0.02, density_max = 0.99;

static void *member(struct gb_params *params, const struct gb_field *field)
{
    return (char *)params + field->offset;
}

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

static bool in_range(const struct gb_field *field, double value)
{
    return isfinite(value) && value >= field->min && value <= field->max;
}

static double reference(const struct gb_field *field, const struct gb_params *params)
{
    return field->relative[0] == 'E' ? params->young_pa : params->diameter_m;
}

double gb_field_absolute(const struct gb_field *field, const struct gb_params *params)
{
    const struct gb_relative *value = member_const(params, field);
    return value->relative ? value->value * reference(field, params) : value->value;
}

/* A choice whose names are numbers ("3", "2") is stored as that number, else as the index. */
static int choice_value(const struct gb_field *field, int index)
{
    const char *name = field->choices[index];
    return g_ascii_isdigit(name[0]) ? atoi(name) : index;
}

/* Index of the choice with this name, or -1. */
static int find_choice(const struct gb_field *field, const char *text)
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
        snprintf(buffer, size, "%s%s%s", field->auto_allowed ? "auto, or " : "",
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
        snprintf(buffer, size, "%s, or density = %g to %g", range, density_min,
                 density_max);
        break;
    case GB_FIELD_PRESSURES:
        write_range(field, range, sizeof range);
        snprintf(buffer, size, "up to %d different pressures separated by ';', %s",
                 GB_UNLOAD_MAX, range);
        break;
    }
    return buffer;
}

/* Units are listed only where the unit is what went wrong. */
static bool refuse(const struct gb_field *field, const char *text, bool units,
                   struct gb_error *err)
{
    char accepted[256];
    gb_field_accepted(field, accepted, sizeof accepted);
    const bool has_unit =
        field->dimension != GB_DIM_NONE && field->dimension != GB_DIM_FRACTION;
    return gb_error_set(err, GB_ERR_INPUT, "%s.%s = %.80s: accepted %s%s%s", field->group,
                        field->key, text, accepted, units && has_unit ? "; units " : "",
                        units && has_unit ? gb_units_accepted(unit_of(field)) : "");
}

static bool read_number(const struct gb_field *field, const char *text, double *out,
                        struct gb_error *err)
{
    double value = 0.0;
    if (!gb_units_parse(text, unit_of(field), &value, NULL)) {
        return refuse(field, text, true, err);
    }
    if (!in_range(field, value)) {
        return refuse(field, text, false, err);
    }
    *out = value;
    return true;
}

static bool read_integer(const struct gb_field *field, const char *text, int64_t *out,
                         struct gb_error *err)
{
    double value = 0.0;
    if (!gb_units_parse(text, GB_DIM_NONE, &value, NULL) || value != floor(value) ||
        !in_range(field, value)) {
        return refuse(field, text, false, err);
    }
    *out = (int64_t)value;
    return true;
}

static bool read_seed(const struct gb_field *field, const char *text, uint64_t *out,
                      struct gb_error *err)
{
    guint64 value = 0;
    if (!g_ascii_string_to_unsigned(text, 10, 0, UINT64_MAX, &value, NULL)) {
        return refuse(field, text, false, err);
    }
    *out = value;
    return true;
}

/* "0.008 d" or "0.1 nm".  The second is compared with the range only by gb_params_check,
 * because the diameter may change after it. */
static bool read_relative(const struct gb_field *field, const char *text,
                          struct gb_relative *out, struct gb_error *err)
{
    const char *end = NULL;
    double value = 0.0;
    if (!gb_units_number(text, &end, &value)) {
        return refuse(field, text, true, err);
    }
    while (*end == ' ' || *end == '\t') {
        end++;
    }
    if (strcmp(end, field->relative) == 0) {
        if (!in_range(field, value)) {
            return refuse(field, text, false, err);
        }
        *out = (struct gb_relative){value, true};
        return true;
    }
    if (!gb_units_parse(text, unit_of(field), &value, NULL)) {
        return refuse(field, text, true, err);
    }
    if (!(value >= 0.0)) {
        return refuse(field, text, false, err);
    }
    *out = (struct gb_relative){value, false};
    return true;
}

static bool read_choice(const struct gb_field *field, const char *text, int *out,
                        struct gb_error *err)
{
    const int index = find_choice(field, text);
    if (index < 0) {
        return refuse(field, text, false, err);
    }
    *out = choice_value(field, index);
    return true;
}

static bool plain_text(const char *text)
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

static bool read_text(const struct gb_field *field, const char *text, char *out,
                      struct gb_error *err)
{
    const size_t length = strlen(text);
    if (length >= field->size || !plain_text(text) ||
        (field->choices && find_choice(field, text) < 0)) {
        return refuse(field, text, false, err);
    }
    memset(out, 0, field->size); /* equal values are equal bytes */
    memcpy(out, text, length);
    return true;
}

static bool read_until(const struct gb_field *field, const char *text,
                       struct gb_params *params, struct gb_error *err)
{
    static const char word[] = "density";
    if (!g_str_has_prefix(text, word)) {
        double pressure = 0.0;
        if (!read_number(field, text, &pressure, err)) {
            return false;
        }
        params->until_pressure_pa = pressure;
        params->until_density = NAN;
        return true;
    }
    const char *at = text + strlen(word);
    at += strspn(at, " \t");
    double density = 0.0;
    if (*at != '=' || !gb_units_parse(at + 1, GB_DIM_NONE, &density, NULL) ||
        !(density >= density_min && density <= density_max)) {
        return refuse(field, text, false, err);
    }
    params->until_density = density;
    params->until_pressure_pa = NAN;
    return true;
}

static int compare_numbers(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static bool read_pressures(const struct gb_field *field, const char *text,
                           struct gb_params *params, struct gb_error *err)
{
    double list[GB_UNLOAD_MAX] = {0};
    int count = 0;
    char **parts = g_strsplit(text, ";", GB_UNLOAD_MAX + 2);
    bool good = true;
    for (int i = 0; parts[i] && good; i++) {
        g_strstrip(parts[i]);
        if (parts[i][0] == '\0') {
            continue; /* a trailing ';' is GLib's own way of writing a list */
        }
        double value = 0.0;
        if (count == GB_UNLOAD_MAX) {
            good = refuse(field, text, false, err);
        } else if (!gb_units_parse(parts[i], unit_of(field), &value, NULL)) {
            good = refuse(field, text, true, err);
        } else if (!in_range(field, value)) {
            good = refuse(field, text, false, err);
        } else {
            list[count++] = value;
        }
    }
    g_strfreev(parts);
    qsort(list, (size_t)count, sizeof list[0], compare_numbers);
    for (int i = 1; i < count && good; i++) {
        good = list[i] > list[i - 1] || refuse(field, text, false, err);
    }
    if (good) {
        memset(params->unload_from_pa, 0, sizeof params->unload_from_pa);
        memcpy(params->unload_from_pa, list, (size_t)count * sizeof list[0]);
        params->unload_count = count;
    }
    return good;
}

/* Stores what "auto" is in memory. */
static void set_automatic(const struct gb_field *field, void *out)
{
    if (field->type == GB_FIELD_NUMBER) {
        *(double *)out = field->automatic;
    } else if (field->type == GB_FIELD_INTEGER) {
        *(int64_t *)out = (int64_t)field->automatic;
    } else {
        *(struct gb_relative *)out = (struct gb_relative){field->automatic, true};
    }
}

static bool read_trimmed(const struct gb_field *field, struct gb_params *params,
                         const char *text, struct gb_error *err)
{
    void *out = member(params, field);
    if (field->auto_allowed && strcmp(text, "auto") == 0) {
        set_automatic(field, out);
        return true;
    }
    switch (field->type) {
    case GB_FIELD_NUMBER:
        return read_number(field, text, out, err);
    case GB_FIELD_RELATIVE:
        return read_relative(field, text, out, err);
    case GB_FIELD_INTEGER:
        return read_integer(field, text, out, err);
    case GB_FIELD_SEED:
        return read_seed(field, text, out, err);
    case GB_FIELD_CHOICE:
        return read_choice(field, text, out, err);
    case GB_FIELD_TEXT:
        return read_text(field, text, out, err);
    case GB_FIELD_UNTIL:
        return read_until(field, text, params, err);
    case GB_FIELD_PRESSURES:
        return read_pressures(field, text, params, err);
    }
    return false;
}

bool gb_field_read(const struct gb_field *field, struct gb_params *params,
                   const char *text, struct gb_error *err)
{
    char *trimmed = g_strstrip(g_strdup(text));
    const bool good = read_trimmed(field, params, trimmed, err);
    g_free(trimmed);
    return good;
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

static void write_choice(const struct gb_field *field, int value, char *buffer, size_t size)
{
    for (int i = 0; field->choices[i]; i++) {
        if (choice_value(field, i) == value) {
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
        gb_units_format(params->unload_from_pa[i], GB_DIM_PRESSURE, number, sizeof number);
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
        gb_units_format(number, unit_of(field), buffer, size);
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
    }
    return buffer;
}

static bool valid_choice(const struct gb_field *field, int value)
{
    for (int i = 0; field->choices[i]; i++) {
        if (choice_value(field, i) == value) {
            return true;
        }
    }
    return false;
}

static bool valid_until(const struct gb_field *field, const struct gb_params *params)
{
    if (isnan(params->until_density)) {
        return in_range(field, params->until_pressure_pa);
    }
    return isnan(params->until_pressure_pa) && params->until_density >= density_min &&
           params->until_density <= density_max;
}

static bool valid_pressures(const struct gb_field *field, const struct gb_params *params)
{
    const double *list = params->unload_from_pa;
    if (params->unload_count < 0 || params->unload_count > GB_UNLOAD_MAX) {
        return false;
    }
    for (int i = 0; i < params->unload_count; i++) {
        if (!in_range(field, list[i]) || (i > 0 && !(list[i] > list[i - 1]))) {
            return false;
        }
    }
    return true;
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
        return in_range(field, number);
    case GB_FIELD_RELATIVE:
        if (!((const struct gb_relative *)value)->relative) {
            number /= reference(field, params);
        }
        return in_range(field, number);
    case GB_FIELD_SEED:
        return true;
    case GB_FIELD_CHOICE:
        return valid_choice(field, *(const int *)value);
    case GB_FIELD_TEXT:
        return memchr(value, '\0', field->size) && plain_text(value) &&
               (!field->choices || find_choice(field, value) >= 0);
    case GB_FIELD_UNTIL:
        return valid_until(field, params);
    case GB_FIELD_PRESSURES:
        return valid_pressures(field, params);
    }
    return false;
}
