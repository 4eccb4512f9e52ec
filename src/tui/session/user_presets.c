#include "tui/session/user_presets.h"

#include <glib.h>
#include <string.h>

char *gb_user_presets_suggest(const struct gb_preset *preset)
{
    const char *path = gb_preset_path(preset);
    char *base = g_path_get_basename(*path != '\0' ? path : "preset.ini");
    if (g_str_has_suffix(base, ".ini")) {
        base[strlen(base) - strlen(".ini")] = '\0';
    }
    const bool own = g_str_has_prefix(path, g_get_user_config_dir());
    char *name = g_strdup_printf("%s%s", own ? "" : "my-", base);
    g_free(base);
    return name;
}

char *gb_user_presets_file(const char *name, struct gb_error *err)
{
    if (strchr(name, '/') != NULL) {
        return g_strdup(name);
    }
    if (*name == '\0' || *name == '.' || *name == '-') {
        gb_error_set(err, GB_ERR_INPUT,
                     "a name is needed that does not begin with '.' or '-'");
        return NULL;
    }
    char *folder =
        g_build_filename(g_get_user_config_dir(), "greenbody", "presets", NULL);
    char *file = g_strconcat(name, g_str_has_suffix(name, ".ini") ? "" : ".ini", NULL);
    char *path = g_build_filename(folder, file, NULL);
    g_mkdir_with_parents(folder, 0700);
    g_free(file);
    g_free(folder);
    return path;
}
