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
