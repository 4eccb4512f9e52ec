#ifndef GB_IO_RUNDIR_FILES_H
#define GB_IO_RUNDIR_FILES_H

#include <glib.h>

#include "greenbody/status.h"

/* The files that a run writes in its directory, by name. */

/* Name of the first entry that no run writes (g_free), NULL when there is none; *entries
 * is increased by the number of entries seen. */
char *gb_rundir_files_foreign(const char *path, int *entries, GError **failure);

/* Refuses a file of a run as the target of another command: a name that runs write, in a
 * directory with a preset.ini, or in its folder of snapshots.  Errors: GB_ERR_INPUT. */
bool gb_rundir_files_protect(const char *path, struct gb_error *err);

/* Removes the files of a run; entries of other names stay. */
bool gb_rundir_files_remove(const char *path, struct gb_error *err);

/* Removes temporary files that a killed engine has left; the caller holds the lock. */
void gb_rundir_files_tidy(const char *path);

#endif
