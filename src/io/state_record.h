#ifndef GB_IO_STATE_RECORD_H
#define GB_IO_STATE_RECORD_H

#include "base/record.h"
#include "io/state.h"
#include "pack/die/die.h"
#include "scene/model.h"

/* The packing of a record, for pictures and other programs.  It uses no experiment, so
 * it may run in another thread. */
bool gb_state_record(struct gb_state **out, const struct gb_record *record,
                     const struct gb_params *params, const struct gb_model *model,
                     struct gb_error *err);

/* Sets the walls of a die, and the box around them with the space next to the bore. */
void gb_state_record_walls(struct gb_state *state, const struct gb_die *die);
double gb_state_record_half_width(const double (*position)[4], int64_t count,
                                  const struct gb_die *die);
/* Sets the axes along which a scene is pressed and the constants of its attraction. */
void gb_state_record_model(struct gb_state *state, const struct gb_model *model);

/* The same for gb_state_write only: arrays that are written row by row are not copied.
 * The record must not change until the state is destroyed. */
bool gb_state_record_to_write(struct gb_state **out, const struct gb_record *record,
                              const struct gb_params *params,
                              const struct gb_model *model, struct gb_error *err);

/* The pairs and optional arrays of a periodic cell, generated row by row from the
 * record of a run, so that a state is written without copying them. */
struct gb_state_source;

void gb_state_record_destroy(struct gb_state_source *source); /* NULL is fine */

/* Has the source the array whose pointer is at this offset of gb_state?  A NULL source
 * has none. */
bool gb_state_record_has(const struct gb_state_source *source, size_t member);

/* Rows of this array in memory of the source, valid until the next call; at most
 * gb_hdf_slab_rows. */
const void *gb_state_record_rows(const struct gb_state *state, size_t member,
                                 int64_t begin, int64_t end);

#endif
