
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/units.h"
#include "figures/figures_compute.h"
#include "figures/figures_label.h"
#include "figures/runs/density_at_pressure.h"
#include "many/key_difference.h"

/* Densities are compared there in P1. */
static const double default_mpa = 100.0;

enum { UNIT_MAX = 16, NAME_MAX_BYTES = 96 };
/* More lines of one point each are the points of a design. */
enum { LINES_MOST = 8 };

/* Value of a key in a group as a preset writes it: number and unit.  False for words and
 * auto. */
static bool read_value(const struct gb_runset *set, size_t group,
                       const struct gb_field *field, double *value, char unit[UNIT_MAX])
{
    char text[GB_PARAMS_VALUE_MAX];
    const char *end = text;
    gb_params_format(&gb_runset_first(set, group)->params, field, text, sizeof text);
    if ((field->type != GB_FIELD_NUMBER && field->type != GB_FIELD_RELATIVE &&
         field->type != GB_FIELD_INTEGER) ||
        !gb_units_number(text, &end, value)) {
        return false;
    }
    g_strlcpy(unit, end + strspn(end, " \t"), UNIT_MAX);
    return true;
}

/* Number of different values of a key; 0 when it is not a number in some group, or has
 * several units. */
static size_t count_values(const struct gb_runset *set, const struct gb_field *field)
{
    size_t count = 0;
    char first[UNIT_MAX] = "";
    for (size_t g = 0; g < set->groups; g++) {
        double value = 0.0;
        char unit[UNIT_MAX];
        bool seen = false;
        if (!read_value(set, g, field, &value, unit) ||
            (g > 0 && strcmp(unit, first) != 0)) {
            return 0;
        }
        g_strlcpy(first, unit, sizeof first);
        for (size_t h = 0; h < g && !seen; h++) {
            double other = 0.0;
            seen = read_value(set, h, field, &other, unit) && other == value;
        }
        count += !seen;
    }
    return count;
}

/* The key with the most values, of those that follow from the material or of the others. */
static const struct gb_field *most_values(const struct gb_runset *set, bool follows)
{
    size_t rows = 0;
    size_t max = 1;
    const struct gb_field *fields = gb_params_fields(&rows);
    const struct gb_field *found = NULL;
    for (size_t i = 0; i < rows; i++) {
        const bool other = gb_key_difference_bookkeeping(&fields[i]) ||
                           gb_runset_follows_material(set, &fields[i]) != follows;
        const size_t values = other ? 0 : count_values(set, &fields[i]);
        if (values > max) {
            max = values;
            found = &fields[i];
        }
    }
    return found;
}

static const struct gb_field *find_key(const struct gb_runset *set, struct gb_error *err)
{
    const struct gb_field *found = most_values(set, false);
    found = found != NULL ? found : most_values(set, true);
    if (found == NULL) {
        gb_error_set(err, GB_ERR_INPUT,
                     "sweep: no number differs between the runs; accepted runs that "
                     "differ in a key with numbers");
    }
    return found;
}

/* First group that differs in nothing but the key. */
static size_t family_of(const struct gb_runset *set, size_t group, const char *key)
{
    const char *const may_differ[] = {key, NULL};
    for (size_t g = 0; g < group; g++) {
        if (gb_runset_difference(set, g, group, may_differ) == NULL) {
            return g;
        }
    }
    return group;
}

struct point {
    size_t group, family;
    double x;
};

/* Order by family, then by the key: no row of another family interrupts a line. */
static int compare_points(const void *a, const void *b)
{
    const struct point *one = a;
    const struct point *two = b;
    return one->family != two->family
               ? (one->family > two->family) - (one->family < two->family)
               : (one->x > two->x) - (one->x < two->x);
}

/* All groups in the order of their lines.  g_free. */
static struct point *sort_groups(const struct gb_runset *set,
                                 const struct gb_field *field, const char *key,
                                 char unit[UNIT_MAX])
{
    struct point *point = g_new0(struct point, set->groups);
    for (size_t g = 0; g < set->groups; g++) {
        point[g].group = g;
        point[g].family = family_of(set, g, key);
        (void)read_value(set, g, field, &point[g].x, unit);
    }
    qsort(point, set->groups, sizeof *point, compare_points);
    return point;
}

static void draw_family(struct gb_series *series, const struct gb_runset *set,
                        const struct point *point, size_t family, const char *key,
                        int style, const double *const from[3])
{
    double *value = gb_series_column(series, "density_%d", style + 1);
    double *error = gb_series_column(series, "se_%d", style + 1);
    for (size_t k = 0; k < set->groups; k++) {
        if (point[k].family == family) {
            value[k] = from[1][k];
            error[k] = from[2][k];
        }
    }
    char *label = gb_figures_label(set, family, key);
    gb_series_draw(series, from[0], value, error, GB_FIGURE_BOTH, style,
                   *label ? label : NULL);
    g_free(label);
}

static size_t count_families(const struct gb_runset *set, const char *key)
{
    size_t count = 0;
    for (size_t g = 0; g < set->groups; g++) {
        count += family_of(set, g, key) == g;
    }
    return count;
}

/* A line for each value of the other keys, or the points of a design as one series. */
static void draw_families(struct gb_series *series, const struct gb_runset *set,
                          const struct point *point, const char *key,
                          const double *const from[3])
{
    const size_t families = count_families(set, key);
    int style = 0;
    if (families == set->groups && families > LINES_MOST) {
        gb_series_draw(series, from[0], from[1], from[2], GB_FIGURE_POINTS, 0, NULL);
        gb_series_caption(series, "Other keys differ from point to point.");
        return;
    }
    for (size_t g = 0; g < set->groups; g++) {
        if (family_of(set, g, key) == g) {
            draw_family(series, set, point, g, key, style++, from);
        }
    }
}

/* Density where loading first reaches a pressure, against the key with the most values; a
 * line for each value of the others. */
bool gb_figures_sweep(struct gb_series *series, const struct gb_figures_input *input,
                      struct gb_error *err)
{
    const struct gb_runset *set = input->set;
    const double mpa = input->pressure_pa > 0.0 ? input->pressure_pa / 1e6 : default_mpa;
    char unit[UNIT_MAX] = "";
    char key[NAME_MAX_BYTES];
    const struct gb_field *field = find_key(set, err);
    if (field == NULL) {
        return false;
    }
    snprintf(key, sizeof key, "%s.%s", field->group, field->key);
    struct point *point = sort_groups(set, field, key, unit);
    gb_series_init(series, set->groups);
    gb_figures_label_note(series, set);
    double *x = gb_series_column(series, "%s%s%s", key, *unit ? "_" : "", unit);
    double *density = gb_series_column(series, "density");
    double *error = gb_series_column(series, "se");
    bool good = true;
    for (size_t k = 0; k < set->groups && good; k++) {
        x[k] = point[k].x;
        good = gb_density_at_pressure(set, point[k].group, mpa, &density[k], &error[k],
                                      err) > 0;
    }
    const double *const columns[3] = {x, density, error};
    if (good) {
        draw_families(series, set, point, key, columns);
    }
    g_free(point);
    gb_series_note(series, "density where loading first reaches %g MPa", mpa);
    gb_series_caption(series, "At %g MPa.", mpa);
    const char *name = g_ptr_array_index(series->names, 0); /* lives as the series */
    char *axis = gb_figures_label_axis(key, unit);
    series->x.name = name;
    series->x.label = g_intern_string(axis);
    g_free(axis);
    return good;
}
