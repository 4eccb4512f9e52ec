#ifndef GB_TUI_TERM_STDERR_TAIL_H
#define GB_TUI_TERM_STDERR_TAIL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Messages of libraries and drivers on standard error go to the log while the screen is
 * open; the newest line is shown among the events. */
struct gb_stderr_tail {
    int64_t length; /* bytes of the log read so far; -1: not opened yet */
};

void gb_stderr_tail_init(struct gb_stderr_tail *stderr_tail);

/* The last complete line written to standard error since the previous call; false: none,
 * or standard error is not a file. */
bool gb_stderr_tail_poll(struct gb_stderr_tail *stderr_tail, char *line, size_t size);

#endif
