#ifndef GB_BASE_FILE_H
#define GB_BASE_FILE_H

#include <glib.h>
#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

#include "greenbody/status.h"

/* Replaces a file as a whole: writes and syncs a temporary file in the same folder,
 * renames it and syncs the folder.  After a crash or on a full disk the old content
 * remains, and a failed write leaves no temporary file.
 *
 * Errors: GB_ERR_MACHINE naming path and reason; GB_ERR_INPUT if path is not a regular
 * file (a rename would turn /dev/null into one). */
bool gb_file_replace(const char *path, const void *data, size_t size,
                     struct gb_error *err);

/* The same with content that is already in a temporary file of the same folder: its
 * first `size` bytes.  On failure the temporary file remains. */
bool gb_file_replace_by(const char *path, const char *temporary, int fd, size_t size,
                        struct gb_error *err);

/* Why GLib could not write a file, without the name of its temporary file. */
const char *gb_file_reason(const GError *error);

/* Makes the checks of gb_file_replace that are possible before the work: path is absent
 * or a regular file, and its folder exists and is writable. */
bool gb_file_check_target(const char *path, struct gb_error *err);

/* To be called before every write.  False with errno ENOSPC if the test hook below
 * simulates a full disk. */
bool gb_file_may_write(void);

/* Writes all of data at the offset.  False with errno on failure; the file is then
 * truncated to the offset, because a full disk writes a part before it fails. */
bool gb_file_append_at(int fd, off_t at, const char *data, size_t size);

/* Do two paths name the same place, relative to the working directory?  Links are not
 * followed. */
bool gb_file_is_same(const char *a, const char *b);

/* Test hook: the k-th write from now on fails as on a full disk (k = 1 is the next
 * one); 0 disables the hook.  Returns the previous count of remaining writes, 0 after
 * the failure.  Thread-safe. */
long gb_file_fail_after(long k);

/* Reads a regular file of at most `most` bytes and appends a NUL.  Free *text with
 * gb_alloc_free.  Errors: GB_ERR_INPUT (absent, not a regular file, too long),
 * GB_ERR_MACHINE, GB_ERR_MEMORY. */
bool gb_file_read(const char *path, size_t most, char **text, size_t *length,
                  struct gb_error *err);

/* Opens a regular file for reading and returns its descriptor, or -1 with err as above.
 * Pipes, devices and folders are refused without waiting for their other end. */
int gb_file_open(const char *path, struct gb_error *err);

#endif
