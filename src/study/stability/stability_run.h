#ifndef GB_STUDY_STABILITY_STABILITY_RUN_H
#define GB_STUDY_STABILITY_STABILITY_RUN_H

#include <stdbool.h>

#include <glib.h>

#include "scene/field/keep_points.h"
#include "study/stability/stability.h"

/* Longest stable steps of the methods of a scene, velocity Verlet or the relaxers, in the
 * states of its run: the packing with its histories, brought to rest on a copy, is
 * disturbed along its fastest mode. */

struct gb_stability_sink {
    /* Called with each row in the order of the run; false ends it with its error. */
    bool (*row)(void *data, const struct gb_stability_row *row, struct gb_error *err);
    /* A state that cannot be measured, and why. */
    void (*skipped)(void *data, double p_pa, const char *why);
    void *data;
    bool (*cancelled)(void *data); /* polled; NULL is fine */
};

/* How many points there are where none are given. */
enum { GB_STABILITY_RUN_POINTS = 3 };

/* Presses a scene without unloading and measures where it first reaches each point (NULL:
 * 1, 10 and 100 MPa, as far as the run goes) and at its end.  *missed counts points that
 * were not reached.  Errors: GB_ERR_INPUT for scenes without a periodic cell, and where no
 * state could be measured; those of the run. */
bool gb_stability_run(const struct gb_params *params, const struct gb_keep_points *points,
                      const struct gb_stability_sink *sink, int *missed,
                      struct gb_error *err);

/* Whether the method is stable with the step that it takes. */
bool gb_stability_run_stable(const struct gb_stability_row *row);

/* A header row, for rows of gb_stability_run_add; comment: lines put in front, with '#'.
 * g_string_free. */
GString *gb_stability_run_csv(const char *comment);
void gb_stability_run_add(GString *csv, const struct gb_stability_row *row);

#endif
