#ifndef GB_RUN_MODULI_TABLE_H
#define GB_RUN_MODULI_TABLE_H

#include <glib.h>
#include <stdbool.h>

#include "base/listing.h"
#include "base/record.h"
#include "greenbody/params.h"
#include "scene/field/keep_points.h"
#include "solve/moduli/moduli.h"

/* Moduli of states as rows of numbers, and where the states come from: a run of a preset,
 * or the files of a run directory. */
enum { GB_MODULI_TABLE_COLUMNS = 63 };

int gb_moduli_table_find(const char *name); /* -1: none */

struct gb_moduli_table_row {
    double value[GB_MODULI_TABLE_COLUMNS]; /* NaN where there is none */
    double c_gpa[6][6];
    bool range_open; /* the elastic range is beyond its value */
    unsigned what;   /* of a run: points of the list, end; see run/record/kept_states.h */
};

/* Called with each row in the order of the run; false ends with its error.  The end of a run
 * is a row even if its state was one before. */
struct gb_moduli_table_sink {
    bool (*row)(void *data, const struct gb_moduli_table_row *row, struct gb_error *err);
    void *data;
    /* Whether the state of this step in a file is to be probed; NULL: it is. */
    bool (*wanted)(void *data, int64_t step);
    bool (*cancelled)(void *data); /* polled; NULL is fine */
    void *cancel_data;
    bool range; /* with the elastic range */
};

/* Runs a preset and probes where it first reaches each point while loading, and at its end;
 * a lattice without points as it was placed, without loading.  *missed counts points that
 * were not reached.  Errors: GB_ERR_GUARD when the run stops early (its last state has been
 * probed), and those of gb_moduli_measure. */
bool gb_moduli_table_run(const struct gb_params *params,
                         const struct gb_keep_points *points,
                         const struct gb_moduli_table_sink *sink, int *missed,
                         struct gb_error *err);

/* Probes the state in a file of a run directory, relative to it ("state.h5").  Errors:
 * GB_ERR_INPUT for a file without contact histories, or of a scene without a periodic
 * cell. */
bool gb_moduli_table_file(const char *directory, const char *name,
                          const struct gb_moduli_table_sink *sink, struct gb_error *err);

/* Moduli of the states of a run: means over replicas with standard errors, and the table
 * moduli.csv, which `greenbody plot --figure moduli` and the workbench read. */
#define GB_MODULI_STATES_FILE "moduli.csv"

/* Sums over the replicas of one state. */
struct gb_moduli_state {
    int count;
    int missing; /* replicas that did not get there */
    double sum[GB_MODULI_TABLE_COLUMNS], squares[GB_MODULI_TABLE_COLUMNS];
    double c_gpa[6][6];
    bool range_open; /* of one of them at least */
};

void gb_moduli_table_add(struct gb_moduli_state *state,
                         const struct gb_moduli_table_row *row);

double gb_moduli_table_mean(const struct gb_moduli_state *state, int column);

/* Standard error over the replicas; NaN for one. */
double gb_moduli_table_error(const struct gb_moduli_state *state, int column);

/* A row per state (struct gb_moduli_state): the columns of the table and `replicas`; where
 * any state has replicas, also `missing`, and error_* of each column.  comment: lines above
 * the table; NULL: none. */
struct gb_listing *gb_moduli_table_listing(const GArray *states, const char *comment);

/* Adds the states of such a table in a file.  Errors: GB_ERR_INPUT for another table, or
 * for one of replicas. */
bool gb_moduli_table_read(GArray *states, const char *path, struct gb_error *err);

/* Whether a state of this step of the run is among them. */
bool gb_moduli_table_has(const GArray *states, int64_t step);

/* By their step. */
void gb_moduli_table_sort(GArray *states);

#endif
