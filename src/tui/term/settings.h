#ifndef GB_TUI_TERM_SETTINGS_H
#define GB_TUI_TERM_SETTINGS_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"

/* Settings of the terminal that override detection.  They are read from the group
 * [screen] of greenbody/screen.ini in $XDG_CONFIG_HOME.  Options with the same names
 * take precedence. */

enum gb_settings_colour { GB_COLOUR_AUTO, GB_COLOUR_ALWAYS, GB_COLOUR_NEVER };
enum gb_settings_graph {
    GB_GRAPH_AUTO,
    GB_GRAPH_BRAILLE,
    GB_GRAPH_BLOCK,
    GB_GRAPH_ASCII
};
enum gb_settings_images {
    GB_IMAGES_AUTO,
    GB_IMAGES_NONE,
    GB_IMAGES_SIXEL,
    GB_IMAGES_KITTY
};
/* How copied text reaches the terminal; see term.h. */
enum gb_settings_clipboard {
    GB_CLIPBOARD_AUTO,
    GB_CLIPBOARD_OSC52,
    GB_CLIPBOARD_TMUX,
    GB_CLIPBOARD_SCREEN,
    GB_CLIPBOARD_OFF
};

/* Colours: see term.h. */
enum gb_settings_theme {
    GB_THEME_AUTO,
    GB_THEME_LIGHT,
    GB_THEME_DARK,
    GB_THEME_CONTRAST
};

struct gb_settings {
    int colour, theme, graph, images, clipboard; /* values of the enums above */
    int ascii, mouse, slow;                      /* 0 or 1 */
};

/* One row per setting: option --name and key of the file. */
struct gb_settings_row {
    const char *name;
    const char *const *values; /* NULL ends; the first is the default */
    const char *meaning;
    size_t offset; /* offset of the int in gb_settings */
};

const struct gb_settings_row *gb_settings_table(size_t *count);

void gb_settings_init(struct gb_settings *settings);

/* Errors: GB_ERR_INPUT with the setting and the possible values. */
bool gb_settings_set(struct gb_settings *settings, const char *name, const char *value,
                     struct gb_error *err);

/* The current value as a word. */
const char *gb_settings_word(const struct gb_settings *settings, const char *name);

/* Reads the file; a missing file is not an error.  Unknown keys and other groups are
 * ignored. */
bool gb_settings_read(struct gb_settings *settings, const char *path,
                      struct gb_error *err);

/* Writes one setting to the file, which keeps its other lines and is created if
 * missing.  Errors: GB_ERR_INPUT if the file is not a key file, GB_ERR_MACHINE. */
bool gb_settings_remember(const char *path, const char *name, const char *value,
                          struct gb_error *err);

/* Path of the file; g_free. */
char *gb_settings_path(void);

#endif
