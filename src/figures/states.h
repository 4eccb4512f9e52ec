#ifndef GB_FIGURES_STATES_H
#define GB_FIGURES_STATES_H

#include <glib.h>
#include <stdbool.h>

#include "figures/figures.h"
#include "greenbody/params.h"
#include "io/state.h"
#include "measure/structure.h"
#include "scene/field/keep_points.h"

/* Kept states of a run directory: the last, state.h5, and those in its folder snapshots. */

/* Reads the last state (at NULL), or the state nearest to a point, "p=100 MPa" or
 * "density=0.5"; of loading and unloading the one of loading.  source: run directory or
 * state file.  Errors: those of gb_state_read; GB_ERR_INPUT for a malformed point, and when
 * every state differs from it by more than 5 %, with the list of states. */
bool gb_states_read(struct gb_state **out, const char *source, const char *at,
                    struct gb_error *err);

/* Paths of all states of a directory in the order of the run, each point once
 * (g_ptr_array_unref); NULL and err when one cannot be read. */
GPtrArray *gb_states_along(const char *source, struct gb_error *err);

/* The same, or for each of the points the state nearest to it, as gb_states_read. */
GPtrArray *gb_states_select(const char *source, const struct gb_keep_points *points,
                            struct gb_error *err);

/* Text of preset.ini of a run directory, or of the run of a state file (in the directory or
 * in its folder snapshots); NULL: none.  g_free. */
char *gb_states_preset(const char *path);

/* One kept state per run of a set. */
struct gb_states_set {
    struct gb_state **state; /* in the order of the runs */
    size_t count;
};

/* Reads the states at the point of the input.  Errors: those of gb_states_read. */
bool gb_states_set_read(struct gb_states_set *states,
                        const struct gb_figures_input *input, struct gb_error *err);

void gb_states_set_finish(struct gb_states_set *states); /* zeroed is fine */

/* Columns NAME_1, se_1 and a curve of the mean of every group; rows: series->rows values
 * of each run. */
void gb_states_set_means(struct gb_series *series, const struct gb_runset *set,
                         const double *rows, const double *x, const char *name);

/* Range of density and pressure of the states as a sentence of the caption. */
void gb_states_set_caption(struct gb_series *series, const struct gb_states_set *states);

/* An initial structure and the quantities measured on it. */
struct gb_packing {
    struct gb_params params;
    struct gb_state *state;
    struct gb_connectivity connectivity;
    double r_eq;  /* of touching particles, d */
    double reach; /* of a contact, d */
    double r_max; /* of g, d */
    int bins;
    double *g;
    double g_end; /* over the last diameter before r_max */
};

/* Writes preset.ini, packing.csv, g.csv, structure.json and state.h5 into a directory
 * that is there; each file atomically.  A bed in a die, whose packing.csv has radii, is
 * without the third and fourth.  Errors: GB_ERR_MACHINE. */
bool gb_states_write_packing(const struct gb_packing *packing, const char *directory,
                             struct gb_error *err);

#endif
