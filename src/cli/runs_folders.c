#include "cli/runs_folders.h"

#include <stdbool.h>
#include <stdlib.h>

#include "io/runs/run_list.h"
#include "tui/session/run_lifecycle.h"

static const char working[] = "runs";

/* Names are unique: those of the workbench are the part below its folder. */
enum names { NAMES_BELOW, NAMES_WHOLE };

static void add(GPtrArray *list, const char *folder, enum names names)
{
    const guint before = list->len;
    gb_run_list_add(list, folder);
    for (guint i = before; i < list->len && names == NAMES_WHOLE; i++) {
        struct gb_run_list_item *item = g_ptr_array_index(list, i);
        g_free(item->name);
        item->name = g_strdup(item->directory);
    }
}

GPtrArray *gb_runs_folders_list(char **folders)
{
    GPtrArray *list = gb_run_list_new();
    GHashTable *seen = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);
    const bool one = folders != NULL && folders[0] != NULL && folders[1] == NULL;
    for (int i = 0; folders != NULL && folders[i] != NULL; i++) {
        add(list, folders[i], one ? NAMES_BELOW : NAMES_WHOLE);
    }
    if (folders == NULL || folders[0] == NULL) {
        char *folder = gb_run_lifecycle_folder();
        add(list, folder, NAMES_BELOW);
        add(list, working, NAMES_WHOLE);
        g_free(folder);
    }
    for (guint i = 0; i < list->len;) {
        const struct gb_run_list_item *item = g_ptr_array_index(list, i);
        char *real = realpath(item->directory, NULL);
        if (g_hash_table_add(seen, g_strdup(real ? real : item->directory))) {
            i++;
        } else { /* below two of the folders */
            g_ptr_array_remove_index(list, i);
        }
        free(real);
    }
    g_hash_table_destroy(seen);
    gb_run_list_sort(list);
    return list;
}

GPtrArray *gb_runs_folders_live(void)
{
    GPtrArray *list = gb_runs_folders_list(NULL);
    for (guint i = list->len; i > 0; i--) {
        const struct gb_run_list_item *item = g_ptr_array_index(list, i - 1);
        if (item->engine == GB_RUN_LIST_NONE) {
            g_ptr_array_remove_index(list, i - 1);
        }
    }
    return list;
}

char *gb_runs_folders_find(const char *name)
{
    char *folder = gb_run_lifecycle_folder();
    char *below = g_build_filename(folder, name, NULL);
    const bool is_below = !g_file_test(name, G_FILE_TEST_EXISTS) && name[0] != '\0' &&
                          g_file_test(below, G_FILE_TEST_IS_DIR);
    g_free(folder);
    if (is_below) {
        return below;
    }
    g_free(below);
    return g_strdup(name);
}

char *gb_runs_folders_text(void)
{
    char *folder = gb_run_lifecycle_folder();
    char *text = g_strdup_printf("%s and ./%s", folder, working);
    g_free(folder);
    return text;
}
