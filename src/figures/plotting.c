#include "figures/plotting.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/alloc.h"
#include "base/file.h"
#include "figures/output_formats.h"
#include "figures/states.h"
#include "io/rundir.h"

/* "x.png" -> "x.csv"; g_free. */
static char *csv_path(const char *path)
{
    return g_strdup_printf("%.*s.csv", (int)strlen(path) - 4, path);
}

static bool check_file(const char *path, enum gb_plotting_existing existing,
                       struct gb_error *err)
{
    if (existing == GB_PLOTTING_KEEP && g_file_test(path, G_FILE_TEST_EXISTS)) {
        return gb_error_set(err, GB_ERR_INPUT, "%.300s: exists; --force replaces it",
                            path);
    }
    return gb_rundir_files_protect(path, err) && gb_file_check_target(path, err);
}

/* The CSV of the same figure in another format has the same data. */
static bool check_twin(const char *csv, enum gb_plotting_existing existing,
                       const GString *text, struct gb_error *err)
{
    char *old = NULL;
    size_t length = 0;
    if (existing == GB_PLOTTING_REPLACE ||
        !gb_file_read(csv, SIZE_MAX, &old, &length, NULL)) {
        return true;
    }
    const bool same = length == text->len && memcmp(old, text->str, length) == 0;
    gb_alloc_free(old);
    return same ||
           gb_error_set(err, GB_ERR_INPUT,
                        "%.300s: exists with other data; --force replaces it", csv);
}

bool gb_plotting_check(const char *output, enum gb_plotting_existing existing,
                       struct gb_error *err)
{
    if (gb_output_formats_find(output, GB_OUTPUT_FORMATS_FIGURE) == NULL) {
        char *names = gb_output_formats_names(GB_OUTPUT_FORMATS_FIGURE);
        gb_error_set(err, GB_ERR_INPUT, "-o %.300s: a name ending in %s is accepted",
                     output, names);
        g_free(names);
        return false;
    }
    char *csv = csv_path(output);
    const bool good = check_file(output, existing, err) &&
                      gb_rundir_files_protect(csv, err) && gb_file_check_target(csv, err);
    g_free(csv);
    return good;
}

static char *run_list(const struct gb_runset *set)
{
    GString *list = g_string_new(NULL);
    for (size_t i = 0; set != NULL && i < set->count; i++) {
        g_string_append_printf(list, "%s%s (seed %" G_GUINT64_FORMAT ")",
                               i > 0 ? "; " : "", set->run[i].directory,
                               set->run[i].params.seed);
    }
    return g_string_free(list, FALSE);
}

static bool write_figure(const struct gb_series *series,
                         const struct gb_plotting_page *page, gb_figure_writer *writer,
                         const char *output, struct gb_error *err)
{
    struct gb_figure figure;
    struct gb_figure_curve *curves = NULL;
    char *title = page->title != NULL ? g_markup_escape_text(page->title, -1) : NULL;
    char *preset = page->set != NULL && page->set->count > 0
                       ? gb_states_preset(page->set->run[0].directory)
                       : NULL;
    char *runs = run_list(page->set);
    gb_series_figure(series, &figure, &curves);
    figure.title = title;
    figure.per_inch = page->per_inch;
    struct gb_image_text texts[5] = {{"Software", "greenbody " GB_VERSION},
                                     {"Title", page->name}};
    int count = 2;
    if (*runs != '\0') {
        texts[count++] = (struct gb_image_text){"Runs", runs};
    }
    if (preset != NULL) {
        texts[count++] = (struct gb_image_text){"Preset", preset};
    }
    const bool good =
        writer(&figure, page->width, page->height, texts, count, output, err);
    g_free(curves);
    g_free(title);
    g_free(preset);
    g_free(runs);
    return good;
}

bool gb_plotting_write(const struct gb_series *series,
                       const struct gb_plotting_page *page, const char *output,
                       struct gb_error *err)
{
    const struct gb_output_formats_row *format =
        gb_output_formats_find(output, GB_OUTPUT_FORMATS_FIGURE);
    gb_figure_writer *writer = format != NULL ? format->figure : NULL;
    char *csv = csv_path(output);
    GString *text = gb_series_csv(series);
    const bool good =
        (writer == NULL || (check_twin(csv, page->existing, text, err) &&
                            gb_series_check_drawable(series, page->name, err) &&
                            write_figure(series, page, writer, output, err))) &&
        gb_file_replace(csv, text->str, text->len, err);
    g_string_free(text, TRUE);
    g_free(csv);
    return good;
}

/* Columns of the axes in a table. */
struct data {
    const struct gb_table *table;
    const double *x, *y, *x_error, *y_error;
};

static const double *find_error(const struct gb_table *table, const char *name)
{
    char *error = g_strdup_printf("%s_error", name);
    const double *column = gb_table_column(table, error, NULL);
    g_free(error);
    return column;
}

static bool has_label(const struct gb_series *series, const char *label)
{
    for (guint k = 0; k < series->curves->len; k++) {
        const char *other =
            g_array_index(series->curves, struct gb_series_curve, k).label;
        if (other != NULL && strcmp(other, label) == 0) {
            return true;
        }
    }
    return false;
}

/* Rows of one word of the column of words as columns and a curve. */
static void draw_words(struct gb_series *series, const struct data *data,
                       const char *word, int number)
{
    const size_t rows = gb_table_rows(data->table);
    double *x = gb_series_column(series, "data_%d_%s", number + 1, series->x.name);
    double *y = gb_series_column(series, "data_%d_%s", number + 1, series->y.name);
    double *y_error =
        gb_series_column(series, "data_%d_%s_error", number + 1, series->y.name);
    double *x_error =
        gb_series_column(series, "data_%d_%s_error", number + 1, series->x.name);
    size_t filled = 0;
    for (size_t k = 0; k < rows; k++) {
        if (strcmp(gb_table_word(data->table, k), word) == 0) {
            x[filled] = data->x[k];
            y[filled] = data->y[k];
            y_error[filled] = data->y_error != NULL ? data->y_error[k] : NAN;
            x_error[filled] = data->x_error != NULL ? data->x_error[k] : NAN;
            filled++;
        }
    }
    char *escaped = g_markup_escape_text(*word != '\0' ? word : "measured", -1);
    char *label =
        g_strconcat(escaped, has_label(series, escaped) ? ", points" : "", NULL);
    struct gb_series_curve *curve = gb_series_draw(
        series, x, y, y_error, GB_FIGURE_POINTS, gb_figure_black(number), label);
    curve->x_error = curve->error + 1;
    curve->rows = filled;
    g_free(label);
    g_free(escaped);
}

/* A curve for every word, in the order of the table. */
static void draw_data(struct gb_series *series, const struct data *data)
{
    int number = 0;
    for (size_t k = 0; k < gb_table_rows(data->table); k++) {
        const char *word = gb_table_word(data->table, k);
        bool seen = false;
        for (size_t i = 0; i < k && !seen; i++) {
            seen = strcmp(gb_table_word(data->table, i), word) == 0;
        }
        if (!seen) {
            draw_words(series, data, word, number++);
        }
    }
}

bool gb_plotting_data(struct gb_series *series, const struct gb_table *table,
                      struct gb_error *err)
{
    struct data data = {table, gb_table_column(table, series->x.name, err), NULL, NULL,
                        NULL};
    data.y = data.x != NULL ? gb_table_column(table, series->y.name, err) : NULL;
    const bool good = data.y != NULL;
    if (good) {
        data.x_error = find_error(table, series->x.name);
        data.y_error = find_error(table, series->y.name);
        gb_series_grow(series, gb_table_rows(table));
        gb_series_note(series, "data: %s", gb_table_path(table));
        draw_data(series, &data);
    }
    return good;
}
