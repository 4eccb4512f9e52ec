#ifndef GB_SCENE_APPLIES_H
#define GB_SCENE_APPLIES_H

#include <stdbool.h>

#include "greenbody/params.h"

/* Does this field change anything in a scene of these parameters?  Other fields are left
 * out of the editor's list; presets may contain them. */
bool gb_applies_field(const struct gb_params *params, const struct gb_field *field);

#endif
