#ifndef GB_IO_STATE_STATE_SOURCE_H
#define GB_IO_STATE_STATE_SOURCE_H

#include "base/record.h"
#include "io/state/state.h"
#include "scene/model.h"

/* The pairs and the optional arrays of a periodic cell, made of the record of a run row by
 * row, so that a state is written without a copy of them. */
struct gb_state_source;

/* The source of a state whose count, pair_count, cell, positions and radii are set; record
 * and model must outlive it.  Errors: GB_ERR_MEMORY, GB_ERR_INPUT for an item that is
 * missing or of another shape. */
bool gb_state_source_create(struct gb_state *state, const struct gb_record *record,
                            const struct gb_model *model, struct gb_error *err);
void gb_state_source_destroy(struct gb_state_source *source); /* NULL is fine */

/* Arrays are named by the offset of their pointer in gb_state; a NULL source has none. */
bool gb_state_source_has(const struct gb_state_source *source, size_t member);

/* Rows begin .. end - 1 of an array that it has. */
void gb_state_source_fill(const struct gb_state *state, size_t member, int64_t begin,
                          int64_t end, void *to);

/* The same in memory of the source, until the next call: as many as gb_hdf_slab_rows. */
const void *gb_state_source_rows(const struct gb_state *state, size_t member,
                                 int64_t begin, int64_t end);

#endif
