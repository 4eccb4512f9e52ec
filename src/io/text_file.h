#ifndef GB_IO_TEXT_FILE_H
#define GB_IO_TEXT_FILE_H

#include <stdbool.h>
#include <stddef.h>

#include <glib.h>

#include "greenbody/status.h"

enum gb_text_file_path {
    GB_TEXT_FILE_OF_RUN, /* a file of a run directory: a new file is not synced */
    GB_TEXT_FILE_TYPED   /* a path given by the user: always synced */
};

/* Replaces a text file as a whole: after a crash the old or the new content exists, or
 * no file if there was none.  Errors: GB_ERR_MACHINE naming path and reason;
 * GB_ERR_INPUT if a path given by the user is a folder or its folder does not exist. */
bool gb_text_file_replace(const char *path, const char *text, size_t length,
                          enum gb_text_file_path kind, struct gb_error *err);

/* Appends text and a newline to lines; control characters become '?'. */
void gb_text_file_add_line(GString *lines, const char *text);

#endif
