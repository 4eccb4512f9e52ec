#include "io/preset_folders.h"

#include <stdlib.h>
#include <string.h>

#include <glib.h>

/* A program run from its build folder finds what belongs to it in its source tree. */
static void add_source_tree(GPtrArray *list, const char *name)
{
    char *program = g_file_read_link("/proc/self/exe", NULL);
    char *folder = program ? g_path_get_dirname(program) : NULL;
    for (int up = 0; folder && up < 3; up++) {
        char *parent = g_path_get_dirname(folder);
        g_ptr_array_add(list, g_build_filename(parent, name, NULL));
        g_free(folder);
        folder = parent;
    }
    g_free(folder);
    g_free(program);
}

/* Folders that hold presets, first match wins; NULL-terminated, g_strfreev. */
static char **folders(void)
{
    GPtrArray *list = g_ptr_array_new();
    g_ptr_array_add(
        list, g_build_filename(g_get_user_config_dir(), "greenbody", "presets", NULL));
    const char *given = g_getenv("GB_PRESET_DIR");
    if (given && *given) {
        g_ptr_array_add(list, g_strdup(given));
    }
    g_ptr_array_add(list, g_strdup(GB_PRESET_INSTALL_DIR));
    add_source_tree(list, "presets");
    g_ptr_array_add(list, NULL);
    return (char **)g_ptr_array_free(list, FALSE);
}

static char *find_in(const char *folder, const char *name)
{
    static const char *const endings[] = {"", ".ini"};
    for (size_t i = 0; i < G_N_ELEMENTS(endings); i++) {
        char *file = g_strconcat(name, endings[i], NULL);
        char *path = g_build_filename(folder, file, NULL);
        g_free(file);
        if (g_file_test(path, G_FILE_TEST_IS_REGULAR)) {
            return path;
        }
        g_free(path);
    }
    return NULL;
}

char *gb_preset_folders_find(const char *name)
{
    if (*name == '\0' || strchr(name, '/')) {
        return NULL;
    }
    char **list = folders();
    char *path = NULL;
    for (int i = 0; list[i] && !path; i++) {
        path = find_in(list[i], name);
    }
    g_strfreev(list);
    return path;
}

char *gb_preset_folders_find_data(const char *file)
{
    GPtrArray *list = g_ptr_array_new_with_free_func(g_free);
    char *path = NULL;
    const char *given = g_getenv("GB_DATA_DIR");
    if (given != NULL && *given != '\0') {
        g_ptr_array_add(list, g_strdup(given));
    }
    g_ptr_array_add(list, g_strdup(GB_DATA_INSTALL_DIR));
    add_source_tree(list, "assets/data");
    for (guint i = 0; i < list->len && path == NULL; i++) {
        path = find_in(g_ptr_array_index(list, i), file);
    }
    g_ptr_array_unref(list);
    return path;
}

static int compare_names(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

static void list_folder(const char *folder, GHashTable *names)
{
    GDir *dir = g_dir_open(folder, 0, NULL);
    if (!dir) {
        return;
    }
    for (const char *file = g_dir_read_name(dir); file; file = g_dir_read_name(dir)) {
        if (g_str_has_suffix(file, ".ini")) {
            g_hash_table_add(names, g_strndup(file, strlen(file) - strlen(".ini")));
        }
    }
    g_dir_close(dir);
}

char **gb_preset_folders_list(void)
{
    GHashTable *names = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);
    char **list = folders();
    for (int i = 0; list[i]; i++) {
        list_folder(list[i], names);
    }
    g_strfreev(list);
    guint count = 0;
    char **found = (char **)g_hash_table_get_keys_as_array(names, &count);
    g_hash_table_steal_all(names); /* they are the caller's now */
    g_hash_table_destroy(names);
    qsort(found, count, sizeof *found, compare_names);
    return found;
}
