#ifndef GB_RUN_ROWS_H
#define GB_RUN_ROWS_H

#include <stdbool.h>
#include <sys/types.h>

#include "greenbody/status.h"

/* A text file that grows by whole lines: curve.csv and events.log. */
struct gb_rows {
    char *path;
    int fd;
    off_t length; /* of the whole lines so far */
};

/* Makes the file, which must not exist.  gb_rows_close is due in any case. */
bool gb_rows_open(struct gb_rows *rows, const char *directory, const char *name,
                  struct gb_error *err);
/* Opens a file that was written before and cuts it to its first `length` bytes, which
 * must be whole lines.  Errors: GB_ERR_INPUT when it is shorter or cut in a line;
 * GB_ERR_MACHINE. */
bool gb_rows_reopen(struct gb_rows *rows, const char *directory, const char *name,
                    off_t length, struct gb_error *err);
void gb_rows_close(struct gb_rows *rows);

/* Appends text, or leaves the file as it was: a full disk must not leave half a row. */
bool gb_rows_append(struct gb_rows *rows, const char *text, struct gb_error *err);

/* Waits until all of it is on the disk. */
bool gb_rows_sync(const struct gb_rows *rows, struct gb_error *err);

#endif
