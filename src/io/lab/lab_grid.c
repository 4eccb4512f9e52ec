#include "io/lab/lab_grid.h"

#include <string.h>

#include "base/table.h"

/* The text is cut in place: cells never become longer. */
struct cutter {
    struct gb_lab_grid *grid;
    const char *path;
    char *at, *end;
    char separator;
    int line;
};

static bool is_line_end(char c)
{
    return c == '\n' || c == '\r';
}

static bool is_separator(const struct cutter *cutter, char c)
{
    return c == cutter->separator || (cutter->separator == ' ' && c == '\t');
}

/* Blanks around a cell; a tab is one unless it separates. */
static size_t blank_at(const struct cutter *cutter, const char *at)
{
    if (*at == ' ' || (*at == '\t' && cutter->separator != '\t')) {
        return 1;
    }
    return g_str_has_prefix(at, "\xc2\xa0") ? 2 : 0; /* no-break space */
}

static void skip_blanks(struct cutter *cutter)
{
    for (size_t size = blank_at(cutter, cutter->at); size > 0 && cutter->at < cutter->end;
         size = blank_at(cutter, cutter->at)) {
        cutter->at += size;
    }
}

/* Whether a cell ends here: at a separator, a line end or the end of the text. */
static bool ends(const struct cutter *cutter)
{
    return cutter->at >= cutter->end || is_line_end(*cutter->at) ||
           is_separator(cutter, *cutter->at);
}

/* The quoted part of a cell, from behind its first quote; NULL: it is not closed. */
static char *unquote(struct cutter *cutter, char *to)
{
    while (cutter->at < cutter->end) {
        const char c = *cutter->at++;
        if (c == '"' && *cutter->at != '"') {
            return to;
        }
        cutter->at += c == '"';
        cutter->line += c == '\n' || (c == '\r' && *cutter->at != '\n');
        *to++ = c;
    }
    return NULL;
}

static void trim_end(char *text, char **end)
{
    while (*end > text && ((*end)[-1] == ' ' || (*end)[-1] == '\t')) {
        (*end)--;
    }
    if (*end - text >= 2 && memcmp(*end - 2, "\xc2\xa0", 2) == 0) {
        *end -= 2;
        trim_end(text, end);
    }
}

/* The cell at the cursor, which stops at what ends it. */
static bool cut_cell(struct cutter *cutter, struct gb_error *err)
{
    const int line = cutter->line;
    if (cutter->separator == ' ' || !ends(cutter)) {
        skip_blanks(cutter);
    }
    char *start = cutter->at;
    char *to = start;
    struct gb_lab_grid_cell cell = {start, !ends(cutter) && *start == '"'};
    if (cell.quoted) {
        cutter->at++;
        to = unquote(cutter, to);
        if (to == NULL) {
            return gb_error_set(err, GB_ERR_INPUT, "%.200s:%d: a quote is not closed",
                                cutter->path, line);
        }
    }
    while (!ends(cutter)) {
        *to++ = *cutter->at++;
    }
    trim_end(start, &to);
    /* a separator or line end at `to` has been seen, or is read before it is replaced */
    g_array_append_val(cutter->grid->cells, cell);
    if (to < cutter->at) {
        *to = '\0';
    }
    return true;
}

/* Messages of spreadsheets that stand for a number: no comments. */
static bool is_formula_error(const char *at)
{
    static const char *const errors[] = {"#DIV/0!", "#N/A",    "#NAME?",  "#NULL!",
                                         "#NUM!",   "#REF!",   "#VALUE!", "#WERT!",
                                         "#ZAHL!",  "#BEZUG!", "#NV",     "#VALEUR!"};
    for (size_t i = 0; i < G_N_ELEMENTS(errors); i++) {
        if (g_str_has_prefix(at, errors[i])) {
            return true;
        }
    }
    return false;
}

static void skip_line_end(struct cutter *cutter)
{
    const char c = *cutter->at;
    *cutter->at++ = '\0';
    if (c == '\r' && cutter->at < cutter->end && *cutter->at == '\n') {
        *cutter->at++ = '\0';
    }
    cutter->line++;
}

/* Drops the empty cells at the end; an empty row is dropped. */
static void close_row(struct gb_lab_grid *grid, struct gb_lab_grid_row row)
{
    row.count = grid->cells->len - row.first;
    while (row.count > 0 &&
           *g_array_index(grid->cells, struct gb_lab_grid_cell, row.first + row.count - 1)
                   .text == '\0') {
        row.count--;
    }
    g_array_set_size(grid->cells, (guint)(row.first + row.count));
    if (row.count > 0) {
        g_array_append_val(grid->rows, row);
    }
}

/* The separator behind a cell becomes its end; false: it was the last one of the row. */
static bool pass_separator(struct cutter *cutter)
{
    if (cutter->separator == ' ') {
        char *end = cutter->at;
        skip_blanks(cutter);
        const bool more = cutter->at < cutter->end && !is_line_end(*cutter->at);
        if (end < cutter->at) {
            *end = '\0';
        }
        return more;
    }
    if (cutter->at >= cutter->end || !is_separator(cutter, *cutter->at)) {
        return false;
    }
    *cutter->at++ = '\0';
    return true;
}

static bool cut_row(struct cutter *cutter, struct gb_error *err)
{
    struct gb_lab_grid_row row = {.first = cutter->grid->cells->len,
                                  .line = cutter->line};
    const char *start = cutter->at + strspn(cutter->at, " ");
    if (*start == '#' && !is_formula_error(start)) {
        row.comment = true;
        cutter->at += start + 1 - cutter->at;
    }
    bool more = true;
    while (more) {
        if (!cut_cell(cutter, err)) {
            return false;
        }
        if (cutter->grid->cells->len - row.first > GB_TABLE_COLUMNS_MAX) {
            return gb_error_set(err, GB_ERR_INPUT, "%.200s:%d: more than %d columns",
                                cutter->path, row.line, GB_TABLE_COLUMNS_MAX);
        }
        more = pass_separator(cutter);
    }
    if (cutter->at < cutter->end) {
        skip_line_end(cutter);
    }
    close_row(cutter->grid, row);
    return true;
}

bool gb_lab_grid_init(struct gb_lab_grid *grid, const char *path, const char *text,
                      size_t length, char separator, struct gb_error *err)
{
    *grid = (struct gb_lab_grid){
        .text = g_strndup(text, length),
        .cells = g_array_new(FALSE, FALSE, sizeof(struct gb_lab_grid_cell)),
        .rows = g_array_new(FALSE, FALSE, sizeof(struct gb_lab_grid_row))};
    struct cutter cutter = {grid, path, grid->text, grid->text + length, separator, 1};
    while (cutter.at < cutter.end) {
        if (!cut_row(&cutter, err)) {
            gb_lab_grid_finish(grid);
            return false;
        }
    }
    return true;
}

void gb_lab_grid_finish(struct gb_lab_grid *grid)
{
    g_free(grid->text);
    if (grid->cells != NULL) {
        g_array_unref(grid->cells);
        g_array_unref(grid->rows);
    }
    *grid = (struct gb_lab_grid){0};
}

size_t gb_lab_grid_rows(const struct gb_lab_grid *grid)
{
    return grid->rows->len;
}

const struct gb_lab_grid_row *gb_lab_grid_row(const struct gb_lab_grid *grid, size_t row)
{
    return &g_array_index(grid->rows, struct gb_lab_grid_row, row);
}

struct gb_lab_grid_cell gb_lab_grid_cell(const struct gb_lab_grid *grid, size_t row,
                                         size_t column)
{
    const struct gb_lab_grid_row *at = gb_lab_grid_row(grid, row);
    return column < at->count
               ? g_array_index(grid->cells, struct gb_lab_grid_cell, at->first + column)
               : (struct gb_lab_grid_cell){"", false};
}
