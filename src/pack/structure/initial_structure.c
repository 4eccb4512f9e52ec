#include "pack/structure/initial_structure.h"

#include <string.h>

#include "pack/structure/chain_growth.h"
#include "scene/imported/imported.h"
#include "scene/lattice.h"
#include "scene/model.h"

/* Particle p of the unit cell at `at`. */
static void fill_point(const struct gb_model *model, const struct gb_lattice *lattice,
                       const int64_t cells[3], const int64_t at[3], int p, double x[3])
{
    for (int k = 0; k < 3; k++) {
        const double share = ((double)at[k] + lattice->point[p][k]) / (double)cells[k];
        x[k] = lattice->cell[k] > 0.0 ? model->edges[k] * share : 0.0;
    }
}

/* Positions of a packing of whole unit cells: count x 3, d, inside the cell of the model.
 * The model's structure is a lattice and its count fits (scene/lattice.h). */
static void unit_cells_fill(const struct gb_model *model, double *position)
{
    const struct gb_lattice *lattice = gb_lattice_of(model->structure);
    int64_t cells[3], at[3];
    (void)gb_lattice_block(lattice, model->count, cells);
    for (at[2] = 0; at[2] < cells[2]; at[2]++) {
        for (at[1] = 0; at[1] < cells[1]; at[1]++) {
            for (at[0] = 0; at[0] < cells[0]; at[0]++) {
                for (int p = 0; p < lattice->particles; p++, position += 3) {
                    fill_point(model, lattice, cells, at, p, position);
                }
            }
        }
    }
}

bool gb_initial_structure_fill(const struct gb_model *model,
                               bool (*cancelled)(void *data), void *data,
                               double *position, struct gb_error *err)
{
    if (model->packing) {
        memcpy(position, model->packing->position,
               3 * (size_t)model->count * sizeof *position);
        return true;
    }
    if (model->structure != GB_STRUCTURE_GROWN) {
        unit_cells_fill(model, position);
        return true;
    }
    struct gb_chain_growth growth = gb_chain_growth_from_model(model);
    growth.cancelled = cancelled;
    growth.data = data;
    return gb_chain_growth_run(&growth, position, err);
}
