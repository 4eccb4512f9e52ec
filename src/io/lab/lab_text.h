#ifndef GB_IO_LAB_LAB_TEXT_H
#define GB_IO_LAB_LAB_TEXT_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"

/* The text of a file as UTF-8, without a byte order mark. */
struct gb_lab_text {
    char *text;           /* NUL-terminated; g_free */
    size_t length;        /* bytes */
    const char *encoding; /* of the file */
    bool guessed;         /* no mark in the file tells it */
};

enum { GB_LAB_TEXT_BYTES_MAX = 1 << 25 };

/* UTF-8 and UTF-16, with a byte order mark or recognised by their bytes; what is neither
 * is taken for Windows-1252, where the decimals and most units are the same in all
 * encodings of one byte.  Errors: GB_ERR_INPUT (binary content, workbooks), GB_ERR_MACHINE,
 * GB_ERR_MEMORY. */
bool gb_lab_text_read(struct gb_lab_text *out, const char *path, struct gb_error *err);
void gb_lab_text_finish(struct gb_lab_text *text); /* zeroed is fine */

enum { GB_LAB_TEXT_SHOWN = 64 };

/* Text of the file in one short line for messages: at most 40 characters, blanks for
 * control characters.  Returns buffer. */
const char *gb_lab_text_show(const char *text, char buffer[GB_LAB_TEXT_SHOWN]);

#endif
