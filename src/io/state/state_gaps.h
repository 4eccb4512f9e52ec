#ifndef GB_IO_STATE_STATE_GAPS_H
#define GB_IO_STATE_STATE_GAPS_H

#include "io/state/state.h"

/* Pairs that attract across a gap: P1 (3) out to the reach of the attraction, from the
 * positions of a state.  They add to the contacts what these lack of the stress: a state
 * lists contacts only. */
struct gb_state_gaps {
    int64_t count;
    int32_t *pair; /* count x 2 particle indices, by the first one */
    double *force; /* count x 3: on the first, E d^2 */
};

/* None without attraction and in a die.  Errors: GB_ERR_MEMORY, GB_ERR_GUARD for a cell narrower than two
 * reaches. */
bool gb_state_gaps_init(struct gb_state_gaps *gaps, const struct gb_state *state,
                        struct gb_error *err);
void gb_state_gaps_finish(struct gb_state_gaps *gaps);

#endif
