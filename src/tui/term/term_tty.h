#ifndef GB_TUI_TERM_TERM_TTY_H
#define GB_TUI_TERM_TERM_TTY_H

#include "greenbody/status.h"

/* What the terminal needs before curses takes it. */

/* Path of the log file; g_free. */
char *gb_term_tty_log(void);

/* The log opened for reading; -1: it cannot be. */
int gb_term_tty_read_log(void);

/* Sends standard output and error to a log file ($XDG_STATE_HOME/greenbody/workbench.log,
 * or nowhere). */
void gb_term_tty_redirect(void);
/* Puts back the descriptors that were duplicated before. */
void gb_term_tty_restore(int out, int err);

/* The terminal's own type, or for one that terminfo does not know (common over ssh) the
 * one that nearly all of them understand.  NULL: no type that can place the cursor. */
const char *gb_term_tty_type(int fd, struct gb_error *err);

/* Colours that terminfo promises of a type, 0: none or it is unknown. */
int gb_term_tty_colours(const char *type, int fd);

#endif
