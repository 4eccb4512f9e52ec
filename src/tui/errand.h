#ifndef GB_TUI_ERRAND_H
#define GB_TUI_ERRAND_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"

enum { GB_ERRAND_LINE = 256 };

/* A command of this program that works beside the screen: a picture, a report, more
 * cells, a calibration.  One at a time. */
struct gb_errand {
    int pid;        /* 0: none is under way */
    int said;       /* its standard output and error; -1 when they have ended */
    bool talks;     /* what it says is news; else only its last line, when it fails */
    char what[16];  /* "picture" */
    char path[512]; /* what it makes */
    char progress[GB_ERRAND_LINE]; /* "12 of 40 runs, ..."; "" without */
    char line[GB_ERRAND_LINE];     /* not ended yet, or the last one */
    size_t length;
};

/* words: command and arguments behind the program's name, NULL at the end, 14 at most.
 * One that talks computes for long: it gives way to the screen.  Errors: GB_ERR_INPUT
 * while another one is under way, GB_ERR_MACHINE. */
bool gb_errand_start(struct gb_errand *errand, const char *what, const char *path,
                     bool talks, const char *const *words, struct gb_error *err);

enum gb_errand_news {
    GB_ERRAND_NOTHING,
    GB_ERRAND_PROGRESS, /* in errand->progress */
    GB_ERRAND_LINE_SAID,
    GB_ERRAND_ENDED
};

/* The next piece of news; text gets the line said, or how it ended. */
enum gb_errand_news gb_errand_poll(struct gb_errand *errand, char *text, size_t size);

#endif
