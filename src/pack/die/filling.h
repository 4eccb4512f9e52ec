#ifndef GB_PACK_DIE_FILLING_H
#define GB_PACK_DIE_FILLING_H

#include <stdbool.h>

#include "pack/die/bed.h"
#include "scene/model.h"

/* Loose powder in the funnel: the spheres of a bed at random positions without overlap,
 * the large ones inserted first, in the cone above the die from its outlet up to the
 * height at which their volume is `density` of the cone.  All at rest.
 *
 * seed        same seed, same positions; the sizes are the bed's own
 * density     about 0.2; beyond 0.3 there may be no room left
 * cancelled   may be NULL; polled, true fails with GB_ERR_CANCELLED
 * Errors: GB_ERR_INPUT when no free position is found for a sphere, GB_ERR_MEMORY.
 * Source: P3 section 5. */
bool gb_filling_fill(struct gb_bed *bed, uint64_t seed, double density,
                     bool (*cancelled)(void *data), void *data, struct gb_error *err);

/* The powder of a scene with kind = die, loose in the funnel above its die, with
 * the law of filling.  Same sizes, seed and die: same bits, for any law of pressing.
 *
 * cancelled   may be NULL; polled with data, true fails with GB_ERR_CANCELLED
 * Errors: GB_ERR_INPUT naming the keys when particles or powder do not fit the die. */
bool gb_filling_create(struct gb_bed **out, const struct gb_params *params,
                       const struct gb_model *model, bool (*cancelled)(void *data),
                       void *data, struct gb_error *err);

/* The same bed without initial positions, for a load. */
bool gb_filling_allocate(struct gb_bed **out, const struct gb_params *params,
                         const struct gb_model *model, struct gb_error *err);

/* Law of filling: Hertz without friction between particles, P3 section 5. */
/* Law of pressing, as the keys of [contact] and [material] say. */
struct gb_bed_law gb_filling_compaction_law(const struct gb_params *params);

#endif
