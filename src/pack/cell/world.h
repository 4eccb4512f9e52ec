#ifndef GB_PACK_CELL_WORLD_H
#define GB_PACK_CELL_WORLD_H

#include <stdbool.h>
#include <stdint.h>

#include "scene/model.h"
#include "greenbody/status.h"
#include "pack/cell/cell.h"
#include "pack/cell/neighbour_list.h"
#include "pack/kernel/batch.h"

/* Owner of a packing: cell, particles, contacts and their history.  Mutable, one thread
 * only; the force sweep inside uses model->numerics.threads threads and gives the same
 * bits for any number of them.  Reduced units. */
struct gb_world;

/* What relaxers and integrators move.  Arrays of count x 3, valid as long as the world.
 */
struct gb_bodies {
    int64_t count;
    double *position;
    double *rotation;    /* since the last evaluation; consumed by it; in scenes
                          * of unequal sizes times the diameter, and torques over it */
    const double *force; /* of the last evaluation */
    const double *torque;
};

/* World with the initial positions (count x 3, inside the cell); no history yet.  The
 * model must outlive it. */
bool gb_world_create(struct gb_world **out, const struct gb_model *model,
                     const double *position, struct gb_error *err);
void gb_world_destroy(struct gb_world *world); /* NULL is fine */

/* Forces and torques at the present positions; advances the history of every contact by
 * the motion since the last evaluation.  Errors: GB_ERR_GUARD with the particle named
 * when a force is not finite or centres are about to cross; the history is then spoilt:
 * restore a copy. */
bool gb_world_evaluate(struct gb_world *world, struct gb_error *err);

/* The same, and the power of the forces along these velocities (count x 3 each), of the
 * particles and of their turns; in a world that drives (pack/cell/integrate_f32.h) along its own.
 * What gb_world_bodies told before has to be asked anew, and the positions told otherwise
 * lag behind until gb_world_synchronise. */
bool gb_world_evaluate_along(struct gb_world *world, const double *velocity,
                             const double *spin, struct gb_error *err);

/* Positions are those of the last motion or evaluation from here on. */
void gb_world_synchronise(struct gb_world *world);

/* Sums over the particles, of the last evaluation. */
struct gb_force_sums {
    double force2, torque2; /* squares */
    double power;           /* along the velocities it was given; else 0 */
};
const struct gb_force_sums *gb_world_sums(const struct gb_world *world);

/* Dynamic scenes: the time that lies between evaluations, for the viscous forces. */
void gb_world_set_step(struct gb_world *world, double time_step);

/* Scales the cell and all positions affinely, axis by axis. */
void gb_world_strain(struct gb_world *world, const double factor[3]);

struct gb_bodies gb_world_bodies(struct gb_world *world);
/* Positions and turns alone, which cost nothing to tell; forces and torques NULL. */
struct gb_bodies gb_world_movable(struct gb_world *world);
const struct gb_cell *gb_world_cell(const struct gb_world *world);
const struct gb_model *gb_world_model(const struct gb_world *world);
const struct gb_tally *gb_world_tally(const struct gb_world *world);
/* Threads that work on it. */
int gb_world_threads(const struct gb_world *world);
const double *gb_world_position(const struct gb_world *world);
/* Of particle i, d. */
double gb_world_diameter(const struct gb_world *world, int64_t i);

/* rms force (and torque over d, whichever is larger) over the force scale: the mean |f_n|
 * of the contacts or f_a(d), whichever is larger (without adhesion: a small floor). */
double gb_world_residual(const struct gb_world *world);

/* The neighbour list and what belongs to its pairs, for measures: histories of the `near`
 * ones here, forces in pack/kernel/pair_forces.h. */
const struct gb_neighbour_list *gb_world_pairs(const struct gb_world *world);
/* Contacts of every particle, one number each, counted anew; good until the next call, by
 * one thread at a time. */
const int32_t *gb_world_coordination(const struct gb_world *world);
const struct gb_contacts *gb_world_contacts(const struct gb_world *world);
/* x_i - x_other of pair k of a list, as of the last evaluation. */
void gb_world_branch_vector(const struct gb_world *world, const struct gb_pair_list *list,
                            int64_t i, int64_t k, double r[3]);

int64_t gb_world_evaluations(const struct gb_world *world);
int64_t gb_world_rebuilds(const struct gb_world *world);

/* A copy of the state that matters (cell, positions, contact histories), to go back to.
 */
struct gb_world_copy;
bool gb_world_copy_save(const struct gb_world *world, struct gb_world_copy **copy,
                        struct gb_error *err); /* reuses *copy when not NULL */
bool gb_world_copy_restore(struct gb_world *world, const struct gb_world_copy *copy,
                           struct gb_error *err);
void gb_world_copy_destroy(struct gb_world_copy *copy); /* NULL is fine */

/* 64-bit hash over cell, positions and histories: equal states, equal hashes. */
uint64_t gb_world_hash(const struct gb_world *world);

#endif
