#include <math.h>
#include <string.h>

#include "scene/imported/imported_private.h"

/* A table: '#' comments, a row of names, rows of numbers, separated by commas,
 * semicolons, tabs or blanks.  Names may stand in a comment; without names, four columns
 * are x, y, z and the radius (Yade).  "# cell, um: 12 12 20" gives the edges of the cell, and
 * "tilt xy xz yz, um: 1 0 0" behind it its tilts; "# d = 9.7e-9 m" the unit of columns in d. */
struct table {
    char separator; /* ' ': blanks and tabs */
    bool named;
    struct gb_imported_columns columns;
};

/* The mark that separates four words or more; some files mix tabs and blanks. */
static char separator_of(const char *line)
{
    enum { COLUMNS_LEAST = 4 };
    for (const char *mark = ";,\t"; *mark != '\0'; mark++) {
        int marks = 0;
        for (const char *at = line; *at != '\0'; at++) {
            marks += *at == *mark;
        }
        if (marks >= COLUMNS_LEAST - 1) {
            return *mark;
        }
    }
    return ' ';
}

/* Words of a line, without empty ones between blanks; g_strfreev. */
static char **split(const char *line, char separator)
{
    if (separator != ' ') {
        const char text[2] = {separator, '\0'};
        char **words = g_strsplit(line, text, -1);
        for (int k = 0; words[k] != NULL; k++) {
            g_strstrip(words[k]);
        }
        return words;
    }
    GPtrArray *words = g_ptr_array_new();
    for (const char *at = line + strspn(line, " \t"); *at != '\0';) {
        const size_t length = strcspn(at, " \t");
        g_ptr_array_add(words, g_strndup(at, length));
        at += length + strspn(at + length, " \t");
    }
    g_ptr_array_add(words, NULL);
    return (char **)g_ptr_array_free(words, FALSE);
}

/* "cell, um: 12 12 20": the unit may be left out. */
static bool take_cell(struct gb_imported_raw *raw, const struct gb_imported_lines *lines,
                      const char *text, struct gb_error *err)
{
    const char *colon = strchr(text, ':');
    if (!g_str_has_prefix(text, "cell") || colon == NULL) {
        return true;
    }
    char *numbers = g_strdup(colon + 1);
    char *tilt = strstr(numbers, "tilt");
    char **tilts = tilt != NULL && strchr(tilt, ':') != NULL
                       ? split(strchr(tilt, ':') + 1, ' ')
                       : g_new0(char *, 1);
    if (tilt != NULL) {
        *tilt = '\0';
    }
    char **edges = split(numbers, ' ');
    bool good =
        g_strv_length(edges) == 3 ||
        gb_imported_lines_refuse(lines, err,
                                 "a cell of %u edges: must be 3, as in # cell, um: 12 12 "
                                 "20",
                                 g_strv_length(edges));
    for (int k = 0; good && k < 3; k++) {
        good = gb_imported_lines_number(lines, edges[k], "an edge of the cell",
                                        &raw->edges[k], err);
    }
    if (good && tilt != NULL && g_strv_length(tilts) != 3) {
        good = gb_imported_lines_refuse(
            lines, err, "%u tilts of the cell: must be 3, as in tilt xy xz yz, um: 1 0 0",
            g_strv_length(tilts));
    }
    for (int k = 0; good && tilts[k] != NULL; k++) {
        good = gb_imported_lines_number(lines, tilts[k], "a tilt of the cell",
                                        &raw->tilts[k], err);
    }
    raw->cell = good;
    g_strfreev(edges);
    g_strfreev(tilts);
    g_free(numbers);
    return good;
}

static bool take_comment(struct table *table, struct gb_imported_raw *raw,
                         const struct gb_imported_lines *lines, const char *text,
                         struct gb_error *err)
{
    const char *missing;
    if (g_str_has_prefix(text, "d = ")) {
        raw->unit_m = g_ascii_strtod(text + strlen("d = "), NULL);
    }
    if (!table->named) { /* Yade: "#format x_y_z_r"; others: "# x y z r" */
        char *names = g_strdup(text);
        if (g_str_has_prefix(names, "format ")) {
            memset(names, ' ', strlen("format "));
            g_strdelimit(names, "_", ' ');
        }
        table->separator = separator_of(names);
        char **words = split(g_strstrip(names), table->separator);
        table->named = gb_imported_columns_find(&table->columns, words, &missing);
        g_strfreev(words);
        g_free(names);
        if (table->named) {
            table->separator = ' ';
        }
    }
    return take_cell(raw, lines, text, err);
}

/* The first line that is no comment: names, or already numbers. */
static bool take_names(struct table *table, const struct gb_imported_lines *lines,
                       const char *line, bool *is_row, struct gb_error *err)
{
    const char *missing = "";
    table->separator = separator_of(line);
    char **words = split(line, table->separator);
    char *end = NULL;
    const char *first = words[0] != NULL ? words[0] : "";
    (void)g_ascii_strtod(first, &end);
    *is_row = end != first && *end == '\0';
    bool good = true;
    if (*is_row && !table->named) {
        table->columns = (struct gb_imported_columns){
            .position = {0, 1, 2}, .size = 3, .radius = true, .unit_m = (double)NAN};
        good = g_strv_length(words) == 4 ||
               gb_imported_lines_refuse(
                   lines, err,
                   "%u columns without names: must be 4 (x y z radius), or "
                   "have a row of names: x, y, z, diameter or radius",
                   g_strv_length(words));
    } else if (!*is_row) {
        good = gb_imported_columns_find(&table->columns, words, &missing) ||
               gb_imported_lines_refuse(
                   lines, err,
                   "no column %s among %.80s: must be x, y, z and diameter "
                   "or radius, with a unit as in x_um",
                   missing, line);
    }
    table->named = true;
    g_strfreev(words);
    return good;
}

static bool take_row(struct table *table, struct gb_imported_raw *raw,
                     const struct gb_imported_lines *lines, const char *line,
                     struct gb_error *err)
{
    char **words = split(line, table->separator);
    const bool good = gb_imported_columns_add_row(raw, lines, &table->columns, words,
                                                  (int)g_strv_length(words), err);
    g_strfreev(words);
    return good;
}

static bool recognise(const char *text)
{
    (void)text; /* what is nothing else is a table */
    return true;
}

static bool read_table(struct gb_imported_lines *lines, struct gb_imported_raw *raw,
                       struct gb_error *err)
{
    struct table table = {.separator = ' '};
    bool begun = false;
    for (char *line; (line = gb_imported_lines_next(lines)) != NULL;) {
        bool is_row = true;
        if (*line == '\0') {
            continue;
        }
        if (*line == '#') {
            if (!take_comment(&table, raw, lines, g_strstrip(line + 1), err)) {
                return false;
            }
            continue;
        }
        if (!begun && !take_names(&table, lines, line, &is_row, err)) {
            return false;
        }
        begun = true;
        if (is_row && !take_row(&table, raw, lines, line, err)) {
            return false;
        }
    }
    raw->reduced = table.columns.reduced;
    if (!raw->reduced && table.named) {
        raw->unit_m = table.columns.unit_m;
    }
    return true;
}

const struct gb_imported_format gb_imported_table = {"table", recognise, read_table};
