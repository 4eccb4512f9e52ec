#ifndef GB_IO_STORE_H
#define GB_IO_STORE_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/curve.h"
#include "greenbody/params.h"
#include "greenbody/snapshot.h"
#include "io/rundir.h"
#include "io/state.h"

/* The files of a run directory: preset.ini, curve.csv, events.log, status.json,
 * state.h5 (docs/manual.md).  Each file is either appended by whole lines or replaced
 * atomically.  After the directory was moved, removed or replaced, nothing more is
 * written: GB_ERR_MACHINE. */
struct gb_store;

/* Creates the directory and writes preset.ini.  An existing run is an error
 * (GB_ERR_INPUT), or with GB_RUNDIR_REPLACE its files are removed first.  A directory
 * with other files is an error. */
bool gb_store_create(struct gb_store **out, const char *directory,
                     const struct gb_params *params, enum gb_rundir_mode mode,
                     struct gb_error *err);

/* The part of the files that belongs to a checkpoint: points, bytes of complete lines,
 * and the checksum of curve.csv; 0: unknown. */
struct gb_store_extent {
    int64_t points, curve_bytes, events_bytes, curve_sum;
};
struct gb_store_extent gb_store_extent(const struct gb_store *store);

/* Reopens the files of a run that continues in dir, which is locked.  The store takes
 * ownership of dir, even on error.  Truncates curve.csv and events.log to the extent;
 * NULL: to nothing.  Errors: GB_ERR_INPUT for shorter files and for a modified curve. */
bool gb_store_reopen(struct gb_store **out, struct gb_rundir *dir,
                     const struct gb_params *params, const struct gb_store_extent *extent,
                     struct gb_error *err);
void gb_store_destroy(struct gb_store *store); /* NULL is fine */
/* Destroys the store and removes the files and directories that it created, for a run
 * that could not start.  NULL is fine. */
void gb_store_discard(struct gb_store *store);
const char *gb_store_directory(const struct gb_store *store);
/* The directory, for other files, which are written by its held path. */
const struct gb_rundir *gb_store_rundir(const struct gb_store *store);

bool gb_store_point(struct gb_store *store, const struct gb_point *point,
                    struct gb_error *err);
bool gb_store_event(struct gb_store *store, int64_t step, const char *text,
                    struct gb_error *err);
/* Does curve.csv of a run directory match its checkpoint?  Errors: GB_ERR_INPUT. */
bool gb_store_check_curve(const char *directory, const struct gb_store_extent *extent,
                          struct gb_error *err);
/* Rewrites status.json. */
bool gb_store_status(struct gb_store *store, const struct gb_snapshot *snapshot,
                     struct gb_error *err);
/* The same in two steps: the text (g_free), then writing the file, which waits for the
 * disk and may run in the thread of gb_store_state. */
char *gb_store_status_text(const struct gb_store *store,
                           const struct gb_snapshot *snapshot);
bool gb_store_put_status(const struct gb_store *store, const char *text,
                         struct gb_error *err);
/* Replaces state.h5.  The previous file becomes state-before.h5, from which `greenbody
 * verify` repeats the steps up to state.h5.  Rows and events are synced first.  This
 * function may run in another thread than the others, one call at a time. */
bool gb_store_state(const struct gb_store *store, const struct gb_state *state,
                    const struct gb_record *record, struct gb_error *err);
/* Flushes and syncs; call it before the last status. */
bool gb_store_sync(struct gb_store *store, struct gb_error *err);

/* A free directory name in folder, based on the name of the preset. g_free. */
char *gb_store_new_directory(const char *folder, const char *preset_path);
/* A free directory name for a run without --out: "runs/<preset>-<k>". g_free. */
char *gb_store_default_directory(const char *preset_path);

#endif
