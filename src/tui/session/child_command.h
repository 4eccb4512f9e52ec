#ifndef GB_TUI_SESSION_CHILD_COMMAND_H
#define GB_TUI_SESSION_CHILD_COMMAND_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"

enum { GB_CHILD_COMMAND_LINE = 256 };

/* A command of this program that works beside the screen: a picture, a report, more
 * cells, a calibration.  One at a time. */
struct gb_child_command {
    int pid;           /* 0: none is under way */
    int output_fd;     /* its standard output and error; -1 when they have ended */
    bool long_running; /* what it says is news; else only its last line, when it fails */
    char what[16];     /* "picture" */
    char path[512];    /* what it makes */
    char progress[GB_CHILD_COMMAND_LINE]; /* "12 of 40 runs, ..."; "" without */
    char line[GB_CHILD_COMMAND_LINE];     /* not ended yet, or the last one */
    size_t length;
};

/* words: command and arguments behind the program's name, NULL at the end, 14 at most.
 * One that talks computes for long: it gives way to the screen.  Errors: GB_ERR_INPUT
 * while another one is under way, GB_ERR_MACHINE. */
bool gb_child_command_start(struct gb_child_command *child, const char *what,
                            const char *path, bool long_running, const char *const *words,
                            struct gb_error *err);

enum gb_child_command_event {
    GB_CHILD_COMMAND_NONE,
    GB_CHILD_COMMAND_PROGRESS, /* in errand->progress */
    GB_CHILD_COMMAND_OUTPUT,
    GB_CHILD_COMMAND_ENDED
};

/* The next piece of news; text gets the line said, or how it ended. */
enum gb_child_command_event gb_child_command_poll(struct gb_child_command *child,
                                                  char *text, size_t size);

#endif
