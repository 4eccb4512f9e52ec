#ifndef GB_CLI_PROGRESS_H
#define GB_CLI_PROGRESS_H

#include <stdbool.h>

#include "greenbody/snapshot.h"

/* What a run without a screen tells on stderr: one line rewritten on a terminal, a plain
 * line every few seconds elsewhere, nothing when quiet. */
struct gb_progress {
    bool quiet, terminal;
    int shown;      /* columns now occupied by the rewritten line */
    double told_at; /* seconds of the run at the last line */
};

void gb_progress_init(struct gb_progress *progress, bool quiet);

/* A line that stays. */
void gb_progress_say(struct gb_progress *progress, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Is it time for the next gb_progress_show?  Filling a snapshot costs a sweep. */
bool gb_progress_due(const struct gb_progress *progress, double seconds);

/* Where the run stands. */
void gb_progress_show(struct gb_progress *progress, const struct gb_snapshot *snapshot);

/* Takes the rewritten line away. */
void gb_progress_clear(struct gb_progress *progress);

#endif
