#ifndef GB_TUI_ERRAND_H
#define GB_TUI_ERRAND_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"

/* A command of this program that works beside the screen: a picture, a report.  What it
 * writes goes to the log; the last line of its complaint is kept.  One at a time. */
struct gb_errand {
    int pid;        /* 0: none is under way */
    int complaint;  /* its standard error */
    char what[16];  /* "picture" */
    char path[512]; /* what it makes */
};

/* words: command and arguments behind the program's name, NULL at the end.  Errors:
 * GB_ERR_INPUT while another one is under way, GB_ERR_MACHINE. */
bool gb_errand_start(struct gb_errand *errand, const char *what, const char *path,
                     const char *const *words, struct gb_error *err);

/* True when it has just ended; text says how. */
bool gb_errand_poll(struct gb_errand *errand, char *text, size_t size);

#endif
