#ifndef GB_TUI_TERM_CRASH_H
#define GB_TUI_TERM_CRASH_H

#include <termios.h>

/* Restores the terminal when the process is ended by a fault: on SIGSEGV, SIGBUS, SIGFPE,
 * SIGILL and SIGABRT writes the reset sequence to the terminal, restores its modes and
 * standard error, and raises the signal with its previous action.  Async-signal-safe.
 *
 * screen  descriptor of the terminal
 * err     standard error before the screen was opened
 * modes   original modes of the terminal
 * reset   sequence that leaves the alternate screen and shows the cursor; copied */
void gb_crash_install(int screen, int err, const struct termios *modes,
                      const char *reset);
void gb_crash_remove(void);

/* The run directory; the message names its last checkpoint, if there is one.  Copied;
 * NULL: none. */
void gb_crash_set_run(const char *directory);

#endif
