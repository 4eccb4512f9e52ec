#ifndef GB_SOLVE_LOADING_DYNAMIC_GUARD_H
#define GB_SOLVE_LOADING_DYNAMIC_GUARD_H

#include <stddef.h>

#include "solve/loading/dynamic_state.h"

/* The guard of the time step: state to go back to, halved steps, sliding contacts. */

/* The present state is the one to go back to.  Errors: GB_ERR_MEMORY. */
bool gb_dynamic_guard_save(struct gb_dynamic *motion, const struct gb_world *world,
                           struct gb_error *err);

/* Back to the saved state with half the time step: MORE, with a line in text (size
 * bytes) that begins with the reason `why`; STOPPED after GB_STEP_HALVINGS_MAX
 * halvings. */
enum gb_step_outcome gb_dynamic_guard_halve(struct gb_dynamic *motion,
                                            struct gb_world *world, const char *why,
                                            char *text, size_t size,
                                            struct gb_error *err);

/* At the end of the steps to a point: POINT, or as of gb_dynamic_guard_halve when more
 * contacts slid than the time step explains. */
enum gb_step_outcome gb_dynamic_guard_judge(struct gb_dynamic *motion,
                                            struct gb_world *world, char *text,
                                            size_t size, struct gb_error *err);

#endif
