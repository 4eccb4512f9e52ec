#ifndef GB_MANY_COMPACTION_DATA_H
#define GB_MANY_COMPACTION_DATA_H

#include <stdbool.h>
#include <stddef.h>

#include "base/table.h"
#include "greenbody/params.h"
#include "io/lab/lab_quantity.h"
#include "many/runset.h"
#include "measure/average.h"
#include "measure/equations.h"

/* Measured compaction: quantities at pressures, of one powder or of several that differ in
 * given keys.  A table as gb_lab_reader_read gives it, with the columns
 *   p_MPa           pressure over the compressed axes
 *   density         relative; and the others of io/lab/lab_quantity.h, one or more of them,
 *                   empty where a row lacks one
 *   density_error   standard error, and QUANTITY_error of the other quantities: in all rows or
 *                   none with one quantity, in all rows with several
 *   weight          (optional, 1) factor on what the row counts in the fit by its error
 *   series          words (optional): one only
 *   branch          load (the default), or unload: what is left after unloading from p_MPa
 *   group.key_unit  (optional, any number) what the row was pressed with, as contact.mu or
 *                   particles.diameter_nm */
struct gb_labdata_row {
    size_t scene;
    double pressure_pa;
    enum gb_lab_quantity quantity;
    bool unloaded;
};

struct gb_labdata {
    struct gb_labdata_row *row; /* one for each quantity of a row of the table */
    double *value;              /* of the rows */
    double *error, *weight;     /* of the rows; NULL: not given */
    size_t count;
    struct gb_params *scene; /* loaded as far as its rows ask */
    size_t scenes;
};

/* Takes the rows; the scenes are params with the keys of their rows, a loading that reaches
 * the greatest pressure, and unloading where rows ask for it.  Errors: GB_ERR_INPUT with
 * the line, GB_ERR_MEMORY.  After success, free it by gb_compaction_data_targets_finish. */
bool gb_compaction_data_take(struct gb_labdata *measured, const struct gb_table *table,
                             const struct gb_params *params, struct gb_error *err);

/* The quantity of a row in a simulated curve; NaN: not reached. */
double gb_compaction_data_simulated(const struct gb_labdata_row *row,
                                    const struct gb_table *curve);

void gb_compaction_data_targets_finish(struct gb_labdata *measured); /* zeroed is fine */

/* Loading curves of runs or of a laboratory as points for the equations of compaction. */

enum { GB_COMPACTION_DATA_LEVELS = 48 }; /* most pressures of a curve */

/* Which points, MPa; NaN: the default, 1 % of the highest pressure (runs) or the lowest
 * one (files), and the highest one that all curves reach. */
struct gb_compaction_window {
    double from, to;
    double initial;    /* D0; NaN: that of the data, unknown in files */
    bool fits_initial; /* D0 is a parameter, even if it is known */
};

struct gb_compaction_data {
    struct gb_equations_points points; /* arrays belong to the data */
    double *memory;
    size_t curves; /* replicas; 0: a file */
};

/* The curves (x: P in MPa, y: rho) of replicas, at pressures in geometric progression, no
 * more than the shortest curve has points in the window: mean, and for several curves the
 * standard errors, smoothed along the curve.  rho is that where a curve first reaches a
 * pressure.  initial: D0 of the curves, NaN: unknown.
 * Errors: GB_ERR_INPUT (no points in the window), GB_ERR_MEMORY. */
bool gb_compaction_data_curves(struct gb_compaction_data *data,
                               const struct gb_average_curve *curves, size_t count,
                               double initial, const struct gb_compaction_window *window,
                               struct gb_error *err);

/* The loading branch of the runs of a group; D0 is the density before loading. */
bool gb_compaction_data_runs(struct gb_compaction_data *data, const struct gb_runset *set,
                             size_t group, const struct gb_compaction_window *window,
                             struct gb_error *err);

/* A table of measured points, as gb_lab_reader_read gives it, for the equations of
 * compaction: ascending in pressure, with the errors of the densities where every point
 * has one above 0.  Rows of a column `branch` other than "load" are left out; of a column
 * `series` only the rows of one word (series; NULL: there must be one only).
 * gb_compaction_data_finish is due on success.
 * Errors: those of gb_measured_take; GB_ERR_INPUT for several series or samples (columns
 * as particles.diameter_nm that are not constant) and for a window without points. */
bool gb_compaction_data_file(struct gb_compaction_data *data,
                             const struct gb_table *table, const char *series,
                             const struct gb_compaction_window *window,
                             struct gb_error *err);

void gb_compaction_data_finish(struct gb_compaction_data *data); /* zeroed is fine */

#endif
