#ifndef GB_PACK_STRUCTURE_UNIT_CELLS_H
#define GB_PACK_STRUCTURE_UNIT_CELLS_H

#include "scene/model.h"

/* Positions of a packing of whole unit cells: count x 3, d, inside the cell of the model.
 * The model's structure is a lattice and its count fits (scene/lattice.h). */
void gb_unit_cells_fill(const struct gb_model *model, double *position);

#endif
