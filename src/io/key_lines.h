#ifndef GB_IO_KEY_LINES_H
#define GB_IO_KEY_LINES_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"

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
bool gb_key_lines_init(struct gb_key_lines *lines, const char *path, const char *text,
                       size_t length, struct gb_error *err);
void gb_key_lines_finish(struct gb_key_lines *lines); /* zeroed is fine */

/* Line of group.key, or of [group] for key = NULL; NULL when there is none. */
const struct gb_key_line *gb_key_lines_find(const struct gb_key_lines *lines,
                                            const char *group, const char *key);

/* Offset at which a new key of the group goes: behind its last key or its header; text of
 * `length` bytes ends there when the group does not exist. */
size_t gb_key_lines_group_end(const struct gb_key_lines *lines, const char *group,
                              size_t length);

#endif
