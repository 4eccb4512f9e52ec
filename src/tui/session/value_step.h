#ifndef GB_TUI_SESSION_VALUE_STEP_H
#define GB_TUI_SESSION_VALUE_STEP_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/params.h"

/* A parameter as a knob: the value one step up (direction 1) or down (-1), as typed in a
 * preset.  Numbers move by a tenth to a twentieth and keep their unit, choices go round,
 * a seed goes by one.  False: the value has no next one (a text, a list, "auto").  The
 * text can be out of the field's range: gb_params_set tells. */
bool gb_value_step_next(const struct gb_field *field, const char *value, int direction,
                        char *text, size_t size);

#endif
