#ifndef GB_IO_PRESET_FOLDERS_H
#define GB_IO_PRESET_FOLDERS_H

/* Presets by name in $XDG_CONFIG_HOME/greenbody/presets, GB_PRESET_DIR, the installed
 * folder, and presets/ beside the source tree; the first match counts. */

/* Path of a preset by name in newly allocated memory (g_free), or NULL. */
char *gb_preset_folders_find(const char *name);

/* Path of a file of data that belongs to the program, in GB_DATA_DIR, the installed folder
 * or assets/data beside the source tree (g_free), or NULL. */
char *gb_preset_folders_find_data(const char *file);

/* Names of all presets that can be found, sorted, NULL-terminated (g_strfreev). */
char **gb_preset_folders_list(void);

#endif
