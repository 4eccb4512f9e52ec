/* The data of a figure as columns and curves; means of the runs of a group; labels of groups;
 * and powders with their fitted equations of compaction. */

#include "figures/series.h"

#include <glib.h>
#include <math.h>
#include <pango/pango.h>
#include <stdarg.h>
#include <string.h>

#include "base/alloc.h"
#include "base/listing.h"
#include "base/visible.h"
#include "many/compaction_data.h"
#include "many/runset.h"
#include "measure/average.h"
#include "measure/compaction_fits.h"
#include "scene/loading_kind.h"

static void free_label(void *curve)
{
    g_free(((struct gb_series_curve *)curve)->label);
}

void gb_series_init(struct gb_series *series, size_t rows)
{
    *series = (struct gb_series){.x = {.low = NAN, .high = NAN},
                                 .y = {.low = NAN, .high = NAN},
                                 .below_y = {.low = NAN, .high = NAN},
                                 .inset = {NAN, NAN}};
    series->curves = g_array_new(FALSE, FALSE, sizeof(struct gb_series_curve));
    g_array_set_clear_func(series->curves, free_label);
    series->annotations = g_array_new(FALSE, FALSE, sizeof(struct gb_figure_annotation));
    series->caption = g_string_new(NULL);
    series->notes = g_string_new(NULL);
    series->names = g_ptr_array_new_with_free_func(g_free);
    series->columns = g_ptr_array_new_with_free_func(g_free);
    series->rows = rows;
}

void gb_series_finish(struct gb_series *series)
{
    if (series->notes != NULL) {
        g_string_free(series->notes, TRUE);
        g_ptr_array_unref(series->names);
        g_ptr_array_unref(series->columns);
        g_array_unref(series->curves);
        g_array_unref(series->annotations);
        g_string_free(series->caption, TRUE);
    }
    if (series->map != NULL) {
        g_free((double *)(uintptr_t)series->map->x);
        g_free((double *)(uintptr_t)series->map->y);
        g_free((double *)(uintptr_t)series->map->value);
        g_free(series->map);
    }
    *series = (struct gb_series){0};
}

void gb_series_map(struct gb_series *series, const struct gb_figure_map *map)
{
    const size_t columns = (size_t)map->columns, rows = (size_t)map->rows;
    series->map = g_memdup2(map, sizeof *map);
    series->map->x = g_memdup2(map->x, (columns + 1) * sizeof *map->x);
    series->map->y = g_memdup2(map->y, (rows + 1) * sizeof *map->y);
    series->map->value = g_memdup2(map->value, columns * rows * sizeof *map->value);
}

void gb_series_note(struct gb_series *series, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    char *line = g_strdup_vprintf(format, arguments);
    va_end(arguments);
    for (char *c = line; *c != '\0'; c++) {
        *c = g_ascii_iscntrl(*c) ? '?'
                                 : *c; /* directory names may contain any character */
    }
    g_string_append_printf(series->notes, "%s\n", line);
    g_free(line);
}

double *gb_series_column(struct gb_series *series, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    g_ptr_array_add(series->names, g_strdup_vprintf(format, arguments));
    va_end(arguments);
    double *column = g_new(double, series->rows + 1);
    for (size_t i = 0; i < series->rows; i++) {
        column[i] = NAN;
    }
    g_ptr_array_add(series->columns, column);
    return column;
}

void gb_series_axes(struct gb_series *series, const char *x_name, const char *x_label,
                    const char *y_name, const char *y_label)
{
    series->x.name = x_name;
    series->x.label = x_label;
    series->y.name = y_name;
    series->y.label = y_label;
}

static int index_of(const struct gb_series *series, const double *column)
{
    for (guint k = 0; k < series->columns->len; k++) {
        if (g_ptr_array_index(series->columns, k) == column) {
            return (int)k;
        }
    }
    return -1;
}

struct gb_series_curve *gb_series_draw(struct gb_series *series, const double *x,
                                       const double *y, const double *error,
                                       enum gb_figure_kind kind, int style,
                                       const char *label)
{
    const struct gb_series_curve curve = {
        .x = index_of(series, x),
        .y = index_of(series, y),
        .error = error != NULL ? index_of(series, error) : -1,
        .x_error = -1,
        .rows = series->rows,
        .kind = kind,
        .style = style,
        .label = g_strdup(label),
    };
    g_array_append_val(series->curves, curve);
    return &g_array_index(series->curves, struct gb_series_curve,
                          series->curves->len - 1);
}

void gb_series_caption(struct gb_series *series, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    if (series->caption->len > 0) {
        g_string_append_c(series->caption, ' ');
    }
    g_string_append_vprintf(series->caption, format, arguments);
    va_end(arguments);
}

void gb_series_grow(struct gb_series *series, size_t rows)
{
    if (rows <= series->rows) {
        return;
    }
    for (guint k = 0; k < series->columns->len; k++) {
        double **column = (double **)&g_ptr_array_index(series->columns, k);
        *column = g_renew(double, *column, rows + 1);
        for (size_t i = series->rows; i < rows; i++) {
            (*column)[i] = NAN;
        }
    }
    series->rows = rows;
}

static const double *column_at(const struct gb_series *series, int index, size_t from)
{
    return index >= 0 ? (const double *)g_ptr_array_index(series->columns, index) + from
                      : NULL;
}

/* Curves of one panel; returns their number. */
static size_t take_curves(const struct gb_series *series, bool below,
                          struct gb_figure_curve *curves)
{
    size_t taken = 0;
    for (guint k = 0; k < series->curves->len; k++) {
        const struct gb_series_curve *from =
            &g_array_index(series->curves, struct gb_series_curve, k);
        if (from->below != below) {
            continue;
        }
        curves[taken++] = (struct gb_figure_curve){
            .label = from->label,
            .kind = from->kind,
            .style = from->style,
            .open = from->open,
            .count = from->rows,
            .x = column_at(series, from->x, from->from),
            .y = column_at(series, from->y, from->from),
            .error = column_at(series, from->error, from->from),
            .x_error = column_at(series, from->x_error, from->from),
        };
    }
    return taken;
}

void gb_series_figure(const struct gb_series *series, struct gb_figure *figure,
                      struct gb_figure_curve **curves)
{
    *curves = g_new0(struct gb_figure_curve, series->curves->len + 1);
    const size_t above = take_curves(series, false, *curves);
    const size_t below = take_curves(series, true, *curves + above);
    *figure = (struct gb_figure){
        .map = series->map,
        .caption = series->caption->str,
        .inset = {series->inset[0], series->inset[1]},
        .equal_scales = series->equal_scales,
        .top = series->top,
        .right = series->right,
        .x = {series->x.label, series->x.log, series->x.low, series->x.high},
        .y = {series->y.label, series->y.log, series->y.low, series->y.high},
        .curve = *curves,
        .count = above,
        .below_y = {series->below_y.label, series->below_y.log, series->below_y.low,
                    series->below_y.high},
        .below = *curves + above,
        .below_count = below,
        .annotation =
            (const struct gb_figure_annotation *)(void *)series->annotations->data,
        .annotations = series->annotations->len,
    };
}

/* Whether a curve has a point at another abscissa than *first, which is NaN before the first
 * point. */
static bool has_another(const struct gb_figure_curve *curve, double *first)
{
    for (size_t k = 0; k < curve->count; k++) {
        if (!isfinite(curve->x[k]) || !isfinite(curve->y[k])) {
            continue;
        }
        *first = isnan(*first) ? curve->x[k] : *first;
        if (curve->x[k] != *first) {
            return true;
        }
    }
    return false;
}

/* Sets *first as has_another does; whether the curves have as many abscissas as `axis` needs. */
static bool has_enough(const struct gb_figure *drawn, const struct gb_series_axis *axis,
                       double *first)
{
    for (size_t k = 0; k < drawn->count; k++) {
        if (has_another(&drawn->curve[k], first) || (!axis->several && !isnan(*first))) {
            return true;
        }
    }
    return drawn->count == 0 || drawn->map != NULL;
}

bool gb_series_check_drawable(const struct gb_series *series, const char *figure,
                              struct gb_error *err)
{
    struct gb_figure drawn;
    struct gb_figure_curve *curves = NULL;
    double first = NAN;
    gb_series_figure(series, &drawn, &curves);
    const bool enough = has_enough(&drawn, &series->x, &first);
    g_free(curves);
    if (!enough && isnan(first)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%s: there is no value to draw; a CSV has the empty table",
                            figure);
    }
    return enough || gb_error_set(err, GB_ERR_INPUT,
                                  "%s: all points have %s = %.4g; a figure takes two "
                                  "values of it or more, a CSV one",
                                  figure, series->x.name, first);
}

/* Notes hold titles of presets: neither formulas nor control characters of a terminal. */
static void add_notes(struct gb_listing *listing, const char *notes)
{
    char **lines = g_strsplit(notes, "\n", -1);
    for (size_t i = 0; lines[i] != NULL; i++) {
        GString *line = g_string_new(NULL);
        gb_visible_add_cell(line, lines[i], false);
        gb_listing_comment(listing, line->str);
        g_string_free(line, TRUE);
    }
    g_strfreev(lines);
}

GString *gb_series_csv(const struct gb_series *series)
{
    struct gb_listing *listing = gb_listing_new();
    add_notes(listing, series->notes->str);
    for (guint k = 0; k < series->names->len; k++) {
        const char *name = g_ptr_array_index(series->names, k);
        gb_listing_column(listing, "%.12g", "%s", name);
    }
    for (size_t i = 0; i < series->rows; i++) {
        for (guint k = 0; k < series->columns->len; k++) {
            const double *column = g_ptr_array_index(series->columns, k);
            gb_listing_number(listing, column[i]);
        }
    }
    return gb_listing_end(listing, GB_LISTING_CSV);
}

static bool load_curves(struct gb_average_curve *curves, double **points,
                        const struct gb_runset *set, const char *branch, const char *x,
                        const char *y, struct gb_error *err)
{
    for (size_t i = 0; i < set->count; i++) {
        const struct gb_runset_run *run = &set->run[i];
        double **xs = &points[2 * i];
        double **ys = &points[2 * i + 1];
        size_t count = 0;
        if (!gb_runset_points(run, branch, x, y, xs, ys, &count, err)) {
            return false;
        }
        for (size_t k = 1; k < count; k++) {
            if ((*xs)[k] < (*xs)[k - 1]) {
                return gb_error_set(err, GB_ERR_INPUT,
                                    "%.300s: %s falls from %g to %g; a mean over runs "
                                    "takes a column that never falls",
                                    gb_table_path(run->table), x, (*xs)[k - 1], (*xs)[k]);
            }
        }
        curves[i] = (struct gb_average_curve){*xs, *ys, count};
    }
    return true;
}

bool gb_series_sample(struct gb_series_sample *sample, const struct gb_runset *set,
                      const char *branch, const char *x, const char *y,
                      struct gb_error *err)
{
    *sample = (struct gb_series_sample){0};
    struct gb_average_curve *curves = g_new0(struct gb_average_curve, set->count);
    double **points = g_new0(double *, 2 * set->count);
    bool good = load_curves(curves, points, set, branch, x, y, err) &&
                gb_average_grid(curves, set->count, GB_SERIES_GRID_MAX, &sample->grid,
                                &sample->size, err);
    if (good) {
        sample->rows =
            gb_alloc_array(set->count * sample->size, sizeof *sample->rows, err);
        good = sample->rows != NULL;
    }
    for (size_t i = 0; i < set->count && good; i++) {
        good = gb_average_resample(&curves[i], sample->grid, sample->size,
                                   sample->rows + i * sample->size, err);
    }
    for (size_t i = 0; i < 2 * set->count; i++) {
        gb_alloc_free(points[i]);
    }
    g_free(points);
    g_free(curves);
    if (!good) {
        gb_series_sample_finish(sample);
    }
    return good;
}

void gb_series_sample_finish(struct gb_series_sample *sample)
{
    gb_alloc_free(sample->grid);
    gb_alloc_free(sample->rows);
    *sample = (struct gb_series_sample){0};
}

bool gb_series_mean(const struct gb_series_sample *sample, const struct gb_runset *set,
                    size_t group, double *mean, double *error, struct gb_error *err)
{
    const size_t members = gb_runset_members(set, group);
    double *rows = gb_alloc_array(members * sample->size, sizeof *rows, err);
    if (rows == NULL) {
        return false;
    }
    size_t filled = 0;
    for (size_t i = 0; i < set->count; i++) {
        if (set->run[i].group == group) {
            memcpy(rows + filled * sample->size, sample->rows + i * sample->size,
                   sample->size * sizeof *rows);
            filled++;
        }
    }
    gb_average_rows(rows, members, sample->size, GB_AVERAGE_ALL, mean, error);
    gb_alloc_free(rows);
    return true;
}

double *gb_series_sample_grid(struct gb_series *series,
                              const struct gb_series_sample *sample, const char *name)
{
    double *column = gb_series_column(series, "%s", name);
    memcpy(column, sample->grid, sample->size * sizeof *column);
    return column;
}

static bool refuse(const struct gb_runset_run *run, const char *kind, const char *figure,
                   struct gb_error *err)
{
    return gb_error_set(err, GB_ERR_INPUT,
                        "%.300s: scene.kind is not %s, which the figure %s takes",
                        run->directory, kind, figure);
}

bool gb_series_check_dynamic(const struct gb_runset *set, const char *figure,
                             struct gb_error *err)
{
    for (size_t i = 0; i < set->count; i++) {
        if (!gb_loading_kind_of(&set->run[i].params)->given_rate) {
            return refuse(&set->run[i], "dynamic", figure, err);
        }
    }
    return true;
}

bool gb_series_check_die(const struct gb_runset *set, const char *figure,
                         struct gb_error *err)
{
    for (size_t i = 0; i < set->count; i++) {
        if (gb_loading_kind_of(&set->run[i].params)->columns != GB_COLUMNS_DIE) {
            return refuse(&set->run[i], "die", figure, err);
        }
    }
    return true;
}

size_t gb_series_density_at_pressure(const struct gb_runset *set, size_t group,
                                     double pressure_mpa, double *mean, double *error,
                                     struct gb_error *err)
{
    double *values = g_new(double, set->count);
    size_t members = 0;
    bool good = true;
    for (size_t i = 0; i < set->count && good; i++) {
        double *x = NULL;
        double *y = NULL;
        size_t count = 0;
        if (set->run[i].group != group) {
            continue;
        }
        good = gb_runset_points(&set->run[i], "load", "p_MPa", "density", &x, &y, &count,
                                err);
        if (good) {
            const struct gb_average_curve curve = {x, y, count};
            values[members++] = gb_average_crossing(&curve, pressure_mpa, NULL);
        }
        gb_alloc_free(x);
        gb_alloc_free(y);
    }
    const size_t used = gb_average_values(values, members, mean, error);
    g_free(values);
    if (good && used == 0) {
        gb_error_set(err, GB_ERR_INPUT, "%.300s: never reaches %g MPa",
                     gb_runset_first(set, group)->directory, pressure_mpa);
    }
    return good ? used : 0;
}

/* Keys with a phrase of their own; others are written "symbol = value", or "key = value"
 * where they have no symbol. */
static const struct {
    const char *key, *format;
} short_forms[] = {
    {"loading.geometry", "%s"},
    {"contact.normal", "%s"},
    {"material.name", "%s"},
    {"numerics.fidelity", "%s"},
    {"contact.bridge_radius", "bridge radius %s"},
    {"contact.relative_motion", "%s motion"},
};

/* Keys that follow from others or carry no information in a figure. */
static const char *const omitted[] = {"structure.base",      "loading.until",
                                      "loading.unload_from", "output.",
                                      "loading.record",      NULL};

/* Longest label, characters. */
enum { MAX_LENGTH = 60 };

static bool is_omitted(const char *key, const char *except)
{
    for (int k = 0; omitted[k] != NULL; k++) {
        if (g_str_has_prefix(key, omitted[k])) {
            return true;
        }
    }
    return except != NULL && strcmp(key, except) == 0;
}

/* The value of a key as markup: the prefix micro as a Greek letter. */
static char *value_markup(const char *value)
{
    char *safe = g_markup_escape_text(value, -1);
    const gsize length = strlen(safe);
    const bool micro =
        length > 3 && safe[length - 2] == 'u' && strchr("msN", safe[length - 1]) != NULL;
    if (micro && strchr(" /", safe[length - 3]) != NULL) {
        char *greek = g_strdup_printf("%.*sμ%c", (int)length - 2, safe, safe[length - 1]);
        g_free(safe);
        return greek;
    }
    return safe;
}

static const char *short_form(const char *key)
{
    for (gsize k = 0; k < G_N_ELEMENTS(short_forms); k++) {
        if (strcmp(short_forms[k].key, key) == 0) {
            return short_forms[k].format;
        }
    }
    return NULL;
}

/* Symbol of "group.key", or the key without its group; g_free. */
static char *symbol_of(const char *name)
{
    const struct gb_field *field = gb_params_find_name(name, NULL);
    const char *symbol = field != NULL ? field->symbol : NULL;
    const char *dot = strchr(name, '.');
    return symbol != NULL ? g_strdup(symbol)
                          : g_markup_escape_text(dot ? dot + 1 : name, -1);
}

/* Adds "group.key = value" in short form. */
static void append_part(GString *label, const char *part, const char *except)
{
    char **sides = g_strsplit(part, " = ", 2);
    if (sides[0] != NULL && sides[1] != NULL && !is_omitted(sides[0], except)) {
        char *value = value_markup(sides[1]);
        g_string_append(label, label->len > 0 ? ", " : "");
        const char *form = short_form(sides[0]);
        if (form != NULL) {
            char **halves = g_strsplit(form, "%s", 2);
            g_string_append_printf(label, "%s%s%s", halves[0], value, halves[1]);
            g_strfreev(halves);
        } else {
            char *symbol = symbol_of(sides[0]);
            g_string_append_printf(label, "%s = %s", symbol, value);
            g_free(symbol);
        }
        g_free(value);
    }
    g_strfreev(sides);
}

/* Characters without the markup. */
static glong visible_length(const char *markup)
{
    char *plain = NULL;
    if (!pango_parse_markup(markup, -1, 0, NULL, &plain, NULL, NULL)) {
        return (glong)strlen(markup);
    }
    const glong length = g_utf8_strlen(plain, -1);
    g_free(plain);
    return length;
}

/* "key = value, ..." in short form; frees the long one. */
static GString *shorten(char *full, const char *except)
{
    char **parts = g_strsplit(full, ", ", -1);
    GString *label = g_string_new(NULL);
    for (int k = 0; parts[k] != NULL; k++) {
        append_part(label, parts[k], except);
    }
    g_strfreev(parts);
    g_free(full);
    return label;
}

static bool has_title_of_another(const struct gb_runset *set, size_t group)
{
    const char *title = gb_runset_first(set, group)->params.title;
    for (size_t g = 0; g < set->groups; g++) {
        if (g != group && strcmp(gb_runset_first(set, g)->params.title, title) == 0) {
            return true;
        }
    }
    return false;
}

static void append_directory(GString *label, const struct gb_runset *set, size_t group)
{
    char *name = g_path_get_basename(gb_runset_first(set, group)->directory);
    char *escaped = g_markup_escape_text(name, -1);
    g_string_append_printf(label, ": %s", escaped);
    g_free(escaped);
    g_free(name);
}

/* Groups with many differences are named by their titles, and groups of one title by
 * their differences, or by the directory of the first run where there are too many. */
static void use_title(GString *label, const struct gb_runset *set, size_t group,
                      const char *except)
{
    char *title = g_markup_escape_text(gb_runset_first(set, group)->params.title, -1);
    GString *differences = shorten(gb_runset_label_of_title(set, group), except);
    g_string_assign(label, title);
    if (differences->len > 0 && visible_length(differences->str) <= MAX_LENGTH) {
        g_string_append_printf(label, ": %s", differences->str);
    } else if (has_title_of_another(set, group)) {
        append_directory(label, set, group);
    }
    g_string_free(differences, TRUE);
    g_free(title);
}

char *gb_series_group_label(const struct gb_runset *set, size_t group, const char *except)
{
    GString *label = shorten(gb_runset_label(set, group), except);
    const bool empty = label->len == 0 && except == NULL;
    if (empty || visible_length(label->str) > MAX_LENGTH) {
        use_title(label, set, group, except);
    }
    return g_string_free(label, FALSE);
}

char *gb_series_key_label(const char *key, const char *unit)
{
    char *symbol = symbol_of(key);
    char *value = g_strconcat("1 ", unit, NULL);
    char *shown = value_markup(value);
    char *label =
        *unit ? g_strdup_printf("%s (%s)", symbol, shown + 2) : g_strdup(symbol);
    g_free(shown);
    g_free(value);
    g_free(symbol);
    return label;
}

size_t gb_series_list_groups(struct gb_series *series, const struct gb_runset *set)
{
    size_t max = 0;
    for (size_t g = 0; g < set->groups; g++) {
        const size_t members = gb_runset_members(set, g);
        char *label = gb_runset_label(set, g);
        gb_series_note(series, "group %zu: %zu runs%s%s", g + 1, members,
                       *label ? ", " : "", label);
        g_free(label);
        max = MAX(max, members);
    }
    return max;
}

void gb_series_note_groups(struct gb_series *series, const struct gb_runset *set)
{
    const size_t max = gb_series_list_groups(series, set);
    size_t min = max;
    for (size_t g = 0; g < set->groups; g++) {
        min = MIN(min, gb_runset_members(set, g));
    }
    if (max > min) {
        gb_series_caption(series,
                          "Means of %zu to %zu runs; bands and bars: standard error.",
                          min, max);
    } else if (max > 1) {
        gb_series_caption(series, "Means of %zu runs; bands and bars: standard error.",
                          max);
    }
}

bool gb_series_means(struct gb_series *series, const struct gb_series_sample *sample,
                     const struct gb_runset *set, const double *grid, const char *name,
                     const char *unit, struct gb_error *err)
{
    for (size_t g = 0; g < set->groups; g++) {
        double *mean = gb_series_column(series, "%s_%zu%s", name, g + 1, unit);
        double *error = gb_series_column(series, "se_%zu%s", g + 1, unit);
        char *label = gb_series_group_label(set, g, NULL);
        gb_series_draw(series, grid, mean, error, GB_FIGURE_LINE, (int)g, label);
        g_free(label);
        if (!gb_series_mean(sample, set, g, mean, error, err)) {
            return false;
        }
    }
    return true;
}

/* Points of a run that are not in equilibrium, behind those of earlier runs of its group.
 * Columns, two from `column` on, are made with the first. */
static bool append_unrelaxed(struct gb_series *series, const struct gb_runset_run *run,
                             const struct gb_series_points *axes, guint column,
                             size_t *used, struct gb_error *err)
{
    double *x = NULL, *y = NULL;
    size_t count = 0;
    const bool good =
        gb_runset_unrelaxed(run, axes->branch, axes->x, axes->y, &x, &y, &count, err);
    if (good && count > 0 && *used == 0) {
        (void)gb_series_column(series, "unrelaxed_%zu_%s", run->group + 1, axes->x);
        (void)gb_series_column(series, "unrelaxed_%zu_%s", run->group + 1, axes->y);
    }
    gb_series_grow(series, *used + count);
    for (size_t i = 0; good && i < count; i++) {
        ((double *)g_ptr_array_index(series->columns, column))[*used] = x[i];
        ((double *)g_ptr_array_index(series->columns, column + 1))[(*used)++] = y[i];
    }
    gb_alloc_free(x);
    gb_alloc_free(y);
    return good;
}

static bool draw_unrelaxed(struct gb_series *series, const struct gb_runset *set,
                           size_t group, const struct gb_series_points *axes, size_t *all,
                           struct gb_error *err)
{
    const guint column = series->columns->len;
    size_t used = 0;
    for (size_t i = 0; i < set->count; i++) {
        if (set->run[i].group == group &&
            !append_unrelaxed(series, &set->run[i], axes, column, &used, err)) {
            return false;
        }
    }
    if (used > 0) {
        gb_series_draw(series, g_ptr_array_index(series->columns, column),
                       g_ptr_array_index(series->columns, column + 1), NULL,
                       GB_FIGURE_POINTS, (int)group, NULL)
            ->open = true;
    }
    *all += used;
    return true;
}

bool gb_series_unrelaxed(struct gb_series *series, const struct gb_runset *set,
                         const struct gb_series_points *axes, struct gb_error *err)
{
    size_t all = 0;
    for (size_t g = 0; g < set->groups; g++) {
        if (!draw_unrelaxed(series, set, g, axes, &all, err)) {
            return false;
        }
    }
    if (all > 0) {
        gb_series_caption(series,
                          "Hollow: points that are not in equilibrium (%zu); the "
                          "means leave them out.",
                          all);
    }
    return true;
}

enum { POWDER_EQUATIONS = 6 }; /* most that one figure shows */

static const double percent = 100.0; /* residuals: % of theoretical density */

bool gb_series_powder_init(struct gb_series_powder *one,
                           const struct gb_compaction_data *data,
                           const struct gb_equation *only, const char *label,
                           struct gb_error *err)
{
    *one = (struct gb_series_powder){.data = *data, .label = g_strdup(label)};
    if (!gb_compaction_fits(&one->fits, &one->data.points, only, GB_COMPACTION_PROFILE,
                            err)) {
        return false;
    }
    const struct gb_error *refusal = &one->fits.fit[0].refusal;
    return one->fits.fitted > 0 || gb_error_set(err, refusal->code, "%s", refusal->text);
}

void gb_series_powder_finish(struct gb_series_powder *one)
{
    gb_compaction_data_finish(&one->data);
    g_free(one->label);
    *one = (struct gb_series_powder){0};
}

/* Walker's and Balshin's equations are one curve, drawn as Walker's. */
static bool is_drawn(const struct gb_compaction_fits *fits, size_t index)
{
    return index < fits->fitted &&
           strcmp(fits->fit[index].equation->name, "balshin") != 0;
}

static const char *title_of(const struct gb_equation *equation)
{
    return strcmp(equation->name, "walker") == 0 ? "Walker, Balshin" : equation->title;
}

/* Parameters of all equations as comment lines. */
static void note_fits(struct gb_series *series, const struct gb_series_powder *one,
                      size_t number)
{
    const struct gb_compaction_fits *fits = &one->fits;
    for (size_t i = 0; i < fits->count; i++) {
        const struct gb_compaction_fit *row = &fits->fit[i];
        GString *line = g_string_new(NULL);
        if (!row->fitted) {
            g_string_append(line, row->refusal.text);
        } else {
            g_string_append_printf(line, "%s: dAICc %.1f, rms %.2g", row->equation->name,
                                   row->delta, row->all.rms);
        }
        for (size_t k = 0; row->fitted && k < gb_compaction_fits_values(fits, i); k++) {
            const struct gb_compaction_value value = gb_compaction_fits_value(fits, i, k);
            g_string_append_printf(line, ", %s = %.5g (%.5g to %.5g) %s", value.name,
                                   value.value.value, value.value.low, value.value.high,
                                   value.unit);
        }
        gb_series_note(series, "group %zu: %s", number, line->str);
        g_string_free(line, TRUE);
    }
}

/* Columns of the points; returns the column of the pressures. */
static double *point_columns(struct gb_series *series, const struct gb_series_powder *one,
                             size_t number, double **density, double **error)
{
    const struct gb_equations_points *points = &one->data.points;
    double *pressure = gb_series_column(series, "p_%zu_MPa", number);
    *density = gb_series_column(series, "density_%zu", number);
    *error = gb_series_column(series, "se_%zu", number);
    for (size_t i = 0; i < points->count; i++) {
        pressure[i] = points->pressure[i];
        (*density)[i] = points->density[i];
        (*error)[i] = points->error != NULL ? points->error[i] : (double)NAN;
    }
    return pressure;
}

/* The curve of a fit and, below, its residuals. */
static void draw_equation(struct gb_series *series, const struct gb_series_powder *one,
                          size_t number, size_t index, const double *pressure, int style,
                          const char *label)
{
    const struct gb_equation_fit *fit = &one->fits.fit[index].all;
    const char *name = fit->equation->name;
    double *density = gb_series_column(series, "%s_%zu", name, number);
    double *residual = gb_series_column(series, "residual_%s_%zu_percent", name, number);
    for (size_t i = 0; i < one->data.points.count; i++) {
        density[i] = gb_compaction_fits_at(fit, pressure[i]);
        residual[i] = percent * (one->data.points.density[i] - density[i]);
    }
    gb_series_draw(series, pressure, density, NULL, GB_FIGURE_LINE, style, label);
    gb_series_draw(series, pressure, residual, NULL, GB_FIGURE_LINE, style, NULL)->below =
        true;
}

/* Points of a run are hollow, next to their curves; measured ones are black. */
static void draw_points(struct gb_series *series, const struct gb_series_powder *one,
                        const double *column[3], int style)
{
    const bool measured = one->data.curves == 0;
    gb_series_draw(series, column[0], column[1], column[2], GB_FIGURE_POINTS,
                   measured ? gb_figure_black(style) : style, one->label)
        ->open = !measured;
}

/* The zero line of the residuals, with the errors of the points. */
static void draw_zero(struct gb_series *series, const struct gb_series_powder *one,
                      size_t number, const double *pressure, const double *error)
{
    double *zero = gb_series_column(series, "zero_%zu", number);
    double *band = gb_series_column(series, "se_%zu_percent", number);
    for (size_t i = 0; i < one->data.points.count; i++) {
        zero[i] = 0.0;
        band[i] = percent * error[i];
    }
    gb_series_draw(series, pressure, zero, band, GB_FIGURE_FAINT, 0, NULL)->below = true;
}

static void draw_powder(struct gb_series *series, const struct gb_series_powder *one,
                        size_t number, size_t most)
{
    double *density = NULL;
    double *error = NULL;
    const int first = most > 1 ? 0 : (int)number - 1; /* style */
    double *pressure = point_columns(series, one, number, &density, &error);
    size_t drawn = 0;
    draw_zero(series, one, number, pressure, error);
    draw_points(series, one, (const double *[]){pressure, density, error}, first);
    for (size_t i = 0; i < one->fits.fitted && drawn < most; i++) {
        if (is_drawn(&one->fits, i)) {
            const struct gb_compaction_fit *row = &one->fits.fit[i];
            char *label =
                g_strdup_printf("%s, ΔAICc %.0f", title_of(row->equation), row->delta);
            drawn++;
            draw_equation(series, one, number, i, pressure, most > 1 ? (int)drawn : first,
                          most > 1 ? label : title_of(row->equation));
            g_free(label);
        }
    }
}

static size_t most_points(const struct gb_series_powder *all, size_t count)
{
    size_t rows = 0;
    for (size_t k = 0; k < count; k++) {
        rows = MAX(rows, all[k].data.points.count);
    }
    return rows;
}

bool gb_series_powder_fit(struct gb_series *series, const struct gb_series_powder *all,
                          size_t count, struct gb_error *err)
{
    (void)err;
    gb_series_init(series, most_points(all, count));
    gb_series_note(series, "equations of compaction, least squares in the density; 95 %% "
                           "intervals");
    for (size_t k = 0; k < count; k++) {
        note_fits(series, &all[k], k + 1);
    }
    for (size_t k = 0; k < count; k++) {
        draw_powder(series, &all[k], k + 1, count == 1 ? POWDER_EQUATIONS : 1);
    }
    series->below_y.label = "residual (%)";
    gb_series_caption(series, count == 1 ? "Residuals in %% of theoretical density."
                                         : "The equation of the least AICc for each; "
                                           "residuals in %% of theoretical density.");
    return true;
}

/* The Heckel plot of one powder: all points, the line on its stretch. */
static bool draw_heckel(struct gb_series *series, const struct gb_series_powder *one,
                        size_t number, struct gb_error *err)
{
    const struct gb_equations_points *points = &one->data.points;
    const struct gb_compaction_fits *fits = &one->fits;
    for (size_t i = 0; i < fits->count; i++) {
        const struct gb_compaction_fit *row = &fits->fit[i];
        if (row->equation == gb_equations_find("heckel") && !row->fitted) {
            return gb_error_set(err, row->refusal.code, "%s", row->refusal.text);
        }
    }
    double *pressure = gb_series_column(series, "p_%zu_MPa", number);
    double *y = gb_series_column(series, "log_%zu", number);
    double *error = gb_series_column(series, "se_%zu", number);
    double *line = gb_series_column(series, "heckel_%zu", number);
    const size_t end = fits->stretch.first + fits->stretch.count;
    for (size_t i = 0; i < points->count; i++) {
        pressure[i] = points->pressure[i];
        y[i] = -log(1.0 - points->density[i]);
        error[i] = points->error != NULL ? points->error[i] / (1.0 - points->density[i])
                                         : (double)NAN;
        if (i >= fits->stretch.first && i < end) {
            line[i] = fits->heckel.x[0] * pressure[i] + fits->heckel.x[1];
        }
    }
    char *label = g_strdup_printf("1/<i>K</i> = %.4g MPa (%.4g to %.4g)",
                                  fits->yield.value, fits->yield.low, fits->yield.high);
    gb_series_note(
        series, "group %zu: straightest stretch %.5g to %.5g MPa, %zu points, R2 %.6f",
        number, points->pressure[fits->stretch.first], points->pressure[end - 1],
        fits->stretch.count, fits->stretch.determination);
    const int style = (int)number - 1;
    draw_points(series, one, (const double *[]){pressure, y, error}, style);
    gb_series_draw(series, pressure, line, NULL, GB_FIGURE_LINE, style, label);
    g_free(label);
    return true;
}

bool gb_series_powder_heckel(struct gb_series *series, const struct gb_series_powder *all,
                             size_t count, struct gb_error *err)
{
    bool good = true;
    gb_series_init(series, most_points(all, count));
    for (size_t k = 0; k < count; k++) {
        note_fits(series, &all[k], k + 1);
    }
    for (size_t k = 0; k < count && good; k++) {
        good = draw_heckel(series, &all[k], k + 1, err);
    }
    gb_series_caption(series, "Lines: Heckel's equation on the straightest stretch, with "
                              "its mean yield pressure and the 95 %% interval.");
    return good;
}

static bool init_group(struct gb_series_powder *one, const struct gb_runset *set,
                       size_t group, struct gb_error *err)
{
    const struct gb_compaction_window window = {.from = NAN, .to = NAN, .initial = NAN};
    struct gb_compaction_data data;
    if (!gb_compaction_data_runs(&data, set, group, &window, err)) {
        return false;
    }
    char *label = gb_series_group_label(set, group, NULL);
    const bool good = gb_series_powder_init(one, &data, NULL, label, err);
    g_free(label);
    return good;
}

bool gb_series_powder_runs(struct gb_series *series, const struct gb_runset *set,
                           gb_series_powder_draw *draw, struct gb_error *err)
{
    struct gb_series_powder *all = g_new0(struct gb_series_powder, set->groups);
    bool good = true;
    for (size_t g = 0; g < set->groups && good; g++) {
        good = init_group(&all[g], set, g, err);
    }
    good = good && draw(series, all, set->groups, err);
    if (good) {
        gb_series_note_groups(series, set);
    }
    for (size_t g = 0; g < set->groups; g++) {
        gb_series_powder_finish(&all[g]);
    }
    g_free(all);
    return good;
}
