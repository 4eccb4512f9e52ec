#include "many/sweep/axes.h"

#include <gsl/gsl_qrng.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>

#include "base/alloc.h"
#include "base/units.h"
#include "greenbody/status.h"
#include "io/material.h"
#include "io/rundir.h"
#include "many/key_difference.h"
#include "many/runset.h"

enum { COORDINATES_MOST = 40 };

/* Coordinate `axis` (0 to 39) of the first points of a Sobol sequence (GSL; Antonov and
 * Saleev, USSR Comput. Maths Math. Phys. 19, 252 (1980)), each in [0, 1).  Errors:
 * GB_ERR_MEMORY. */
static bool sobol_coordinate(size_t axis, size_t points, double *share,
                             struct gb_error *err)
{
    const unsigned int dimension = (unsigned int)axis + 1;
    double coordinate[COORDINATES_MOST];
    void *state = gb_alloc_array(1, gsl_qrng_sobol->state_size(dimension), err);
    if (state == NULL) {
        return false;
    }
    gsl_qrng_sobol->init_state(state, dimension);
    for (size_t p = 0; p < points; p++) {
        gsl_qrng_sobol->get(state, dimension, coordinate);
        share[p] = coordinate[axis];
    }
    gb_alloc_free(state);
    return true;
}

enum { DESIGN_LEAST = 2 };

static bool refuse(const char *text, struct gb_error *err)
{
    return gb_error_set(
        err, GB_ERR_INPUT,
        "%.120s: expected group.key=FROM:TO:COUNT, FROM:TO:COUNT:log or a "
        "list VALUE;VALUE;... or VALUE,VALUE,..., a unit at the end counts for all",
        text);
}

static bool refuse_range(const char *text, struct gb_error *err)
{
    return gb_error_set(err, GB_ERR_INPUT,
                        "%.120s: expected in a design: group.key=FROM:TO or FROM:TO:log, "
                        "a unit at the end counts for both",
                        text);
}

bool gb_axes_design(struct gb_axes *axes, const char *text, struct gb_error *err)
{
    guint64 points = 0;
    if (!g_str_has_prefix(text, "sobol:") ||
        !g_ascii_string_to_unsigned(text + strlen("sobol:"), 10, DESIGN_LEAST,
                                    GB_AXES_VALUES_MOST, &points, NULL)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--design %.80s: expected sobol:N, a Sobol sequence of %d to "
                            "%d points",
                            text, DESIGN_LEAST, GB_AXES_VALUES_MOST);
    }
    axes->design = (size_t)points;
    return true;
}

/* The unit behind a number, "" when there is none; NULL for text that is no number. */
static const char *unit_of(const char *text, double *value)
{
    const char *end = text;
    if (!gb_units_number(text, &end, value)) {
        return NULL;
    }
    return end + strspn(end, " \t");
}

static bool set_value(const struct gb_axis *axis, struct gb_params *params,
                      const char *value, struct gb_error *err)
{
    return axis->material ? gb_material_apply(params, value, err)
                          : gb_params_set(params, axis->field, value, err);
}

/* Takes one value if the key does; *params holds the fallbacks. */
static bool add_value(struct gb_axis *axis, const char *text, struct gb_error *err)
{
    struct gb_params params;
    char value[GB_PARAMS_VALUE_MAX];
    gb_params_init(&params);
    if (!set_value(axis, &params, text, err)) {
        return false;
    }
    if (axis->material) {
        g_strlcpy(value, text, sizeof value);
    } else {
        gb_params_format(&params, axis->field, value, sizeof value);
    }
    for (guint i = 0; i < axis->values->len && axis->share == NULL; i++) {
        if (strcmp(g_ptr_array_index(axis->values, i), value) == 0) {
            return gb_error_set(err, GB_ERR_INPUT, "%s.%s = %.80s is given twice",
                                axis->field->group, axis->field->key, value);
        }
    }
    if (axis->values->len == GB_AXES_VALUES_MOST) {
        return gb_error_set(err, GB_ERR_INPUT, "%s.%s: expected up to %d values",
                            axis->field->group, axis->field->key, GB_AXES_VALUES_MOST);
    }
    g_ptr_array_add(axis->values, g_strdup(value));
    return true;
}

/* A value that may lack its unit. */
static bool add_with_unit(struct gb_axis *axis, const char *text, const char *unit,
                          struct gb_error *err)
{
    double number = 0.0;
    const char *own = unit_of(text, &number);
    char *whole = own != NULL && *own == '\0' && *unit != '\0'
                      ? g_strconcat(text, " ", unit, NULL)
                      : g_strdup(text);
    const bool good = add_value(axis, whole, err);
    g_free(whole);
    return good;
}

/* "0,1" with nothing else: 0.1 of a decimal comma, or 0 and 1? */
static bool is_decimal_comma(const struct gb_axis *axis, const char *values)
{
    const char *comma = strchr(values, ',');
    return axis->field->type != GB_FIELD_INTEGER && comma != NULL &&
           strchr(comma + 1, ',') == NULL && strpbrk(values, ".eE") == NULL &&
           comma > values && g_ascii_isdigit(comma[-1]) && g_ascii_isdigit(comma[1]);
}

bool gb_axes_is_free_text(const struct gb_axis *axis)
{
    return axis->material ||
           (axis->field->type == GB_FIELD_TEXT && axis->field->choices == NULL);
}

/* What is between the values: ';', or ',' where there is none and the key's own values
 * cannot have one. */
static const char *separator_of(const struct gb_axis *axis, const char *values)
{
    return (gb_axes_is_free_text(axis) && !axis->material) || strchr(values, ';') != NULL
               ? ";"
               : ",";
}

static bool add_list(struct gb_axis *axis, const char *text, const char *values,
                     struct gb_error *err)
{
    const char *separator = separator_of(axis, values);
    if (*separator == ',' && is_decimal_comma(axis, values)) {
        return gb_error_set(
            err, GB_ERR_INPUT,
            "%.120s: one number with a comma, or two: expected a point in "
            "numbers and ';' between values",
            text);
    }
    char **parts = g_strsplit(values, separator, GB_AXES_VALUES_MOST + 2);
    const guint count = g_strv_length(parts);
    for (guint i = 0; i < count; i++) {
        g_strstrip(parts[i]);
    }
    double number = 0.0;
    const char *unit = count > 0 ? unit_of(parts[count - 1], &number) : NULL;
    bool good = count > 0 || refuse(text, err);
    for (guint i = 0; i < count && good; i++) {
        good = parts[i][0] != '\0' ? add_with_unit(axis, parts[i], unit ? unit : "", err)
                                   : refuse(text, err);
    }
    g_strfreev(parts);
    return good;
}

struct range {
    double from, to, count;
    bool logarithmic;
    const char *unit;
};

/* "0.05:0.4:8", "9.7:38:4 nm", "9.7 nm:38 nm:4", "1:100:3:log MPa". */
static bool read_range(char **parts, struct range *range)
{
    const guint length = g_strv_length(parts);
    double *const into[] = {&range->from, &range->to, &range->count};
    range->unit = "";
    for (guint i = 0; i < 3 && i < length; i++) {
        const char *unit = unit_of(g_strstrip(parts[i]), into[i]);
        if (unit == NULL || (*unit && *range->unit && strcmp(unit, range->unit) != 0)) {
            return false;
        }
        range->unit = *unit ? unit : range->unit;
    }
    if (length == 4 && g_str_has_prefix(g_strstrip(parts[3]), "log")) {
        const char *unit = parts[3] + 3 + strspn(parts[3] + 3, " \t");
        range->unit = *unit ? unit : range->unit;
        range->logarithmic = true;
    }
    return (length == 3 || range->logarithmic) && isfinite(range->from) &&
           isfinite(range->to) && range->count >= 2.0 &&
           range->count <= GB_AXES_VALUES_MOST && range->count == floor(range->count) &&
           (!range->logarithmic || (range->from > 0.0 && range->to > 0.0));
}

static double range_value(const struct range *range, double share)
{
    return range->logarithmic ? range->from * pow(range->to / range->from, share)
                              : range->from + share * (range->to - range->from);
}

static bool add_range(struct gb_axis *axis, const char *text, const char *values,
                      struct gb_error *err)
{
    char **parts = g_strsplit(values, ":", 5);
    struct range range = {0};
    bool good = read_range(parts, &range) || refuse(text, err);
    for (guint i = 0; good && i < (guint)range.count; i++) {
        char value[64];
        /* twelve digits: 0.1 and not 0.10000000000000001 */
        char *item = g_strconcat(
            g_ascii_formatd(value, sizeof value, "%.12g",
                            range_value(&range, (double)i / (range.count - 1.0))),
            *range.unit ? " " : "", range.unit, NULL);
        good = add_value(axis, item, err);
        g_free(item);
    }
    g_strfreev(parts);
    return good;
}

/* "0.05:0.4", "9.7:38 nm", "9.7 nm:38 nm:log": a range without its count. */
static bool read_design_range(char **parts, struct range *range)
{
    const guint length = g_strv_length(parts);
    if (length < 2 || length > 3) {
        return false;
    }
    char count[] = "2";
    char *with_count[] = {parts[0], parts[1], count, length == 3 ? parts[2] : NULL, NULL};
    return read_range(with_count, range) && range->from != range->to;
}

static bool add_designed(struct gb_axis *axis, const struct range *range, double share,
                         struct gb_error *err)
{
    const double at = range_value(range, share);
    char value[64];
    g_ascii_formatd(value, sizeof value, "%.12g",
                    axis->field->type == GB_FIELD_INTEGER ? round(at) : at);
    char *item = g_strconcat(value, *range->unit ? " " : "", range->unit, NULL);
    const bool good = add_value(axis, item, err);
    g_free(item);
    return good;
}

static bool add_design(struct gb_axes *axes, const char *text, const char *values,
                       struct gb_error *err)
{
    struct gb_axis *axis = &axes->axis[axes->count - 1];
    char **parts = g_strsplit(values, ":", 5);
    struct range range = {0};
    axis->share = gb_alloc_array(axes->design, sizeof *axis->share, err);
    bool good = axis->share != NULL &&
                (read_design_range(parts, &range) || refuse_range(text, err)) &&
                sobol_coordinate(axes->count - 1, axes->design, axis->share, err);
    for (size_t p = 0; good && p < axes->design; p++) {
        good = add_designed(axis, &range, axis->share[p], err);
    }
    g_strfreev(parts);
    return good;
}

/* The row of "group.key", or of a key that only one group has, if it can be varied. */
static const struct gb_field *find_field(const struct gb_axes *axes, const char *name,
                                         struct gb_error *err)
{
    const struct gb_field *field = gb_params_find_name(name, err);
    if (field == NULL) {
        return NULL;
    }
    if (gb_key_difference_bookkeeping(field) || field->type == GB_FIELD_PRESSURES ||
        field->type == GB_FIELD_SEED || field->type == GB_FIELD_SIZES ||
        field->type == GB_FIELD_PACKING) {
        gb_error_set(err, GB_ERR_INPUT,
                     "%s: cannot be varied; expected keys of one value that make another "
                     "experiment (replicas vary the seed)",
                     name);
        return NULL;
    }
    for (size_t i = 0; i < axes->count; i++) {
        if (axes->axis[i].field == field) {
            gb_error_set(err, GB_ERR_INPUT, "%s: is varied twice", name);
            return NULL;
        }
    }
    return field;
}

bool gb_axes_add(struct gb_axes *axes, const char *text, struct gb_error *err)
{
    const char *equals = strchr(text, '=');
    if (equals == NULL || equals == text) {
        return refuse(text, err);
    }
    if (axes->count == GB_AXES_MOST) {
        return gb_error_set(err, GB_ERR_INPUT, "%.120s: expected up to %d varied keys",
                            text, GB_AXES_MOST);
    }
    char *name = g_strstrip(g_strndup(text, (gsize)(equals - text)));
    const bool material = strcmp(name, GB_MATERIAL_GROUP) == 0;
    const struct gb_field *field =
        find_field(axes, material ? GB_MATERIAL_GROUP ".name" : name, err);
    g_free(name);
    if (field == NULL) {
        return false;
    }
    if (material && axes->design > 0) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%.120s: expected in a grid, names have no range", text);
    }
    struct gb_axis *axis = &axes->axis[axes->count++];
    *axis = (struct gb_axis){field, .values = g_ptr_array_new_with_free_func(g_free),
                             .material = material};
    if (axes->design > 0) {
        return add_design(axes, text, equals + 1, err);
    }
    return strchr(equals, ':') != NULL && !material
               ? add_range(axis, text, equals + 1, err)
               : add_list(axis, text, equals + 1, err);
}

void gb_axes_finish(struct gb_axes *axes)
{
    for (size_t i = 0; i < axes->count; i++) {
        g_ptr_array_unref(axes->axis[i].values);
        gb_alloc_free(axes->axis[i].share);
    }
    axes->count = 0;
}

size_t gb_axes_points(const struct gb_axes *axes)
{
    size_t points = 1;
    if (axes->design > 0 && axes->count > 0) {
        return axes->design;
    }
    for (size_t i = 0; i < axes->count; i++) {
        points *= axes->axis[i].values->len;
    }
    return points;
}

const char *gb_axes_value(const struct gb_axes *axes, size_t point, size_t axis)
{
    for (size_t i = axes->count - 1; i > axis && axes->design == 0; i--) {
        point /= axes->axis[i].values->len;
    }
    const GPtrArray *values = axes->axis[axis].values;
    return g_ptr_array_index(values, point % values->len);
}

bool gb_axes_apply(const struct gb_axes *axes, size_t point, struct gb_params *params,
                   struct gb_error *err)
{
    /* a material first: it sets keys that other axes may set again */
    for (size_t i = 0; i < 2 * axes->count; i++) {
        const size_t at = i % axes->count;
        const struct gb_axis *axis = &axes->axis[at];
        if (axis->material == (i < axes->count) &&
            !set_value(axis, params, gb_axes_value(axes, point, at), err)) {
            return false;
        }
    }
    return gb_params_check(params, err);
}

/* The unit in which a column is written: that of the first value if all have it, else of
 * the SI.  "" for pure numbers and words; *same tells which. */
static const char *column_unit(const struct gb_axis *axis, bool *same)
{
    double number = 0.0;
    const char *first = unit_of(g_ptr_array_index(axis->values, 0), &number);
    *same = true;
    for (guint i = 1; i < axis->values->len && first != NULL; i++) {
        const char *unit = unit_of(g_ptr_array_index(axis->values, i), &number);
        *same = *same && unit != NULL && strcmp(unit, first) == 0;
    }
    return *same && first != NULL ? first : "";
}

char *gb_axes_column(const struct gb_axes *axes, size_t axis)
{
    const struct gb_field *field = axes->axis[axis].field;
    bool same = true;
    const char *unit = column_unit(&axes->axis[axis], &same);
    return g_strconcat(field->group, ".", field->key,
                       !same   ? "_SI"
                       : *unit ? "_"
                               : "",
                       unit, NULL);
}

char *gb_axes_cell(const struct gb_axes *axes, size_t point, size_t axis, char *buffer,
                   size_t size)
{
    const struct gb_axis *at = &axes->axis[axis];
    const char *value = gb_axes_value(axes, point, axis);
    bool same = true;
    double number = 0.0;
    const char *unit = unit_of(value, &number);
    (void)column_unit(at, &same);
    if (same || unit == NULL || *unit == '\0') {
        const size_t length = unit != NULL ? strcspn(value, " \t") : strlen(value);
        g_snprintf(buffer, (gulong)size, "%.*s", (int)length, value);
    } else if (gb_units_parse(value, (enum gb_dimension)at->field->dimension, &number,
                              NULL)) {
        g_ascii_formatd(buffer, (gint)size, "%.15g", number);
    } else {
        g_strlcpy(buffer, value, size); /* "0.008 d" among lengths: as it stands */
    }
    return buffer;
}

/* Is the key alone enough to tell this axis from the others? */
static bool is_key_unique(const struct gb_axes *axes, size_t axis)
{
    for (size_t i = 0; i < axes->count; i++) {
        if (i != axis &&
            strcmp(axes->axis[i].field->key, axes->axis[axis].field->key) == 0) {
            return false;
        }
    }
    return true;
}

char *gb_axes_name(const struct gb_axes *axes, size_t point)
{
    GString *name = g_string_new(axes->count == 0 ? "scene" : NULL);
    for (size_t i = 0; i < axes->count; i++) {
        const struct gb_field *field = axes->axis[i].field;
        g_string_append(name, i > 0 ? "_" : "");
        if (!is_key_unique(axes, i)) {
            g_string_append_printf(name, "%s.", field->group);
        }
        g_string_append_printf(name, "%s-",
                               axes->axis[i].material ? field->group : field->key);
        gb_rundir_name_value(name, gb_axes_value(axes, point, i),
                             gb_axes_is_free_text(&axes->axis[i]));
    }
    return g_string_free(name, FALSE);
}
