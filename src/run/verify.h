#ifndef GB_RUN_VERIFY_H
#define GB_RUN_VERIFY_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/status.h"

enum { GB_VERIFY_NAME = 64 };

/* Result of repeating the last steps of a run. */
struct gb_verify {
    int64_t from,
        to; /* recorded points: repeated from here (0: the beginning) to there */
    uint64_t kept, repeated; /* hashes of the two states */
    bool equal;
    char name[GB_VERIFY_NAME]; /* of the first array that differs ... */
    int64_t row;               /* ... and its first row that does */
};

/* Repeats a run from state-before.h5, or from the beginning where there is none, to
 * state.h5 and compares them bit by bit.  Changes nothing; holds the lock of the
 * directory meanwhile.
 *
 * Errors: GB_ERR_INPUT (no run, a run under way, no or a damaged checkpoint),
 * GB_ERR_GUARD when the repeated run ends before the checkpoint, GB_ERR_CANCELLED. */
bool gb_verify_run(struct gb_verify *verify, const char *directory,
                   bool (*cancelled)(void *data), void *data, struct gb_error *err);

#endif
