#ifndef GB_BASE_FILE_H
#define GB_BASE_FILE_H

#include <glib.h>
#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

#include "greenbody/status.h"

/* Replaces a file as a whole: temporary file in the same folder, synced, renamed, folder
 * synced.  After a crash or a full disk the old content is still there and no temporary
 * file is left by a failed write.
 *
 * Errors: GB_ERR_MACHINE naming path and reason; GB_ERR_INPUT when path is something
 * other than a regular file (a rename would turn /dev/null into one). */
bool gb_file_replace(const char *path, const void *data, size_t size,
                     struct gb_error *err);

/* The same with content that is in a temporary file of the same folder already: its first
 * `size` bytes.  The temporary file is left where that fails. */
bool gb_file_replace_by(const char *path, const char *temporary, int fd, size_t size,
                        struct gb_error *err);

/* Why GLib could not write a file, without the name of its temporary one. */
const char *gb_file_reason(const GError *error);

/* The checks of gb_file_replace that can be made before the work: path is absent or a
 * regular file, and its folder exists and can be written. */
bool gb_file_check_target(const char *path, struct gb_error *err);

/* Called before every write: false with errno ENOSPC when the hook below
 * says so. */
bool gb_file_may_write(void);

/* Writes all of data at the offset; false with errno and with the file cut back to the
 * offset where that fails: a full disk takes a part before it says so. */
bool gb_file_append_at(int fd, off_t at, const char *data, size_t size);

/* Two names of one place, seen from the working directory; links are not followed. */
bool gb_file_is_same(const char *a, const char *b);

/* Test hook: the k-th write from now on fails as on a full disk (k = 1 is the next one);
 * 0 switches the hook off.  Returns how many were left before: 0 after the failure.
 * Thread-safe. */
long gb_file_fail_after(long k);

/* The bytes of a regular file of at most `most` bytes, and a NUL behind them.  *text is
 * for gb_alloc_free.  Errors: GB_ERR_INPUT (absent, no regular file, too long),
 * GB_ERR_MACHINE, GB_ERR_MEMORY. */
bool gb_file_read(const char *path, size_t most, char **text, size_t *length,
                  struct gb_error *err);

/* Descriptor of a regular file for reading; -1 with err as above.  Pipes, devices and
 * folders are refused without waiting for their other end. */
int gb_file_open(const char *path, struct gb_error *err);

#endif
