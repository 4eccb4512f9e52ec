#ifndef GB_IO_STATE_RECORD_H
#define GB_IO_STATE_RECORD_H

#include "base/record.h"
#include "io/state.h"
#include "pack/die/die.h"
#include "scene/model.h"

/* The packing that a record was taken of, for pictures and other programs.  Touches no
 * experiment: it can be made in another thread. */
bool gb_state_record(struct gb_state **out, const struct gb_record *record,
                     const struct gb_params *params, const struct gb_model *model,
                     struct gb_error *err);

/* Walls of a die, and half the width of the box around them and what lies beside the bore. */
void gb_state_record_walls(struct gb_state *state, const struct gb_die *die);
double gb_state_record_half_width(const double (*position)[4], int64_t count,
                                  const struct gb_die *die);
/* Axes along which a scene is pressed, and the constants of its attraction. */
void gb_state_record_model(struct gb_state *state, const struct gb_model *model);

/* The same for gb_state_write alone: what is written row by row is not copied.  The record
 * must stay as it is until the state is destroyed. */
bool gb_state_record_to_write(struct gb_state **out, const struct gb_record *record,
                              const struct gb_params *params,
                              const struct gb_model *model, struct gb_error *err);

/* The pairs and the optional arrays of a periodic cell, made of the record of a run row by
 * row, so that a state is written without a copy of them. */
struct gb_state_source;

void gb_state_record_destroy(struct gb_state_source *source); /* NULL is fine */

/* Arrays are named by the offset of their pointer in gb_state; a NULL source has none. */
bool gb_state_record_has(const struct gb_state_source *source, size_t member);

/* The same in memory of the source, until the next call: as many as gb_hdf_slab_rows. */
const void *gb_state_record_rows(const struct gb_state *state, size_t member,
                                 int64_t begin, int64_t end);

#endif
