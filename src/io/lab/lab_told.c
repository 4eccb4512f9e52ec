#include "io/lab/lab_private.h"

#include <math.h>
#include <string.h>

/* The line that says how a file was read. */

static const char *describe_unit(const struct gb_lab_column *column)
{
    if (column->unit->dimension == GB_DIM_FRACTION) {
        return column->unit->si < 1.0 ? "percent" : "fractions";
    }
    return column->unit->name;
}

static void add_columns(const struct gb_lab_reading *reading, GString *text)
{
    for (int role = 0; role < GB_LAB_ROLES; role++) {
        const struct gb_lab_column *column = &reading->column[role];
        char shown[GB_LAB_LAYOUT_COLUMN];
        if (column->index == GB_LAB_NONE) {
            continue;
        }
        g_string_append_printf(text, "%s%s from %s", text->len > 0 ? ", " : "",
                               gb_lab_role_name((enum gb_lab_role)role),
                               gb_lab_layout_column(reading, column->index, shown));
        if (column->unit != NULL) {
            g_string_append_printf(text, " in %s%s", describe_unit(column),
                                   column->unit_said ? " (it names no unit)" : "");
        }
    }
}

static const char *describe_separator(char separator)
{
    switch (separator) {
    case '\t':
        return "tabs";
    case ' ':
        return "blanks";
    case ';':
        return "semicolons";
    case '|':
        return "bars";
    default:
        return "commas";
    }
}

static void add_format(const struct gb_lab_reading *reading, GString *text)
{
    g_string_append_printf(text, "; between %s", describe_separator(reading->separator));
    if (reading->decimal != 0) {
        g_string_append_printf(text, ", decimal %s",
                               reading->decimal == ',' ? "comma" : "point");
    }
    if (reading->text.guessed) {
        g_string_append_printf(text, ", taken for %s", reading->text.encoding);
    }
    if (reading->names != GB_LAB_NONE) {
        const struct gb_lab_grid_row *row =
            gb_lab_grid_row(&reading->grid, (size_t)reading->names);
        g_string_append_printf(text, ", headings in line %d%s", row->line,
                               row->comment ? " (a comment)" : "");
    }
    g_string_append(text, reading->said->str);
}

static void add_left_out(const struct gb_lab_reading *reading, GString *text)
{
    for (int k = 0; k < reading->reasons; k++) {
        const struct gb_lab_reason *reason = &reading->reason[k];
        g_string_append_printf(text, "%s%zu row%s %s (%sline %d)",
                               k > 0 ? ", " : "; left out: ", reason->rows,
                               reason->rows > 1 ? "s" : "", reason->text,
                               reason->rows > 1 ? "from " : "", reason->line);
    }
}

static void add_range(const struct gb_lab_reading *reading, GString *text)
{
    double low[2] = {INFINITY, INFINITY};
    double high[2] = {-INFINITY, -INFINITY};
    for (size_t i = 0; i < reading->count; i++) {
        const double value[2] = {reading->pressure[i], reading->density[i]};
        for (int k = 0; k < 2; k++) {
            low[k] = fmin(low[k], value[k]);
            high[k] = fmax(high[k], value[k]);
        }
    }
    g_string_append_printf(text,
                           "; %zu points, %.4g to %.4g MPa, relative density %.4g to "
                           "%.4g",
                           reading->count, low[0], high[0], low[1], high[1]);
}

static bool is_read(const struct gb_lab_reading *reading, size_t column)
{
    bool read = false;
    for (int role = 0; role < GB_LAB_ROLES; role++) {
        read = read || reading->column[role].index == (int)column;
    }
    for (int k = 0; k < reading->options->keys; k++) {
        read = read || reading->key[k].index == (int)column;
    }
    return read;
}

static void add_others(const struct gb_lab_reading *reading, GString *text)
{
    size_t others = 0;
    for (size_t k = 0; k < reading->columns; k++) {
        char shown[GB_LAB_TEXT_SHOWN];
        gb_lab_text_show(gb_lab_layout_head(reading, k), shown);
        if (!is_read(reading, k)) {
            g_string_append_printf(text, *shown != '\0' ? "%s'%s'" : "%s%s%zu",
                                   others++ > 0 ? ", " : "; not read: ",
                                   *shown != '\0' ? shown : "column ", k + 1);
        }
    }
}

static bool is_guessed(const struct gb_lab_reading *reading)
{
    bool guessed = reading->separator_guessed || reading->text.guessed ||
                   reading->decimal_guessed || reading->reasons > 0 ||
                   reading->said->len > 0;
    for (int role = 0; role < GB_LAB_ROLES; role++) {
        const struct gb_lab_column *column = &reading->column[role];
        guessed = guessed || (column->index != GB_LAB_NONE && column->guessed);
    }
    return guessed;
}

void gb_lab_told_write(struct gb_lab_reading *reading)
{
    struct gb_lab_report *report = reading->report;
    if (!is_guessed(reading)) {
        return;
    }
    GString *text = g_string_new(NULL);
    add_columns(reading, text);
    add_format(reading, text);
    add_left_out(reading, text);
    add_range(reading, text);
    add_others(reading, text);
    if (text->len >= sizeof report->told) { /* the end is about columns not read */
        const char *end = g_utf8_find_prev_char(
            text->str, text->str + sizeof report->told - strlen("..."));
        g_string_truncate(text, end != NULL ? (gsize)(end - text->str) : 0);
        g_string_append(text, "...");
    }
    g_strlcpy(report->told, text->str, sizeof report->told);
    g_string_free(text, TRUE);
}
