#include "tui/session/repeat.h"

#include <glib.h>
#include <string.h>

#include "io/preset_folders.h"
#include "tui/session/overlay/previous_curve.h"

/* "p1-set2-38nm" if the preset is found by that name, otherwise its path. */
static char *name_of(const char *path)
{
    char *base = g_path_get_basename(path);
    if (g_str_has_suffix(base, ".ini")) {
        base[strlen(base) - strlen(".ini")] = '\0';
    }
    char *found = gb_preset_folders_find(base);
    char *name =
        found != NULL && strcmp(found, path) == 0 ? g_strdup(base) : g_strdup(path);
    g_free(found);
    g_free(base);
    return name;
}

/* Quotes for the shell where necessary. */
static char *quote(const char *word)
{
    for (const char *at = word; *at != '\0'; at++) {
        if (!g_ascii_isalnum(*at) && strchr("._-/=+,:%", *at) == NULL) {
            return g_shell_quote(word);
        }
    }
    return g_strdup(word);
}

static void add_word(GString *text, gsize *line, const char *word, int cols)
{
    char *quoted = quote(word);
    const gsize width = (gsize)g_utf8_strlen(quoted, -1);
    if (*line > 0 && *line + 1 + width + 2 > (gsize)cols) {
        g_string_append(text, " \\\n    ");
        *line = 4;
    } else if (*line > 0) {
        g_string_append_c(text, ' ');
        (*line)++;
    }
    g_string_append(text, quoted);
    *line += width;
    g_free(quoted);
}

static void add_values(GString *text, gsize *line, const struct gb_params *own,
                       const struct gb_params *file, int cols)
{
    size_t count = 0;
    const struct gb_field *field = gb_params_fields(&count);
    for (size_t i = 0; i < count; i++) {
        if (!gb_params_diff_same(own, file, &field[i])) {
            char value[GB_PARAMS_VALUE_MAX];
            gb_params_format(own, &field[i], value, sizeof value);
            char *word = g_strdup_printf("%s.%s=%s", field[i].group, field[i].key, value);
            add_word(text, line, word, cols);
            g_free(word);
        }
    }
}

char *gb_repeat_command(const struct gb_preset *preset, const struct gb_params *params,
                        int cols)
{
    struct gb_preset *file = NULL;
    GString *text = g_string_new(NULL);
    gsize line = 0;
    char *name = name_of(gb_preset_path(preset));
    if (!gb_preset_load(&file, *name != '\0' ? name : "default", NULL)) {
        g_free(name);
        return g_string_free(
            g_string_assign(text, "the preset file does not exist any more"), FALSE);
    }
    add_word(text, &line, "greenbody", cols);
    add_word(text, &line, "run", cols);
    add_word(text, &line, *name != '\0' ? name : "default", cols);
    add_values(text, &line, params, gb_preset_params(file), cols);
    gb_preset_destroy(file);
    g_free(name);
    return g_string_free(text, FALSE);
}
