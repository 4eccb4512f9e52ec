#include "figures/provenance.h"

#include <glib.h>

static char *read_in(const char *folder)
{
    char *text = NULL;
    char *path = g_build_filename(folder, "preset.ini", NULL);
    if (!g_file_get_contents(path, &text, NULL, NULL) ||
        !g_utf8_validate(text, -1, NULL)) {
        g_free(text);
        text = NULL;
    }
    g_free(path);
    return text;
}

char *gb_provenance_preset(const char *place)
{
    if (g_file_test(place, G_FILE_TEST_IS_DIR)) {
        return read_in(place);
    }
    char *folder = g_path_get_dirname(place);
    char *parent = g_path_get_dirname(folder);
    char *text = read_in(folder);
    if (text == NULL) {
        text = read_in(parent);
    }
    g_free(parent);
    g_free(folder);
    return text;
}
