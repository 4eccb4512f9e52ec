#ifndef GB_IO_PRESET_H
#define GB_IO_PRESET_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/params.h"
#include "greenbody/status.h"

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

/* Where the keys of a key file stand.  GKeyFile parses values but forgets line numbers
 * and the exact bytes, which messages and saving need. */
struct gb_key_line {
    char *group;
    char *key;        /* NULL: the line of a [group] */
    int line;         /* from 1 */
    size_t value;     /* offset of the first byte of the value, blanks skipped */
    size_t value_end; /* behind its last byte, trailing blanks left out */
    size_t end;       /* offset of the next line */
};

struct gb_key_lines {
    struct gb_key_line *item;
    size_t count, room;
};

/* Indexes text.  Errors (GB_ERR_INPUT) begin with "path:line: ": NUL bytes, invalid
 * UTF-8, lines that are neither group, key nor comment, keys before a group, duplicate
 * keys. */
bool gb_preset_lines_init(struct gb_key_lines *lines, const char *path, const char *text,
                          size_t length, struct gb_error *err);

void gb_preset_lines_finish(struct gb_key_lines *lines); /* zeroed is fine */

/* Line of group.key, or of [group] for key = NULL; NULL when there is none. */
const struct gb_key_line *gb_preset_lines_find(const struct gb_key_lines *lines,
                                               const char *group, const char *key);

#endif
