#include "tui/session/params_diff.h"

#include <glib.h>
#include <string.h>

#include "io/preset.h"
#include "io/preset_folders.h"
#include "tui/session/previous.h"
#include "tui/term/paint.h"

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

char *gb_params_diff_command(const struct gb_preset *preset,
                             const struct gb_params *params, int cols)
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

bool gb_params_diff_same(const struct gb_params *a, const struct gb_params *b,
                         const struct gb_field *field)
{
    char one[GB_PARAMS_VALUE_MAX];
    char other[GB_PARAMS_VALUE_MAX];
    gb_params_format(a, field, one, sizeof one);
    gb_params_format(b, field, other, sizeof other);
    return strcmp(one, other) == 0;
}

static bool is_title(const struct gb_field *field)
{
    return strcmp(field->key, "title") == 0;
}

int gb_params_diff_count(const struct gb_params *a, const struct gb_params *b)
{
    size_t count = 0;
    int differences = 0;
    const struct gb_field *field = gb_params_fields(&count);
    for (size_t i = 0; i < count; i++) {
        differences += !is_title(&field[i]) && !gb_params_diff_same(a, b, &field[i]);
    }
    return differences;
}

char *gb_params_diff_describe(const struct gb_params *own, const struct gb_params *other,
                              char *text, size_t size)
{
    size_t count = 0;
    const struct gb_field *field = gb_params_fields(&count);
    GString *all = g_string_new(NULL);
    for (size_t i = 0; i < count; i++) {
        if (!is_title(&field[i]) && !gb_params_diff_same(own, other, &field[i])) {
            char value[GB_PARAMS_VALUE_MAX];
            gb_params_format(own, &field[i], value, sizeof value);
            const bool none = value[0] == '\0';
            g_string_append_printf(all, "%s%s%s%s%s", all->len > 0 ? ", " : "",
                                   none ? "no " : "", field[i].key, none ? "" : " ",
                                   value);
        }
    }
    gb_paint_fit_copy(text, size, all->len > 0 ? all->str : "same parameters");
    g_string_free(all, TRUE);
    return text;
}
