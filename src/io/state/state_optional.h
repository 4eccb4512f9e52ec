#ifndef GB_IO_STATE_STATE_OPTIONAL_H
#define GB_IO_STATE_STATE_OPTIONAL_H

#include "base/record.h"
#include "hdf/hdf.h"
#include "io/state/state.h"

/* The arrays that a state may lack: velocities exist in scenes with time, resultants and
 * contact radii in states of a run.  With them the numbers of pictures. */

/* Memory for an array of the state, zeroed: &state->velocity, ... */
bool gb_state_optional_allocate(struct gb_state *state, double **member,
                                struct gb_error *err);
void gb_state_optional_free(struct gb_state *state);

/* Those that the record of a run has.  The rotations of a periodic cell are arcs there,
 * the diameter times the angle: the radii of the state must be set.  Errors:
 * GB_ERR_MEMORY, GB_ERR_INPUT for an item of another shape. */
bool gb_state_optional_take(struct gb_state *state, const struct gb_record *record,
                            struct gb_error *err);

/* The same without a copy, for sources of a periodic cell: the shapes of all items; is
 * there an item for the array at an offset of gb_state; its rows begin .. end - 1. */
bool gb_state_optional_check(const struct gb_state *state, const struct gb_record *record,
                             struct gb_error *err);
bool gb_state_optional_has(const struct gb_record *record, size_t member);
void gb_state_optional_fill(const struct gb_state *state, const struct gb_record *record,
                            size_t member, int64_t begin, int64_t end, double *to);

/* Datasets of the state's file with a checksum of their own. */
bool gb_state_optional_write(const struct gb_state *state, struct gb_hdf *file,
                             struct gb_error *err);
/* Reads them; radii and sizes of the state must be set.
 * Errors: GB_ERR_MEMORY, GB_ERR_INPUT naming path and dataset. */
bool gb_state_optional_read(struct gb_state *state, struct gb_hdf *file, const char *path,
                            struct gb_error *err);

#endif
