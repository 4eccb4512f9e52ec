#ifndef GB_SCENE_CHANGES_H
#define GB_SCENE_CHANGES_H

#include "greenbody/params.h"

/* Parameter changes during a run (loading.changes): "120 contact.mu=0.3; 200
 * loading.geometry=isotropic", in the order of the recorded steps after which each one
 * applies.  Part of the preset, so that preset and seed repeat the run to the same bits.
 *
 * Keys that can change leave the packing and its contact histories valid: friction,
 * attraction, bridges, and the further loading. */

/* Scenes whose runs can change: quasi-static ones.  Errors (GB_ERR_INPUT) name the entry
 * and what is accepted; also for values that do not fit the rest. */
bool gb_changes_check(const struct gb_params *params, struct gb_error *err);

/* The parameters that hold after a recorded step: those of the preset with all changes
 * up to and including it.  params has been checked. */
void gb_changes_effective(const struct gb_params *params, int64_t step,
                          struct gb_params *out);

/* Whether a change follows exactly this step. */
bool gb_changes_due(const struct gb_params *params, int64_t step);

/* The first step after `step` that a change follows; -1 when there is none. */
int64_t gb_changes_next(const struct gb_params *params, int64_t step);

/* Adds entries "step key=value" for assignments "mu=0.3; loading.geometry=isotropic" (the
 * groups contact and loading may be left out).  On error params is untouched. */
bool gb_changes_add(struct gb_params *params, int64_t step, const char *assignments,
                    struct gb_error *err);

#endif
