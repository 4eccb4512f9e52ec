#ifndef GB_STUDY_STABILITY_STABILITY_SCENE_H
#define GB_STUDY_STABILITY_STABILITY_SCENE_H

#include "pack/cell/world.h"
#include "scene/model.h"

enum gb_stability_packing {
    GB_STABILITY_PAIR,
    GB_STABILITY_CHAIN,
    GB_STABILITY_LATTICE,
    GB_STABILITY_PACKING
};
enum gb_stability_law { GB_STABILITY_ROD, GB_STABILITY_FRICTION, GB_STABILITY_BRIDGE };

/* Alumina of 9.7 nm at rest, every pair at its equilibrium distance, and its fastest
 * mode. */
struct gb_stability_scene {
    struct gb_model model;
    struct gb_world *world;
    struct gb_world_copy *rest;
    double inertia;   /* rotational, m d^2 */
    double *mass;     /* count; NULL: all are 1 */
    double *mode;     /* count x 6: moves, then turns, both times the root of the
                       * inertia; of length 1 */
    double frequency; /* of the mode */
};

/* inertia: 0.1 of a sphere, or what a relaxer takes. */
bool gb_stability_scene_init(struct gb_stability_scene *scene,
                             enum gb_stability_packing packing, enum gb_stability_law law,
                             double inertia, struct gb_error *err);
/* A copy of a world right after an evaluation, brought to rest, its mode without viscous
 * forces.  power: masses are the diameters to this power.  Errors: those of
 * gb_probe_create. */
bool gb_stability_scene_copy(struct gb_stability_scene *scene,
                             const struct gb_world *world, double inertia, int power,
                             struct gb_error *err);
void gb_stability_scene_finish(struct gb_stability_scene *scene);

/* Moves the particles by `by` times the mode. */
void gb_stability_scene_move(const struct gb_stability_scene *scene, const double *mode,
                             double by);
/* By what a component of the mode is divided for a motion, and an elastic force for a
 * component: the root of the mass, for turns (k from 3 x count on) of the inertia. */
double gb_stability_scene_root(const struct gb_stability_scene *scene, int64_t k);

/* Back to rest, the forces evaluated. */
bool gb_stability_scene_reset(struct gb_stability_scene *scene, struct gb_error *err);

/* The frequency in closed form: normal or rotational-tangential mode of a pair, normal
 * mode of a chain; NaN for other scenes. */
double gb_stability_scene_exact(const struct gb_stability_scene *scene,
                                enum gb_stability_packing packing,
                                enum gb_stability_law law);

#endif
