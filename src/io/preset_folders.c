#include "io/preset_folders.h"

#include <stdlib.h>
#include <string.h>

#include <glib.h>

#include "base/program.h"

/* Files of the program (presets, data, ...) are searched by name in several folders, in
 * this order. */
enum { ABOVE = 3 };

/* Folder of materials in a folder of presets. */
static const char materials[] = "materials";

static void add_once(GPtrArray *list, char *folder)
{
    if (g_ptr_array_find_with_equal_func(list, folder, g_str_equal, NULL)) {
        g_free(folder);
    } else {
        g_ptr_array_add(list, folder);
    }
}

/* Adds share/greenbody/NAME of the prefix in which the program is, even if it was
 * moved. */
static void add_prefix(GPtrArray *list, const char *program, const char *name)
{
    char *prefix = g_path_get_dirname(program);
    add_once(list, g_build_filename(prefix, "share", "greenbody", name, NULL));
    g_free(prefix);
}

/* For a program in its build folder: adds the folder in the source tree, or the link
 * that meson leaves in a build folder elsewhere. */
static void add_source_tree(GPtrArray *list, const char *program, const char *name)
{
    char *folder = g_strdup(program);
    for (int up = 0; up < ABOVE; up++) {
        char *parent = g_path_get_dirname(folder);
        char *here = g_build_filename(parent, name, NULL);
        if (g_file_test(here, G_FILE_TEST_IS_DIR)) {
            add_once(list, here);
        } else {
            g_free(here);
        }
        g_free(folder);
        folder = parent;
    }
    g_free(folder);
}

/* The same for the prefix in which the library is: PREFIX/lib or a folder in it. */
static void add_library(GPtrArray *list, const char *library, const char *name)
{
    char *folder = g_strdup(library);
    for (int up = 0; up < ABOVE - 1; up++) {
        char *parent = g_path_get_dirname(folder);
        char *here = g_build_filename(parent, "share", "greenbody", name, NULL);
        if (g_file_test(here, G_FILE_TEST_IS_DIR)) {
            add_once(list, here);
        } else {
            g_free(here);
        }
        g_free(folder);
        folder = parent;
    }
    g_free(folder);
}

/* The folders searched for share/greenbody/NAME.  `given`: value of an environment
 * variable, or NULL. */
static void add_shipped(GPtrArray *list, const char *given, const char *name,
                        const char *installed, const char *in_tree)
{
    char *program = gb_program_folder();
    char *library = gb_program_library_folder();
    if (given != NULL && *given != '\0') {
        add_once(list, g_strdup(given));
    }
    if (program != NULL) {
        add_prefix(list, program, name);
        add_source_tree(list, program, in_tree);
    }
    if (library != NULL) {
        add_library(list, library, name);
    }
    add_once(list, g_strdup(installed));
    g_free(library);
    g_free(program);
}

char **gb_preset_folders(void)
{
    GPtrArray *list = g_ptr_array_new();
    add_once(list,
             g_build_filename(g_get_user_config_dir(), "greenbody", "presets", NULL));
    add_shipped(list, g_getenv("GB_PRESET_DIR"), "presets", GB_PRESET_INSTALL_DIR,
                "presets");
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

/* `part` of each preset folder: the folder itself (NULL), or a folder in it. */
static char **folders_of(const char *part)
{
    char **list = gb_preset_folders();
    for (int i = 0; list[i] != NULL && part != NULL; i++) {
        char *folder = g_build_filename(list[i], part, NULL);
        g_free(list[i]);
        list[i] = folder;
    }
    return list;
}

static char *find_named(const char *part, const char *name)
{
    if (*name == '\0' || strchr(name, '/')) {
        return NULL;
    }
    char **list = folders_of(part);
    char *path = NULL;
    for (int i = 0; list[i] && !path; i++) {
        path = find_in(list[i], name);
    }
    g_strfreev(list);
    return path;
}

char *gb_preset_folders_find(const char *name)
{
    return find_named(NULL, name);
}

char *gb_preset_folders_find_material(const char *name)
{
    return find_named(materials, name);
}

char *gb_preset_folders_find_data(const char *file)
{
    GPtrArray *list = g_ptr_array_new_with_free_func(g_free);
    char *path = NULL;
    add_shipped(list, g_getenv("GB_DATA_DIR"), "data", GB_DATA_INSTALL_DIR,
                "assets/data");
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

static char **list_named(const char *part)
{
    GHashTable *names = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);
    char **list = folders_of(part);
    for (int i = 0; list[i]; i++) {
        list_folder(list[i], names);
    }
    g_strfreev(list);
    guint count = 0;
    char **found = (char **)g_hash_table_get_keys_as_array(names, &count);
    g_hash_table_steal_all(names); /* the caller owns them now */
    g_hash_table_destroy(names);
    qsort(found, count, sizeof *found, compare_names);
    return found;
}

char **gb_preset_folders_list(void)
{
    return list_named(NULL);
}

char **gb_preset_folders_list_materials(void)
{
    return list_named(materials);
}
