#ifndef GB_SOLVE_LOADING_LOADING_CELL_H
#define GB_SOLVE_LOADING_LOADING_CELL_H

#include "solve/loading/loading.h"

/* What the modes in a periodic cell share: their world. */

/* A packing grown in the cell; its forces are evaluated. */
bool gb_loading_cell_grow(struct gb_loading *loading, bool (*cancelled)(void *data),
                          void *data, struct gb_error *err);

/* The packing of a record. */
bool gb_loading_cell_load(struct gb_loading *loading, struct gb_record *record,
                          struct gb_error *err);

#endif
