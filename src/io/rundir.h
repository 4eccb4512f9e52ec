#ifndef GB_IO_RUNDIR_H
#define GB_IO_RUNDIR_H

#include <stdbool.h>

#include "greenbody/status.h"

/* The directory of a run as a place: may a run begin there, make it, take it back.  What
 * is inside the files is the store's business. */
struct gb_rundir {
    char *path;
    char *made; /* topmost directory that was created for it, NULL when path existed */
    int lock;   /* open directory, locked as long as the run is written */
    char *held; /* another path to it, through the lock: it leads there even when the
                   directory has another name by now.  Where the system has none: path */
};

enum gb_rundir_mode {
    GB_RUNDIR_KEEP,   /* a run that is there already is an error */
    GB_RUNDIR_REPLACE /* it is removed, unless it is still being written */
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

/* Locks the directory of a run that was begun before.  Errors: GB_ERR_INPUT when it is no
 * such directory or another process writes there; GB_ERR_MACHINE.  A lock is the
 * process's own: one that was killed has left none. */
bool gb_rundir_open(struct gb_rundir *dir, const char *path, struct gb_error *err);

/* Is the directory still the one that was locked?  Errors: GB_ERR_MACHINE when it was
 * moved, removed or replaced by another. */
bool gb_rundir_stands(const struct gb_rundir *dir, struct gb_error *err);

/* The result of writing a file by its held path; its error is told of the name that the
 * user knows, or that the directory does not stand any more. */
bool gb_rundir_result(const struct gb_rundir *dir, bool good, struct gb_error *err);

/* Is a process writing there now? */
bool gb_rundir_busy(const char *path);

/* Ends the lock and frees; the directory stays. */
void gb_rundir_finish(struct gb_rundir *dir);

/* Takes back what was begun: removes the files of the run and the directories that were
 * made, then finishes. */
void gb_rundir_unmake(struct gb_rundir *dir);

#endif
