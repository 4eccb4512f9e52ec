#ifndef GB_PACK_DIE_RANDOM_INSERTION_H
#define GB_PACK_DIE_RANDOM_INSERTION_H

#include <stdbool.h>

#include "pack/die/bed.h"
#include "scene/seed.h"

/* Loose powder in the funnel: the spheres of a bed at random positions without overlap,
 * the large ones inserted first, in the cone above the die from its outlet up to the
 * height at which their volume is `density` of the cone.  All at rest.
 *
 * seed        same seed, same positions; the sizes are the bed's own
 * density     about 0.2; beyond 0.3 there may be no room left
 * cancelled   may be NULL; polled, true fails with GB_ERR_CANCELLED
 * Errors: GB_ERR_INPUT when no free position is found for a sphere, GB_ERR_MEMORY.
 * Source: P3 section 5. */
bool gb_random_insertion_fill(struct gb_bed *bed, const struct gb_seed *seed,
                              double density, bool (*cancelled)(void *data), void *data,
                              struct gb_error *err);

#endif
