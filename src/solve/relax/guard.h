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

/* Looks at a relaxed strain step: did a particle go so far that it may have passed
 * contacts by?  RETRY while half the step may help; ACCEPT with a line when it does not:
 * the packing itself jumps, across a gap or off a bridge. */
enum gb_guard_action gb_guard_departure(struct gb_guard *guard,
                                        const struct gb_nonaffine *departure, char *text,
                                        size_t size);

#endif
