#ifndef GB_IO_PRESET_H
#define GB_IO_PRESET_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/params.h"
#include "greenbody/status.h"

/* A preset: parameters plus the key file they came from, so that saving keeps comments
 * and unknown keys. */
struct gb_preset;

/* Reads a key file. name_or_path is an existing path, or a name with or without ".ini"
 * that is searched in $XDG_CONFIG_HOME/greenbody/presets and then in the shipped
 * presets (see gb_preset_folders_find).  Errors are one line: file, line, key, value,
 * what is expected.  Unknown keys in known groups are errors, because they are likely
 * typos, unless they start with "x-".  Unknown groups are kept and ignored. */
bool gb_preset_load(struct gb_preset **out, const char *name_or_path,
                    struct gb_error *err);
/* A preset with all defaults and no file. */
bool gb_preset_create(struct gb_preset **out, struct gb_error *err);
void gb_preset_destroy(struct gb_preset *preset); /* NULL is fine */

struct gb_params *gb_preset_params(struct gb_preset *preset);
const char *gb_preset_path(const struct gb_preset *preset); /* "" without a file */

/* Does the file have a line for the key? */
bool gb_preset_has(const struct gb_preset *preset, const char *group, const char *key);

/* The first group of the file other than `group`, or NULL. */
const char *gb_preset_other_group(const struct gb_preset *preset, const char *group);

enum gb_preset_extent {
    GB_PRESET_CHANGED_KEYS, /* add missing keys that differ from their defaults */
    GB_PRESET_ALL_KEYS      /* add all missing keys */
};

/* Writes the preset atomically and durably: the original text with changed values
 * replaced, comments and unknown keys kept. */
bool gb_preset_save(struct gb_preset *preset, const char *path,
                    enum gb_preset_extent extent, struct gb_error *err);

/* Positions of the keys of a file.  Messages need the line numbers and saving needs the
 * exact bytes; GKeyFile provides neither. */
struct gb_key_line {
    char *group;
    char *key;        /* NULL: the line of a [group] */
    int line;         /* from 1 */
    size_t value;     /* offset of the first byte of the value, blanks skipped */
    size_t value_end; /* after its last byte, without trailing blanks */
    size_t end;       /* offset of the next line */
};

struct gb_key_lines {
    struct gb_key_line *item;
    size_t count, room;
};

/* Indexes text.  Errors (GB_ERR_INPUT) begin with "path:line: ": NUL bytes, invalid
 * UTF-8, duplicate keys, keys before a group, and lines that are neither group, key nor
 * comment. */
bool gb_preset_lines_init(struct gb_key_lines *lines, const char *path, const char *text,
                          size_t length, struct gb_error *err);

void gb_preset_lines_finish(struct gb_key_lines *lines); /* zeroed is fine */

/* Line of group.key, or of [group] for key = NULL.  NULL if there is none. */
const struct gb_key_line *gb_preset_lines_find(const struct gb_key_lines *lines,
                                               const char *group, const char *key);

#endif
