#ifndef GB_TUI_SESSION_COST_CONFIRM_H
#define GB_TUI_SESSION_COST_CONFIRM_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/params.h"

/* Whether a run needs a confirmation because of its estimated cost; text then receives
 * the estimate and cheaper parameters.  False for invalid parameters, whose error comes
 * at the start.
 *
 * particle_steps_per_s  measured speed; 0: none yet, an assumption is used */
bool gb_cost_confirm_question(const struct gb_params *params, double particle_steps_per_s,
                              char *text, size_t size);

/* The same for a quasi-static run, estimated from the time of its quick cell.  *seconds:
 * estimated duration of the run, NaN: no estimate. */
bool gb_cost_confirm_after_quick(const struct gb_params *full,
                                 const struct gb_params *quick, double quick_s,
                                 double *seconds, char *text, size_t size);

#endif
