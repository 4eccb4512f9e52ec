#ifndef GB_PACK_STRUCTURE_HILBERT_H
#define GB_PACK_STRUCTURE_HILBERT_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/status.h"
#include "scene/model.h"

/* Numbers the particles of a model along a Hilbert curve, so that neighbours in space are
 * neighbours in memory: every sweep reads and adds to both particles of a pair. Particles
 * of unequal sizes keep their order, in which the sizes are assigned.
 *
 * position   count x 3, d; put into the new order
 * Errors: GB_ERR_MEMORY.  Particles of one cell of the curve keep their order. */
bool gb_hilbert_sort(const struct gb_model *model, double *position,
                     struct gb_error *err);

/* Where the curve of 2^bits cells an edge comes through a cell, 0 to 2^(n bits) - 1;
 * cells that follow each other share a face.
 *
 * cell   n coordinates, each below 2^bits
 * Source: Skilling, AIP Conf. Proc. 707, 381 (2004). */
uint64_t gb_hilbert_index(const uint32_t *cell, int n, int bits);

/* Particles and where the curve passes them. */
struct gb_hilbert_entry {
    uint64_t key;
    int64_t particle;
};

/* Sorts by key, and by particle where keys are equal. */
void gb_hilbert_order(struct gb_hilbert_entry *entry, int64_t count);

#endif
