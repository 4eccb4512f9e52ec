#ifndef GB_SCENE_DYNAMIC_SCENE_H
#define GB_SCENE_DYNAMIC_SCENE_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/params.h"
#include "greenbody/status.h"
#include "scene/model.h"

/* What dynamic scenes ask for beyond the ranges of their keys; true for other kinds,
 * whose runs do not look at these keys.  Errors: GB_ERR_INPUT naming the keys. */
bool gb_dynamic_scene_check(const struct gb_params *params, struct gb_error *err);

/* The dynamic keys in reduced units; all zero for other kinds. */
struct gb_dynamics gb_dynamic_scene_reduce(const struct gb_params *params);

/* Line `index` (0, 1, ...) of what a dynamic scene carries; NULL after the last and for
 * other kinds.  The text lives in buffer. */
const char *gb_dynamic_scene_note(const struct gb_model *model, int index, char *buffer,
                                  size_t size);

#endif
