#include "figures/provenance.h"

#include <glib.h>

static char *read_preset(const char *folder)
{
    char *text = NULL;
    char *file = g_build_filename(folder, "preset.ini", NULL);
    if (!g_file_get_contents(file, &text, NULL, NULL) ||
        !g_utf8_validate(text, -1, NULL)) {
        g_free(text);
        text = NULL;
    }
    g_free(file);
    return text;
}

char *gb_provenance_preset(const char *path)
{
    if (g_file_test(path, G_FILE_TEST_IS_DIR)) {
        return read_preset(path);
    }
    char *folder = g_path_get_dirname(path);
    char *parent = g_path_get_dirname(folder);
    char *text = read_preset(folder);
    if (text == NULL) {
        text = read_preset(parent);
    }
    g_free(parent);
    g_free(folder);
    return text;
}
