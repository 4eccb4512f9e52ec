#ifndef GB_RUN_STORE_H
#define GB_RUN_STORE_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/curve.h"
#include "greenbody/params.h"
#include "greenbody/snapshot.h"
#include "run/state.h"

/* A run directory (interface.md): preset.ini, curve.csv, events.log, status.json,
 * state.h5. Every file is either appended line by line or replaced atomically. */
struct gb_store;

/* Makes the directory.  An existing run directory is refused (GB_ERR_INPUT) unless force,
 * which removes the files of the old run first; a directory with foreign files is never
 * touched.  Writes preset.ini. */
bool gb_store_create(struct gb_store **out, const char *directory,
                     const struct gb_params *params, bool force, struct gb_error *err);
void gb_store_destroy(struct gb_store *store); /* NULL is fine */
/* Destroys and removes the files and directories that were made: for a run that could not
 * begin.  NULL is fine. */
void gb_store_discard(struct gb_store *store);
const char *gb_store_directory(const struct gb_store *store);

bool gb_store_point(struct gb_store *store, const struct gb_point *point,
                    struct gb_error *err);
bool gb_store_event(struct gb_store *store, int64_t step, const char *text,
                    struct gb_error *err);
/* Rewrites status.json. */
bool gb_store_status(struct gb_store *store, const struct gb_snapshot *snapshot,
                     struct gb_error *err);
bool gb_store_state(struct gb_store *store, const struct gb_state *state,
                    struct gb_error *err);
/* Flushes and syncs; call before the last status. */
bool gb_store_sync(struct gb_store *store, struct gb_error *err);

/* A free directory name for a run without --out: "runs/<preset>-<k>". Caller g_frees. */
char *gb_store_default_directory(const char *preset_path);

#endif
