#include "study/papers/papers_printed.h"

#include <math.h>
#include <string.h>

#include <glib.h>

#include "base/alloc.h"
#include "base/read_file.h"
#include "base/units.h"
#include "io/preset_folders.h"

enum { BYTES_MAX = 1 << 20 };

/* A number printed with "about" may be off by this share of it. */
static const double about = 0.1;

enum column {
    ID,
    PAPER,
    ITEM,
    QUANTITY,
    CONDITION,
    VALUE,
    ERROR,
    UNIT,
    RELATION,
    CELLS,
    FIGURE,
    X,
    Y,
    SERIES,
    SOURCE,
    WITHOUT,
    COLUMNS,
    NEEDED = SOURCE + 1 /* the last one may be empty, and is cut off then */
};

static const char *const names[COLUMNS] = {[PAPER] = "paper",
                                           [ITEM] = "item",
                                           [ID] = "id",
                                           [QUANTITY] = "quantity",
                                           [CONDITION] = "condition",
                                           [VALUE] = "value",
                                           [ERROR] = "error",
                                           [UNIT] = "unit",
                                           [RELATION] = "relation",
                                           [CELLS] = "cells",
                                           [FIGURE] = "figure",
                                           [X] = "x",
                                           [Y] = "y",
                                           [SERIES] = "series",
                                           [SOURCE] = "source",
                                           [WITHOUT] = "without"};

/* A row that is being read. */
struct reader {
    const struct gb_papers_numbers *numbers;
    const struct gb_lab_grid_row *row;
    size_t index;
    struct gb_error *err;
};

static const char *cell(const struct reader *reader, enum column column)
{
    return gb_lab_grid_cell(&reader->numbers->grid, reader->index, (size_t)column).text;
}

static bool refuse(const struct reader *reader, enum column column, const char *accepted)
{
    return gb_error_set(reader->err, GB_ERR_INPUT, "%.200s:%d: %s \"%.60s\": accepted %s",
                        reader->numbers->path, reader->row->line, names[column],
                        cell(reader, column), accepted);
}

/* An empty cell is NaN. */
static bool read_number(const struct reader *reader, enum column column, double *value)
{
    const char *text = cell(reader, column);
    const char *end = NULL;
    *value = NAN;
    return *text == '\0' ||
           (gb_units_number(text, &end, value) && *end == '\0' && isfinite(*value)) ||
           refuse(reader, column, "a number");
}

/* Standard deviation of what was rounded to these digits: a uniform distribution over one
 * unit of the last digit. */
static double rounding(const char *digits)
{
    const char *point = strchr(digits, '.');
    const size_t behind = point != NULL ? strspn(point + 1, "0123456789") : 0;
    return pow(10.0, -(double)behind) / sqrt(12.0);
}

static bool read_relation(const struct reader *reader, enum gb_papers_relation *relation)
{
    static const char signs[] = "=~<";
    const char *text = cell(reader, RELATION);
    const char *found =
        text[0] != '\0' && text[1] == '\0' ? strchr(signs, text[0]) : NULL;
    *relation =
        found != NULL ? (enum gb_papers_relation)(found - signs) : GB_PAPERS_EQUAL;
    return found != NULL || refuse(reader, RELATION, "=, ~ or <");
}

static bool read_error(const struct reader *reader, struct gb_papers_printed *printed)
{
    double given = NAN;
    if (!read_number(reader, ERROR, &given)) {
        return false;
    }
    if (given < 0.0) {
        return refuse(reader, ERROR, "0 or more");
    }
    printed->error = hypot(isnan(given) ? 0.0 : given, rounding(printed->digits));
    if (printed->relation == GB_PAPERS_ABOUT) {
        printed->error = hypot(printed->error, about * fabs(printed->value));
    }
    return true;
}

/* A coordinate is a number or the value itself, which has an error. */
static bool read_coordinate(const struct reader *reader, enum column column,
                            const struct gb_papers_printed *printed, double *at,
                            double *error)
{
    *error = NAN;
    if (strcmp(cell(reader, column), "value") == 0) {
        *at = printed->value;
        *error = printed->error;
        return true;
    }
    return read_number(reader, column, at) &&
           (*printed->figure == '\0' || isfinite(*at) ||
            refuse(reader, column, "a number or value, for a figure"));
}

static bool read_row(const struct reader *reader, struct gb_papers_printed *printed)
{
    *printed = (struct gb_papers_printed){.paper = cell(reader, PAPER),
                                          .item = cell(reader, ITEM),
                                          .id = cell(reader, ID),
                                          .quantity = cell(reader, QUANTITY),
                                          .condition = cell(reader, CONDITION),
                                          .digits = cell(reader, VALUE),
                                          .unit = cell(reader, UNIT),
                                          .figure = cell(reader, FIGURE),
                                          .series = cell(reader, SERIES),
                                          .source = cell(reader, SOURCE),
                                          .without = cell(reader, WITHOUT),
                                          .line = reader->row->line};
    static const enum column needed[] = {PAPER, ITEM, ID, QUANTITY, VALUE, UNIT, SOURCE};
    for (size_t k = 0; k < G_N_ELEMENTS(needed); k++) {
        if (*cell(reader, needed[k]) == '\0') {
            return refuse(reader, needed[k], "a text");
        }
    }
    return read_number(reader, VALUE, &printed->value) &&
           read_relation(reader, &printed->relation) && read_error(reader, printed) &&
           read_number(reader, CELLS, &printed->cells) &&
           read_coordinate(reader, X, printed, &printed->x, &printed->x_error) &&
           read_coordinate(reader, Y, printed, &printed->y, &printed->y_error);
}

static bool check_header(const struct reader *reader)
{
    for (int k = 0; k < COLUMNS; k++) {
        if (strcmp(cell(reader, (enum column)k), names[k]) != 0) {
            return refuse(reader, (enum column)k, names[k]);
        }
    }
    return true;
}

static bool check_id(const struct reader *reader, const char *id)
{
    return gb_papers_printed_find(reader->numbers, id) == NULL ||
           refuse(reader, ID, "each id once");
}

static bool read_rows(struct gb_papers_numbers *numbers, struct gb_error *err)
{
    const size_t rows = gb_lab_grid_rows(&numbers->grid);
    struct reader reader = {.numbers = numbers, .err = err};
    bool header = false;
    numbers->row = g_new0(struct gb_papers_printed, rows + 1);
    for (; reader.index < rows; reader.index++) {
        struct gb_papers_printed printed;
        reader.row = gb_lab_grid_row(&numbers->grid, reader.index);
        if (reader.row->comment) {
            continue;
        }
        if (!header) {
            header = true;
            if (!check_header(&reader)) {
                return false;
            }
            continue;
        }
        if (!read_row(&reader, &printed) || !check_id(&reader, printed.id)) {
            return false;
        }
        numbers->row[numbers->count++] = printed;
    }
    return header || gb_error_set(err, GB_ERR_INPUT, "%.300s: no header", numbers->path);
}

bool gb_papers_printed_read(struct gb_papers_numbers *numbers, const char *path,
                            struct gb_error *err)
{
    *numbers = (struct gb_papers_numbers){0};
    numbers->path =
        path != NULL ? g_strdup(path) : gb_preset_folders_find_data("papers.csv");
    if (numbers->path == NULL) {
        return gb_error_set(err, GB_ERR_MACHINE,
                            "papers.csv, the printed numbers: not found among the "
                            "installed files");
    }
    char *text = NULL;
    size_t length = 0;
    const bool good =
        gb_read_file(numbers->path, BYTES_MAX, &text, &length, err) &&
        gb_lab_grid_init(&numbers->grid, numbers->path, text, length, ',', err) &&
        read_rows(numbers, err);
    gb_alloc_free(text);
    return good;
}

void gb_papers_printed_finish(struct gb_papers_numbers *numbers)
{
    gb_lab_grid_finish(&numbers->grid);
    g_free(numbers->row);
    g_free(numbers->path);
    *numbers = (struct gb_papers_numbers){0};
}

const struct gb_papers_printed *
gb_papers_printed_find(const struct gb_papers_numbers *numbers, const char *id)
{
    for (size_t k = 0; k < numbers->count; k++) {
        if (strcmp(numbers->row[k].id, id) == 0) {
            return &numbers->row[k];
        }
    }
    return NULL;
}
