#ifndef GB_PACK_CELL_PARTICLES_H
#define GB_PACK_CELL_PARTICLES_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/status.h"
#include "pack/cell/cell.h"
#include "scene/model.h"

struct gb_team;

/* The particles and their cell; owned by particles.c.  Reduced units. */
struct gb_particles {
    int64_t count;
    struct gb_cell cell;
    double *position;       /* count x 3, d */
    double *rotation;       /* count x 3: increment since the last evaluation, rad */
    double *force, *torque; /* count x 3: of the last evaluation */
    double *diameter;       /* d; NULL: all are 1 */
};

/* The cell of the scene, with the tilts of an imported packing. */
void gb_particles_cell(const struct gb_model *model, struct gb_cell *cell);
bool gb_particles_init(struct gb_particles *particles, const struct gb_model *model,
                       const double *position, struct gb_error *err);
void gb_particles_finish(struct gb_particles *particles);

/* Deforms the cell and all positions affinely; the rotation of F is added to the rotation
 * increments. */
void gb_particles_deform(struct gb_particles *particles,
                         const struct gb_deformation *deformation);

/* Replaces cell and positions; no rotation is left over. */
void gb_particles_replace(struct gb_particles *particles, const struct gb_cell *cell,
                          const double *position);

/* Moves all positions into the cell. */
void gb_particles_wrap(struct gb_particles *particles, struct gb_team *team);

#endif
