#ifndef GB_TUI_SESSION_CHILD_COMMAND_H
#define GB_TUI_SESSION_CHILD_COMMAND_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"

enum { GB_CHILD_COMMAND_LINE = 256 };

enum gb_child_command_kind {
    GB_CHILD_COMMAND_SHORT, /* its last line of output is shown if it fails */
    GB_CHILD_COMMAND_LONG,  /* all its output is shown; lower scheduling priority */
    GB_CHILD_COMMAND_QUIET  /* its progress is shown, the rest as SHORT; lower priority */
};

/* A command of this program as a child process: picture, report, replicas, calibration.
 * One at a time. */
struct gb_child_command {
    int pid;       /* 0: no child */
    int output_fd; /* pipe of its standard output and error; -1: closed */
    enum gb_child_command_kind kind;
    char name[16];                        /* "picture" */
    char path[512];                       /* of its result */
    char progress[GB_CHILD_COMMAND_LINE]; /* "12 of 40 runs, ...", "1 of 3 states: ..." */
    char line[GB_CHILD_COMMAND_LINE];     /* incomplete line, or the last one */
    size_t length;
    bool succeeded; /* of the last one that has ended */
};

/* words: command and arguments without the program's name, NULL at the end, 14 at most.
 * Errors: GB_ERR_INPUT while another one is running, GB_ERR_MACHINE. */
bool gb_child_command_start(struct gb_child_command *child, const char *name,
                            const char *path, enum gb_child_command_kind kind,
                            const char *const *words, struct gb_error *err);

/* Asks the command to end; it is over with GB_CHILD_COMMAND_ENDED. */
void gb_child_command_stop(const struct gb_child_command *child);

enum gb_child_command_event {
    GB_CHILD_COMMAND_NONE,
    GB_CHILD_COMMAND_PROGRESS, /* in child->progress */
    GB_CHILD_COMMAND_OUTPUT,
    GB_CHILD_COMMAND_ENDED
};

/* The next event; text receives the line of output, or the outcome. */
enum gb_child_command_event gb_child_command_poll(struct gb_child_command *child,
                                                  char *text, size_t size);

#endif
