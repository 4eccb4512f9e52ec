#ifndef GB_RUN_CHECKPOINT_H
#define GB_RUN_CHECKPOINT_H

#include <stdbool.h>

#include "base/record.h"
#include "run/experiment.h"

/* An experiment into a record and back, whole: gb_experiment_resume on that record goes
 * on to the last bit as the experiment itself.
 *
 * Taken only right after GB_STEP_POINT.  There the relaxer remembers only what it
 * lists itself, the way back is the present state, and all events are due to be taken:
 * little is left to keep.
 *
 * A new kind of scene adds the function that lists its members (as gb_quasistatic_record does)
 * and calls it in gb_checkpoint_take and gb_checkpoint_load. */

/* Fills the record, using its memory again.  Errors: GB_ERR_MEMORY; GB_ERR_INPUT for a
 * kind of scene that has no checkpoints. */
bool gb_checkpoint_take(struct gb_experiment *experiment, struct gb_record *record,
                        struct gb_error *err);

/* May a run of these parameters be checkpointed? */
bool gb_checkpoint_known(const struct gb_params *params);

/* The two halves of gb_experiment_resume: the world before the programme begins, and
 * everything else after. */
bool gb_checkpoint_load_world(struct gb_experiment *experiment, struct gb_record *record,
                              struct gb_error *err);
bool gb_checkpoint_load(struct gb_experiment *experiment, struct gb_record *record,
                        struct gb_error *err);

/* Step number of the point at which a record was taken; -1 when it has none. */
int64_t gb_checkpoint_step(const struct gb_record *record);

#endif
