#ifndef GB_IO_LINE_FILE_H
#define GB_IO_LINE_FILE_H

#include <stdbool.h>
#include <stdint.h>
#include <sys/types.h>
#include <time.h>

#include <glib.h>

#include "greenbody/status.h"

/* A text file that grows by whole lines: curve.csv and events.log.  Its text is kept in
 * memory too: where another program has changed, cut, replaced or removed the file, it is
 * written again. */
struct gb_line_file {
    char *path;
    int fd;
    off_t length;             /* of the whole lines so far */
    GString *text;            /* the same lines */
    uint64_t sum;             /* FNV-1a over them */
    struct timespec modified; /* after the last write */
    bool restored;            /* was written again; for the caller to tell and to reset */
};

/* Makes the file, which must not exist.  gb_line_file_close is due in any case. */
bool gb_line_file_open(struct gb_line_file *rows, const char *directory, const char *name,
                       struct gb_error *err);
/* Opens a file that was written before and cuts it to its first `length` bytes, which
 * must be whole lines.  The file is cut by gb_line_file_cut.  Errors: GB_ERR_INPUT when it
 * is shorter or cut in a line; GB_ERR_MACHINE, GB_ERR_MEMORY. */
bool gb_line_file_reopen(struct gb_line_file *rows, const char *directory,
                         const char *name, off_t length, struct gb_error *err);
void gb_line_file_close(struct gb_line_file *rows);

/* Removes what is behind `length`: when the lines before were found to be right. */
bool gb_line_file_cut(const struct gb_line_file *rows, struct gb_error *err);

/* Is the file as it was left?  Else it is written again.  Only its size, place and time are
 * looked at, unless `whole`. */
bool gb_line_file_check(struct gb_line_file *rows, bool whole, struct gb_error *err);

/* Appends text, or leaves the file as it was: a full disk must not leave half a row.
 * gb_line_file_check comes first. */
bool gb_line_file_append(struct gb_line_file *rows, const char *text,
                         struct gb_error *err);

/* Adds text and a newline to line; control characters become '?'. */
void gb_line_file_add_text(GString *line, const char *text);

/* Waits until all of it is on the disk. */
bool gb_line_file_sync(const struct gb_line_file *rows, struct gb_error *err);

#endif
