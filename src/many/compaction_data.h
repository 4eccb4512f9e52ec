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

/* Measured compaction: quantities at pressures, for one powder or for several that
 * differ in given keys.  The table comes from gb_lab_reader_read and has these columns:
 *   p_MPa           pressure over the compressed axes
 *   density         relative density; also other quantities of io/lab/lab_quantity.h, at
 *                   least one, with empty cells where a row lacks one
 *   density_error   standard error, likewise QUANTITY_error.  With one quantity: in all
 *                   rows or none; with several: in all rows
 *   weight          (optional, 1) factor on the weight of the row in the fit
 *   series          words (optional); all rows have the same
 *   branch          load (the default), or unload: after unloading from p_MPa
 *   group.key_unit  (optional, any number) parameter of the row, such as contact.mu or
 *                   particles.diameter_nm */
struct gb_labdata_row {
    size_t scene;
    double pressure_pa;
    enum gb_lab_quantity quantity;
    bool unloaded;
};

struct gb_labdata {
    struct gb_labdata_row *row; /* one per quantity and table row */
    double *value;              /* per row */
    double *error, *weight;     /* per row; NULL: not given */
    size_t count;
    struct gb_params *scene; /* with a loading that reaches its rows */
    size_t scenes;
};

/* Takes the rows.  Each scene is params with the keys of its rows, loading to the
 * greatest pressure, and unloading where rows need it.  Errors: GB_ERR_INPUT with the
 * line, GB_ERR_MEMORY.  After success call gb_compaction_data_targets_finish. */
bool gb_compaction_data_take(struct gb_labdata *measured, const struct gb_table *table,
                             const struct gb_params *params, struct gb_error *err);

/* The quantity of a row in a simulated curve; NaN if the curve does not reach it. */
double gb_compaction_data_simulated(const struct gb_labdata_row *row,
                                    const struct gb_table *curve);

void gb_compaction_data_targets_finish(struct gb_labdata *measured); /* zeroed is fine */

/* Loading curves of runs or of a laboratory, as points for fits of compaction
 * equations. */

enum { GB_COMPACTION_DATA_LEVELS = 48 }; /* most pressures of a curve */

/* Limits of the points, MPa.  NaN: the default, which is 1 % of the highest pressure
 * (runs) or the lowest pressure (files), and the highest pressure that all curves
 * reach. */
struct gb_compaction_window {
    double from, to;
    double initial;    /* D0; NaN: from the data, unknown in files */
    bool fits_initial; /* fit D0 even if it is known */
};

struct gb_compaction_data {
    struct gb_equations_points points; /* arrays belong to the data */
    double *memory;
    size_t curves; /* replicas; 0: a file */
};

/* Takes the curves of replicas (x: P in MPa, y: rho) at pressures in geometric
 * progression.  Their number is at most the number of points of the shortest curve in
 * the window.  The density at a pressure is where the curve first reaches it.  Gives
 * the mean and, for several curves, standard errors smoothed along the curve. initial:
 * D0 of the curves, NaN: unknown.  Errors: GB_ERR_INPUT (no points in the window),
 * GB_ERR_MEMORY. */
bool gb_compaction_data_curves(struct gb_compaction_data *data,
                               const struct gb_average_curve *curves, size_t count,
                               double initial, const struct gb_compaction_window *window,
                               struct gb_error *err);

/* Takes the loading branch of the runs of a group; D0 is the density before loading. */
bool gb_compaction_data_runs(struct gb_compaction_data *data, const struct gb_runset *set,
                             size_t group, const struct gb_compaction_window *window,
                             struct gb_error *err);

/* Takes a table of measured points from gb_lab_reader_read, ascending in pressure, with
 * the errors of the densities if every point has one above 0.  Rows with a branch other
 * than "load" are ignored.  If there is a column `series`, only the rows with this word
 * are used (NULL: the table must have only one).  On success gb_compaction_data_finish
 * must be called.  Errors: see gb_measured_take; GB_ERR_INPUT for several series or
 * samples (columns such as particles.diameter_nm that are not constant) and for a
 * window without points. */
bool gb_compaction_data_file(struct gb_compaction_data *data,
                             const struct gb_table *table, const char *series,
                             const struct gb_compaction_window *window,
                             struct gb_error *err);

void gb_compaction_data_finish(struct gb_compaction_data *data); /* zeroed is fine */

#endif
