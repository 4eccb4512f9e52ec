#ifndef GB_IO_MATERIAL_H
#define GB_IO_MATERIAL_H

#include <stdbool.h>

#include "greenbody/params.h"

/* A material is a key file with only the group [material].  It is found by name in the
 * folder materials/ of the preset folders (io/preset_folders.h). */

/* The group of the field table that a material sets. */
#define GB_MATERIAL_GROUP "material"

/* Sets every key of [material]; keys missing in the file get their defaults, so that
 * nothing of the previous material remains.  If the title contains the name of the
 * previous material, it is replaced. name_or_path: a name in any case, or the path of a
 * file.  Errors: GB_ERR_INPUT listing the materials or naming the line of the file;
 * params does not change then. */
bool gb_material_apply(struct gb_params *params, const char *name_or_path,
                       struct gb_error *err);

/* Sets a key as gb_params_assign does, or "material=NAME" as gb_material_apply does. */
bool gb_material_assign(struct gb_params *params, const char *assignment,
                        struct gb_error *err);

/* Path of a material by name or path (g_free).  NULL and err: GB_ERR_INPUT listing the
 * materials. */
char *gb_material_path(const char *name_or_path, struct gb_error *err);

/* Keys of the file marked "(guessed)" in the comment lines above them: "epsilon,
 * yield", or "" for none; g_free. */
char *gb_material_guessed(const char *path);

#endif
