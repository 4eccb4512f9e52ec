#ifndef GB_SCENE_QUASISTATIC_SCENE_H
#define GB_SCENE_QUASISTATIC_SCENE_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/params.h"
#include "greenbody/status.h"
#include "scene/model.h"

/* The functions of the row `quasistatic` of scene/loading_kind.h. */

/* Nothing beyond what all periodic cells require. */
bool gb_quasistatic_scene_check(const struct gb_params *params, struct gb_error *err);

/* Nothing beyond what all periodic cells have. */
void gb_quasistatic_scene_freeze(struct gb_model *model, const struct gb_params *params);

/* The relaxation; NULL after line 0.  The text lives in buffer. */
const char *gb_quasistatic_scene_note(const struct gb_model *model, int index,
                                      char *buffer, size_t size);

#endif
