#ifndef GB_IO_STATE_STATE_RECORD_H
#define GB_IO_STATE_STATE_RECORD_H

#include "base/record.h"
#include "io/state/state.h"
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

#endif
