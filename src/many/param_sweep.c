/* A sweep of parameters.  The axes give the points (a grid or a Sobol design), each
 * point has replicas, and an ensemble computes the runs.  A target of the standard
 * error can end the replicas of a point early.  Tables are read back from the run
 * directories, so they do not depend on which process computed a run. */

#include "many/param_sweep.h"

#include <glib.h>
#include <gsl/gsl_qrng.h>
#include <inttypes.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "base/file.h"
#include "base/listing.h"
#include "base/units.h"
#include "base/visible.h"
#include "greenbody/params.h"
#include "greenbody/snapshot.h"
#include "greenbody/status.h"
#include "io/follow.h"
#include "io/material.h"
#include "io/rundir.h"
#include "many/ensemble.h"
#include "many/reading.h"
#include "many/runset.h"
#include "measure/average.h"

enum { COORDINATES_MOST = 40 };

/* Coordinate `axis` (0 to 39) of the first points of a Sobol sequence, each in [0, 1).
 * Source: GSL; Antonov and Saleev, USSR Comput.  Maths Math.  Phys. 19, 252 (1980).
 * Errors: GB_ERR_MEMORY. */
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

bool gb_param_sweep_design(struct gb_axes *axes, const char *text, struct gb_error *err)
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

/* The unit after a number, "" without a unit; NULL if the text is not a number. */
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

/* Adds one value if it is valid for the key; *params has the defaults. */
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

/* Adds a value, with `unit` if it lacks its own. */
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

/* Is the list just "0,1", which could be 0.1 with a decimal comma or the values 0 and
 * 1? */
static bool is_decimal_comma(const struct gb_axis *axis, const char *values)
{
    const char *comma = strchr(values, ',');
    return axis->field->type != GB_FIELD_INTEGER && comma != NULL &&
           strchr(comma + 1, ',') == NULL && strpbrk(values, ".eE") == NULL &&
           comma > values && g_ascii_isdigit(comma[-1]) && g_ascii_isdigit(comma[1]);
}

/* Does the key have free text, in which every character counts? */
static bool axes_is_free_text(const struct gb_axis *axis)
{
    return axis->material ||
           (axis->field->type == GB_FIELD_TEXT && axis->field->choices == NULL);
}

/* Separator of the values: ';', or ',' if the list has no ';' and the values of the key
 * cannot contain a comma. */
static const char *separator_of(const struct gb_axis *axis, const char *values)
{
    return (axes_is_free_text(axis) && !axis->material) || strchr(values, ';') != NULL
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

/* Reads "0.05:0.4:8", "9.7:38:4 nm", "9.7 nm:38 nm:4", "1:100:3:log MPa". */
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
        /* twelve digits, so that 0.1 is not written as 0.10000000000000001 */
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

/* Reads a range without a count: "0.05:0.4", "9.7:38 nm", "9.7 nm:38 nm:log". */
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

/* The row of "group.key", or of a key that only one group has, if it may be varied. */
static const struct gb_field *find_field(const struct gb_axes *axes, const char *name,
                                         struct gb_error *err)
{
    const struct gb_field *field = gb_params_find_name(name, err);
    if (field == NULL) {
        return NULL;
    }
    if (gb_runset_bookkeeping(field) || field->type == GB_FIELD_PRESSURES ||
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

bool gb_param_sweep_add_axis(struct gb_axes *axes, const char *text, struct gb_error *err)
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

void gb_param_sweep_axes_finish(struct gb_axes *axes)
{
    for (size_t i = 0; i < axes->count; i++) {
        g_ptr_array_unref(axes->axis[i].values);
        gb_alloc_free(axes->axis[i].share);
    }
    axes->count = 0;
}

size_t gb_param_sweep_points(const struct gb_axes *axes)
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

const char *gb_param_sweep_value(const struct gb_axes *axes, size_t point, size_t axis)
{
    for (size_t i = axes->count - 1; i > axis && axes->design == 0; i--) {
        point /= axes->axis[i].values->len;
    }
    const GPtrArray *values = axes->axis[axis].values;
    return g_ptr_array_index(values, point % values->len);
}

bool gb_param_sweep_apply(const struct gb_axes *axes, size_t point,
                          struct gb_params *params, struct gb_error *err)
{
    /* materials first: they set keys that other axes may set again */
    for (size_t i = 0; i < 2 * axes->count; i++) {
        const size_t at = i % axes->count;
        const struct gb_axis *axis = &axes->axis[at];
        if (axis->material == (i < axes->count) &&
            !set_value(axis, params, gb_param_sweep_value(axes, point, at), err)) {
            return false;
        }
    }
    return gb_params_check(params, err);
}

/* Unit of a column: the unit of all values (*same), else "" for SI.  Numbers without a
 * unit and words also have "". */
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

char *gb_param_sweep_column(const struct gb_axes *axes, size_t axis)
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

char *gb_param_sweep_cell(const struct gb_axes *axes, size_t point, size_t axis,
                          char *buffer, size_t size)
{
    const struct gb_axis *at = &axes->axis[axis];
    const char *value = gb_param_sweep_value(axes, point, axis);
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
        g_strlcpy(buffer, value, size); /* "0.008 d" among lengths stays as typed */
    }
    return buffer;
}

/* Does no other axis have the same key without its group? */
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

char *gb_param_sweep_point_name(const struct gb_axes *axes, size_t point)
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
        gb_rundir_name_value(name, gb_param_sweep_value(axes, point, i),
                             axes_is_free_text(&axes->axis[i]));
    }
    return g_string_free(name, FALSE);
}

/* --- pressures ---------------------------------------------------------------------- */

/* Range of the default pressures, MPa. */
static const double least_mpa = 1.0;
static const double most_mpa = 1e5;

static int compare_doubles(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

static void sort_pressures(struct gb_sweep_table_pressures *at)
{
    size_t kept = 0;
    qsort(at->pa, at->count, sizeof at->pa[0], compare_doubles);
    for (size_t i = 0; i < at->count; i++) {
        if (kept == 0 || at->pa[i] > at->pa[kept - 1] * (1.0 + 1e-9)) {
            at->pa[kept++] = at->pa[i];
        }
    }
    at->count = kept;
}

bool gb_param_sweep_pressures(struct gb_sweep_table_pressures *at, const char *text,
                              struct gb_error *err)
{
    char **parts = g_strsplit(text, ";", GB_SWEEP_TABLE_PRESSURES + 1);
    const guint count = g_strv_length(parts);
    const char *unit = "";
    double number = 0.0;
    at->count = 0;
    if (count > 0 && gb_units_number(g_strstrip(parts[count - 1]), &unit, &number)) {
        unit += strspn(unit, " \t");
    }
    bool good = count > 0 && count <= GB_SWEEP_TABLE_PRESSURES;
    for (guint i = 0; i < count && good; i++) {
        const char *end = NULL;
        g_strstrip(parts[i]);
        const bool bare = gb_units_number(parts[i], &end, &number) && *end == '\0';
        char *whole = g_strconcat(parts[i], bare ? unit : "", NULL);
        double *to = &at->pa[at->count++];
        good = gb_units_parse(whole, GB_DIM_PRESSURE, to, NULL) && *to > 0.0;
        g_free(whole);
    }
    g_strfreev(parts);
    sort_pressures(at);
    return good ||
           gb_error_set(err, GB_ERR_INPUT,
                        "%.120s: expected up to %d pressures above 0 separated by "
                        "';', as in 50;100;200 MPa",
                        text, GB_SWEEP_TABLE_PRESSURES);
}

void gb_param_sweep_default_pressures(struct gb_sweep_table_pressures *at,
                                      const struct gb_params *params)
{
    static const double steps[] = {1.0, 2.0, 5.0};
    const double until = params->until_pressure_pa / 1e6;
    const double last = isfinite(until) ? fmin(until, most_mpa) : most_mpa;
    at->count = 0;
    for (double decade = least_mpa; decade <= last; decade *= 10.0) {
        for (size_t k = 0; k < G_N_ELEMENTS(steps) && decade * steps[k] <= last; k++) {
            at->pa[at->count++] = 1e6 * decade * steps[k];
        }
    }
    for (int i = 0; i < params->unload_count; i++) {
        at->pa[at->count++] = params->unload_from_pa[i];
    }
    if (isfinite(until)) {
        at->pa[at->count++] = params->until_pressure_pa;
    }
    sort_pressures(at);
}

/* --- figures of a point ------------------------------------------------------------- */

typedef bool read_figures(const struct gb_table *curve, double pressure_pa,
                          double values[GB_READING_QUANTITIES]);

static const struct branch {
    const char *name;
    read_figures *read;
} branches[GB_SWEEP_BRANCHES] = {{"load", gb_reading_loaded},
                                 {"unload", gb_reading_unloaded}};

const char *gb_param_sweep_branch(size_t branch)
{
    return branches[branch].name;
}

static double *cell(const struct gb_sweep_readings *readings, size_t branch,
                    size_t pressure, size_t quantity)
{
    const size_t row = (branch * readings->pressures + pressure) * GB_READING_QUANTITIES;
    return readings->value + (row + quantity) * readings->runs;
}

static void read_run(const struct gb_sweep_readings *readings, size_t column,
                     struct gb_ensemble_run *run,
                     const struct gb_sweep_table_pressures *at)
{
    struct gb_table *curve = NULL;
    const bool good = run->ended && run->error.code == GB_OK &&
                      gb_reading_open(&curve, run->directory, &run->error);
    for (size_t b = 0; b < GB_SWEEP_BRANCHES; b++) {
        for (size_t p = 0; p < at->count; p++) {
            double values[GB_READING_QUANTITIES];
            const bool there = good && branches[b].read(curve, at->pa[p], values);
            for (size_t q = 0; q < GB_READING_QUANTITIES; q++) {
                cell(readings, b, p, q)[column] = there ? values[q] : (double)NAN;
            }
        }
    }
    gb_table_destroy(curve);
}

void gb_param_sweep_readings_init(struct gb_sweep_readings *readings,
                                  struct gb_ensemble *ensemble, size_t point,
                                  const struct gb_sweep_table_pressures *at)
{
    *readings = (struct gb_sweep_readings){.pressures = at->count};
    readings->runs = gb_ensemble_used(ensemble, point);
    readings->value = g_new(double, GB_SWEEP_BRANCHES * at->count *
                                        GB_READING_QUANTITIES * readings->runs);
    for (size_t r = 0; r < readings->runs; r++) {
        read_run(readings, r, gb_ensemble_at(ensemble, point, r), at);
    }
}

void gb_param_sweep_readings_finish(struct gb_sweep_readings *readings)
{
    g_free(readings->value);
    *readings = (struct gb_sweep_readings){0};
}

const double *gb_param_sweep_readings_at(const struct gb_sweep_readings *readings,
                                         size_t branch, size_t pressure, size_t quantity)
{
    return cell(readings, branch, pressure, quantity);
}

/* --- target of the standard error --------------------------------------------------- */

/* The scatter of fewer replicas is too uncertain to stop. */
enum { REPLICAS_MIN = 4 };

bool gb_param_sweep_target(struct gb_sweep_target *target, const char *text,
                           struct gb_error *err)
{
    char **parts = g_strsplit(text, "@", 3);
    const bool good =
        g_strv_length(parts) == 2 &&
        gb_units_parse(parts[0], GB_DIM_NONE, &target->standard_error, NULL) &&
        gb_units_parse(parts[1], GB_DIM_PRESSURE, &target->pressure_pa, NULL) &&
        target->standard_error > 0.0 && target->pressure_pa > 0.0;
    g_strfreev(parts);
    return good || gb_error_set(err, GB_ERR_INPUT,
                                "--until-se %.80s: expected a standard error of the "
                                "density and a pressure, as in 0.002@100MPa",
                                text);
}

/* The density of a run that has ended; reads its curve only once. */
static double density_of(const struct gb_sweep_target *target,
                         const struct gb_ensemble *ensemble,
                         const struct gb_ensemble_run *run)
{
    const size_t i = (size_t)(run - ensemble->run);
    double values[GB_READING_QUANTITIES] = {NAN};
    struct gb_table *curve = NULL;
    if (target->is_read[i]) {
        return target->density[i];
    }
    if (run->error.code == GB_OK && gb_reading_open(&curve, run->directory, NULL)) {
        gb_reading_loaded(curve, target->pressure_pa, values);
    }
    gb_table_destroy(curve);
    target->is_read[i] = true;
    target->density[i] = values[GB_READING_DENSITY];
    return target->density[i];
}

/* Are the first k replicas enough for some k, all of them having ended? */
static bool has_converged(const struct gb_ensemble *ensemble, size_t point, void *data)
{
    const struct gb_sweep_target *target = data;
    double *values = g_new(double, ensemble->replicas);
    bool enough = false;
    for (size_t r = 0; r < ensemble->replicas && !enough; r++) {
        const struct gb_ensemble_run *run = gb_ensemble_at(ensemble, point, r);
        double mean = NAN;
        double error = NAN;
        if (!run->ended) {
            break;
        }
        values[r] = density_of(target, ensemble, run);
        const size_t runs = gb_average_values(values, r + 1, &mean, &error);
        enough = runs >= REPLICAS_MIN && error <= target->standard_error;
    }
    g_free(values);
    return enough;
}

/* Sets the target as the convergence test of the ensemble; target must outlive the
 * work.  Errors: GB_ERR_MEMORY. gb_param_sweep_target_finish must be called. */
static bool sweep_target_apply(struct gb_sweep_target *target,
                               struct gb_ensemble *ensemble, struct gb_error *err)
{
    const size_t runs = ensemble->points * ensemble->replicas;
    target->density = gb_alloc_array(runs, sizeof *target->density, err);
    target->is_read =
        target->density ? gb_alloc_array(runs, sizeof *target->is_read, err) : NULL;
    ensemble->converged = has_converged;
    ensemble->data = target;
    return target->is_read != NULL;
}

void gb_param_sweep_target_finish(struct gb_sweep_target *target)
{
    gb_alloc_free(target->density);
    gb_alloc_free(target->is_read);
    target->density = NULL;
    target->is_read = NULL;
}

size_t gb_param_sweep_missed(const struct gb_sweep_target *target,
                             const struct gb_ensemble *ensemble)
{
    size_t missed = 0;
    for (size_t p = 0; p < ensemble->points && target->is_read != NULL; p++) {
        missed += !has_converged(ensemble, p, (void *)target);
    }
    return missed;
}

/* --- tables ------------------------------------------------------------------------- */

/* The tables of a sweep depend only on the run directories.  They are the same for any
 * number of workers and restarts. */

/* Goals of the loading and equilibrium that completed runs did not reach. */

/* The text from the run itself, g_free.  NULL: it reached everything, or is not done. */
static char *sweep_shortfall_text(const struct gb_ensemble_run *run)
{
    struct gb_snapshot shot = {0};
    struct gb_follow_engine engine;
    struct gb_error ignored;
    const bool told = run->ended && run->error.code == GB_OK &&
                      gb_follow_status(run->directory, &shot, &engine, &ignored) &&
                      shot.state == GB_RUN_DONE && shot.error.text[0] != '\0';
    return told ? g_strdup(shot.error.text) : NULL;
}

size_t gb_param_sweep_shortfalls(const struct gb_ensemble *ensemble)
{
    size_t runs = 0;
    for (size_t point = 0; point < ensemble->points; point++) {
        const size_t used = gb_ensemble_used(ensemble, point);
        for (size_t replica = 0; replica < used; replica++) {
            char *text = sweep_shortfall_text(gb_ensemble_at(ensemble, point, replica));
            runs += text != NULL;
            g_free(text);
        }
    }
    return runs;
}

/* Adds the varied values of a point as cells; numbers have the unit of the column. */
static void add_values(struct gb_listing *listing, const struct gb_axes *axes,
                       size_t point)
{
    for (size_t i = 0; i < axes->count; i++) {
        char cell[GB_PARAMS_VALUE_MAX];
        GString *text = g_string_new(NULL);
        gb_param_sweep_cell(axes, point, i, cell, sizeof cell);
        gb_visible_add_cell(text, cell, true);
        gb_listing_text(listing, text->str);
        g_string_free(text, TRUE);
    }
}

static void add_rows(struct gb_listing *listing, const struct gb_sweep_readings *readings,
                     const struct gb_axes *axes, size_t point,
                     const struct gb_sweep_table_pressures *at)
{
    for (size_t b = 0; b < GB_SWEEP_BRANCHES; b++) {
        for (size_t p = 0; p < at->count; p++) {
            double mean = NAN;
            double error = NAN;
            const size_t runs = gb_average_values(
                gb_param_sweep_readings_at(readings, b, p, GB_READING_DENSITY),
                readings->runs, &mean, &error);
            if (runs == 0) {
                continue;
            }
            gb_listing_whole(listing, point + 1);
            add_values(listing, axes, point);
            gb_listing_text(listing, gb_param_sweep_branch(b));
            gb_listing_number(listing, at->pa[p] / 1e6);
            gb_listing_whole(listing, runs);
            for (size_t q = 0; q < GB_READING_QUANTITIES; q++) {
                gb_average_values(gb_param_sweep_readings_at(readings, b, p, q),
                                  readings->runs, &mean, &error);
                gb_listing_number(listing, mean);
                gb_listing_number(listing, error);
            }
        }
    }
}

static struct gb_listing *new_means(const struct gb_axes *axes,
                                    const struct gb_ensemble *ensemble)
{
    struct gb_listing *listing = gb_listing_new();
    gb_listing_comment(
        listing,
        "greenbody " GB_VERSION "\n"
        "means over the runs of a point and their standard errors (se_); load: where "
        "the mean\npressure over the compressed axes first reaches p_MPa; unload: "
        "after unloading from it");
    const size_t shortfalls = gb_param_sweep_shortfalls(ensemble);
    if (shortfalls > 0) { /* runs that are used although they missed a goal */
        char *note =
            g_strdup_printf("runs that missed a goal or have points that are not "
                            "in equilibrium: %zu (runs.csv)",
                            shortfalls);
        gb_listing_comment(listing, note);
        g_free(note);
    }
    gb_listing_columns(listing, "%.0f", "point");
    for (size_t i = 0; i < axes->count; i++) {
        char *name = gb_param_sweep_column(axes, i);
        gb_listing_column(listing, "%s", "%s", name);
        g_free(name);
    }
    gb_listing_columns(listing, "%s", "branch");
    gb_listing_columns(listing, "%.12g", "p_MPa,runs");
    for (int q = 0; q < GB_READING_QUANTITIES; q++) {
        const char *name = gb_reading_name((enum gb_reading_quantity)q);
        gb_listing_columns(listing, "%.12g", name);
        gb_listing_column(listing, "%.12g", "se_%s", name);
    }
    return listing;
}

GString *gb_param_sweep_means(struct gb_ensemble *ensemble, const struct gb_axes *axes,
                              const struct gb_sweep_table_pressures *at)
{
    struct gb_listing *listing = new_means(axes, ensemble);
    for (size_t point = 0; point < ensemble->points; point++) {
        struct gb_sweep_readings readings;
        gb_param_sweep_readings_init(&readings, ensemble, point, at);
        add_rows(listing, &readings, axes, point, at);
        gb_param_sweep_readings_finish(&readings);
    }
    return gb_listing_end(listing, GB_LISTING_CSV);
}

GString *gb_param_sweep_runs(const struct gb_ensemble *ensemble)
{
    struct gb_listing *listing = gb_listing_new();
    gb_listing_columns(listing, "%s", "run");
    gb_listing_columns(listing, "%.0f", "point,seed");
    gb_listing_columns(listing, "%s", "state");
    gb_listing_columns(listing, "\"%s\"", "error");
    for (size_t i = 0; i < ensemble->points * ensemble->replicas; i++) {
        const struct gb_ensemble_run *run = &ensemble->run[i];
        const bool used = run->replica < gb_ensemble_used(ensemble, run->point);
        if (!run->ended && !used) {
            continue;
        }
        const bool failed = run->error.code != GB_OK;
        char *name = g_path_get_basename(run->directory);
        char *shortfall = sweep_shortfall_text(run);
        gb_listing_text(listing, name);
        gb_listing_whole(listing, run->point + 1);
        gb_listing_whole(listing, run->params.seed);
        gb_listing_text(listing, !run->ended ? "missing"
                                 : failed    ? "failed"
                                 : used      ? "done"
                                             : "spare");
        gb_listing_text(listing,
                        shortfall == NULL && failed ? run->error.text : shortfall);
        g_free(shortfall);
        g_free(name);
    }
    return gb_listing_end(listing, GB_LISTING_CSV);
}

/* --- the sweep ---------------------------------------------------------------------- */

/* Sets the parameters and the directory of every run. */
static bool fill_runs(struct gb_param_sweep *sweep, const struct gb_params *params,
                      const char *directory, struct gb_error *err)
{
    for (size_t i = 0; i < sweep->ensemble.points * sweep->ensemble.replicas; i++) {
        struct gb_ensemble_run *run = &sweep->ensemble.run[i];
        run->params = *params;
        if (!gb_param_sweep_apply(&sweep->axes, run->point, &run->params, err)) {
            return false;
        }
        run->params.seed += run->replica;
        /* runs share the cores, so each run has one thread */
        run->params.threads = run->params.threads > 0 ? run->params.threads : 1;
        char *name = gb_param_sweep_point_name(&sweep->axes, run->point);
        run->directory = g_strdup_printf("%s/%s_seed-%" G_GUINT64_FORMAT, directory, name,
                                         run->params.seed);
        g_free(name);
    }
    return true;
}

bool gb_param_sweep_fill(struct gb_param_sweep *sweep, const struct gb_params *params,
                         size_t replicas, const char *directory, struct gb_error *err)
{
    return gb_ensemble_init(&sweep->ensemble, gb_param_sweep_points(&sweep->axes),
                            replicas, err) &&
           fill_runs(sweep, params, directory, err) &&
           (!(sweep->target.standard_error > 0.0) ||
            sweep_target_apply(&sweep->target, &sweep->ensemble, err)) &&
           gb_ensemble_find_done(&sweep->ensemble, err);
}

void gb_param_sweep_finish(struct gb_param_sweep *sweep)
{
    gb_param_sweep_target_finish(&sweep->target);
    gb_ensemble_finish(&sweep->ensemble);
    gb_param_sweep_axes_finish(&sweep->axes);
}

bool gb_param_sweep_put(const char *directory, const char *name, GString *text,
                        struct gb_error *err)
{
    char *path = g_build_filename(directory, name, NULL);
    const bool good = gb_file_replace(path, text->str, text->len, err);
    g_free(path);
    g_string_free(text, TRUE);
    return good;
}

bool gb_param_sweep_write(struct gb_param_sweep *sweep, const char *directory,
                          struct gb_error *err)
{
    return gb_param_sweep_put(
               directory, "sweep.csv",
               gb_param_sweep_means(&sweep->ensemble, &sweep->axes, &sweep->at), err) &&
           gb_param_sweep_put(directory, "runs.csv",
                              gb_param_sweep_runs(&sweep->ensemble), err);
}
