#ifndef GB_SCENE_DIE_SCENE_H
#define GB_SCENE_DIE_SCENE_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/params.h"
#include "greenbody/status.h"
#include "scene/model.h"

/* What scenes with kind = die ask for beyond the ranges of their keys.  Errors:
 * GB_ERR_INPUT naming the keys. */
bool gb_die_scene_check(const struct gb_params *params, struct gb_error *err);

/* For what needs a periodic cell: false and GB_ERR_INPUT for scenes with kind = die. */
bool gb_die_scene_require_periodic(const struct gb_params *params, const char *what,
                                   struct gb_error *err);

/* The keys of a die in reduced units; all zero for other kinds. */
struct gb_die_scene gb_die_scene_reduce(const struct gb_params *params);

/* Line `index` (0, 1, ...) of what a die carries; NULL after the last.  The text lives in
 * buffer. */
const char *gb_die_scene_note(const struct gb_model *model, int index, char *buffer,
                              size_t size);

#endif
