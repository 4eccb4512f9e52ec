#ifndef GB_RUN_EXPERIMENT_H
#define GB_RUN_EXPERIMENT_H

#include <stdbool.h>
#include <stdint.h>

#include "base/record.h"
#include "greenbody/curve.h"
#include "greenbody/params.h"
#include "greenbody/snapshot.h"
#include "io/state.h"
#include "scene/model.h"
#include "solve/step_outcome.h"

/* One simulation: parameters to recorded points.  No threads, no files, no printing. */
struct gb_experiment;
struct gb_world;
struct gb_bed;

/* Freezes the parameters and builds the initial structure.  cancelled (may be NULL) is
 * polled with its data during the growth; true makes it fail with GB_ERR_CANCELLED. */
bool gb_experiment_create(struct gb_experiment **out, const struct gb_params *params,
                          bool (*cancelled)(void *data), void *data,
                          struct gb_error *err);
/* Continues from a checkpoint (run/checkpoint.h) of a run with the same parameters, with
 * the same bits.  Errors: GB_ERR_INPUT naming the item of the record that does not fit. */
bool gb_experiment_resume(struct gb_experiment **out, const struct gb_params *params,
                          struct gb_record *record, struct gb_error *err);
void gb_experiment_destroy(struct gb_experiment *experiment); /* NULL is fine */

/* One bounded slice of work: at most max_evaluations force evaluations. */
enum gb_step_outcome gb_experiment_advance(struct gb_experiment *experiment,
                                           int64_t max_evaluations, struct gb_error *err);

/* What a run that has come to its end has missed, as one line into text: goals of the
 * loading never reached or exceeded, points that are not in equilibrium.  False: nothing. */
bool gb_experiment_missed(const struct gb_experiment *experiment, char *text,
                          size_t size);

/* True after the last point, and after a stop. */
bool gb_experiment_over(const struct gb_experiment *experiment);

/* The last recorded point; its seconds field is the caller's to fill. */
const struct gb_point *gb_experiment_point(const struct gb_experiment *experiment);

/* Oldest event not yet taken (guards, unloading begins, ...), one line, and the
 * step that was computed when it happened (NULL is fine): the same for any slices.  False
 * when there is none. */
bool gb_experiment_event(struct gb_experiment *experiment, int64_t *step, char *text,
                         size_t size);

/* Share of the loading that is done, 0 to 1. */
double gb_experiment_progress(const struct gb_experiment *experiment);

/* Fills the snapshot except state, seconds and rates. */
void gb_experiment_observe(const struct gb_experiment *experiment,
                           struct gb_snapshot *snapshot);

/* Copies the packing for pictures and files. */
bool gb_experiment_state(const struct gb_experiment *experiment, struct gb_state **out,
                         struct gb_error *err);

const struct gb_model *gb_experiment_model(const struct gb_experiment *experiment);
const struct gb_params *gb_experiment_params(const struct gb_experiment *experiment);
/* NULL for dies. */
const struct gb_world *gb_experiment_world(const struct gb_experiment *experiment);
/* NULL for periodic cells. */
const struct gb_bed *gb_experiment_bed(const struct gb_experiment *experiment);
/* Of the forces, since the start. */
int64_t gb_experiment_evaluations(const struct gb_experiment *experiment);

#endif
