#ifndef GB_CLI_PACK_PACK_PERCOLATION_H
#define GB_CLI_PACK_PACK_PERCOLATION_H

#include "greenbody/params.h"
#include "greenbody/status.h"

/* `greenbody pack --percolation CELLS`: the number of particles at which the growing cluster
 * percolates, of cells whose seeds count up from that of the scene, as CSV on stdout with
 * mean, standard error and standard deviation. */

enum { GB_PACK_PERCOLATION_CELLS = 100000 }; /* most */

/* Errors: GB_ERR_INPUT (lattices, those of gb_percolation_find, stdout cannot be written). */
bool gb_pack_percolation(const struct gb_params *params, int cells, struct gb_error *err);

#endif
