#include <math.h>
#include <stdio.h>

#include <glib.h>

#include "base/units.h"
#include "scene/field/field.h"

/* Lists contain "0 to 2", sentences "must be between 0 and 2". */
enum style { LIST, SENTENCE };

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
        gb_units_format(bound, (enum gb_dimension)field->dimension, buffer, size);
    }
}

static void write_range(const struct gb_field *field, enum style style, char *buffer,
                        size_t size)
{
    char low[80], high[80];
    write_bound(field, field->min, low, sizeof low);
    if (isinf(field->max)) {
        snprintf(buffer, size, style == LIST ? "%s or more" : "at least %s", low);
        return;
    }
    write_bound(field, field->max, high, sizeof high);
    snprintf(buffer, size, style == LIST ? "%s to %s" : "between %s and %s", low, high);
}

/* "a, b or c". */
static void write_choices(const struct gb_field *field, char *buffer, size_t size)
{
    g_strlcpy(buffer, field->choices[0], size);
    for (int i = 1; field->choices[i]; i++) {
        g_strlcat(buffer, field->choices[i + 1] ? ", " : " or ", size);
        g_strlcat(buffer, field->choices[i], size);
    }
}

/* "auto, wall, or 1 nm to 1 mm"; "auto, wall or between 1 nm and 1 mm". */
static void write_number(const struct gb_field *field, enum style style, char *buffer,
                         size_t size)
{
    char range[192];
    const bool whole = field->type == GB_FIELD_INTEGER;
    const char *words[2] = {NULL};
    int count = 0;
    if (field->auto_allowed) {
        words[count++] = "auto";
    }
    if (field->infinite) {
        words[count++] = field->infinite;
    }
    write_range(field, style, range, sizeof range);
    snprintf(buffer, size, "%s%s%s%s%s%s", count > 0 ? words[0] : "",
             count > 1 ? ", " : "", count > 1 ? words[1] : "",
             count == 0      ? ""
             : style == LIST ? ", or "
                             : " or ",
             !whole          ? ""
             : style == LIST ? "whole number "
                             : "a whole number ",
             range);
}

static char *describe(const struct gb_field *field, enum style style, char *buffer,
                      size_t size)
{
    char range[192];
    write_range(field, style, range, sizeof range);
    switch (field->type) {
    case GB_FIELD_NUMBER:
    case GB_FIELD_INTEGER:
    case GB_FIELD_RELATIVE:
        write_number(field, style, buffer, size);
        break;
    case GB_FIELD_SEED:
        snprintf(buffer, size,
                 style == LIST ? "whole number 0 to %" G_GUINT64_FORMAT
                               : "a whole number between 0 and %" G_GUINT64_FORMAT,
                 UINT64_MAX);
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
        snprintf(buffer, size, "%s, or density = %g to %g", range, GB_FIELD_DENSITY_MIN,
                 GB_FIELD_DENSITY_MAX);
        break;
    case GB_FIELD_PRESSURES:
        snprintf(buffer, size, "up to %d different pressures separated by ';', %s",
                 GB_UNLOAD_MAX, range);
        break;
    case GB_FIELD_SIZES:
        snprintf(buffer, size,
                 "a CSV file, or number: 1 um 0.4; 2 um 0.6 (or volume:); up to %d, %s",
                 GB_SIZES_MAX, range);
        break;
    case GB_FIELD_PACKING:
        snprintf(
            buffer, size,
            "a file: extended XYZ, LAMMPS dump or data, VTKHDF, or a table of x, y, z and "
            "diameter or radius");
        break;
    }
    return buffer;
}

char *gb_field_accepted(const struct gb_field *field, char *buffer, size_t size)
{
    return describe(field, LIST, buffer, size);
}

char *gb_field_accepted_sentence(const struct gb_field *field, char *buffer, size_t size)
{
    return describe(field, SENTENCE, buffer, size);
}
