#ifndef GB_IO_RUNDIR_H
#define GB_IO_RUNDIR_H

#include <glib.h>
#include <stdbool.h>

#include "greenbody/status.h"
#include "io/lock.h"

/* The directory of a run: checking, creation, locking, removal. io/store.h writes its
 * files. */
struct gb_rundir {
    char *path;
    char *made;          /* topmost directory created for it; NULL if path existed */
    struct gb_lock lock; /* while the run is being written */
    char *held; /* path through the open directory (/proc/self/fd): valid even after the
                   directory was renamed.  Systems without it: path */
};
#define GB_RUNDIR_NONE ((struct gb_rundir){.lock = GB_LOCK_NONE})

enum gb_rundir_mode {
    GB_RUNDIR_KEEP,    /* an existing run is an error */
    GB_RUNDIR_REPLACE, /* remove an existing run, unless it is being written */
    GB_RUNDIR_MISSING  /* the same, but a completed run is an error */
};

/* Can a run start at path?  Changes nothing, so that a wrong --out is reported before
 * minutes of packing.
 *
 * Errors: GB_ERR_INPUT (a file, an existing run, foreign files, an active run),
 * GB_ERR_MACHINE (the parent cannot be written). */
bool gb_rundir_check(const char *path, enum gb_rundir_mode mode, struct gb_error *err);

/* Checks and creates the directory with its parents, locks it and removes the files of
 * an old run.  On error nothing needs to be finished. */
bool gb_rundir_make(struct gb_rundir *dir, const char *path, enum gb_rundir_mode mode,
                    struct gb_error *err);

/* Locks the directory of an existing run.  Errors: GB_ERR_INPUT if it is not a run
 * directory or another process writes there; GB_ERR_MACHINE.  The lock ends with its
 * process, even if that is killed. */
bool gb_rundir_open(struct gb_rundir *dir, const char *path, struct gb_error *err);

/* Is the directory still the one that was locked?  Errors: GB_ERR_MACHINE if it was
 * moved, removed or replaced. */
bool gb_rundir_check_identity(const struct gb_rundir *dir, struct gb_error *err);

/* Passes on the result of writing a file by its held path.  The error names the path as
 * given by the user, or reports that the directory was moved. */
bool gb_rundir_result(const struct gb_rundir *dir, bool good, struct gb_error *err);

/* Is a process writing there now? */
bool gb_rundir_busy(const char *path);
/* Describes this process for the user; see gb_lock_holder. */
char *gb_rundir_holder(const char *path);

/* Releases the lock and frees; the directory stays. */
void gb_rundir_finish(struct gb_rundir *dir);

/* Removes the files of the run and the directories that were made for it, then
 * finishes. */
void gb_rundir_remove(struct gb_rundir *dir);

/* Appends a value of a key to a directory name; different values get different names.
 * ASCII letters, digits, '.', '+' and '-' stay.  Other bytes of free text become "~"
 * and two hexadecimal digits; those of a number with its unit are dropped.  Values
 * longer than 60 characters become their first 40, "~~" and a checksum. */
void gb_rundir_name_value(GString *name, const char *value, bool free_text);

/* Rejects a file of a run as the output of another command: a file name of runs in a
 * directory with a preset.ini, or any file in its folder of snapshots.  Errors:
 * GB_ERR_INPUT. */
bool gb_rundir_files_protect(const char *path, struct gb_error *err);

/* Removes temporary files left by a killed engine.  The caller holds the lock. */
void gb_rundir_files_tidy(const char *path);

#endif
