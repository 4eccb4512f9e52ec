#include "tui/term/settings.h"

#include <glib.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "base/file.h"

enum { BYTES_MAX = 1 << 20 };

static const char *const when[] = {"auto", "always", "never", NULL};
static const char *const themes[] = {"auto", "light", "dark", "contrast", NULL};
static const char *const graphs[] = {"auto", "braille", "block", "ascii", NULL};
static const char *const images[] = {"auto", "none", "sixel", "kitty", NULL};
static const char *const clipboards[] = {"auto", "osc52", "tmux", "screen", "off", NULL};
static const char *const on_off[] = {"on", "off", NULL};
static const char *const off_on[] = {"off", "on", NULL};

static const struct gb_settings_row table[] = {
    {"color", when, "colours; auto: unless NO_COLOR is set",
     offsetof(struct gb_settings, colour)},
    {"theme", themes,
     "for a light or a dark background of the terminal; contrast: white on black",
     offsetof(struct gb_settings, theme)},
    {"graph", graphs, "how plots are drawn; auto: braille where the font has it",
     offsetof(struct gb_settings, graph)},
    {"images", images, "the packing in real pixels; auto: where the terminal can",
     offsetof(struct gb_settings, images)},
    {"clipboard", clipboards, "how y copies: by OSC 52, through tmux or screen, or not",
     offsetof(struct gb_settings, clipboard)},
    {"mouse", on_off, "clicks and the wheel; M switches it, Shift selects text",
     offsetof(struct gb_settings, mouse)},
    {"ascii", off_on, "nothing but ASCII", offsetof(struct gb_settings, ascii)},
    {"slow", off_on, "two frames a second instead of ten",
     offsetof(struct gb_settings, slow)},
};

const struct gb_settings_row *gb_settings_table(size_t *count)
{
    *count = G_N_ELEMENTS(table);
    return table;
}

void gb_settings_init(struct gb_settings *settings)
{
    memset(settings, 0,
           sizeof *settings); /* the first value of each row is the default */
}

static int *at(struct gb_settings *settings, const struct gb_settings_row *row)
{
    return (int *)(void *)((char *)settings + row->offset);
}

static const struct gb_settings_row *find(const char *name)
{
    for (size_t i = 0; i < G_N_ELEMENTS(table); i++) {
        if (strcmp(table[i].name, name) == 0) {
            return &table[i];
        }
    }
    return NULL;
}

bool gb_settings_set(struct gb_settings *settings, const char *name, const char *value,
                     struct gb_error *err)
{
    const struct gb_settings_row *row = find(name);
    if (row == NULL) {
        return gb_error_set(err, GB_ERR_INPUT, "%.40s: no such setting", name);
    }
    for (int i = 0; row->values[i] != NULL; i++) {
        if (strcmp(row->values[i], value) == 0) {
            *at(settings, row) = i;
            return true;
        }
    }
    char *accepted = g_strjoinv(", ", (char **)row->values);
    gb_error_set(err, GB_ERR_INPUT, "%s = %.40s: expected: %s", name, value, accepted);
    g_free(accepted);
    return false;
}

const char *gb_settings_word(const struct gb_settings *settings, const char *name)
{
    const struct gb_settings_row *row = find(name);
    return row->values[*at((struct gb_settings *)settings, row)];
}

/* Takes the values of the group [screen]. */
static bool take_all(struct gb_settings *settings, GKeyFile *file, const char *path,
                     struct gb_error *err)
{
    bool good = true;
    for (size_t i = 0; i < G_N_ELEMENTS(table) && good; i++) {
        char *value = g_key_file_get_string(file, "screen", table[i].name, NULL);
        struct gb_error wrong = {0};
        if (value != NULL &&
            !gb_settings_set(settings, table[i].name, g_strstrip(value), &wrong)) {
            good = gb_error_set(err, GB_ERR_INPUT, "%s: %s", path, wrong.text);
        }
        g_free(value);
    }
    return good;
}

/* Reads the key file; empty if it does not exist.  NULL: it cannot be read. */
static GKeyFile *load(const char *path, struct gb_error *err)
{
    char *text = NULL;
    size_t length = 0;
    GError *error = NULL;
    GKeyFile *file = g_key_file_new();
    if (!g_file_test(path, G_FILE_TEST_EXISTS)) {
        return file;
    }
    bool good = gb_file_read(path, BYTES_MAX, &text, &length, err);
    if (good && !g_key_file_load_from_data(file, text, length, G_KEY_FILE_KEEP_COMMENTS,
                                           &error)) {
        good = gb_error_set(err, GB_ERR_INPUT, "%s: %s", path, error->message);
    }
    g_clear_error(&error);
    gb_alloc_free(text);
    if (!good) {
        g_key_file_free(file);
        return NULL;
    }
    return file;
}

bool gb_settings_read(struct gb_settings *settings, const char *path,
                      struct gb_error *err)
{
    if (!g_file_test(path, G_FILE_TEST_EXISTS)) {
        return true;
    }
    GKeyFile *file = load(path, err);
    const bool good = file != NULL && take_all(settings, file, path, err);
    if (file != NULL) {
        g_key_file_free(file);
    }
    return good;
}

bool gb_settings_remember(const char *path, const char *name, const char *value,
                          struct gb_error *err)
{
    GKeyFile *file = load(path, err);
    if (file == NULL) {
        return false;
    }
    g_key_file_set_string(file, "screen", name, value);
    gsize length = 0;
    char *text = g_key_file_to_data(file, &length, NULL);
    char *folder = g_path_get_dirname(path);
    g_mkdir_with_parents(folder, 0777);
    const bool written = gb_file_replace(path, text, length, err);
    g_free(folder);
    g_free(text);
    g_key_file_free(file);
    return written;
}

char *gb_settings_path(void)
{
    return g_build_filename(g_get_user_config_dir(), "greenbody", "screen.ini", NULL);
}
