#include "pack/structure/unit_cells.h"

#include "scene/lattice.h"

/* Particle p of the unit cell at `at`. */
static void fill_point(const struct gb_model *model, const struct gb_lattice *lattice,
                       const int64_t cells[3], const int64_t at[3], int p, double x[3])
{
    for (int k = 0; k < 3; k++) {
        const double share = ((double)at[k] + lattice->point[p][k]) / (double)cells[k];
        x[k] = lattice->cell[k] > 0.0 ? model->edges[k] * share : 0.0;
    }
}

void gb_unit_cells_fill(const struct gb_model *model, double *position)
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
