#ifndef GB_RUN_SWEEPTABLE_H
#define GB_RUN_SWEEPTABLE_H

#include <stdbool.h>
#include <stddef.h>

#include <glib.h>

#include "run/axes.h"
#include "run/ensemble.h"

/* The tables of a sweep.  Both are made from the run directories alone, so that they are
 * the same for any number of workers and restarts. */

enum { GB_SWEEPTABLE_PRESSURES = 256 };

/* Pressures at which a sweep is tabulated, ascending. */
struct gb_sweeptable_pressures {
    double pa[GB_SWEEPTABLE_PRESSURES];
    size_t count;
};

/* "50 MPa;100 MPa;1 GPa" or "50;100 MPa".  Errors: GB_ERR_INPUT. */
bool gb_sweeptable_parse(struct gb_sweeptable_pressures *at, const char *text,
                         struct gb_error *err);

/* Where nothing was asked for: 1, 2, 5, 10, ... MPa up to the end of the programme, and
 * the pressures that are unloaded from. */
void gb_sweeptable_default(struct gb_sweeptable_pressures *at,
                           const struct gb_params *params);

/* sweep.csv: a row per point of the grid, branch and pressure: the varied values, how
 * many runs got there, mean and standard error of each figure over them.  Branch load is
 * read at the pressure; unload is the end of unloading from it.  A run that cannot be
 * read counts as failed; its error goes to the run.  Caller frees. */
GString *gb_sweeptable_means(struct gb_ensemble *ensemble, const struct gb_axes *axes,
                             const struct gb_sweeptable_pressures *at);

/* runs.csv: a row per run: directory, point, seed, done, failed or missing, why. */
GString *gb_sweeptable_runs(const struct gb_ensemble *ensemble);

#endif
