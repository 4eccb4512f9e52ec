#include "io/export/export_series.h"

#include <inttypes.h>
#include <json-glib/json-glib.h>
#include <string.h>

#include "base/file.h"
#include "io/status/status_json.h"

char *gb_export_series_name(const char *path, int64_t index)
{
    const char *slash = strrchr(path, G_DIR_SEPARATOR);
    const char *base = slash != NULL ? slash + 1 : path;
    const char *dot = strrchr(base, '.');
    const char *end = dot != NULL && dot != base ? dot : path + strlen(path);
    return g_strdup_printf("%.*s-%04" PRId64 "%s", (int)(end - path), path, index, end);
}

char *gb_export_series_list_name(const char *path)
{
    return g_strconcat(path, ".series", NULL);
}

static void add_file(JsonBuilder *builder, const char *path, int64_t index, int64_t step)
{
    char *name = gb_export_series_name(path, index);
    char *base = g_path_get_basename(name);
    json_builder_begin_object(builder);
    json_builder_set_member_name(builder, "name");
    json_builder_add_string_value(builder, base);
    json_builder_set_member_name(builder, "time");
    json_builder_add_double_value(builder, (double)step);
    json_builder_end_object(builder);
    g_free(base);
    g_free(name);
}

bool gb_export_series_put_list(const char *path, const int64_t *steps, int64_t count,
                               struct gb_error *err)
{
    JsonBuilder *builder = json_builder_new();
    json_builder_begin_object(builder);
    json_builder_set_member_name(builder, "file-series-version");
    json_builder_add_string_value(builder, "1.0");
    json_builder_set_member_name(builder, "files");
    json_builder_begin_array(builder);
    for (int64_t k = 0; k < count; k++) {
        add_file(builder, path, k, steps[k]);
    }
    json_builder_end_array(builder);
    json_builder_end_object(builder);
    JsonNode *root = json_builder_get_root(builder);
    char *text = gb_status_json_print(root);
    char *name = gb_export_series_list_name(path);
    const bool done = gb_file_replace(name, text, strlen(text), err);
    g_free(name);
    g_free(text);
    json_node_unref(root);
    g_object_unref(builder);
    return done;
}
