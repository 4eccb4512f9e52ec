#include "io/lab/lab_private.h"

#include <string.h>

/* Strongest first: a character that never stands in numbers or names. */
static const char separators[] = "\t;|, ";

/* Bytes of the beginning by which the separator is found. */
enum { SAMPLE = 1 << 16, NUMBERS_MIN = 2 };

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

bool gb_lab_separator_first(const struct gb_lab_grid *grid, size_t *first)
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
    const bool found = gb_lab_separator_first(&grid, &first);
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

enum gb_lab_outcome gb_lab_separator_find(struct gb_lab_reading *reading,
                                          const char **text)
{
    const char excel = excel_separator(text);
    const char given = reading->options->separator;
    reading->separator = given != 0 ? given : excel;
    return reading->separator != 0 ? GB_LAB_READ : find_separator(reading, *text);
}
