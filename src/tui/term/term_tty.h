#ifndef GB_TUI_TERM_TERM_TTY_H
#define GB_TUI_TERM_TERM_TTY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <termios.h>

#include "greenbody/status.h"

/* The terminal apart from curses: redirection and choice of the type. */

/* Messages of libraries and drivers on standard error go to the log while the screen is
 * open; the newest line is shown among the events. */
struct gb_stderr_tail {
    int64_t length; /* bytes of the log read so far; -1: not opened yet */
};

void gb_term_tty_tail_init(struct gb_stderr_tail *stderr_tail);

/* The last complete line written to standard error since the previous call; false: none,
 * or standard error is not a file. */
bool gb_term_tty_tail_poll(struct gb_stderr_tail *stderr_tail, char *line, size_t size);

/* Restores the terminal when the process is ended by a fault: on SIGSEGV, SIGBUS, SIGFPE,
 * SIGILL and SIGABRT writes the reset sequence to the terminal, restores its modes and
 * standard error, and raises the signal with its previous action.  Async-signal-safe.
 *
 * screen  descriptor of the terminal
 * err     standard error before the screen was opened
 * modes   original modes of the terminal
 * reset   sequence that leaves the alternate screen and shows the cursor; copied */
void gb_term_tty_crash_install(int screen, int err, const struct termios *modes,
                               const char *reset);

void gb_term_tty_crash_remove(void);

/* The run directory; the message names its last checkpoint, if there is one.  Copied;
 * NULL: none. */
void gb_term_tty_crash_set_run(const char *directory);

/* Path of the log file; g_free. */
char *gb_term_tty_log(void);

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
