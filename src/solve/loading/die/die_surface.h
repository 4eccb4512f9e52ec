#ifndef GB_SOLVE_LOADING_DIE_DIE_SURFACE_H
#define GB_SOLVE_LOADING_DIE_DIE_SURFACE_H

#include "base/record.h"
#include "pack/die/bed.h"

/* A surface of the compact: the particles that touched a wall under the full pressure.  The
 * median over them stands for its position: a few particles that come off move the mean by
 * any amount.  A zeroed surface is empty. */
struct gb_die_surface {
    int64_t count;
    int32_t *particle;
    double *value; /* room for the median */
};

/* The particles that touch a wall, right after an evaluation; replaces what it held.
 * Errors: GB_ERR_MEMORY. */
bool gb_die_surface_take(struct gb_die_surface *surface, const struct gb_bed *bed,
                         enum gb_die_wall wall, struct gb_error *err);
void gb_die_surface_finish(struct gb_die_surface *surface);

/* Median height of the upper, or distance from the axis of the outer points of its
 * particles; NaN for an empty one. */
double gb_die_surface_height(const struct gb_die_surface *surface,
                             const struct gb_bed *bed);
double gb_die_surface_radius(const struct gb_die_surface *surface,
                             const struct gb_bed *bed);

/* Into a record, or back; loading, a record without the item leaves it empty.
 * particles: of the bed.  Errors: GB_ERR_INPUT, GB_ERR_MEMORY. */
bool gb_die_surface_record(struct gb_die_surface *surface, const char *name,
                           int64_t particles, struct gb_record *record,
                           struct gb_error *err);

#endif
