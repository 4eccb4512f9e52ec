#ifndef GB_CLI_PROGRESS_H
#define GB_CLI_PROGRESS_H

#include <stdbool.h>

#include "greenbody/snapshot.h"

/* Progress of a run without screen on stderr: one rewritten line on a terminal, a line
 * every few seconds elsewhere, nothing when quiet. */
struct gb_progress {
    bool quiet, terminal;
    int shown;      /* columns now occupied by the rewritten line */
    double line_at; /* seconds of the run at the last line */
};

void gb_progress_init(struct gb_progress *progress, bool quiet);

/* Prints a permanent line. */
void gb_progress_say(struct gb_progress *progress, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* "density 0.4213, p 12.3 MPa", with that separator; a compact outside its die has no
 * density. */
enum { GB_PROGRESS_POINT = 64 };
void gb_progress_point(char text[GB_PROGRESS_POINT], const struct gb_point *point,
                       const char *separator);

/* Whether gb_progress_show is due.  Filling a snapshot costs an evaluation of the
 * forces. */
bool gb_progress_due(const struct gb_progress *progress, double seconds);

/* Shows the progress of the run. */
void gb_progress_show(struct gb_progress *progress, const struct gb_snapshot *snapshot);

/* "12 of 40 frames  30 %  8 s left" when it is due, and behind the last one on a terminal;
 * seconds since the first began. */
void gb_progress_count(struct gb_progress *progress, size_t done, size_t total,
                       const char *what, double seconds);

/* Removes the rewritten line. */
void gb_progress_clear(struct gb_progress *progress);

#endif
