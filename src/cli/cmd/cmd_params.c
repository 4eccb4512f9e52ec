#include <stdio.h>
#include <string.h>

#include "base/text/visible.h"
#include "base/units.h"
#include "cli/commands.h"
#include "cli/options.h"

enum { COLUMNS = 6, CELL = 320 };

static const char *const titles[COLUMNS] = {"key",  "default", "range",
                                            "unit", "meaning", "source"};

static void write_unit(const struct gb_field *field, char *out, size_t size)
{
    const char *units = gb_units_accepted((enum gb_dimension)field->dimension);
    if (field->type == GB_FIELD_RELATIVE) {
        snprintf(out, size, "%s, or %s", field->relative, units);
    } else if (field->dimension == GB_DIM_NONE) {
        g_strlcpy(out, "-", size);
    } else {
        g_strlcpy(out, units, size);
    }
}

static void write_row(const struct gb_field *field, char cells[COLUMNS][CELL])
{
    snprintf(cells[0], CELL, "%s.%s", field->group, field->key);
    g_strlcpy(cells[1], *field->fallback ? field->fallback : "-", CELL);
    gb_params_accepted(field, cells[2], CELL);
    write_unit(field, cells[3], CELL);
    g_strlcpy(cells[4], field->meaning, CELL);
    g_strlcpy(cells[5], field->source, CELL);
}

static void print_markdown(const struct gb_field *fields, size_t count)
{
    gb_visible_put(
        stdout,
        "| key | default | range | unit | meaning | source |\n|---|---|---|---|---|---|\n");
    for (size_t i = 0; i < count; i++) {
        char cells[COLUMNS][CELL];
        write_row(&fields[i], cells);
        gb_visible_print(stdout, "| `%s` | %s | %s | %s | %s | %s |\n", cells[0],
                         cells[1], cells[2], cells[3], cells[4], cells[5]);
    }
}

static void print_line(char cells[COLUMNS][CELL], const int width[COLUMNS])
{
    for (int k = 0; k < COLUMNS - 1; k++) {
        gb_visible_print(stdout, "%-*s  ", width[k], cells[k]);
    }
    gb_visible_print(stdout, "%s\n", cells[COLUMNS - 1]);
}

static void print_plain(const struct gb_field *fields, size_t count)
{
    char cells[COLUMNS][CELL];
    int width[COLUMNS];
    for (int k = 0; k < COLUMNS; k++) {
        width[k] = (int)strlen(titles[k]);
    }
    for (size_t i = 0; i < count; i++) {
        write_row(&fields[i], cells);
        for (int k = 0; k < COLUMNS; k++) {
            width[k] = MAX(width[k], (int)strlen(cells[k]));
        }
    }
    for (int k = 0; k < COLUMNS; k++) {
        g_strlcpy(cells[k], titles[k], CELL);
    }
    print_line(cells, width);
    for (size_t i = 0; i < count; i++) {
        write_row(&fields[i], cells);
        print_line(cells, width);
    }
}

int gb_cmd_params(int argc, char **argv)
{
    gboolean markdown = FALSE;
    const GOptionEntry entries[] = {
        {"markdown", 0, 0, G_OPTION_ARG_NONE, &markdown, "a Markdown table", NULL},
        {0},
    };
    static const struct gb_options_page page = {
        .usage = "",
        .summary =
            "Every preset key: default, range, unit, meaning, source.\n"
            "Keys are written under [group] in a preset, or as group.key=value on the\n"
            "command line.",
    };
    char **words = NULL;
    int status = 0;
    if (!gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        return status;
    }
    struct gb_error err = {0};
    if (words[0]) {
        gb_error_set(&err, GB_ERR_INPUT, "%.80s: params takes no words", words[0]);
        g_strfreev(words);
        return gb_options_fail(&err);
    }
    g_strfreev(words);
    size_t count = 0;
    const struct gb_field *fields = gb_params_fields(&count);
    if (markdown) {
        print_markdown(fields, count);
    } else {
        print_plain(fields, count);
    }
    return 0;
}
