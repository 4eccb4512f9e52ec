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
 * gb_preset_folders_find). Errors are one line: file, line, key, value, what is accepted. Unknown
 * keys in known groups are errors (a typo must not be silent) unless they start with
 * "x-"; unknown groups are kept and ignored. */
bool gb_preset_load(struct gb_preset **out, const char *name_or_path,
                    struct gb_error *err);
/* All fallbacks, no file. */
bool gb_preset_create(struct gb_preset **out, struct gb_error *err);
void gb_preset_destroy(struct gb_preset *preset); /* NULL is fine */

struct gb_params *gb_preset_params(struct gb_preset *preset);
const char *gb_preset_path(const struct gb_preset *preset); /* "" without a file */

/* Whether the file has a line for the key. */
bool gb_preset_has(const struct gb_preset *preset, const char *group, const char *key);

/* The first group of the file that is another than `group`, or NULL. */
const char *gb_preset_other_group(const struct gb_preset *preset, const char *group);

enum gb_preset_extent {
    GB_PRESET_CHANGED_KEYS, /* missing keys are added where they differ from the default */
    GB_PRESET_ALL_KEYS      /* every missing key is added */
};

/* Writes the preset atomically and durably: the original text with changed values
 * replaced, comments and unknown keys kept. */
bool gb_preset_save(struct gb_preset *preset, const char *path,
                    enum gb_preset_extent extent, struct gb_error *err);

#endif
