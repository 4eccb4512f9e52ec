#include "tui/panel/complete.h"

#include <glib.h>
#include <string.h>

char *gb_complete_home(const char *path)
{
    return g_str_has_prefix(path, "~/")
               ? g_build_filename(g_get_home_dir(), path + 2, NULL)
               : g_strdup(path);
}

/* Truncates a to the common prefix with b, at a whole character. */
static void cut_to_common(GString *a, const char *b)
{
    gsize n = 0;
    while (n < a->len && a->str[n] == b[n]) {
        n++;
    }
    while (n > 0 && (a->str[n] & 0xc0) == 0x80) {
        n--;
    }
    g_string_truncate(a, n);
}

/* Common prefix of the names in a folder that begin with `begun`; NULL: none. */
static GString *common_name(const char *folder, const char *begun, int *count)
{
    GString *common = NULL;
    GDir *dir = g_dir_open(folder, 0, NULL);
    const char *name = NULL;
    *count = 0;
    while (dir != NULL && (name = g_dir_read_name(dir)) != NULL) {
        if (!g_str_has_prefix(name, begun) || (*begun == '\0' && *name == '.')) {
            continue;
        }
        (*count)++;
        if (common == NULL) {
            common = g_string_new(name);
        } else {
            cut_to_common(common, name);
        }
    }
    if (dir != NULL) {
        g_dir_close(dir);
    }
    return common;
}

char *gb_complete_path(const char *path, int *count)
{
    int found = 0;
    char *real = gb_complete_home(path);
    const char *slash = strrchr(real, '/');
    char *folder = slash == NULL   ? g_strdup(".")
                   : slash == real ? g_strdup("/")
                                   : g_strndup(real, (gsize)(slash - real));
    GString *name = common_name(folder, slash == NULL ? real : slash + 1, &found);
    char *done = NULL;
    if (name == NULL) {
        done = g_strdup(path);
    } else {
        char *head = g_strndup(real, slash == NULL ? 0 : (gsize)(slash - real + 1));
        done = g_strconcat(head, name->str, NULL);
        if (found == 1 && g_file_test(done, G_FILE_TEST_IS_DIR)) {
            char *with_slash = g_strconcat(done, "/", NULL);
            g_free(done);
            done = with_slash;
        }
        g_free(head);
        g_string_free(name, TRUE);
    }
    if (count != NULL) {
        *count = found;
    }
    g_free(folder);
    g_free(real);
    return done;
}
