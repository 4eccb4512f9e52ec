#ifndef GB_MANY_PARAM_SWEEP_H
#define GB_MANY_PARAM_SWEEP_H

#include <glib.h>
#include <stdbool.h>
#include <stddef.h>

#include "greenbody/params.h"
#include "many/ensemble.h"
#include "many/reading.h"

/* The points of a sweep: keys with their values, in all combinations (a grid) or with
 * one value of each key per point (a design). */
enum { GB_AXES_MOST = 6, GB_AXES_VALUES_MOST = 10000 };

struct gb_axis {
    const struct gb_field *field;
    GPtrArray *values; /* char *, as in a preset */
    double *share;     /* design: position in the range at each point, 0 to 1 */
    bool material;     /* values are names of materials, the field is material.name */
};

struct gb_axes {
    struct gb_axis axis[GB_AXES_MOST];
    size_t count;
    size_t design; /* number of points of a Sobol sequence; 0: a grid */
};

/* Reads "sobol:64" into empty axes.  Errors: GB_ERR_INPUT. */
bool gb_param_sweep_design(struct gb_axes *axes, const char *text, struct gb_error *err);

/* Adds an axis: a range "contact.mu=0.05:0.4:8" (from, to, count; ":log" after it
 * spaces the values evenly in the logarithm), or a list
 * "particles.diameter=9.7;16;21;38 nm", "loading.geometry=uniaxial;isotropic".  A
 * number without a unit has the unit at the end. "material=alumina;yttria" varies all
 * keys of [material] by name, before the other axes; its column is material.name.
 *
 * In a design a range has no count: "contact.mu=0.05:0.4" or "...:log".  Coordinate k
 * of the Sobol sequence is the position in the range of axis k, evenly in the value or
 * its logarithm, so a longer design contains the shorter ones.
 *
 * Errors: GB_ERR_INPUT with what was given and what is expected: for invalid values,
 * values given twice, keys that make no other experiment (seed, title, threads,
 * [output]), and keys that are lists. */
bool gb_param_sweep_add_axis(struct gb_axes *axes, const char *text,
                             struct gb_error *err);

void gb_param_sweep_axes_finish(struct gb_axes *axes); /* zeroed is fine */

/* Number of points; 1 without axes. */
size_t gb_param_sweep_points(const struct gb_axes *axes);

/* Value of an axis at a point.  In a grid the last axis varies fastest. */
const char *gb_param_sweep_value(const struct gb_axes *axes, size_t point, size_t axis);

/* Sets params to the values of a point and checks them. */
bool gb_param_sweep_apply(const struct gb_axes *axes, size_t point,
                          struct gb_params *params, struct gb_error *err);

/* Name of a point, "mu-0.2_diameter-9.7nm"; "scene" without axes.  It depends only on
 * the values, so a grid can grow in the same directory, and it differs between any two
 * points.  In words with free text (a material, a loading path) other characters than
 * letters, digits, '.', '+' and '-' become "~" and two hexadecimal digits per byte.
 * Names too long for a file end with "~~" and a checksum. g_free. */
char *gb_param_sweep_point_name(const struct gb_axes *axes, size_t point);

/* For a table: the name of a column, "contact.mu" or "particles.diameter_nm" (g_free),
 * and the cell of a point in it: a number in that unit, or a word (returns buffer). */
char *gb_param_sweep_column(const struct gb_axes *axes, size_t axis);

char *gb_param_sweep_cell(const struct gb_axes *axes, size_t point, size_t axis,
                          char *buffer, size_t size);

enum { GB_SWEEP_TABLE_PRESSURES = 256 };

/* Pressures of the rows of a sweep's table, ascending. */
struct gb_sweep_table_pressures {
    double pa[GB_SWEEP_TABLE_PRESSURES];
    size_t count;
};

/* Reads "50 MPa;100 MPa;1 GPa" or "50;100 MPa".  Errors: GB_ERR_INPUT. */
bool gb_param_sweep_pressures(struct gb_sweep_table_pressures *at, const char *text,
                              struct gb_error *err);

/* Default: 1, 2, 5, 10, ...  MPa up to the end of loading, and the pressures of
 * unloading. */
void gb_param_sweep_default_pressures(struct gb_sweep_table_pressures *at,
                                      const struct gb_params *params);

/* Branches on which a sweep reads its figures: loading, and unloading from a pressure. */
enum { GB_SWEEP_BRANCHES = 2 };

const char *gb_param_sweep_branch(size_t branch); /* "load", "unload" */

/* The figures of the used runs of one point, at all pressures. */
struct gb_sweep_readings {
    double *value; /* [branch][pressure][quantity][run]; NaN: not reached, or failed */
    size_t pressures, runs;
};

/* Reads the curves.  A run that cannot be read counts as failed and gets the error.
 * gb_param_sweep_readings_finish must be called. */
void gb_param_sweep_readings_init(struct gb_sweep_readings *readings,
                                  struct gb_ensemble *ensemble, size_t point,
                                  const struct gb_sweep_table_pressures *at);

void gb_param_sweep_readings_finish(
    struct gb_sweep_readings *readings); /* zeroed is fine */

/* The values of one figure over the runs. */
const double *gb_param_sweep_readings_at(const struct gb_sweep_readings *readings,
                                         size_t branch, size_t pressure, size_t quantity);

/* Ends the replicas of a point when the standard error of their mean density at a
 * pressure is small enough. */
struct gb_sweep_target {
    double standard_error; /* of the density; 0: do all replicas */
    double pressure_pa;
    double *density; /* of each run at the pressure, NaN if it failed ... */
    bool *is_read;   /* ... once its curve.csv was read */
};

/* Reads "0.002@100MPa".  Errors: GB_ERR_INPUT. */
bool gb_param_sweep_target(struct gb_sweep_target *target, const char *text,
                           struct gb_error *err);

void gb_param_sweep_target_finish(struct gb_sweep_target *target); /* zeroed is fine */

/* Number of points for which all replicas were not enough for the standard error. */
size_t gb_param_sweep_missed(const struct gb_sweep_target *target,
                             const struct gb_ensemble *ensemble);

/* Number of used runs that missed a goal of their loading or have points out of
 * equilibrium. */
size_t gb_param_sweep_shortfalls(const struct gb_ensemble *ensemble);

/* sweep.csv: one row per point, branch and pressure, with the varied values, the number
 * of runs that reached the pressure, and mean and standard error of each figure.  The
 * branch load is read at the pressure; unload is the end of unloading from it.  A run
 * that cannot be read counts as failed and gets the error.  Caller frees. */
GString *gb_param_sweep_means(struct gb_ensemble *ensemble, const struct gb_axes *axes,
                              const struct gb_sweep_table_pressures *at);

/* runs.csv: one row per run with directory, point, seed, done/failed/missing, and the
 * reason. */
GString *gb_param_sweep_runs(const struct gb_ensemble *ensemble);

/* A sweep with replicas: a directory for each run, and tables. */
struct gb_param_sweep {
    struct gb_axes axes;
    struct gb_sweep_table_pressures at;
    struct gb_sweep_target target;
    struct gb_ensemble ensemble;
};

/* Lists the runs in directory from axes, target and the scene of params, and marks
 * those that are done.  Errors: GB_ERR_INPUT, GB_ERR_MEMORY. gb_param_sweep_finish must
 * be called in any case. */
bool gb_param_sweep_fill(struct gb_param_sweep *sweep, const struct gb_params *params,
                         size_t replicas, const char *directory, struct gb_error *err);
void gb_param_sweep_finish(struct gb_param_sweep *sweep); /* zeroed is fine */

/* Writes sweep.csv and runs.csv for any state of the runs. */
bool gb_param_sweep_write(struct gb_param_sweep *sweep, const char *directory,
                          struct gb_error *err);

/* Writes another table of the sweep and frees its text. */
bool gb_param_sweep_put(const char *directory, const char *name, GString *text,
                        struct gb_error *err);

#endif
