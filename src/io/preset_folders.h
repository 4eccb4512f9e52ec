#ifndef GB_IO_PRESET_FOLDERS_H
#define GB_IO_PRESET_FOLDERS_H

/* Presets by name in $XDG_CONFIG_HOME/greenbody/presets, GB_PRESET_DIR, share/greenbody of
 * the prefix that the program stands in, presets/ of the source tree of a build folder, and
 * the folder of the installation; the first match counts. */

/* These folders, NULL-terminated (g_strfreev). */
char **gb_preset_folders(void);

/* Path of a preset by name in newly allocated memory (g_free), or NULL. */
char *gb_preset_folders_find(const char *name);

/* Path of a material by name in the folder materials/ of these folders, in newly allocated
 * memory (g_free), or NULL. */
char *gb_preset_folders_find_material(const char *name);

/* Path of a file of data that belongs to the program, found in the same way
 * (GB_DATA_DIR, share/greenbody/data, assets/data; g_free), or NULL. */
char *gb_preset_folders_find_data(const char *file);

/* Names of all presets that can be found, sorted, NULL-terminated (g_strfreev). */
char **gb_preset_folders_list(void);

/* The same of all materials. */
char **gb_preset_folders_list_materials(void);

#endif
