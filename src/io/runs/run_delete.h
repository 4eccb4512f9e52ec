#ifndef GB_IO_RUNS_RUN_DELETE_H
#define GB_IO_RUNS_RUN_DELETE_H

#include <stdbool.h>

#include "greenbody/status.h"

/* Number of files in a directory tree; symbolic links are not followed. */
int gb_run_delete_count(const char *directory);

/* Removes the directory of a run with all that is in it, under the lock of the run: never
 * while a process computes it.  Symbolic links are removed, not followed.
 *
 * Errors: GB_ERR_INPUT (no run directory, a run under way), GB_ERR_MACHINE. */
bool gb_run_delete(const char *directory, struct gb_error *err);

#endif
