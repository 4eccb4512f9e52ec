#ifndef GB_TUI_SESSION_VALUE_STEP_H
#define GB_TUI_SESSION_VALUE_STEP_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/params.h"

/* The next value of a parameter upwards (direction 1) or downwards (-1), as text of a
 * preset.  Numbers change by 4 to 10 % and keep their unit, choices are cyclic, a seed
 * changes by 1.  False: no next value (a text, a list, "auto").  The result may be out of
 * range; gb_params_set checks it. */
bool gb_value_step_next(const struct gb_field *field, const char *value, int direction,
                        char *text, size_t size);

#endif
