#ifndef GB_FIGURES_STATES_H
#define GB_FIGURES_STATES_H

#include <stdbool.h>

#include <glib.h>

#include "io/state.h"

/* The packings that a run directory keeps: state.h5, the last one, and those of its
 * folder snapshots. */

/* Reads the last state (at NULL), or the kept one nearest to a point: "p=100 MPa",
 * "density=0.5"; on the way up where there is a choice.  place may be a state file
 * itself. Errors: those of gb_state_read; GB_ERR_INPUT for a point that cannot be read,
 * and for one from which every kept state is away by more than 5 %, telling what there
 * is. */
bool gb_states_read(struct gb_state **out, const char *place, const char *at,
                    struct gb_error *err);

/* Paths of all states of a directory in the order of the run, each point once
 * (g_ptr_array_unref); NULL and err when one cannot be read. */
GPtrArray *gb_states_along(const char *place, struct gb_error *err);

#endif
