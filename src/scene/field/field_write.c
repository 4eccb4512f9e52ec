#include <math.h>
#include <stdio.h>

#include <glib.h>

#include "base/units.h"
#include "scene/field/field.h"
#include "scene/size/size_table.h"

static const void *member_const(const struct gb_params *params,
                                const struct gb_field *field)
{
    return (const char *)params + field->offset;
}

static enum gb_dimension unit_of(const struct gb_field *field)
{
    return (enum gb_dimension)field->dimension;
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

char *gb_field_write(const struct gb_field *field, const struct gb_params *params,
                     char *buffer, size_t size)
{
    const void *value = member_const(params, field);
    double number = 0.0;
    if (gb_field_number(field, value, &number) && gb_field_is_auto(field, number)) {
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
    case GB_FIELD_PACKING:
        g_strlcpy(buffer, ((const struct gb_packing_file *)value)->path, size);
        break;
    }
    return buffer;
}
