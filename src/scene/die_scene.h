#ifndef GB_SCENE_DIE_SCENE_H
#define GB_SCENE_DIE_SCENE_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/params.h"
#include "greenbody/status.h"
#include "scene/model.h"

/* The functions of the row `die` of scene/loading_kind.h. */

/* What scenes with kind = die require beyond the ranges of their keys.  Errors:
 * GB_ERR_INPUT naming the keys. */
bool gb_die_scene_check(const struct gb_params *params, struct gb_error *err);

/* The keys of a die in reduced units, as model->die. */
void gb_die_scene_freeze(struct gb_model *model, const struct gb_params *params);

/* Line `index` (0, 1, ...) of what a die carries; NULL after the last.  The text lives in
 * buffer. */
const char *gb_die_scene_note(const struct gb_model *model, int index, char *buffer,
                              size_t size);

#endif
