#ifndef GB_TUI_TERM_TERM_PROFILE_H
#define GB_TUI_TERM_TERM_PROFILE_H

#include <stdbool.h>
#include <stdio.h>

#include "greenbody/status.h"
#include "tui/term/settings.h"

/* What the terminal is taken for, by its capabilities, its environment and what the user
 * says.  --diagnose prints it. */
struct gb_term_profile {
    const char *own;  /* $TERM, "" when it is not set */
    const char *type; /* the terminfo entry in use */
    char better[64];  /* holds type where it is not own */
    bool utf8, braille;
    bool inside; /* of tmux or screen: no images there, or over ssh, unasked */
    int colours; /* that terminfo promises */
    bool coloured;
    bool can_mouse; /* terminfo knows how a mouse reports */
    int images;     /* GB_IMAGES_NONE, _SIXEL or _KITTY */
};

/* Sets the locale as well.  Error (GB_ERR_MACHINE): no terminal type works; the rest is
 * filled all the same. */
bool gb_term_profile_detect(struct gb_term_profile *profile, int fd,
                            const struct gb_settings *settings, struct gb_error *err);

/* One line for each guess, with what it rests on. */
void gb_term_profile_print(FILE *out, int fd, const struct gb_settings *settings);

#endif
