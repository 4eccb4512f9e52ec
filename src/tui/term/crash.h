#ifndef GB_TUI_TERM_CRASH_H
#define GB_TUI_TERM_CRASH_H

#include <termios.h>

/* Gives the terminal back even when the process dies of a fault: on SIGSEGV, SIGBUS,
 * SIGFPE, SIGILL and SIGABRT writes the reset text to the terminal, restores its modes
 * and standard error, and lets the signal do what it did before.  Async-signal-safe.
 *
 * screen  descriptor of the terminal
 * err     standard error as it was before the screen was taken
 * modes   of the terminal as found
 * reset   what leaves the alternate screen and shows the cursor; copied */
void gb_crash_install(int screen, int err, const struct termios *modes,
                      const char *reset);
void gb_crash_remove(void);

/* The run directory whose last checkpoint, if there is one by then, is named in the
 * message; copied, NULL: none. */
void gb_crash_set_run(const char *directory);

#endif
