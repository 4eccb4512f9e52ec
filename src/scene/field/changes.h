#ifndef GB_SCENE_CHANGES_H
#define GB_SCENE_CHANGES_H

#include "greenbody/params.h"

/* Parameter changes during a run (loading.changes): "120 contact.mu=0.3; 200
 * loading.geometry=isotropic".  Entries are in the order of the recorded steps after
 * which they apply.  They are part of the preset, so preset and seed repeat the run
 * exactly.
 *
 * Only keys that keep the packing and its contact histories valid may change: friction,
 * attraction, bridges, and the loading from then on. */

/* Checks the changes, which only quasi-static scenes may have.  Errors: GB_ERR_INPUT
 * naming the entry and what is expected, also for values that do not fit the other
 * keys. */
bool gb_changes_check(const struct gb_params *params, struct gb_error *err);

/* The parameters after a recorded step: those of the preset with all changes up to and
 * including this step. params must be checked. */
void gb_changes_effective(const struct gb_params *params, int64_t step,
                          struct gb_params *out);

/* Does a change apply right after this step? */
bool gb_changes_due(const struct gb_params *params, int64_t step);

/* The first step after `step` with a change; -1 if there is none. */
int64_t gb_changes_next(const struct gb_params *params, int64_t step);

/* Adds entries "step key=value" for assignments "mu=0.3; loading.geometry=isotropic".
 * The group contact or loading may be omitted.  On error params does not change. */
bool gb_changes_add(struct gb_params *params, int64_t step, const char *assignments,
                    struct gb_error *err);

#endif
