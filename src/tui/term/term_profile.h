#ifndef GB_TUI_TERM_TERM_PROFILE_H
#define GB_TUI_TERM_TERM_PROFILE_H

#include <stdbool.h>
#include <stdio.h>

#include "greenbody/status.h"
#include "tui/term/settings.h"

/* Properties of the terminal from terminfo, environment and settings, as printed by
 * --diagnose. */
struct gb_term_profile {
    const char *own;  /* $TERM, "" when it is not set */
    const char *type; /* the terminfo entry in use */
    char better[64];  /* buffer of type if it differs from own */
    bool utf8, braille;
    bool inside; /* inside tmux or screen: no images; over ssh only on request */
    int colours; /* number in terminfo */
    bool coloured;
    bool can_mouse; /* terminfo has a mouse sequence */
    int images;     /* GB_IMAGES_NONE, _SIXEL or _KITTY */
    int theme;      /* enum gb_settings_theme */
    int clipboard;  /* enum gb_settings_clipboard, never auto */
};

/* Also sets the locale.  Errors: GB_ERR_MACHINE if no terminal type works; the other
 * members are set nevertheless. */
bool gb_term_profile_detect(struct gb_term_profile *profile, int fd,
                            const struct gb_settings *settings, struct gb_error *err);

/* One line per property, with its sources. */
void gb_term_profile_print(FILE *out, int fd, const struct gb_settings *settings);

#endif
