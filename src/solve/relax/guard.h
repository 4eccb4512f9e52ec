#ifndef GB_SOLVE_RELAX_GUARD_H
#define GB_SOLVE_RELAX_GUARD_H

#include <stdbool.h>

#include "greenbody/status.h"
#include "pack/cell/nonaffine.h"
#include "solve/relax/relax.h"

/* What is done when a strain step fails, in one place. */
enum gb_guard_action {
    GB_GUARD_ACCEPT, /* record the state */
    GB_GUARD_RETRY,  /* go back to the last good state and take half the strain step */
    GB_GUARD_STOP    /* go back to the last good state and stop; err says why */
};

struct gb_guard {
    int halvings; /* of the strain step, in a row */
    int jumps;    /* of these because of particles that went too far */
};

/* Judges the outcome of a strain step.  text (size bytes) receives one line for
 * events.log when something happened, else "".  Errors: err keeps its text on RETRY (what
 * happened) and is completed on STOP. */
enum gb_guard_action gb_guard_judge(struct gb_guard *guard, enum gb_relax_outcome outcome,
                                    const struct gb_relax *relax, char *text, size_t size,
                                    struct gb_error *err);

/* Judges the nonaffine displacements of a relaxed strain step: beyond GB_NONAFFINE_MAX a
 * particle may have passed contacts by.  RETRY while half the step may help; ACCEPT with a
 * line in text when it does not: an instability of the packing, across a gap or by the
 * failure of a bridge. */
enum gb_guard_action gb_guard_nonaffine(struct gb_guard *guard,
                                        const struct gb_nonaffine *nonaffine, char *text,
                                        size_t size);

#endif
