#ifndef GB_SOLVE_LOADING_DYNAMIC_STEP_H
#define GB_SOLVE_LOADING_DYNAMIC_STEP_H

#include <stddef.h>

#include "solve/loading/dynamic_state.h"

/* Longest time step (T) allowed in the present state of the world: that of the preset, or
 * the automatic one, both bounded by the critical step and by the guard.  text (size
 * bytes) receives one line when the critical step bounds it for the first time. */
double gb_dynamic_step_allowed(struct gb_dynamic *motion, const struct gb_world *world,
                               char *text, size_t size);

#endif
