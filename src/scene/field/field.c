#include "scene/field/field.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <glib.h>

#include "base/units.h"
#include "scene/derived.h"
#include "scene/size/size_table.h"

static const void *member_const(const struct gb_params *params,
                                const struct gb_field *field)
{
    return (const char *)params + field->offset;
}

bool gb_field_is_auto(const struct gb_field *field, double value)
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
        return gb_derived_unit_time_s(params);
    default:
        return gb_derived_reference_m(params);
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

bool gb_field_number(const struct gb_field *field, const void *member, double *number)
{
    if (field->type == GB_FIELD_NUMBER) {
        *number = *(const double *)member;
    } else if (field->type == GB_FIELD_RELATIVE) {
        *number = ((const struct gb_relative *)member)->value;
    } else if (field->type == GB_FIELD_INTEGER) {
        *number = (double)*(const int64_t *)member;
    } else {
        return false;
    }
    return true;
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
    if (gb_field_number(field, value, &number) && gb_field_is_auto(field, number)) {
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
    case GB_FIELD_PACKING: /* gb_imported_check_params checks the file */
        return memchr(((const struct gb_packing_file *)value)->path, '\0',
                      sizeof((const struct gb_packing_file *)value)->path) != NULL;
    }
    return false;
}

bool gb_field_applies(const struct gb_field *field, const struct gb_params *params)
{
    return (field->kinds == 0 || (field->kinds >> params->kind & 1u) != 0) &&
           (field->laws == 0 || (field->laws >> params->normal & 1u) != 0) &&
           (field->applies == NULL || field->applies(params));
}
