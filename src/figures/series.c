#include "figures/series.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

#include "base/alloc.h"
#include "base/text/visible.h"
#include "measure/fit/average.h"

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

static void append_notes(GString *text, const char *notes)
{
    char **lines = g_strsplit(notes, "\n", -1);
    for (size_t i = 0; lines[i] != NULL; i++) {
        if (lines[i][0] != '\0') {
            g_string_append(text, "# ");
            gb_visible_add_cell(text, lines[i], false);
            g_string_append_c(text, '\n');
        }
    }
    g_strfreev(lines);
}

GString *gb_series_csv(const struct gb_series *series)
{
    GString *text = g_string_new(NULL);
    append_notes(text, series->notes->str);
    for (guint k = 0; k < series->names->len; k++) {
        g_string_append_printf(text, "%s%s", k > 0 ? "," : "",
                               (const char *)g_ptr_array_index(series->names, k));
    }
    g_string_append_c(text, '\n');
    for (size_t i = 0; i < series->rows; i++) {
        for (guint k = 0; k < series->columns->len; k++) {
            const double *column = g_ptr_array_index(series->columns, k);
            g_string_append(text, k > 0 ? "," : "");
            if (isfinite(column[i])) {
                g_string_append_printf(text, "%.12g", column[i]);
            }
        }
        g_string_append_c(text, '\n');
    }
    return text;
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
