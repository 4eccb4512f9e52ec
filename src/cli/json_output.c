#include "cli/json_output.h"

#include <json-glib/json-glib.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "base/text/visible.h"
#include "io/status/status_json.h"

static void print_node(JsonNode *root)
{
    char *text = gb_status_json_print(root);
    gb_visible_print(stdout, "%s\n", text);
    g_free(text);
}

static bool is_number(const char *cell)
{
    char *end = NULL;
    (void)g_ascii_strtod(cell, &end);
    return *end == '\0';
}

/* The rows of a table, split; NULL behind the last. */
static char ***split_rows(const char *csv)
{
    char **lines = g_strsplit(csv, "\n", -1);
    GPtrArray *rows = g_ptr_array_new();
    for (char **line = lines; *line != NULL; line++) {
        if (**line != '#' && **line != '\0') {
            g_ptr_array_add(rows, g_strsplit(*line, ",", -1));
        }
    }
    g_ptr_array_add(rows, NULL);
    g_strfreev(lines);
    return (char ***)g_ptr_array_free(rows, FALSE);
}

/* A column is of numbers where all of its cells are; units are texts, also "1". */
static bool is_column_of_numbers(char ***rows, guint column)
{
    bool numbers = strcmp(rows[0][column], "unit") != 0;
    for (char ***row = rows + 1; *row != NULL && numbers; row++) {
        numbers = g_strv_length(*row) <= column || is_number((*row)[column]);
    }
    return numbers;
}

static void add_cell(JsonBuilder *json, const char *cell, bool number)
{
    if (*cell == '\0') {
        json_builder_add_null_value(json);
    } else if (number) {
        json_builder_add_double_value(json, g_ascii_strtod(cell, NULL));
    } else {
        json_builder_add_string_value(json, cell);
    }
}

static void add_rows(JsonBuilder *json, char ***rows)
{
    const guint columns = rows[0] != NULL ? g_strv_length(rows[0]) : 0;
    bool *numbers = g_new0(bool, columns + 1);
    for (guint k = 0; k < columns; k++) {
        numbers[k] = is_column_of_numbers(rows, k);
    }
    for (char ***row = rows + 1; columns > 0 && *row != NULL; row++) {
        json_builder_begin_object(json);
        for (guint k = 0; k < columns && (*row)[k] != NULL; k++) {
            json_builder_set_member_name(json, rows[0][k]);
            add_cell(json, (*row)[k], numbers[k]);
        }
        json_builder_end_object(json);
    }
    g_free(numbers);
}

JsonBuilder *gb_json_output_begin(const char *name)
{
    JsonBuilder *json = json_builder_new();
    json_builder_begin_object(json);
    json_builder_set_member_name(json, name);
    json_builder_begin_array(json);
    return json;
}

void gb_json_output_end(JsonBuilder *json)
{
    json_builder_end_array(json);
    json_builder_end_object(json);
    JsonNode *root = json_builder_get_root(json);
    print_node(root);
    json_node_unref(root);
    g_object_unref(json);
}

void gb_json_output_table(const char *csv)
{
    char ***rows = split_rows(csv);
    JsonBuilder *json = gb_json_output_begin("rows");
    add_rows(json, rows);
    gb_json_output_end(json);
    for (char ***row = rows; *row != NULL; row++) {
        g_strfreev(*row);
    }
    g_free(rows);
}

void gb_json_output_run(const struct gb_run_loop *loop)
{
    const char *directory = gb_store_directory(gb_run_recorder_store(loop->recorder));
    char *text =
        gb_status_json_text(&loop->snapshot, gb_run_recorder_points(loop->recorder));
    char *name = g_utf8_make_valid(directory, -1);
    JsonNode *root = json_from_string(text, NULL);
    json_object_set_string_member(json_node_get_object(root), "directory", name);
    print_node(root);
    json_node_unref(root);
    g_free(name);
    g_free(text);
}
