#ifndef GB_SCENE_FIELD_FIRST_DEFAULTS_H
#define GB_SCENE_FIELD_FIRST_DEFAULTS_H

#include <stdbool.h>

#include "greenbody/params.h"

/* Defaults of version 0.1, with those of later keys at what it did: a complete preset that
 * it wrote lacks them, and repeats its run to the bit. */
void gb_first_defaults_init(struct gb_params *params);

/* Does the text of a preset begin with "# greenbody 0.1..." (the line of complete presets
 * in run directories, pictures and reports)? */
bool gb_first_defaults_meant(const char *text);

#endif
