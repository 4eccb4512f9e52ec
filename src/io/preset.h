#ifndef GB_IO_PRESET_H
#define GB_IO_PRESET_H

#include <stdbool.h>

#include "greenbody/params.h"

/* A preset: parameters plus the key file they came from, so that saving keeps comments
 * and unknown keys. */
struct gb_preset;

/* Reads a key file.  name_or_path: a path that exists, or a name looked up (with and
 * without
 * ".ini") in $XDG_CONFIG_HOME/greenbody/presets, then in the shipped presets
 * (GB_PRESET_DIR of the installation, then presets/ beside the source tree, see
 * gb_preset_find). Errors are one line: file, line, key, value, what is accepted. Unknown
 * keys in known groups are errors (a typo must not be silent) unless they start with
 * "x-"; unknown groups are kept and ignored. */
bool gb_preset_load(struct gb_preset **out, const char *name_or_path,
                    struct gb_error *err);
/* All fallbacks, no file. */
bool gb_preset_create(struct gb_preset **out, struct gb_error *err);
void gb_preset_destroy(struct gb_preset *preset); /* NULL is fine */

struct gb_params *gb_preset_params(struct gb_preset *preset);
const char *gb_preset_path(const struct gb_preset *preset); /* "" without a file */

/* Writes the preset atomically and durably: the original text with changed values
 * replaced, comments and unknown keys kept; complete adds every missing key. */
bool gb_preset_save(struct gb_preset *preset, const char *path, bool complete,
                    struct gb_error *err);

/* Path of a preset by name in newly allocated memory (g_free), or NULL. */
char *gb_preset_find(const char *name);

/* Names of all presets that can be found, sorted, NULL-terminated (g_strfreev). */
char **gb_preset_list(void);

#endif
