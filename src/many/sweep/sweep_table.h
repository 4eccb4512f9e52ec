#ifndef GB_MANY_SWEEP_SWEEP_TABLE_H
#define GB_MANY_SWEEP_SWEEP_TABLE_H

#include <stdbool.h>
#include <stddef.h>

#include <glib.h>

#include "many/ensemble.h"
#include "many/sweep/axes.h"

/* The tables of a sweep.  Both depend on the run directories alone: they are the same for
 * any number of workers and restarts. */

enum { GB_SWEEP_TABLE_PRESSURES = 256 };

/* Pressures at which a sweep is tabulated, ascending. */
struct gb_sweep_table_pressures {
    double pa[GB_SWEEP_TABLE_PRESSURES];
    size_t count;
};

/* "50 MPa;100 MPa;1 GPa" or "50;100 MPa".  Errors: GB_ERR_INPUT. */
bool gb_sweep_table_parse(struct gb_sweep_table_pressures *at, const char *text,
                          struct gb_error *err);

/* The default: 1, 2, 5, 10, ... MPa up to the end of loading, and the pressures of
 * unloading. */
void gb_sweep_table_default(struct gb_sweep_table_pressures *at,
                            const struct gb_params *params);

/* sweep.csv: a row per point of the grid, branch and pressure: the varied values, the
 * number of runs that reached it, mean and standard error of each figure over them.  Branch load is
 * read at the pressure; unload is the end of unloading from it.  A run that cannot be
 * read counts as failed; its error goes to the run.  Caller frees. */
GString *gb_sweep_table_means(struct gb_ensemble *ensemble, const struct gb_axes *axes,
                              const struct gb_sweep_table_pressures *at);

/* runs.csv: a row per run: directory, point, seed, done, failed or missing, why. */
GString *gb_sweep_table_runs(const struct gb_ensemble *ensemble);

#endif
