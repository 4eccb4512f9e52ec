#ifndef GB_RUN_CHANGE_H
#define GB_RUN_CHANGE_H

#include "run/experiment.h"

/* Changes of a run under way (scene/field/changes.h), applied.
 *
 * The state passes through a record (run/checkpoint.h) into a world of the changed model,
 * whether the run changes on its own, is resumed there, or goes on as a what-if of
 * another run: the same bits on all three ways. */

/* Called after each recorded point: what is due there takes effect; the next strain step
 * obeys it.  Errors: GB_ERR_INPUT for a step on an unloading branch, or for histories the
 * contacts do not carry (bridges or friction where there were none); GB_ERR_MEMORY. */
bool gb_change_apply(struct gb_experiment *experiment, struct gb_error *err);

/* The rest of a resume: when a change was due at the step of the record, what the record
 * says about the next strain step may still be the order of before. */
bool gb_change_order(struct gb_experiment *experiment, struct gb_error *err);

#endif
