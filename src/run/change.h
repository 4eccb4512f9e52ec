#ifndef GB_RUN_CHANGE_H
#define GB_RUN_CHANGE_H

#include "run/experiment.h"

/* Changes of a run under way (scene/field/changes.h), applied.
 *
 * The state passes through a record (run/checkpoint.h) into a world of the changed model,
 * whether the run changes under way, is resumed there, or continues as a what-if of
 * another run: the same bits in all three cases. */

/* Called after each recorded point: changes that are due there apply from the next strain
 * step on.  Errors: GB_ERR_INPUT for a step on an unloading branch, or for histories the
 * contacts do not carry (bridges or friction where there were none); GB_ERR_MEMORY. */
bool gb_change_apply(struct gb_experiment *experiment, struct gb_error *err);

/* Whether a run can continue after a recorded step with these changed parameters instead.
 * Errors: GB_ERR_INPUT as above, and for a change of precision (a path that shears after
 * one that does not, unless numerics.precision = double). */
bool gb_change_allowed(const struct gb_params *params, const struct gb_params *changed,
                       int64_t step, struct gb_error *err);

/* Whether a run that begins with this model can take all its changes.  Errors:
 * GB_ERR_INPUT as above; a step on an unloading branch is found when the run is there. */
bool gb_change_check_all(const struct gb_params *params, const struct gb_model *model,
                         struct gb_error *err);

/* Last part of a resume: when a change was due at the step of the record, the next strain
 * step is decided again with the changed parameters. */
bool gb_change_order(struct gb_experiment *experiment, struct gb_error *err);

#endif
