#ifndef GB_SCENE_QUASISTATIC_SCENE_H
#define GB_SCENE_QUASISTATIC_SCENE_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/params.h"
#include "greenbody/status.h"
#include "scene/model.h"

/* The functions of the row `quasistatic` of scene/loading_kind.h. */

/* Checks units of numerics.tolerance against the scene.  Errors: GB_ERR_INPUT. */
bool gb_quasistatic_scene_check(const struct gb_params *params, struct gb_error *err);

/* Sets nothing: quasi-static scenes have no part of the model of their own. */
void gb_quasistatic_scene_freeze(struct gb_model *model, const struct gb_params *params);

/* Describes the relaxation; NULL after the last line.  The text is in buffer. */
const char *gb_quasistatic_scene_note(const struct gb_model *model, int index,
                                      char *buffer, size_t size);

#endif
