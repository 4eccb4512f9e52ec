#ifndef GB_SCENE_DYNAMIC_SCENE_H
#define GB_SCENE_DYNAMIC_SCENE_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/params.h"
#include "greenbody/status.h"
#include "scene/model.h"

/* The functions of the row `dynamic` of scene/loading_kind.h. */

/* Checks the requirements of kind = dynamic beyond the ranges of the keys.  Errors:
 * GB_ERR_INPUT naming the keys. */
bool gb_dynamic_scene_check(const struct gb_params *params, struct gb_error *err);

/* Sets model->dynamics from the keys, in reduced units. */
void gb_dynamic_scene_freeze(struct gb_model *model, const struct gb_params *params);

/* Line `index` (0, 1, ...) of a description of the dynamic scene; NULL after the last.
 * The text is in buffer. */
const char *gb_dynamic_scene_note(const struct gb_model *model, int index, char *buffer,
                                  size_t size);

#endif
