#ifndef GB_SOLVE_LOADING_PATH_STRAIN_TANGENT_H
#define GB_SOLVE_LOADING_PATH_STRAIN_TANGENT_H

#include "greenbody/status.h"
#include "pack/cell/world.h"
#include "scene/path/path.h"

/* Stress of a packing against strain of its cell, as far as it is known: stress increments
 * k strain increments, components as in scene/path/path.h, in E. */
struct gb_strain_tangent {
    double k[GB_PATH_COMPONENTS][GB_PATH_COMPONENTS];
};

/* Deformation gradient of the strains: diagonal exp(-e), engineering shears above it. */
struct gb_deformation
gb_strain_tangent_deformation(const double strain[GB_PATH_COMPONENTS]);

/* Pressures xx, yy, zz and the shear stresses of a world right after an evaluation. */
void gb_strain_tangent_stress(const struct gb_world *world,
                              double stress[GB_PATH_COMPONENTS]);

/* The tangent without relaxation, from small affine strains of the packing, which is
 * brought back to *good (saved here).  Shears only where the model allows them.  Stiffer
 * than the relaxed packing, and the start of what is learned.  Errors: GB_ERR_MEMORY,
 * GB_ERR_GUARD. */
bool gb_strain_tangent_measure(struct gb_strain_tangent *tangent, struct gb_world *world,
                               struct gb_world_copy **good, struct gb_error *err);

/* Learns from one increment: afterwards k strain = stress holds for it (Broyden's rank-one
 * update, Math. Comput. 19, 577 (1965)). */
void gb_strain_tangent_learn(struct gb_strain_tangent *tangent,
                             const double strain[GB_PATH_COMPONENTS],
                             const double stress[GB_PATH_COMPONENTS]);

/* A linear condition on the stress of component `of`: its increment, less share times the
 * one of component `base` (share 0: none), is `change`. */
struct gb_stress_condition {
    int of, base;
    double share, change;
};

/* Fills the strains of the components named by the conditions, the other ones given, so
 * that all conditions hold; at most GB_PATH_COMPONENTS.  False: the tangent is singular;
 * strain is untouched then. */
bool gb_strain_tangent_solve(const struct gb_strain_tangent *tangent,
                             const struct gb_stress_condition *condition, int count,
                             double strain[GB_PATH_COMPONENTS]);

#endif
