#ifndef GB_TUI_TERM_STDERR_TAIL_H
#define GB_TUI_TERM_STDERR_TAIL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* What libraries and drivers say while the screen has the terminal goes to the log; its
 * newest line belongs among the events. */
struct gb_stderr_tail {
    int64_t length; /* of the log, as far as it was read; -1: not looked at yet */
};

void gb_stderr_tail_init(struct gb_stderr_tail *stderr_tail);

/* The last whole line that was written to standard error since the call before; false:
 * there is none, or standard error is no file. */
bool gb_stderr_tail_poll(struct gb_stderr_tail *stderr_tail, char *line, size_t size);

#endif
