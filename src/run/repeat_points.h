#ifndef GB_RUN_REPEAT_POINTS_H
#define GB_RUN_REPEAT_POINTS_H

#include "run/experiment.h"

/* Computes the points after step `from`, at which the experiment is, up to step `to` again;
 * their events are dropped.  cancelled (NULL is fine) is polled with its data.
 *
 * Errors: GB_ERR_CANCELLED; GB_ERR_GUARD where the experiment ends before; what stopped it.
 */
bool gb_repeat_points(struct gb_experiment *experiment, int64_t from, int64_t to,
                      bool (*cancelled)(void *data), void *data, struct gb_error *err);

/* Replaces a record by that of a later point of the same run, step `to`.  Where that fails,
 * it is as before, or empty (GB_ERR_MEMORY); errors as above. */
bool gb_repeat_points_record(struct gb_record *record, const struct gb_params *params,
                             int64_t to, struct gb_error *err);

#endif
