#ifndef GB_IO_RUNDIR_H
#define GB_IO_RUNDIR_H

#include <glib.h>
#include <stdbool.h>

#include "greenbody/status.h"
#include "io/lock.h"

/* The directory of a run: checked, made, locked, removed.  io/store.h writes its files. */
struct gb_rundir {
    char *path;
    char *made; /* topmost directory that was created for it, NULL when path existed */
    struct gb_lock lock; /* as long as the run is written */
    char *held; /* path through the open directory (/proc/self/fd): valid even after the
                   directory was renamed.  Systems without it: path */
};
#define GB_RUNDIR_NONE ((struct gb_rundir){.lock = GB_LOCK_NONE})

enum gb_rundir_mode {
    GB_RUNDIR_KEEP,    /* an existing run is an error */
    GB_RUNDIR_REPLACE, /* an existing run is removed, unless it is still being written */
    GB_RUNDIR_MISSING /* the same, but one that is done is an error, seen under the lock */
};

/* Could a run begin at path?  Changes nothing: a wrong --out is reported before minutes of
 * packing.
 *
 * Errors: GB_ERR_INPUT (a file, an existing run, foreign files, a run under way),
 * GB_ERR_MACHINE (the parent cannot be written). */
bool gb_rundir_check(const char *path, enum gb_rundir_mode mode, struct gb_error *err);

/* Checks, makes the directory and its parents, locks it and removes the files of an old
 * run.  On error nothing is left to finish. */
bool gb_rundir_make(struct gb_rundir *dir, const char *path, enum gb_rundir_mode mode,
                    struct gb_error *err);

/* Locks the directory of an existing run.  Errors: GB_ERR_INPUT when it is no run
 * directory or another process writes there; GB_ERR_MACHINE.  A lock ends with its
 * process, also when that is killed. */
bool gb_rundir_open(struct gb_rundir *dir, const char *path, struct gb_error *err);

/* Is the directory still the one that was locked?  Errors: GB_ERR_MACHINE when it was
 * moved, removed or replaced by another. */
bool gb_rundir_check_identity(const struct gb_rundir *dir, struct gb_error *err);

/* The result of writing a file by its held path.  The error names the path as the user
 * gave it, or says that the directory was moved. */
bool gb_rundir_result(const struct gb_rundir *dir, bool good, struct gb_error *err);

/* Is a process writing there now? */
bool gb_rundir_busy(const char *path);
/* Which one, for people; see gb_lock_holder. */
char *gb_rundir_holder(const char *path);

/* Ends the lock and frees; the directory stays. */
void gb_rundir_finish(struct gb_rundir *dir);

/* Removes the files of the run and the directories that were made for it, then
 * finishes. */
void gb_rundir_remove(struct gb_rundir *dir);

/* Adds a value of a key to the name of a directory, so that two values have two names.  ASCII
 * letters, digits, '.', '+' and '-' stay.  Of free text every other byte becomes "~" and two
 * hexadecimal digits, of a number with its unit it is left out.  More than 60 characters
 * become the first 40, "~~" and a checksum. */
void gb_rundir_name_value(GString *name, const char *value, bool free_text);

/* Refuses a file of a run as the target of another command: a name that runs write, in a
 * directory with a preset.ini, or in its folder of snapshots.  Errors: GB_ERR_INPUT. */
bool gb_rundir_files_protect(const char *path, struct gb_error *err);

/* Removes temporary files that a killed engine has left; the caller holds the lock. */
void gb_rundir_files_tidy(const char *path);

#endif
