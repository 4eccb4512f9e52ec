#ifndef GB_FIGURES_PACKINGS_STATE_SET_H
#define GB_FIGURES_PACKINGS_STATE_SET_H

#include "figures/figures.h"
#include "io/state/state.h"

/* One kept state per run of a set. */
struct gb_state_set {
    struct gb_state **state; /* in the order of the runs */
    size_t count;
};

/* Reads the states at the point of the input.  Errors: those of gb_states_read. */
bool gb_state_set_read(struct gb_state_set *states, const struct gb_figures_input *input,
                       struct gb_error *err);
void gb_state_set_finish(struct gb_state_set *states); /* zeroed is fine */

/* Columns NAME_1, se_1 and a curve of the mean of every group; rows: series->rows values
 * of each run. */
void gb_state_set_means(struct gb_series *series, const struct gb_runset *set,
                        const double *rows, const double *x, const char *name);

/* Range of density and pressure of the states as a sentence of the caption. */
void gb_state_set_caption(struct gb_series *series, const struct gb_state_set *states);

#endif
