#include "io/lab/lab_private.h"

#include <string.h>

const char *gb_lab_layout_head(const struct gb_lab_reading *reading, size_t column)
{
    return reading->names == GB_LAB_NONE
               ? ""
               : gb_lab_grid_cell(&reading->grid, (size_t)reading->names, column).text;
}

const char *gb_lab_layout_column(const struct gb_lab_reading *reading, int column,
                                 char buffer[GB_LAB_LAYOUT_COLUMN])
{
    char shown[GB_LAB_TEXT_SHOWN];
    const char *head = gb_lab_layout_head(reading, (size_t)column);
    gb_lab_text_show(head, shown);
    g_snprintf(buffer, GB_LAB_LAYOUT_COLUMN,
               *head != '\0' ? "column %d '%s'" : "column %d", column + 1, shown);
    return buffer;
}

char *gb_lab_layout_list(const struct gb_lab_reading *reading)
{
    enum { LONG = 220 };
    GString *list = g_string_new(NULL);
    for (size_t k = 0; k < reading->columns; k++) {
        char shown[GB_LAB_TEXT_SHOWN];
        if (list->len > LONG) {
            g_string_append_printf(list, ", ... %zu columns", reading->columns);
            break;
        }
        const char *head = gb_lab_layout_head(reading, k);
        const char *cell = gb_lab_grid_cell(&reading->grid, reading->first, k).text;
        gb_lab_text_show(reading->names != GB_LAB_NONE ? head : cell, shown);
        g_string_append_printf(list, *shown != '\0' ? "%s%zu '%s'" : "%s%zu",
                               k > 0 ? ", " : "", k + 1, shown);
    }
    return g_string_free(list, FALSE);
}

/* Whether all cells of a row are units, some in brackets. */
static bool is_units(const struct gb_lab_grid *grid, size_t row)
{
    const struct gb_lab_grid_row *at = gb_lab_grid_row(grid, row);
    size_t units = 0;
    for (size_t k = 0; k < at->count; k++) {
        char *text = g_strstrip(g_strdup(gb_lab_grid_cell(grid, row, k).text));
        const size_t size = strlen(text);
        if (size > 1 && strchr("([{", text[0]) && strchr(")]}", text[size - 1])) {
            text[0] = ' ';
            text[size - 1] = ' ';
        }
        const bool unit = gb_lab_unit_find(text) != NULL;
        const bool empty = size == 0;
        g_free(text);
        if (!unit && !empty) {
            return false;
        }
        units += unit;
    }
    return units > 0;
}

/* The row of heads at or above `row`: a comment only where no other row can be it. */
static int find_names(const struct gb_lab_reading *reading, int row)
{
    const struct gb_lab_grid *grid = &reading->grid;
    const size_t data = gb_lab_grid_row(grid, reading->first)->count;
    for (int above = row; above >= 0; above--) {
        const struct gb_lab_grid_row *at = gb_lab_grid_row(grid, (size_t)above);
        if (!at->comment) {
            row = at->count >= data || above == row ? above : row;
            break;
        }
    }
    if (row < 0) {
        return GB_LAB_NONE;
    }
    const size_t heads = gb_lab_grid_row(grid, (size_t)row)->count;
    /* heads of several words are cut by blanks; a row of one cell is a title */
    const bool fits = reading->separator == ' ' ? heads == data : heads > 1;
    return fits ? row : GB_LAB_NONE;
}

static void find_heads(struct gb_lab_reading *reading)
{
    const int above = (int)reading->first - 1;
    const bool units = above > 0 && is_units(&reading->grid, (size_t)above);
    reading->units = units ? above : GB_LAB_NONE;
    reading->names = find_names(reading, units ? above - 1 : above);
}

static void read_heads(struct gb_lab_reading *reading)
{
    reading->heading = g_new0(struct gb_lab_heading, reading->columns);
    for (size_t k = 0; k < reading->columns; k++) {
        gb_lab_role_heading(gb_lab_layout_head(reading, k), &reading->heading[k]);
        if (reading->units != GB_LAB_NONE) {
            struct gb_lab_heading below = {.unit = NULL};
            char *text = g_strconcat(
                "x ", gb_lab_grid_cell(&reading->grid, (size_t)reading->units, k).text,
                NULL);
            gb_lab_role_heading(text, &below);
            if (below.unit == NULL) {
                below.unit = gb_lab_unit_find(text + strlen("x "));
            }
            reading->heading[k].unit =
                below.unit != NULL ? below.unit : reading->heading[k].unit;
            g_free(text);
        }
    }
}

/* Decimal commas between commas would shift all cells behind them. */
static enum gb_lab_outcome check_width(struct gb_lab_reading *reading)
{
    const struct gb_lab_grid *grid = &reading->grid;
    for (size_t r = reading->first; r < gb_lab_grid_rows(grid); r++) {
        const struct gb_lab_grid_row *row = gb_lab_grid_row(grid, r);
        const size_t heads = reading->names == GB_LAB_NONE
                                 ? reading->columns
                                 : gb_lab_grid_row(grid, (size_t)reading->names)->count;
        if (!row->comment && row->count > heads && reading->separator != ';' &&
            reading->separator != '\t') {
            return gb_lab_question_fail(
                reading,
                "%.200s:%d: %zu cells below %zu headings; expected one cell per heading, "
                "numbers with a decimal comma in quotes or between semicolons",
                reading->path, row->line, row->count, heads);
        }
    }
    return GB_LAB_READ;
}

static enum gb_lab_outcome cut(struct gb_lab_reading *reading, const char *text)
{
    struct gb_lab_grid *grid = &reading->grid;
    if (!gb_lab_grid_init(grid, reading->path, text, strlen(text), reading->separator,
                          reading->err)) {
        return GB_LAB_FAILED;
    }
    if (!gb_lab_separator_first(grid, &reading->first)) {
        return gb_lab_question_fail(reading,
                                    "%.200s: no rows of two numbers or more; expected a "
                                    "table of pressure (or force) and density (or "
                                    "travel)",
                                    reading->path);
    }
    find_heads(reading);
    for (size_t r = reading->first; r < gb_lab_grid_rows(grid); r++) {
        const struct gb_lab_grid_row *row = gb_lab_grid_row(grid, r);
        reading->columns =
            row->comment ? reading->columns : MAX(reading->columns, row->count);
    }
    if (reading->names != GB_LAB_NONE) {
        reading->columns =
            MAX(reading->columns, gb_lab_grid_row(grid, (size_t)reading->names)->count);
    }
    read_heads(reading);
    return check_width(reading);
}

enum gb_lab_outcome gb_lab_layout_find(struct gb_lab_reading *reading)
{
    const char *text = reading->text.text;
    const enum gb_lab_outcome outcome = gb_lab_separator_find(reading, &text);
    return outcome == GB_LAB_READ ? cut(reading, text) : outcome;
}
