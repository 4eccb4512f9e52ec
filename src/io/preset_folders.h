#ifndef GB_IO_PRESET_FOLDERS_H
#define GB_IO_PRESET_FOLDERS_H

/* Presets are found by name in these folders, in this order:
 * $XDG_CONFIG_HOME/greenbody/presets, $GB_PRESET_DIR, share/greenbody of the prefix in
 * which the program is, presets/ of the source tree of a build folder, and the folder
 * of the installation.  The first match is used. */

/* These folders, NULL-terminated (g_strfreev). */
char **gb_preset_folders(void);

/* Path of a preset by name (g_free), or NULL. */
char *gb_preset_folders_find(const char *name);

/* Path of a material by name in the folder materials/ of these folders (g_free), or
 * NULL. */
char *gb_preset_folders_find_material(const char *name);

/* Path of a data file of the program, found in the same way (GB_DATA_DIR,
 * share/greenbody/data, assets/data; g_free), or NULL. */
char *gb_preset_folders_find_data(const char *file);

/* Names of all presets that can be found, sorted, NULL-terminated (g_strfreev). */
char **gb_preset_folders_list(void);

/* The same of all materials. */
char **gb_preset_folders_list_materials(void);

#endif
