#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <glib.h>

#include "base/units.h"
#include "scene/field/field.h"
#include "scene/imported/imported.h"
#include "scene/size/size_table.h"

static void *member(struct gb_params *params, const struct gb_field *field)
{
    return (char *)params + field->offset;
}

/* What is wrong with a value.  The message lists the units only for UNIT. */
enum fault { VALUE, UNIT };

static bool refuse(const struct gb_field *field, const char *text, enum fault fault,
                   struct gb_error *err)
{
    char accepted[256];
    if (field->type != GB_FIELD_CHOICE &&
        *gb_units_comma(text, accepted, sizeof accepted) != '\0') {
        return gb_error_set(err, GB_ERR_INPUT, "%s.%s = %.80s: %s", field->group,
                            field->key, text, accepted);
    }
    gb_field_accepted_sentence(field, accepted, sizeof accepted);
    const enum gb_dimension dimension = (enum gb_dimension)field->dimension;
    const bool units =
        fault == UNIT && dimension != GB_DIM_NONE && dimension != GB_DIM_FRACTION;
    return gb_error_set(err, GB_ERR_INPUT, "%s.%s = %.80s: must be %s%s%s", field->group,
                        field->key, text, accepted, units ? "; units " : "",
                        units ? gb_units_accepted(dimension) : "");
}

static bool read_number(const struct gb_field *field, const char *text, double *out,
                        struct gb_error *err)
{
    double value = 0.0;
    if (field->infinite && strcmp(text, field->infinite) == 0) {
        *out = INFINITY;
        return true;
    }
    if (!gb_units_parse(text, (enum gb_dimension)field->dimension, &value, NULL)) {
        return refuse(field, text, UNIT, err);
    }
    if (!gb_field_in_range(field, value)) {
        return refuse(field, text, VALUE, err);
    }
    *out = value;
    return true;
}

static bool read_integer(const struct gb_field *field, const char *text, int64_t *out,
                         struct gb_error *err)
{
    double value = 0.0;
    if (!gb_units_parse(text, GB_DIM_NONE, &value, NULL) || value != floor(value) ||
        !gb_field_in_range(field, value)) {
        return refuse(field, text, VALUE, err);
    }
    *out = (int64_t)value;
    return true;
}

static bool read_seed(const struct gb_field *field, const char *text, uint64_t *out,
                      struct gb_error *err)
{
    guint64 value = 0;
    if (!g_ascii_string_to_unsigned(text, 10, 0, UINT64_MAX, &value, NULL)) {
        return refuse(field, text, VALUE, err);
    }
    *out = value;
    return true;
}

/* "0.008 d" or "0.1 nm".  Only gb_params_check compares a length with the range,
 * because the diameter may still change. */
static bool read_relative(const struct gb_field *field, const char *text,
                          struct gb_relative *out, struct gb_error *err)
{
    const char *end = NULL;
    double value = 0.0;
    if (!gb_units_number(text, &end, &value)) {
        return refuse(field, text, UNIT, err);
    }
    while (*end == ' ' || *end == '\t') {
        end++;
    }
    if (strcmp(end, field->relative) == 0) {
        if (!gb_field_in_range(field, value)) {
            return refuse(field, text, VALUE, err);
        }
        *out = (struct gb_relative){value, true};
        return true;
    }
    if (!gb_units_parse(text, (enum gb_dimension)field->dimension, &value, NULL)) {
        return refuse(field, text, UNIT, err);
    }
    if (!(value >= 0.0)) {
        return refuse(field, text, VALUE, err);
    }
    *out = (struct gb_relative){value, false};
    return true;
}

static bool read_choice(const struct gb_field *field, const char *text, int *out,
                        struct gb_error *err)
{
    const int index = gb_field_find_choice(field, text);
    if (index < 0) {
        return refuse(field, text, VALUE, err);
    }
    *out = gb_field_choice_value(field, index);
    return true;
}

static bool read_text(const struct gb_field *field, const char *text, char *out,
                      struct gb_error *err)
{
    const size_t length = strlen(text);
    if (length >= field->size || !gb_field_plain_text(text) ||
        (field->choices && gb_field_find_choice(field, text) < 0)) {
        return refuse(field, text, VALUE, err);
    }
    memset(out, 0, field->size); /* equal texts must be equal byte by byte */
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
        !(density >= GB_FIELD_DENSITY_MIN && density <= GB_FIELD_DENSITY_MAX)) {
        return refuse(field, text, VALUE, err);
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
            continue; /* GLib ends a list with ';' */
        }
        double value = 0.0;
        if (count == GB_UNLOAD_MAX) {
            good = refuse(field, text, VALUE, err);
        } else if (!gb_units_parse(parts[i], (enum gb_dimension)field->dimension, &value,
                                   NULL)) {
            good = refuse(field, text, UNIT, err);
        } else if (!gb_field_in_range(field, value)) {
            good = refuse(field, text, VALUE, err);
        } else {
            list[count++] = value;
        }
    }
    g_strfreev(parts);
    qsort(list, (size_t)count, sizeof list[0], compare_numbers);
    for (int i = 1; i < count && good; i++) {
        good = list[i] > list[i - 1] || refuse(field, text, VALUE, err);
    }
    if (good) {
        memset(params->unload_from_pa, 0, sizeof params->unload_from_pa);
        memcpy(params->unload_from_pa, list, (size_t)count * sizeof list[0]);
        params->unload_count = count;
    }
    return good;
}

static bool read_sizes(const struct gb_field *field, const char *text,
                       struct gb_sizetable *out, struct gb_error *err)
{
    struct gb_sizetable table;
    struct gb_error why = {0};
    if (!gb_size_table_read(&table, text, &why)) {
        return gb_error_set(err, why.code, "%s.%s: %s", field->group, field->key,
                            why.text);
    }
    if (!gb_field_sizes_in_range(field, &table)) {
        return refuse(field, text, VALUE, err);
    }
    *out = table;
    return true;
}

/* Stores an absolute path, because the run may continue from another folder. */
static bool read_packing(const struct gb_field *field, const char *text,
                         struct gb_params *params, struct gb_error *err)
{
    struct gb_error why = {0};
    if (*text == '\0') {
        params->from = (struct gb_packing_file){.path = ""};
        return true;
    }
    char *path = g_canonicalize_filename(text, NULL);
    bool good = strlen(path) < sizeof params->from.path;
    if (!good) {
        gb_error_set(&why, GB_ERR_INPUT, "%.80s: the path is longer than %zu bytes", path,
                     sizeof params->from.path - 1);
    }
    const struct gb_imported *packing = good ? gb_imported_load(path, &why) : NULL;
    if (packing != NULL) {
        gb_imported_take(params, path, packing);
    }
    g_free(path);
    return packing != NULL ||
           gb_error_set(err, why.code, "%s.%s: %s", field->group, field->key, why.text);
}

/* Stores the value of "auto". */
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
    case GB_FIELD_SIZES:
        return read_sizes(field, text, out, err);
    case GB_FIELD_PACKING:
        return read_packing(field, text, params, err);
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
