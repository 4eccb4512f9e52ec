#include "cli/complete/candidates.h"

#include <stdio.h>
#include <string.h>

#include "base/text/visible.h"
#include "io/preset_folders.h"

/* A description takes one line of the list. */
enum { DOC = 90 };

void gb_candidates_add_any(const struct gb_candidates *to, const char *candidate,
                           const char *doc)
{
    char *shown = gb_visible_text(candidate, "");
    if (strcmp(shown, candidate) == 0) { /* an escape would complete another word */
        gb_visible_print(stdout, "%s%s\t%.*s\n", to->before, candidate,
                         doc != NULL ? MIN((int)strcspn(doc, "\n"), DOC) : 0,
                         doc != NULL ? doc : "");
    }
    g_free(shown);
}

void gb_candidates_add(const struct gb_candidates *to, const char *candidate,
                       const char *doc)
{
    if (g_str_has_prefix(candidate, to->prefix)) {
        gb_candidates_add_any(to, candidate, doc);
    }
}

void gb_candidates_presets(const struct gb_candidates *to)
{
    char **names = gb_preset_folders_list();
    for (int i = 0; names[i] != NULL; i++) {
        gb_candidates_add(to, names[i], "preset");
    }
    g_strfreev(names);
}

/* The folder that a typed path is in, to be opened: "" is the working folder, a leading "~/"
 * the user's. */
static char *folder_of(const char *typed, size_t length)
{
    char *folder = g_strndup(typed, length);
    if (g_str_has_prefix(folder, "~/")) {
        char *home = g_build_filename(g_get_home_dir(), folder + 2, NULL);
        g_free(folder);
        return home;
    }
    return folder;
}

static bool has_ending(const char *name, const char *const *endings)
{
    bool found = endings == NULL;
    for (int i = 0; !found && endings[i] != NULL; i++) {
        found = g_str_has_suffix(name, endings[i]);
    }
    return found;
}

/* Of one run, or of many. */
static bool is_run(const char *folder)
{
    static const char *const signs[] = {"preset.ini", "sweep.csv", "calibration.csv"};
    bool found = false;
    for (size_t i = 0; i < G_N_ELEMENTS(signs) && !found; i++) {
        char *sign = g_build_filename(folder, signs[i], NULL);
        found = g_file_test(sign, G_FILE_TEST_EXISTS);
        g_free(sign);
    }
    return found;
}

static void add_path(const struct gb_candidates *to, enum gb_candidates_path kind,
                     const char *const *endings, const char *path, const char *shown)
{
    const bool folder = g_file_test(path, G_FILE_TEST_IS_DIR);
    char *below = g_strconcat(shown, "/", NULL);
    if (folder && kind == GB_CANDIDATES_RUN && is_run(path)) {
        gb_candidates_add(to, shown, "run");
    } else if (folder) {
        gb_candidates_add(to, below, "folder");
    } else if (kind == GB_CANDIDATES_FILE && has_ending(shown, endings)) {
        gb_candidates_add(to, shown, "file");
    }
    g_free(below);
}

static int by_name(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

void gb_candidates_paths(const struct gb_candidates *to, enum gb_candidates_path kind,
                         const char *const *endings)
{
    const char *slash = strrchr(to->prefix, '/');
    const size_t length = slash != NULL ? (size_t)(slash - to->prefix) + 1 : 0;
    const bool hidden = to->prefix[length] == '.';
    char *folder = folder_of(to->prefix, length);
    GDir *dir = g_dir_open(*folder != '\0' ? folder : ".", 0, NULL);
    GPtrArray *names = g_ptr_array_new_with_free_func(g_free);
    for (const char *name = dir != NULL ? g_dir_read_name(dir) : NULL; name != NULL;
         name = g_dir_read_name(dir)) {
        if ((name[0] == '.') == hidden) {
            g_ptr_array_add(names, g_strdup(name));
        }
    }
    if (dir != NULL) {
        g_dir_close(dir);
    }
    /* a folder lists its files in an order of its own, which differs between disks */
    g_ptr_array_sort(names, by_name);
    for (guint i = 0; i < names->len; i++) {
        const char *name = g_ptr_array_index(names, i);
        char *path = g_build_filename(folder, name, NULL);
        char *shown = g_strdup_printf("%.*s%s", (int)length, to->prefix, name);
        add_path(to, kind, endings, path, shown);
        g_free(shown);
        g_free(path);
    }
    g_ptr_array_unref(names);
    g_free(folder);
}
