#ifndef GB_PACK_CELL_RECORD_CHECKS_H
#define GB_PACK_CELL_RECORD_CHECKS_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/status.h"
#include "pack/cell/cell.h"
#include "pack/cell/contact_history.h"

/* Checks of the items that a checkpoint holds.  name: item of the message.
 * Errors: GB_ERR_INPUT. */

/* Sets the error; returns false. */
bool gb_record_checks_out_of_range(const char *name, struct gb_error *err);

/* The pairs are sorted and of existing particles. */
bool gb_record_checks_history(const struct gb_contact_history *history, int64_t count,
                              const char *name, struct gb_error *err);

/* The edges are positive and below 1e9 d. */
bool gb_record_checks_edges(const struct gb_cell *cell, const char *name,
                            struct gb_error *err);

/* The positions (count x 3) lie in the cell.  margin: distance outside of it that is
 * allowed along periodic axes, over the edge. */
bool gb_record_checks_inside(const struct gb_cell *cell, const double *position,
                             int64_t count, double margin, const char *name,
                             struct gb_error *err);

#endif
