#ifndef GB_PACK_STRUCTURE_INITIAL_STRUCTURE_H
#define GB_PACK_STRUCTURE_INITIAL_STRUCTURE_H

#include <stdbool.h>

#include "greenbody/status.h"
#include "scene/model.h"

/* Places the particles of the structure that a model begins with: grown chains, a
 * lattice, or those of a file.
 *
 * position    count x 3, filled with positions inside the cell (y = 0 in 2D)
 * cancelled   polled with data during growth; NULL is fine
 * Errors: of gb_chain_growth_run. */
bool gb_initial_structure_fill(const struct gb_model *model,
                               bool (*cancelled)(void *data), void *data,
                               double *position, struct gb_error *err);

#endif
