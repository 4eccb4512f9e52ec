/* Writes figures to files, with their data next to them, and adds measured points to a figure.
 * The table below has the output formats of figures, pictures and sequences. */
#include "figures/plotting.h"

#include <glib.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/alloc.h"
#include "base/built_with.h"
#include "base/file.h"
#include "figures/sequence.h"
#include "figures/states.h"
#include "io/rundir.h"

#if GB_WITH_PICTURES
#define FRAMES(writer) .frames = &(writer)
#else
#define FRAMES(writer) .frames = NULL
#endif

/* Even sides and 4:2:0 colours, which all encoders accept and all players show. */
#define EVEN_YUV420 "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white,format=yuv420p"
/* GIF has 256 colours, chosen from all frames. */
#define OWN_PALETTE "split[a][b];[a]palettegen[p];[b][p]paletteuse"

/* A format is a writer and a row here; messages and help follow from the row. */
static const struct gb_plotting_format formats[] = {
    {".png", "image with the preset in its text chunks; a sequence is an animated PNG",
     GB_PLOTTING_FIGURE | GB_PLOTTING_PICTURE | GB_PLOTTING_SEQUENCE,
     .figure = gb_figure_write_png, FRAMES(gb_sequence_apng)},
    {".svg", "vector figure", GB_PLOTTING_FIGURE, .figure = gb_figure_write_svg},
    {".pdf", "vector figure", GB_PLOTTING_FIGURE, .figure = gb_figure_write_pdf},
    {".csv", "data of a figure", GB_PLOTTING_FIGURE, .figure = NULL},
    {".mp4", "video (ffmpeg)", GB_PLOTTING_SEQUENCE, FRAMES(gb_sequence_video),
     .video_filter = EVEN_YUV420},
    {".webm", "video (ffmpeg)", GB_PLOTTING_SEQUENCE, FRAMES(gb_sequence_video),
     .video_filter = EVEN_YUV420},
    {".mkv", "video (ffmpeg)", GB_PLOTTING_SEQUENCE, FRAMES(gb_sequence_video),
     .video_filter = EVEN_YUV420},
    {".gif", "animated image (ffmpeg)", GB_PLOTTING_SEQUENCE, FRAMES(gb_sequence_video),
     .video_filter = OWN_PALETTE},
    {0},
};

const struct gb_plotting_format *gb_plotting_formats(void)
{
    return formats;
}

static bool is_for(const struct gb_plotting_format *row, enum gb_plotting_use use)
{
    return (row->uses & use) != 0;
}

const struct gb_plotting_format *gb_plotting_format_find(const char *path,
                                                         enum gb_plotting_use use)
{
    for (const struct gb_plotting_format *row = formats; row->extension; row++) {
        if (is_for(row, use) && g_str_has_suffix(path, row->extension)) {
            return row;
        }
    }
    return NULL;
}

/* Rows of a use, or its videos alone. */
enum chosen { ALL, VIDEOS };

static char *join_names(enum gb_plotting_use use, enum chosen chosen)
{
    GPtrArray *names = g_ptr_array_new();
    for (const struct gb_plotting_format *row = formats; row->extension; row++) {
        if (is_for(row, use) && (chosen == ALL || row->video_filter != NULL)) {
            g_ptr_array_add(names, (gpointer)(uintptr_t)row->extension);
        }
    }
    GString *text = g_string_new(NULL);
    for (guint k = 0; k < names->len; k++) {
        const char *before = k == 0 ? "" : k + 1 < names->len ? ", " : " or ";
        g_string_append_printf(text, "%s%s", before,
                               (const char *)g_ptr_array_index(names, k));
    }
    g_ptr_array_unref(names);
    return g_string_free(text, FALSE);
}

char *gb_plotting_format_names(enum gb_plotting_use use)
{
    return join_names(use, ALL);
}

char *gb_plotting_videos(void)
{
    return join_names(GB_PLOTTING_SEQUENCE, VIDEOS);
}

char *gb_plotting_pattern(enum gb_plotting_use use)
{
    GString *text = g_string_new("FILE.");
    for (const struct gb_plotting_format *row = formats; row->extension; row++) {
        if (is_for(row, use)) {
            g_string_append_printf(text, "%s|", row->extension + 1);
        }
    }
    g_string_truncate(text, text->len - 1);
    return g_string_free(text, FALSE);
}

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
    if (gb_plotting_format_find(output, GB_PLOTTING_FIGURE) == NULL) {
        char *names = gb_plotting_format_names(GB_PLOTTING_FIGURE);
        gb_error_set(err, GB_ERR_INPUT, "-o %.300s: expected a name ending in %s", output,
                     names);
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
    const struct gb_plotting_format *format =
        gb_plotting_format_find(output, GB_PLOTTING_FIGURE);
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
