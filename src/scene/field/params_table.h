#ifndef GB_SCENE_PARAMS_TABLE_H
#define GB_SCENE_PARAMS_TABLE_H

#include "greenbody/params.h"

/* The field table: every key of a preset with its type, unit, range, default, meaning and
 * source.  Preset files, --set, the editor, `greenbody params` and --help follow from
 * it. */
const struct gb_field *gb_params_table(size_t *count);

#endif
