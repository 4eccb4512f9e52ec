/* A table that is filled and then written.  Every cell is kept as the text for CSV,
 * Markdown and aligned text; JSON converts this text back to numbers, so all formats
 * have the same digits.  The cells of all rows are in one string, each terminated by a
 * NUL, because the table of a packing has millions of cells. */
#include "base/listing.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "base/file.h"
#include "base/number.h"

struct column {
    char *name;
    const char *format;
};

/* A comment above a row. */
struct note {
    size_t row;
    char *line;
};

struct gb_listing {
    GArray *column; /* struct column */
    GArray *note;   /* struct note, by row */
    GString *head;  /* comments above the names */
    GString *cells;
    size_t count; /* number of cells */
    bool quote;   /* quote every CSV cell */
};

static void clear_column(void *column)
{
    g_free(((struct column *)column)->name);
}

static void clear_note(void *note)
{
    g_free(((struct note *)note)->line);
}

struct gb_listing *gb_listing_new(void)
{
    struct gb_listing *listing = g_new(struct gb_listing, 1);
    *listing =
        (struct gb_listing){.column = g_array_new(FALSE, FALSE, sizeof(struct column)),
                            .note = g_array_new(FALSE, FALSE, sizeof(struct note)),
                            .head = g_string_new(NULL),
                            .cells = g_string_new(NULL)};
    g_array_set_clear_func(listing->column, clear_column);
    g_array_set_clear_func(listing->note, clear_note);
    return listing;
}

void gb_listing_free(struct gb_listing *listing)
{
    if (listing == NULL) {
        return;
    }
    g_array_free(listing->column, TRUE);
    g_array_free(listing->note, TRUE);
    g_string_free(listing->head, TRUE);
    g_string_free(listing->cells, TRUE);
    g_free(listing);
}

static const struct column *column_at(const struct gb_listing *listing, size_t k)
{
    return &g_array_index(listing->column, struct column, k);
}

static bool is_text(const struct column *column)
{
    return strchr(column->format, 's') != NULL;
}

/* --- filling ------------------------------------------------------------------------ */

void gb_listing_comment(struct gb_listing *listing, const char *lines)
{
    char **line = g_strsplit(lines != NULL ? lines : "", "\n", -1);
    for (size_t i = 0; line[i] != NULL; i++) {
        if (line[i][0] != '\0') {
            g_string_append_printf(listing->head, "# %s\n", line[i]);
        }
    }
    g_strfreev(line);
}

void gb_listing_note(struct gb_listing *listing, const char *line)
{
    const struct note note = {listing->count / listing->column->len, g_strdup(line)};
    g_array_append_val(listing->note, note);
}

void gb_listing_quote(struct gb_listing *listing)
{
    listing->quote = true;
}

static void add_column(struct gb_listing *listing, const char *format, char *name)
{
    const struct column column = {name, format};
    g_array_append_val(listing->column, column);
}

void gb_listing_columns(struct gb_listing *listing, const char *format, const char *names)
{
    char **name = g_strsplit(names, ",", -1);
    for (size_t k = 0; name[k] != NULL; k++) {
        add_column(listing, format, name[k]);
    }
    g_free(name); /* the columns own the names */
}

void gb_listing_column(struct gb_listing *listing, const char *format, const char *name,
                       ...)
{
    va_list arguments;
    va_start(arguments, name);
    add_column(listing, format, g_strdup_vprintf(name, arguments));
    va_end(arguments);
}

static void end_cell(struct gb_listing *listing)
{
    g_string_append_c(listing->cells, '\0');
    listing->count++;
}

void gb_listing_number(struct gb_listing *listing, double value)
{
    const char *format =
        column_at(listing, listing->count % listing->column->len)->format;
    char number[GB_NUMBER_MAX];
    if (!isfinite(value)) {
        end_cell(listing);
        return;
    }
    if (*format == '\0') {
        g_string_append(listing->cells, gb_number_write(value, number));
    } else {
        g_string_append_printf(listing->cells, format, value);
    }
    end_cell(listing);
}

void gb_listing_numbers(struct gb_listing *listing, const double *value, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        gb_listing_number(listing, value[i]);
    }
}

void gb_listing_whole(struct gb_listing *listing, uint64_t value)
{
    g_string_append_printf(listing->cells, "%" PRIu64, value);
    end_cell(listing);
}

void gb_listing_text(struct gb_listing *listing, const char *text)
{
    g_string_append(listing->cells, text != NULL ? text : "");
    end_cell(listing);
}

/* --- writing ------------------------------------------------------------------------ */

/* Position while writing the cells in order. */
struct walk {
    const struct gb_listing *listing;
    const char *cell; /* next cell */
    size_t row;
};

static bool has_row(const struct walk *walk)
{
    return walk->cell < walk->listing->cells->str + walk->listing->cells->len;
}

static const char *take_cell(struct walk *walk)
{
    const char *cell = walk->cell;
    walk->cell += strlen(cell) + 1;
    return cell;
}

static void append_csv_cell(GString *text, const char *cell, bool quoted)
{
    if (!quoted && strpbrk(cell, ",\"\n") == NULL) {
        g_string_append(text, cell);
        return;
    }
    g_string_append_c(text, '"');
    for (const char *c = cell; *c != '\0'; c++) {
        g_string_append(text, *c == '"' ? "\"" : "");
        g_string_append_c(text, *c);
    }
    g_string_append_c(text, '"');
}

static void print_csv(struct walk *walk, GString *text)
{
    const struct gb_listing *listing = walk->listing;
    const guint columns = listing->column->len;
    guint noted = 0;
    g_string_append(text, listing->head->str);
    for (guint k = 0; k < columns; k++) {
        append_csv_cell(text, column_at(listing, k)->name, listing->quote);
        g_string_append_c(text, k + 1 < columns ? ',' : '\n');
    }
    for (;; walk->row++) {
        for (; noted < listing->note->len; noted++) {
            const struct note *note = &g_array_index(listing->note, struct note, noted);
            if (note->row > walk->row) {
                break;
            }
            g_string_append_printf(text, "# %s\n", note->line);
        }
        if (!has_row(walk)) {
            return;
        }
        for (guint k = 0; k < columns; k++) {
            const char *cell = take_cell(walk);
            const bool always = column_at(listing, k)->format[0] == '"';
            append_csv_cell(text, cell, listing->quote || (always && *cell != '\0'));
            g_string_append_c(text, k + 1 < columns ? ',' : '\n');
        }
    }
}

static void append_json_text(GString *text, const char *cell)
{
    static const char escaped[] = "\"\\\b\f\n\r\t", code[] = "\"\\bfnrt";
    g_string_append_c(text, '"');
    for (const char *c = cell; *c != '\0'; c++) {
        const char *found = strchr(escaped, *c);
        if (found != NULL) {
            g_string_append_printf(text, "\\%c", code[found - escaped]);
        } else if ((unsigned char)*c < 0x20 || *c == 0x7f) {
            g_string_append_printf(text, "\\u%04x", (unsigned)*c);
        } else {
            g_string_append_c(text, *c);
        }
    }
    g_string_append_c(text, '"');
}

/* Prints a number with 17 digits, with a point if it has no exponent.  Integers are
 * printed unchanged. */
static void append_json_number(GString *text, const char *cell, bool integer)
{
    char number[G_ASCII_DTOSTR_BUF_SIZE];
    if (integer) {
        g_string_append(text, cell);
        return;
    }
    g_ascii_dtostr(number, sizeof number, g_ascii_strtod(cell, NULL));
    g_string_append(text, number);
    g_string_append(text, strpbrk(number, ".e") != NULL ? "" : ".0");
}

static void print_json(struct walk *walk, GString *text)
{
    const guint columns = walk->listing->column->len;
    g_string_append(text, "{\n  \"rows\" : [");
    for (; has_row(walk); walk->row++) {
        g_string_append(text, walk->row > 0 ? ",\n    {\n" : "\n    {\n");
        for (guint k = 0; k < columns; k++) {
            const struct column *column = column_at(walk->listing, k);
            const char *cell = take_cell(walk);
            g_string_append(text, "      ");
            append_json_text(text, column->name);
            g_string_append(text, " : ");
            if (*cell == '\0') {
                g_string_append(text, "null");
            } else if (is_text(column)) {
                append_json_text(text, cell);
            } else {
                append_json_number(text, cell, strcmp(column->format, "%.0f") == 0);
            }
            g_string_append(text, k + 1 < columns ? ",\n" : "\n");
        }
        g_string_append(text, "    }");
    }
    g_string_append(text, walk->row > 0 ? "\n  ]\n}\n" : "]\n}\n");
}

static void print_markdown(struct walk *walk, GString *text)
{
    const guint columns = walk->listing->column->len;
    for (guint k = 0; k < columns; k++) {
        g_string_append_printf(text, "| %s ", column_at(walk->listing, k)->name);
    }
    g_string_append(text, "|\n");
    for (guint k = 0; k < columns; k++) {
        g_string_append(text, "|---");
    }
    g_string_append(text, "|\n");
    while (has_row(walk)) {
        for (guint k = 0; k < columns; k++) {
            const bool code = column_at(walk->listing, k)->format[0] == '`';
            g_string_append_printf(text, code ? "| `%s` " : "| %s ", take_cell(walk));
        }
        g_string_append(text, "|\n");
    }
}

static const char *shown(const char *cell)
{
    return *cell != '\0' ? cell : "-";
}

static void append_aligned(GString *text, const char *cell, size_t width, bool left,
                           bool last)
{
    const size_t own = (size_t)g_utf8_strlen(cell, -1);
    const int gap = (int)(width > own ? width - own : 0);
    if (left) {
        g_string_append_printf(text, "%s%*s", cell, last ? 0 : gap, "");
    } else {
        g_string_append_printf(text, "%*s%s", gap, "", cell);
    }
    g_string_append(text, last ? "\n" : "  ");
}

/* Aligned columns, as wide as their widest cell: texts left, numbers right. */
static void print_text(struct walk *walk, GString *text)
{
    const struct gb_listing *listing = walk->listing;
    const guint columns = listing->column->len;
    size_t *width = g_new(size_t, columns);
    for (guint k = 0; k < columns; k++) {
        width[k] = (size_t)g_utf8_strlen(column_at(listing, k)->name, -1);
    }
    for (struct walk first = *walk; has_row(&first);) {
        for (guint k = 0; k < columns; k++) {
            const char *cell = shown(take_cell(&first));
            width[k] = MAX(width[k], (size_t)g_utf8_strlen(cell, -1));
        }
    }
    for (guint k = 0; k < columns; k++) {
        const struct column *column = column_at(listing, k);
        append_aligned(text, column->name, width[k], is_text(column), k + 1 == columns);
    }
    while (has_row(walk)) {
        for (guint k = 0; k < columns; k++) {
            append_aligned(text, shown(take_cell(walk)), width[k],
                           is_text(column_at(listing, k)), k + 1 == columns);
        }
    }
    g_free(width);
}

GString *gb_listing_print(const struct gb_listing *listing, enum gb_listing_format format)
{
    static void (*const print[])(struct walk *,
                                 GString *) = {[GB_LISTING_CSV] = print_csv,
                                               [GB_LISTING_JSON] = print_json,
                                               [GB_LISTING_MARKDOWN] = print_markdown,
                                               [GB_LISTING_TEXT] = print_text};
    GString *text = g_string_sized_new(listing->cells->len + listing->head->len + 1);
    struct walk walk = {listing, listing->cells->str, 0};
    print[format](&walk, text);
    return text;
}

GString *gb_listing_end(struct gb_listing *listing, enum gb_listing_format format)
{
    GString *text = gb_listing_print(listing, format);
    gb_listing_free(listing);
    return text;
}

bool gb_listing_store(struct gb_listing *listing, const char *directory, const char *name,
                      struct gb_error *err)
{
    GString *text = gb_listing_end(listing, GB_LISTING_CSV);
    char *path = g_build_filename(directory, name, NULL);
    const bool good = gb_file_replace(path, text->str, text->len, err);
    g_free(path);
    g_string_free(text, TRUE);
    return good;
}
