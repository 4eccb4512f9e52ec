#ifndef GB_IO_MATERIAL_H
#define GB_IO_MATERIAL_H

#include <stdbool.h>

#include "greenbody/params.h"

/* A material is a key file with the group [material] alone, found by name in the folder
 * materials/ of the folders of presets (io/preset_folders.h). */

/* The group of the field table that a material sets. */
#define GB_MATERIAL_GROUP "material"

/* Sets every key of [material]: those that the file leaves out get their default, so that
 * nothing of the material before is left; a title that names the one before names it.
 * name_or_path: a name, upper and lower case alike, or a path of a file.  Errors:
 * GB_ERR_INPUT with the materials there are, or the line of the file; params is untouched
 * then. */
bool gb_material_apply(struct gb_params *params, const char *name_or_path,
                       struct gb_error *err);

/* As gb_params_assign; also "material=NAME", as gb_material_apply. */
bool gb_material_assign(struct gb_params *params, const char *assignment,
                        struct gb_error *err);

/* Path of a material by name or path, in newly allocated memory (g_free); NULL and err:
 * GB_ERR_INPUT with the materials there are. */
char *gb_material_path(const char *name_or_path, struct gb_error *err);

/* Keys of the file whose comment, the lines in front of them, has "(guessed)": "epsilon,
 * yield", "" for none; g_free. */
char *gb_material_guessed(const char *path);

#endif
