#ifndef GB_IO_FOLLOW_H
#define GB_IO_FOLLOW_H

#include <stdbool.h>

#include "greenbody/curve.h"
#include "greenbody/params.h"
#include "greenbody/snapshot.h"

/* A run that another process computes, seen through its directory: status.json and
 * curve.csv, read only. */

/* Preset of a run directory.  Errors: GB_ERR_INPUT, GB_ERR_MACHINE. */
bool gb_follow_params(const char *directory, struct gb_params *params,
                      struct gb_error *err);

/* The process that computes a run. */
struct gb_follow_engine {
    long long pid;
    bool here; /* on this machine */
};

/* Reads status.json.  It does not tell whether the engine still runs; the lock of the
 * directory does (gb_rundir_busy). */
bool gb_follow_status(const char *directory, struct gb_snapshot *snapshot,
                      struct gb_follow_engine *engine, struct gb_error *err);

/* Has the process ended, on this machine?  False if this cannot be determined. */
bool gb_follow_engine_gone(const struct gb_follow_engine *engine);

/* Does the process have no controlling terminal, because it was closed or never
 * existed?  False if this cannot be determined. */
bool gb_follow_engine_detached(const struct gb_follow_engine *engine);

/* Asks the engine of an active run to write a checkpoint and stop.  Errors:
 * GB_ERR_INPUT if it is on another machine or is not the process that status.json
 * names. */
bool gb_follow_request_stop(const char *directory, struct gb_error *err);

#endif
