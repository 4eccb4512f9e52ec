#ifndef GB_TUI_SESSION_COST_CONFIRM_H
#define GB_TUI_SESSION_COST_CONFIRM_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/params.h"

/* Is this run one to ask about first?  Then text says what it takes and what would make
 * it cheaper.  Parameters that cannot be run are not asked about: starting them tells
 * why.
 *
 * particle_steps_per_s  as measured before; 0: not yet, an assumption is taken */
bool gb_cost_confirm_question(const struct gb_params *params, double particle_steps_per_s,
                              char *text, size_t size);

/* The same of a quasi-static run, by what its quick cell took.  *seconds: that the run
 * will take about, NaN when it cannot be foretold. */
bool gb_cost_confirm_after_quick(const struct gb_params *full,
                                 const struct gb_params *quick, double quick_s,
                                 double *seconds, char *text, size_t size);

#endif
