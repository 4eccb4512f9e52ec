#include "io/lab/lab_private.h"

#include <string.h>

/* Strongest first: a character that never stands in numbers or names. */
static const char separators[] = "\t;|, ";

/* Bytes of the beginning by which the separator is found. */
enum { SAMPLE = 1 << 16, NUMBERS_MIN = 2 };

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

static bool is_number(const struct gb_lab_grid *grid, size_t row, size_t column)
{
    struct gb_lab_number number;
    return gb_lab_number_scan(gb_lab_grid_cell(grid, row, column).text, &number);
}

/* Whether a row can be one of the data: two numbers or more. */
static bool is_data(const struct gb_lab_grid *grid, size_t row)
{
    const struct gb_lab_grid_row *at = gb_lab_grid_row(grid, row);
    size_t numbers = 0;
    for (size_t k = 0; k < at->count && numbers < NUMBERS_MIN && !at->comment; k++) {
        numbers += is_number(grid, row, k);
    }
    return numbers >= NUMBERS_MIN;
}

static size_t next_row(const struct gb_lab_grid *grid, size_t row)
{
    size_t next = row + 1;
    while (next < gb_lab_grid_rows(grid) && gb_lab_grid_row(grid, next)->comment) {
        next++;
    }
    return next;
}

/* The first row of the data: one of data before another one or at the end; without such
 * a pair the first of all. */
static bool find_first(const struct gb_lab_grid *grid, size_t *first)
{
    const size_t rows = gb_lab_grid_rows(grid);
    bool found = false;
    for (size_t r = 0; r < rows; r++) {
        if (is_data(grid, r)) {
            const size_t next = next_row(grid, r);
            *first = found ? *first : r;
            found = true;
            if (next >= rows || is_data(grid, next)) {
                *first = r;
                return true;
            }
        }
    }
    return found;
}

/* "12 0,41" between commas: two numbers that another separator parts. */
static bool holds_two_numbers(const char *text)
{
    char **parts = g_strsplit_set(text, " \t", -1);
    struct gb_lab_number number;
    int numbers = 0;
    for (size_t i = 0; parts[i] != NULL; i++) {
        numbers += gb_lab_number_scan(parts[i], &number);
    }
    g_strfreev(parts);
    return numbers > 1 && !gb_lab_number_scan(text, &number);
}

/* A cell that this separator has left uncut: it has a stronger one beside a digit. */
static bool is_uncut(struct gb_lab_grid_cell cell, char separator)
{
    struct gb_lab_number number;
    const bool bare = cell.text[0] != '\0' && cell.text[1] == '\0' && separator == ' ';
    if (cell.quoted || (!bare && strpbrk(cell.text, "0123456789") == NULL) ||
        gb_lab_number_scan(cell.text, &number)) {
        return false;
    }
    const char *stronger = separators;
    for (; *stronger != separator; stronger++) {
        if (strchr(cell.text, *stronger) != NULL) {
            return true;
        }
    }
    return separator != ' ' && holds_two_numbers(cell.text);
}

/* Whether a separator makes a table of the text: most rows of it have no uncut cell. */
static bool suits(const char *path, const char *text, size_t length, char separator)
{
    struct gb_lab_grid grid = {0};
    size_t first = 0;
    size_t good = 0;
    size_t bad = 0;
    if (!gb_lab_grid_init(&grid, path, text, length, separator, NULL)) {
        return false;
    }
    const bool found = find_first(&grid, &first);
    for (size_t r = first; found && r < gb_lab_grid_rows(&grid); r++) {
        const struct gb_lab_grid_row *row = gb_lab_grid_row(&grid, r);
        bool uncut = false;
        for (size_t k = 0; k < row->count && !uncut; k++) {
            uncut = is_uncut(gb_lab_grid_cell(&grid, r, k), separator);
        }
        good += !uncut && !row->comment;
        bad += uncut && !row->comment;
    }
    gb_lab_grid_finish(&grid);
    return found && good > bad;
}

static const char *separator_word(char separator)
{
    switch (separator) {
    case '\t':
        return "tab";
    case ' ':
        return "blank";
    case ';':
        return "semicolon";
    case '|':
        return "bar";
    default:
        return "comma";
    }
}

/* The first line "sep=;" of Excel; the text behind it. */
static char excel_separator(const char **text)
{
    const char *line = *text;
    if (g_ascii_strncasecmp(line, "sep=", 4) != 0 || line[4] == '\0' ||
        strchr(separators, line[4]) == NULL) {
        return 0;
    }
    *text = line + 5;
    return line[4];
}

static enum gb_lab_outcome find_separator(struct gb_lab_reading *reading,
                                          const char *text)
{
    const size_t length = MIN(strlen(text), SAMPLE);
    char found[sizeof separators] = "";
    size_t count = 0;
    for (const char *s = separators; *s != '\0'; s++) {
        const bool tabs = *s == ' ' && strchr(found, '\t') != NULL; /* blanks, too */
        if (!tabs && suits(reading->path, text, length, *s)) {
            found[count++] = *s;
        }
    }
    if (count > 1) {
        for (size_t i = 0; i < count; i++) {
            char *item = g_strdup_printf("separator=%s", separator_word(found[i]));
            gb_lab_question_choice(reading, item);
            g_free(item);
        }
        return gb_lab_question_ask(reading, "which character separates its cells?");
    }
    reading->separator = count > 0 ? found[0] : ',';
    reading->separator_guessed = count > 0;
    return GB_LAB_READ;
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
                "%.200s:%d: %zu cells below %zu heads; accepted one cell per head, "
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
    if (!find_first(grid, &reading->first)) {
        return gb_lab_question_fail(reading,
                                    "%.200s: no rows of two numbers or more; accepted a "
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
    const char excel = excel_separator(&text);
    const char *behind = text;
    reading->separator = reading->options->separator;
    if (reading->separator == 0) {
        reading->separator = excel;
    }
    if (reading->separator == 0) {
        const enum gb_lab_outcome outcome = find_separator(reading, behind);
        if (outcome != GB_LAB_READ) {
            return outcome;
        }
    }
    return cut(reading, behind);
}
