#ifndef GB_SOLVE_LOADING_LOADING_CELL_H
#define GB_SOLVE_LOADING_LOADING_CELL_H

#include <stdbool.h>

#include "scene/model.h"
#include "solve/loading/loading.h"

/* The axes of a periodic cell that its loading strains. */
struct gb_compressed_axes {
    bool axis[3];
    int count;
};

struct gb_compressed_axes gb_loading_cell_of(const struct gb_model *model);

/* Mean over these axes of the normal pressures in x, y, z. */
double gb_loading_cell_mean(const struct gb_compressed_axes *axes,
                            const double pressure[3]);

/* factor along these axes, 1 along the others. */
void gb_loading_cell_scale(const struct gb_compressed_axes *axes, double along,
                           double factor[3]);

/* What the modes in a periodic cell share: their world. */

/* A packing grown in the cell; its forces are evaluated. */
bool gb_loading_cell_grow(struct gb_loading *loading, bool (*cancelled)(void *data),
                          void *data, struct gb_error *err);

/* The packing of a record. */
bool gb_loading_cell_load(struct gb_loading *loading, struct gb_record *record,
                          struct gb_error *err);

#endif
