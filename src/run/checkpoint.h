#ifndef GB_RUN_CHECKPOINT_H
#define GB_RUN_CHECKPOINT_H

#include <stdbool.h>

#include "base/record.h"
#include "run/experiment.h"

/* The whole state of an experiment as a record: gb_experiment_resume on that record
 * continues with the same bits as the experiment itself.
 *
 * Taken only right after GB_STEP_POINT.  There the relaxer has only the state that it
 * records, the state to return to after unloading is the present one, and no event has
 * been taken yet.  Each loading mode records its members in its `record`. */

/* Fills the record, using its memory again.  Errors: GB_ERR_MEMORY. */
bool gb_checkpoint_take(struct gb_experiment *experiment, struct gb_record *record,
                        struct gb_error *err);

/* The part of gb_experiment_resume that belongs to no loading mode. */
bool gb_checkpoint_load(struct gb_experiment *experiment, struct gb_record *record,
                        struct gb_error *err);

/* Step number of the point at which a record was taken; -1 when it has none. */
int64_t gb_checkpoint_step(const struct gb_record *record);

#endif
