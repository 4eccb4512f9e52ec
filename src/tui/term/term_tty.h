#ifndef GB_TUI_TERM_TERM_TTY_H
#define GB_TUI_TERM_TERM_TTY_H

#include "greenbody/status.h"

/* The terminal apart from curses: redirection and choice of the type. */

/* Path of the log file; g_free. */
char *gb_term_tty_log(void);

/* Descriptor of the log for reading; -1: error. */
int gb_term_tty_read_log(void);

/* Can the log be written?  Otherwise err says why nothing is logged, and the rest works. */
bool gb_term_tty_check_log(struct gb_error *err);

/* Redirects standard output and error to a log file
 * ($XDG_STATE_HOME/greenbody/workbench.log, or /dev/null). */
void gb_term_tty_redirect(void);
/* Restores the descriptors that were duplicated before. */
void gb_term_tty_restore(int out, int err);

/* The terminal's own type, or for an unknown one (common over ssh) a type that nearly all
 * terminals understand.  NULL: no type with cursor addressing. */
const char *gb_term_tty_type(int fd, struct gb_error *err);

/* Number of colours in terminfo; 0: none, or an unknown type. */
int gb_term_tty_colours(const char *type, int fd);

#endif
