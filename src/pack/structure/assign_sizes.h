#ifndef GB_PACK_STRUCTURE_ASSIGN_SIZES_H
#define GB_PACK_STRUCTURE_ASSIGN_SIZES_H

#include "scene/model.h"

/* The sizes of a powder in the order that a seed gives them (gb_sizes_fill, shuffled).
 *
 * diameter_m   count values
 * Errors: GB_ERR_MEMORY.  Same sizes, count and seed: same bits. */
bool gb_assign_sizes(const struct gb_sizes *sizes, int64_t count, uint64_t seed,
                     double *diameter_m, struct gb_error *err);

/* Those of a model's particles, d: its sizes, or 1. */
bool gb_assign_sizes_model(const struct gb_model *model, double *diameter,
                           struct gb_error *err);

#endif
