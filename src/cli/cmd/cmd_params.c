#include <stdio.h>
#include <string.h>

#include "base/text/visible.h"
#include "base/units.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "io/material.h"
#include "io/preset_folders.h"

enum { CELL = 320 };

/* Rows of cells, each NULL-terminated and of one length; the first one has the titles. */
static GPtrArray *begin_table(const char *const *titles)
{
    GPtrArray *rows = g_ptr_array_new_with_free_func((GDestroyNotify)g_strfreev);
    g_ptr_array_add(rows, g_strdupv((char **)(uintptr_t)titles));
    return rows;
}

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

static GPtrArray *list_keys(void)
{
    static const char *const titles[] = {"key",     "default", "range", "unit",
                                         "meaning", "source",  NULL};
    size_t count = 0;
    const struct gb_field *field = gb_params_fields(&count);
    GPtrArray *rows = begin_table(titles);
    for (size_t i = 0; i < count; i++) {
        char **cell = g_new0(char *, G_N_ELEMENTS(titles));
        char text[CELL];
        cell[0] = g_strdup_printf("%s.%s", field[i].group, field[i].key);
        cell[1] = g_strdup(*field[i].fallback ? field[i].fallback : "-");
        cell[2] = g_strdup(gb_params_accepted(&field[i], text, sizeof text));
        write_unit(&field[i], text, sizeof text);
        cell[3] = g_strdup(text);
        cell[4] = g_strdup(field[i].meaning);
        cell[5] = g_strdup(field[i].source);
        g_ptr_array_add(rows, cell);
    }
    return rows;
}

/* Columns of materials: the name, keys, and where the values come from. */
static const char *const material_titles[] = {"material", "young",   "poisson", "density",
                                              "d0",       "epsilon", "yield",   "guessed",
                                              "file",     NULL};
enum { GUESSED = 7, MATERIAL_FILE };

/* The values of a material, and its file; of one that cannot be read, why. */
static char **describe_material(const char *name)
{
    struct gb_params params;
    struct gb_error err = {0};
    char **cell = g_new0(char *, G_N_ELEMENTS(material_titles));
    gb_params_init(&params);
    const bool good = gb_material_apply(&params, name, &err);
    cell[0] = g_strdup(name);
    for (int k = 1; k < GUESSED; k++) {
        char text[GB_PARAMS_VALUE_MAX] = "-";
        if (good) {
            gb_params_format(&params,
                             gb_params_find(GB_MATERIAL_GROUP, material_titles[k]), text,
                             sizeof text);
        }
        cell[k] = g_strdup(text);
    }
    cell[MATERIAL_FILE] = good ? gb_material_path(name, NULL) : g_strdup(err.text);
    cell[GUESSED] = good ? gb_material_guessed(cell[MATERIAL_FILE]) : g_strdup("");
    if (*cell[GUESSED] == '\0') {
        g_free(cell[GUESSED]);
        cell[GUESSED] = g_strdup("-");
    }
    return cell;
}

static GPtrArray *list_materials(void)
{
    GPtrArray *rows = begin_table(material_titles);
    char **names = gb_preset_folders_list_materials();
    for (int i = 0; names[i] != NULL; i++) {
        g_ptr_array_add(rows, describe_material(names[i]));
    }
    g_strfreev(names);
    return rows;
}

static void print_markdown(const GPtrArray *rows)
{
    for (guint i = 0; i < rows->len; i++) {
        char **cell = g_ptr_array_index(rows, i);
        gb_visible_print(stdout, i > 0 ? "| `%s` |" : "| %s |", cell[0]);
        for (int k = 1; cell[k] != NULL; k++) {
            gb_visible_print(stdout, " %s |", cell[k]);
        }
        for (int k = 0; i == 0 && cell[k] != NULL; k++) {
            gb_visible_put(stdout, k > 0 ? "---|" : "\n|---|");
        }
        gb_visible_put(stdout, "\n");
    }
}

static int width_of(const GPtrArray *rows, int column)
{
    int width = 0;
    for (guint i = 0; i < rows->len; i++) {
        char **cell = g_ptr_array_index(rows, i);
        width = MAX(width, (int)strlen(cell[column]));
    }
    return width;
}

static void print_plain(const GPtrArray *rows)
{
    const guint columns = g_strv_length(g_ptr_array_index(rows, 0));
    int *width = g_new(int, columns);
    for (guint k = 0; k < columns; k++) {
        width[k] = k + 1 < columns ? width_of(rows, (int)k) : 0;
    }
    for (guint i = 0; i < rows->len; i++) {
        char **cell = g_ptr_array_index(rows, i);
        for (guint k = 0; k < columns; k++) {
            gb_visible_print(stdout, "%-*s%s", width[k], cell[k],
                             k + 1 < columns ? "  " : "\n");
        }
    }
    g_free(width);
}

int gb_cmd_params(int argc, char **argv)
{
    gboolean markdown = FALSE, materials = FALSE;
    const GOptionEntry entries[] = {
        {"materials", 0, 0, G_OPTION_ARG_NONE, &materials,
         "the materials that material=NAME takes, with their files, instead of the keys",
         NULL},
        {"markdown", 0, 0, G_OPTION_ARG_NONE, &markdown, "a Markdown table", NULL},
        {0},
    };
    static const struct gb_options_page page = {
        .usage = "",
        .summary =
            "Every preset key: default, range, unit, meaning, source.\n"
            "Keys are written under [group] in a preset, or as group.key=value on the\n"
            "command line; material=NAME sets all keys of [material].",
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
    GPtrArray *rows = materials ? list_materials() : list_keys();
    if (markdown) {
        print_markdown(rows);
    } else {
        print_plain(rows);
    }
    g_ptr_array_unref(rows);
    return 0;
}
