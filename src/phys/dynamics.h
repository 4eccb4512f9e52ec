#ifndef GB_PHYS_DYNAMICS_H
#define GB_PHYS_DYNAMICS_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/model.h"
#include "greenbody/params.h"
#include "greenbody/status.h"

/* What dynamic scenes ask for beyond the ranges of their keys; true for other kinds,
 * whose runs do not look at these keys.  Errors: GB_ERR_INPUT naming the keys. */
bool gb_dynamics_check(const struct gb_params *params, struct gb_error *err);

/* The dynamic keys in reduced units; all zero for other kinds. */
struct gb_dynamics gb_dynamics_of(const struct gb_params *params);

/* Line `index` (0, 1, ...) of what a dynamic scene carries; NULL after the last and for
 * other kinds.  The text lives in buffer. */
const char *gb_dynamics_note(const struct gb_model *model, int index, char *buffer,
                             size_t size);

#endif
