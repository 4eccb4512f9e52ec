#include "io/lab/lab_private.h"

#include <math.h>
#include <string.h>

void gb_lab_rows_leave_out(struct gb_lab_reading *reading, const char *reason, int line)
{
    int k = 0;
    while (k < reading->reasons && strcmp(reading->reason[k].text, reason) != 0) {
        k++;
    }
    if (k == GB_LAB_REASONS) {
        return;
    }
    if (k == reading->reasons) {
        reading->reason[reading->reasons++] = (struct gb_lab_reason){reason, 0, line};
    }
    reading->reason[k].rows++;
}

/* Numbers of a row. */
struct row {
    double value[GB_LAB_ROLES], key[GB_LAB_OPTIONS_KEYS];
};

/* A thousand that a mark groups could be a decimal to another reader: said once. */
static void say_group(struct gb_lab_reading *reading, const struct gb_lab_number *number,
                      const char *text, int line, double value)
{
    const bool grouped =
        reading->decimal == ',' ? number->grouped_comma : number->grouped_point;
    if (grouped && strstr(reading->said->str, "thousands") == NULL) {
        char shown[GB_LAB_TEXT_SHOWN];
        char plain[G_ASCII_DTOSTR_BUF_SIZE];
        g_ascii_formatd(plain, sizeof plain, "%.10g", value);
        g_string_append_printf(reading->said,
                               ", thousands grouped ('%s' in line %d is %s)",
                               gb_lab_text_show(text, shown), line, plain);
    }
}

/* All cells of a column have a percent sign or none, unless the head says percent. */
static bool check_percent(struct gb_lab_reading *reading, struct gb_lab_column *column,
                          bool percent, int line)
{
    if (percent && column->unit == NULL) {
        column->unit = gb_lab_unit_find("%");
        column->percent = true;
        column->guessed = true;
    }
    column->plain = column->plain || !percent;
    const bool is_unit = column->unit != NULL && column->unit->si == 0.01 &&
                         column->unit->dimension == GB_DIM_FRACTION;
    if ((percent && !is_unit) || (column->percent && column->plain)) {
        char shown[GB_LAB_LAYOUT_COLUMN];
        gb_lab_question_fail(reading,
                             "%.200s:%d: %s: expected a percent sign in all cells, or in "
                             "none, and no other unit",
                             reading->path, line,
                             gb_lab_layout_column(reading, column->index, shown));
        return false;
    }
    return true;
}

static bool read_cell(struct gb_lab_reading *reading, struct gb_lab_column *column,
                      size_t row, bool is_key, double *value)
{
    const char *text = gb_lab_grid_cell(&reading->grid, row, (size_t)column->index).text;
    const int line = gb_lab_grid_row(&reading->grid, row)->line;
    struct gb_lab_number number;
    *value = NAN;
    if (*text == '\0') {
        return true;
    }
    if (!gb_lab_number_scan(text, &number) ||
        !gb_lab_number_read(&number, reading->decimal, value)) {
        char name[GB_LAB_LAYOUT_COLUMN];
        char shown[GB_LAB_TEXT_SHOWN];
        gb_lab_question_fail(reading, "%.200s:%d: %s = '%s': must be a number%s or empty",
                             reading->path, line,
                             gb_lab_layout_column(reading, column->index, name),
                             gb_lab_text_show(text, shown),
                             reading->decimal == ',' ? " with a decimal comma" : "");
        return false;
    }
    say_group(reading, &number, text, line, *value);
    return is_key || check_percent(reading, column, number.percent, line);
}

static bool read_row(struct gb_lab_reading *reading, size_t row, struct row *out)
{
    for (int role = 0; role < GB_LAB_ROLES; role++) {
        struct gb_lab_column *column = &reading->column[role];
        out->value[role] = NAN;
        if (column->index != GB_LAB_NONE &&
            !gb_lab_role_is_words((enum gb_lab_role)role) &&
            !read_cell(reading, column, row, false, &out->value[role])) {
            return false;
        }
    }
    for (int k = 0; k < reading->options->keys; k++) {
        if (!read_cell(reading, &reading->key[k], row, true, &out->key[k])) {
            return false;
        }
    }
    return true;
}

/* A row of one cell that is no number: a remark. */
static bool is_remark(const struct gb_lab_reading *reading, size_t row)
{
    const struct gb_lab_grid_row *at = gb_lab_grid_row(&reading->grid, row);
    struct gb_lab_number number;
    size_t filled = 0;
    bool numbers = false;
    for (size_t k = 0; k < at->count; k++) {
        const char *text = gb_lab_grid_cell(&reading->grid, row, k).text;
        filled += *text != '\0';
        numbers = numbers || gb_lab_number_scan(text, &number);
    }
    return filled == 1 && !numbers;
}

/* How many of the columns that a point needs are empty. */
static int count_missing(const struct gb_lab_reading *reading, const struct row *row,
                         int *needed)
{
    static const enum gb_lab_role roles[] = {GB_LAB_ROLE_PRESSURE, GB_LAB_ROLE_FORCE,
                                             GB_LAB_ROLE_DENSITY,  GB_LAB_ROLE_POROSITY,
                                             GB_LAB_ROLE_HEIGHT,   GB_LAB_ROLE_TRAVEL};
    int missing = 0;
    *needed = 0;
    for (size_t i = 0; i < G_N_ELEMENTS(roles); i++) {
        const bool used = reading->column[roles[i]].index != GB_LAB_NONE;
        *needed += used;
        missing += used && isnan(row->value[roles[i]]);
    }
    return missing;
}

static void put_row(struct gb_lab_reading *reading, size_t row, const struct row *values)
{
    const size_t at = reading->count++;
    const int branch = reading->column[GB_LAB_ROLE_BRANCH].index;
    const int words =
        branch != GB_LAB_NONE ? branch : reading->column[GB_LAB_ROLE_SERIES].index;
    reading->line[at] = gb_lab_grid_row(&reading->grid, row)->line;
    reading->word[at] = words != GB_LAB_NONE
                            ? gb_lab_grid_cell(&reading->grid, row, (size_t)words).text
                            : "";
    for (int role = 0; role < GB_LAB_ROLES; role++) {
        reading->value[role][at] = values->value[role];
    }
    for (int k = 0; k < reading->options->keys; k++) {
        reading->key_value[k][at] = values->key[k];
    }
}

static bool take_row(struct gb_lab_reading *reading, size_t row)
{
    const int line = gb_lab_grid_row(&reading->grid, row)->line;
    struct row values;
    int needed = 0;
    if (gb_lab_grid_row(&reading->grid, row)->comment) {
        gb_lab_rows_leave_out(reading, "comment", line);
        return true;
    }
    if (is_remark(reading, row)) {
        gb_lab_rows_leave_out(reading, "remark", line);
        return true;
    }
    if (!read_row(reading, row, &values)) {
        return false;
    }
    const int missing = count_missing(reading, &values, &needed);
    if (missing > 0) {
        gb_lab_rows_leave_out(
            reading, missing == needed ? "without numbers" : "with an empty cell", line);
    } else {
        put_row(reading, row, &values);
    }
    return true;
}

static void reserve(struct gb_lab_reading *reading, size_t rows)
{
    reading->line = g_new0(int, rows);
    reading->word = g_new0(const char *, rows);
    for (int role = 0; role < GB_LAB_ROLES; role++) {
        reading->value[role] = g_new0(double, rows);
    }
    for (int k = 0; k < GB_LAB_OPTIONS_KEYS; k++) {
        reading->key_value[k] = g_new0(double, rows);
    }
    reading->pressure = g_new0(double, rows);
    reading->density = g_new0(double, rows);
}

enum gb_lab_outcome gb_lab_rows_read(struct gb_lab_reading *reading)
{
    const size_t rows = gb_lab_grid_rows(&reading->grid);
    reserve(reading, rows - reading->first);
    for (size_t r = reading->first; r < rows; r++) {
        if (!take_row(reading, r)) {
            return GB_LAB_FAILED;
        }
    }
    return reading->count > 0
               ? GB_LAB_READ
               : gb_lab_question_fail(reading,
                                      "%.200s: no row has numbers in all columns "
                                      "that are read",
                                      reading->path);
}

void gb_lab_rows_keep(struct gb_lab_reading *reading, const bool *kept)
{
    size_t count = 0;
    for (size_t i = 0; i < reading->count; i++) {
        if (!kept[i]) {
            continue;
        }
        reading->line[count] = reading->line[i];
        reading->word[count] = reading->word[i];
        reading->pressure[count] = reading->pressure[i];
        reading->density[count] = reading->density[i];
        for (int role = 0; role < GB_LAB_ROLES; role++) {
            reading->value[role][count] = reading->value[role][i];
        }
        for (int k = 0; k < GB_LAB_OPTIONS_KEYS; k++) {
            reading->key_value[k][count] = reading->key_value[k][i];
        }
        count++;
    }
    reading->count = count;
}
