#ifndef GB_RUN_MODULI_STATES_H
#define GB_RUN_MODULI_STATES_H

#include <stdbool.h>

#include <glib.h>

#include "base/listing.h"
#include "run/moduli/moduli_table.h"

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

void gb_moduli_states_add(struct gb_moduli_state *state,
                          const struct gb_moduli_table_row *row);
double gb_moduli_states_mean(const struct gb_moduli_state *state, int column);
/* Standard error over the replicas; NaN for one. */
double gb_moduli_states_error(const struct gb_moduli_state *state, int column);

/* A row per state (struct gb_moduli_state): the columns of the table and `replicas`; where
 * any state has replicas, also `missing`, and error_* of each column.  comment: lines above
 * the table; NULL: none. */
struct gb_listing *gb_moduli_states_listing(const GArray *states, const char *comment);

/* Adds the states of such a table in a file.  Errors: GB_ERR_INPUT for another table, or
 * for one of replicas. */
bool gb_moduli_states_read(GArray *states, const char *path, struct gb_error *err);

/* Whether a state of this step of the run is among them. */
bool gb_moduli_states_has(const GArray *states, int64_t step);
/* By their step. */
void gb_moduli_states_sort(GArray *states);

#endif
