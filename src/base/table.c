#include "base/table.h"

#include <glib.h>
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/file.h"
#include "base/units.h"

struct gb_table {
    char *path;
    char *text; /* names and words; a file is cut into lines and cells in place */
    size_t length;
    size_t columns, rows;
    char *name[GB_TABLE_COLUMNS_MAX]; /* into text */
    size_t words;                     /* index of the column of words; columns: none */
    size_t units;                     /* index of their units, which are skipped */
    size_t wholes;                    /* index of the column of whole numbers, likewise */
    double *value;                    /* columns x rows */
    uint64_t *whole;                  /* rows; NULL without whole numbers */
    char **word;                      /* rows, into text; NULL without words */
    int *line;                        /* rows */
};

static size_t text_length(const struct gb_table_content *content)
{
    size_t length = 0;
    for (size_t k = 0; k < content->columns; k++) {
        length += strlen(content->name[k]) + 1;
    }
    for (size_t i = 0; content->word != NULL && i < content->rows; i++) {
        length += strlen(content->word[i]) + 1;
    }
    return length;
}

/* Appends a copy of a string to the text. */
static char *append(struct gb_table *table, const char *text)
{
    char *at = table->text + table->length;
    const size_t size = strlen(text) + 1;
    memcpy(at, text, size);
    table->length += size;
    return at;
}

static bool reserve(struct gb_table *table, const struct gb_table_content *content,
                    struct gb_error *err)
{
    const size_t rows = content->rows;
    table->path = g_strdup(content->path);
    table->columns = content->columns;
    table->rows = rows;
    table->words = table->units = table->wholes = content->columns;
    table->text = gb_alloc_array(text_length(content) + 1, 1, err);
    table->value = gb_alloc_array(content->columns * rows, sizeof *table->value, err);
    table->word = gb_alloc_array(rows, sizeof *table->word, err);
    table->line = gb_alloc_array(rows, sizeof *table->line, err);
    return table->text && table->value && table->word && table->line;
}

static void fill(struct gb_table *table, const struct gb_table_content *content)
{
    for (size_t k = 0; k < table->columns; k++) {
        table->name[k] = append(table, content->name[k]);
        for (size_t i = 0; i < table->rows; i++) {
            table->value[k * table->rows + i] =
                content->value[k] != NULL ? content->value[k][i] : (double)NAN;
        }
        if (content->value[k] == NULL) {
            table->words = k;
        }
    }
    for (size_t i = 0; i < table->rows; i++) {
        table->line[i] = content->line[i];
        if (content->word != NULL) {
            table->word[i] = append(table, content->word[i]);
        }
    }
}

bool gb_table_build(struct gb_table **out, const struct gb_table_content *content,
                    struct gb_error *err)
{
    struct gb_table *table = gb_alloc_array(1, sizeof *table, err);
    if (table == NULL || !reserve(table, content, err)) {
        gb_table_destroy(table);
        return false;
    }
    fill(table, content);
    *out = table;
    return true;
}

void gb_table_keep(struct gb_table *table, const char *word)
{
    const size_t before = table->rows;
    size_t kept = 0;
    for (size_t i = 0; i < before; i++) {
        if (strcmp(gb_table_word(table, i), word) == 0) {
            for (size_t k = 0; k < table->columns; k++) {
                table->value[k * before + kept] = table->value[k * before + i];
            }
            if (table->words < table->columns) {
                table->word[kept] = table->word[i];
            }
            table->line[kept++] = table->line[i];
        }
    }
    for (size_t k = 1; k < table->columns && kept < before; k++) {
        memmove(&table->value[k * kept], &table->value[k * before],
                kept * sizeof *table->value);
    }
    table->rows = kept;
}

/* Some editors write this before UTF-8 text. */
static const char byte_order_mark[] = "\xef\xbb\xbf";

static const char blanks[] = " \t\r";

/* Position in the file. */
struct cursor {
    char *next, *end;
    int line;
};

/* The next line that is neither empty nor a comment, terminated in place; NULL at the
 * end. */
static char *next_line(struct cursor *at)
{
    while (at->next < at->end) {
        char *line = at->next;
        char *stop = memchr(line, '\n', (size_t)(at->end - line));
        stop = stop ? stop : at->end;
        *stop = '\0'; /* the text has one byte more than the file */
        at->next = stop + 1;
        at->line++;
        if (line[0] != '#' && line[strspn(line, blanks)] != '\0') {
            return line;
        }
    }
    return NULL;
}

/* The next cell, trimmed and terminated in place; NULL after the last. */
static char *next_cell(char **rest)
{
    if (*rest == NULL) {
        return NULL;
    }
    char *cell = *rest + strspn(*rest, blanks);
    char *comma = strchr(cell, ',');
    char *end = comma ? comma : cell + strlen(cell);
    *rest = comma ? comma + 1 : NULL;
    while (end > cell && strchr(blanks, end[-1])) {
        end--;
    }
    *end = '\0';
    return cell;
}

static size_t find(const struct gb_table *table, const char *name)
{
    size_t k = 0;
    while (k < table->columns && strcmp(table->name[k], name) != 0) {
        k++;
    }
    return k;
}

static bool read_header(struct gb_table *table, struct cursor *at, struct gb_error *err)
{
    char *rest = next_line(at);
    if (rest == NULL) {
        return gb_error_set(err, GB_ERR_INPUT, "%s: no header row of column names",
                            table->path);
    }
    for (char *cell = next_cell(&rest); cell; cell = next_cell(&rest)) {
        if (table->columns == GB_TABLE_COLUMNS_MAX) {
            return gb_error_set(err, GB_ERR_INPUT, "%s:%d: more than %d columns",
                                table->path, at->line, GB_TABLE_COLUMNS_MAX);
        }
        if (*cell == '\0' || strchr(cell, '"') || find(table, cell) < table->columns) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "%s:%d: column %zu: name '%.40s' must be unique, not "
                                "empty and without quotes",
                                table->path, at->line, table->columns + 1, cell);
        }
        table->name[table->columns++] = cell;
    }
    return true;
}

/* Upper bound of the number of rows, to allocate the arrays. */
static size_t count_lines(const struct cursor *at)
{
    size_t lines = 0;
    for (const char *c = at->next; c < at->end; lines++) {
        const char *stop = memchr(c, '\n', (size_t)(at->end - c));
        c = stop ? stop + 1 : at->end;
    }
    return lines;
}

static bool read_cell(const struct gb_table *table, const struct cursor *at,
                      size_t column, const char *cell, double *value,
                      struct gb_error *err)
{
    const char *end = cell;
    *value = NAN;
    if (*cell == '\0' || column == table->words || column == table->units) {
        return true;
    }
    if (gb_units_number(cell, &end, value) && *end == '\0' && isfinite(*value)) {
        return true;
    }
    return gb_error_set(err, GB_ERR_INPUT,
                        "%s:%d: %.40s = '%.40s': must be a number or empty", table->path,
                        at->line, table->name[column], cell);
}

static bool read_whole(struct gb_table *table, const struct cursor *at, const char *cell,
                       struct gb_error *err)
{
    guint64 number = 0;
    if (!g_ascii_string_to_unsigned(cell, 10, 0, G_MAXUINT64, &number, NULL)) {
        return gb_error_set(
            err, GB_ERR_INPUT,
            "%s:%d: %.40s = '%.40s': must be a whole number from 0 to 2^64 - 1",
            table->path, at->line, table->name[table->wholes], cell);
    }
    table->whole[table->rows] = number;
    return true;
}

static bool read_row(struct gb_table *table, const struct cursor *at, char *rest,
                     size_t room, struct gb_error *err)
{
    size_t column = 0;
    for (char *cell = next_cell(&rest); cell; cell = next_cell(&rest)) {
        if (column < table->columns) {
            double *value = &table->value[column * room + table->rows];
            if (!read_cell(table, at, column, cell, value, err)) {
                return false;
            }
            if (column == table->words) {
                table->word[table->rows] = cell;
            }
            if (column == table->wholes && !read_whole(table, at, cell, err)) {
                return false;
            }
        }
        column++;
    }
    if (column != table->columns) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%s:%d: %zu cells: must be %zu, one per column", table->path,
                            at->line, column, table->columns);
    }
    table->line[table->rows++] = at->line;
    return true;
}

/* Compacts the columns: their stride shrinks from `room` to the number of rows. */
static void close_gaps(struct gb_table *table, size_t room)
{
    for (size_t k = 1; k < table->columns && room > table->rows; k++) {
        memmove(&table->value[k * table->rows], &table->value[k * room],
                table->rows * sizeof *table->value);
    }
}

static bool parse(struct gb_table *table, const char *words, const char *whole,
                  struct gb_error *err)
{
    struct cursor at = {table->text, table->text + table->length, 0};
    const void *nul = memchr(table->text, '\0', table->length);
    if (nul != NULL) {
        return gb_error_set(err, GB_ERR_INPUT, "%s: contains NUL bytes: must be text",
                            table->path);
    }
    if (g_str_has_prefix(table->text, byte_order_mark)) {
        at.next += strlen(byte_order_mark);
    }
    if (!read_header(table, &at, err)) {
        return false;
    }
    const size_t room = count_lines(&at);
    table->words = words ? find(table, words) : table->columns;
    table->units = words ? find(table, "unit") : table->columns;
    table->wholes = whole ? find(table, whole) : table->columns;
    if (room > GB_TABLE_CELLS_MAX / table->columns) {
        return gb_error_set(err, GB_ERR_INPUT, "%s: more than %d cells", table->path,
                            GB_TABLE_CELLS_MAX);
    }
    table->value = gb_alloc_array(table->columns * room, sizeof *table->value, err);
    table->word = gb_alloc_array(room, sizeof *table->word, err);
    table->line = gb_alloc_array(room, sizeof *table->line, err);
    table->whole = table->wholes < table->columns
                       ? gb_alloc_array(room, sizeof *table->whole, err)
                       : NULL;
    if (table->value == NULL || table->word == NULL || table->line == NULL ||
        (table->whole == NULL && table->wholes < table->columns)) {
        return false;
    }
    for (char *line = next_line(&at); line; line = next_line(&at)) {
        if (!read_row(table, &at, line, room, err)) {
            return false;
        }
    }
    close_gaps(table, room);
    return true;
}

bool gb_table_read(struct gb_table **out, const char *path, const char *words,
                   struct gb_error *err)
{
    return gb_table_read_whole(out, path, words, NULL, err);
}

bool gb_table_read_whole(struct gb_table **out, const char *path, const char *words,
                         const char *whole, struct gb_error *err)
{
    struct gb_table *table = gb_alloc_array(1, sizeof *table, err);
    if (table == NULL) {
        return false;
    }
    table->path = g_strdup(path);
    if (!gb_file_read(path, GB_TABLE_BYTES_MAX, &table->text, &table->length, err) ||
        !parse(table, words, whole, err)) {
        gb_table_destroy(table);
        return false;
    }
    *out = table;
    return true;
}

void gb_table_destroy(struct gb_table *table)
{
    if (table == NULL) {
        return;
    }
    g_free(table->path);
    gb_alloc_free(table->text);
    gb_alloc_free(table->value);
    gb_alloc_free(table->whole);
    gb_alloc_free(table->word);
    gb_alloc_free(table->line);
    gb_alloc_free(table);
}

const char *gb_table_path(const struct gb_table *table)
{
    return table->path;
}

size_t gb_table_rows(const struct gb_table *table)
{
    return table->rows;
}

const char *gb_table_name(const struct gb_table *table, size_t column)
{
    return column < table->columns ? table->name[column] : NULL;
}

int gb_table_line(const struct gb_table *table, size_t row)
{
    return table->line[row];
}

const double *gb_table_column(const struct gb_table *table, const char *name,
                              struct gb_error *err)
{
    const size_t k = find(table, name);
    if (k < table->columns) {
        return table->value + k * table->rows;
    }
    GString *known = g_string_new(NULL);
    for (size_t i = 0; i < table->columns && known->len < 300; i++) {
        g_string_append_printf(known, "%s%.40s", i > 0 ? ", " : "", table->name[i]);
    }
    gb_error_set(err, GB_ERR_INPUT, "%s: no column %s; there are %s", table->path, name,
                 known->str);
    g_string_free(known, TRUE);
    return NULL;
}

const uint64_t *gb_table_whole(const struct gb_table *table)
{
    return table->whole;
}

const char *gb_table_words(const struct gb_table *table)
{
    return table->words < table->columns ? table->name[table->words] : NULL;
}

const char *gb_table_word(const struct gb_table *table, size_t row)
{
    return table->words < table->columns ? table->word[row] : "";
}
