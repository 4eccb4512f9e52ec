#include "io/lab/lab_private.h"

#include <string.h>

/* What the cells of some columns say about the decimal mark. */
struct evidence {
    size_t point, comma, both; /* cells that have this reading only; two that differ */
    char point_text[GB_LAB_TEXT_SHOWN], comma_text[GB_LAB_TEXT_SHOWN];
    char both_text[GB_LAB_TEXT_SHOWN];
    int point_line, comma_line, both_line;
    bool both_comma; /* a comma stands in one of those */
};

static void note(size_t *count, char text[GB_LAB_TEXT_SHOWN], int *line, const char *cell,
                 int at)
{
    if ((*count)++ == 0) {
        gb_lab_text_show(cell, text);
        *line = at;
    }
}

static void add_cell(struct evidence *evidence, const char *text, int line)
{
    struct gb_lab_number number;
    if (!gb_lab_number_scan(text, &number)) {
        return;
    }
    if (!number.is_comma) {
        note(&evidence->point, evidence->point_text, &evidence->point_line, text, line);
    } else if (!number.is_point) {
        note(&evidence->comma, evidence->comma_text, &evidence->comma_line, text, line);
    } else if (number.comma < number.point || number.comma > number.point) {
        note(&evidence->both, evidence->both_text, &evidence->both_line, text, line);
        evidence->both_comma = evidence->both_comma || strchr(text, ',') != NULL;
    }
}

static void collect(const struct gb_lab_reading *reading, const bool *wanted,
                    struct evidence *evidence)
{
    const struct gb_lab_grid *grid = &reading->grid;
    for (size_t r = reading->first; r < gb_lab_grid_rows(grid); r++) {
        const struct gb_lab_grid_row *row = gb_lab_grid_row(grid, r);
        for (size_t k = 0; k < row->count && !row->comment; k++) {
            if (wanted[k]) {
                add_cell(evidence, gb_lab_grid_cell(grid, r, k).text, row->line);
            }
        }
    }
}

static enum gb_lab_outcome ask(struct gb_lab_reading *reading,
                               const struct evidence *evidence)
{
    struct gb_lab_number number;
    char as_comma[32];
    char as_point[32];
    gb_lab_number_scan(evidence->both_text, &number);
    g_ascii_formatd(as_comma, sizeof as_comma, "%.10g", number.comma);
    g_ascii_formatd(as_point, sizeof as_point, "%.10g", number.point);
    gb_lab_question_choice(reading, "decimal=comma");
    gb_lab_question_choice(reading, "decimal=point");
    return gb_lab_question_ask(
        reading, "'%s' in line %d: is it %s (decimal comma) or %s (decimal point)?",
        evidence->both_text, evidence->both_line, as_comma, as_point);
}

/* The decision by some cells; 0: they say nothing. */
static char decide(const struct evidence *evidence)
{
    return evidence->point > 0 && evidence->comma == 0   ? '.'
           : evidence->comma > 0 && evidence->point == 0 ? ','
                                                         : 0;
}

static enum gb_lab_outcome decide_by(struct gb_lab_reading *reading,
                                     const struct evidence *used,
                                     const struct evidence *others)
{
    if (used->point > 0 && used->comma > 0) {
        gb_lab_question_choice(reading, "decimal=comma");
        gb_lab_question_choice(reading, "decimal=point");
        return gb_lab_question_ask(
            reading, "'%s' in line %d and '%s' in line %d: which is the decimal mark?",
            used->comma_text, used->comma_line, used->point_text, used->point_line);
    }
    reading->decimal = decide(used);
    reading->decimal_guessed = reading->decimal != 0;
    if (reading->decimal != 0 || used->both == 0) {
        return GB_LAB_READ;
    }
    reading->decimal = decide(others);
    if (reading->decimal == 0 && reading->separator == ',' && !used->both_comma &&
        others->comma == 0) {
        reading->decimal = '.'; /* between commas a comma is no part of a number */
    }
    reading->decimal_guessed = true;
    return reading->decimal != 0 ? GB_LAB_READ : ask(reading, used);
}

enum gb_lab_outcome gb_lab_decimal_find(struct gb_lab_reading *reading)
{
    struct evidence used = {.point = 0};
    struct evidence others = {.point = 0};
    reading->decimal = reading->options->decimal;
    if (reading->decimal != 0) {
        return GB_LAB_READ;
    }
    bool *wanted = g_new0(bool, reading->columns);
    for (int role = 0; role < GB_LAB_ROLES; role++) {
        const int index = reading->column[role].index;
        if (index != GB_LAB_NONE && !gb_lab_role_is_words((enum gb_lab_role)role)) {
            wanted[index] = true;
        }
    }
    for (int k = 0; k < reading->options->keys; k++) {
        wanted[reading->key[k].index] = true;
    }
    collect(reading, wanted, &used);
    for (size_t k = 0; k < reading->columns; k++) {
        wanted[k] = !wanted[k];
    }
    collect(reading, wanted, &others);
    g_free(wanted);
    return decide_by(reading, &used, &others);
}
