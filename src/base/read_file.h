#ifndef GB_BASE_READ_FILE_H
#define GB_BASE_READ_FILE_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"

/* The bytes of a regular file of at most `most` bytes, and a NUL behind them.  *text is
 * for gb_alloc_free.  Errors: GB_ERR_INPUT (absent, no regular file, too long),
 * GB_ERR_MACHINE, GB_ERR_MEMORY. */
bool gb_read_file(const char *path, size_t most, char **text, size_t *length,
                  struct gb_error *err);

/* Descriptor of a regular file for reading; -1 with err as above.  Pipes, devices and
 * folders are refused without waiting for their other end. */
int gb_read_file_open(const char *path, struct gb_error *err);

#endif
