#include "figures/provenance.h"

#include <glib.h>

#include "base/alloc.h"
#include "base/read_file.h"

enum { BYTES_MAX = 1 << 24 };

static char *read_preset(const char *folder)
{
    char *text = NULL;
    size_t length = 0;
    char *file = g_build_filename(folder, "preset.ini", NULL);
    const bool good = gb_read_file(file, BYTES_MAX, &text, &length, NULL) &&
                      g_utf8_validate(text, -1, NULL);
    char *copy = good ? g_strdup(text) : NULL;
    gb_alloc_free(text);
    g_free(file);
    return copy;
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
