#ifndef GB_SCENE_SEED_H
#define GB_SCENE_SEED_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/params.h"
#include "greenbody/status.h"

/* Does the result depend on the seed?  It does in dies and grown structures.  Lattices
 * and packings from a file give the same cell for every seed. */
bool gb_seed_matters(const struct gb_params *params);

/* Checks a plan of several cells that differ only by their seed.  Identical cells would
 * have an error of zero.  Errors: GB_ERR_INPUT. */
bool gb_seed_check_cells(const struct gb_params *params, size_t cells,
                         struct gb_error *err);

#endif
