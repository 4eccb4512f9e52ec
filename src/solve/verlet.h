#ifndef GB_SOLVE_VERLET_H
#define GB_SOLVE_VERLET_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/status.h"
#include "pack/cell/world.h"

/* Newton's equations for translation and rotation, P2 (1), by velocity Verlet. Velocities
 * are those beside the affine motion of the cell.  Reduced units: a particle of the
 * reference diameter has m = 1, J = 0.1; one of diameter d has m = d^3, J = m d^2/10, and
 * its rotations are arcs, d times the angle (pack/kernel/sweep_f64.h), whose inertia is
 * m/10.  In 2D only x, z and the rotation about y move; discs have the masses of spheres,
 * P2 (1). */
struct gb_verlet {
    int64_t count;
    double inertia;          /* over the mass, d = 1 */
    double *velocity, *spin; /* count x 3 */
    double *inverse_mass;    /* count x 3, each mass three times; NULL: all are 1 */
    double work;             /* done by the moving cell on the packing */
    double absorbed;         /* taken up by the contacts */
};

bool gb_verlet_init(struct gb_verlet *verlet, const struct gb_model *model,
                    struct gb_error *err);
void gb_verlet_finish(struct gb_verlet *verlet);

/* One step of the given length; the cell and all positions are scaled by factor on the
 * way (1, 1, 1: a fixed cell).  The world must have been evaluated at the present
 * positions. Errors: as of gb_world_evaluate. */
bool gb_verlet_step(struct gb_verlet *verlet, struct gb_world *world, double time_step,
                    const double factor[3], struct gb_error *err);

double gb_verlet_kinetic(const struct gb_verlet *verlet);

/* Highest frequency of the packing as it is, from the stiffness around each particle: the
 * pair mode in which shear and rotation go together is the stiffest, sqrt(3) times the
 * normal one at nu = 0.25.  A step above 2 over it blows up. */
double gb_verlet_frequency(const struct gb_world *world, double *scratch);

#endif
