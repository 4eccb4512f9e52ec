#ifndef GB_PACK_CELL_WORLD_H
#define GB_PACK_CELL_WORLD_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/status.h"
#include "pack/cell/cell.h"
#include "pack/cell/contacts.h"
#include "pack/kernel/batch/batch.h"
#include "pack/kernel/fabric_sums.h"
#include "pack/kernel/tally.h"
#include "pack/list/neighbour_list.h"
#include "scene/model.h"

struct gb_fabric_sums;

struct gb_world;

/* sum[a][b]: sum of f_a r_b over all pairs, in contact or attracting across a gap (E d^3),
 * as of the last evaluation: f is the force on the first particle, r the branch vector from
 * the second to the first.  Over the volume it is the pressure tensor (P1 eq. 16).  Computed
 * once an evaluation. */
void gb_world_virial(const struct gb_world *world, double sum[3][3]);

/* The same in one pass with the sums of the fabric tensors (NULL: without). */
void gb_world_virial_fabric(const struct gb_world *world, double sum[3][3],
                            struct gb_fabric_sums *fabric);

struct gb_engine;

/* A periodic packing: cell, particles, contacts and their history.  Mutable, one thread
 * only; the force sweep inside uses model->numerics.threads threads and gives the same
 * bits for any number of them.  Reduced units.  How it works: docs/engine.md. */
struct gb_world;
struct gb_team;

/* The arrays that relaxers and integrators move: count x 3, valid as long as the
 * world. */
struct gb_bodies {
    int64_t count;
    double *position;    /* d */
    double *rotation;    /* increment since the last evaluation, rad; the next one uses it
                          * up.  With unequal sizes times the diameter, and torques over
                          * it */
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
 * when a force is not finite or centres are about to cross; the history is spoilt then:
 * restore a copy. */
bool gb_world_evaluate(struct gb_world *world, struct gb_error *err);

/* The same, and the power of the forces along these velocities (count x 3 each) of the
 * particles and of their rotations; in single precision along the velocities of
 * pack/f32/integrate_f32.h.  Call gb_world_bodies again afterwards: positions read from
 * an earlier one are not current until gb_world_synchronise. */
bool gb_world_evaluate_along(struct gb_world *world, const double *velocity,
                             const double *spin, struct gb_error *err);

/* Makes `position` current after velocity updates in single precision. */
void gb_world_synchronise(struct gb_world *world);

/* Sums over the particles, of the last evaluation; power 0 where none was summed. */
const struct gb_force_sums *gb_world_sums(const struct gb_world *world);

/* Dynamic scenes: time between two evaluations, for the viscous forces. */
void gb_world_set_step(struct gb_world *world, double time_step);

/* Scales the cell and all positions affinely, axis by axis. */
void gb_world_strain(struct gb_world *world, const double factor[3]);

/* Deforms the cell and all positions affinely.  Particles turn with the rotation of F:
 * none where F is symmetric.  Shear is for scenes with model->sheared and for copies in
 * double precision. */
void gb_world_deform(struct gb_world *world, const struct gb_deformation *deformation);

/* All arrays, for reading and moving the particles. */
struct gb_bodies gb_world_bodies(struct gb_world *world);
/* Positions and rotations only, without a conversion of forces; force, torque: NULL. */
struct gb_bodies gb_world_movable(struct gb_world *world);
/* The same for readers: positions and forces are brought up to date, and no later bit depends
 * on the call. */
struct gb_bodies gb_world_readable(struct gb_world *world);
const struct gb_cell *gb_world_cell(const struct gb_world *world);
const struct gb_model *gb_world_model(const struct gb_world *world);
const struct gb_tally *gb_world_tally(const struct gb_world *world);
/* The threads of its sweeps; NULL: the calling one alone. */
struct gb_team *gb_world_team(const struct gb_world *world);
const double *gb_world_position(const struct gb_world *world);
/* Diameters (count), d; NULL: all are 1. */
const double *gb_world_diameters(const struct gb_world *world);
/* Diameter of particle i, d. */
double gb_world_diameter(const struct gb_world *world, int64_t i);

/* rms force, E d^2, or rms torque over d, whichever is larger. */
double gb_world_imbalance(const struct gb_world *world);

/* The imbalance over the force scale: the mean |f_n| of the contacts or f_a(d), whichever
 * is larger (without adhesion: a small floor). */
double gb_world_residual(const struct gb_world *world);

/* Largest force, and largest torque, on a particle: E d^2, E d^3. */
void gb_world_largest(const struct gb_world *world, double *force, double *torque);

/* For measurements: the neighbour lists, and the contact records of their `near` pairs.
 * Forces of pairs: pack/kernel/pair_forces.h. */
const struct gb_neighbour_list *gb_world_pairs(const struct gb_world *world);
const struct gb_contacts *gb_world_contacts(const struct gb_world *world);
/* Coordination number of every particle, counted at the call; valid until the next call,
 * by one thread at a time. */
const int32_t *gb_world_coordination(const struct gb_world *world);
/* x_i - x_other of pair k of a list (d), as of the last evaluation. */
void gb_world_branch_vector(const struct gb_world *world, const struct gb_pair_list *list,
                            int64_t i, int64_t k, double r[3]);

int64_t gb_world_evaluations(const struct gb_world *world);
/* Sets the number: after going back to a record, evaluations since then count, too. */
void gb_world_set_evaluations(struct gb_world *world, int64_t evaluations);
int64_t gb_world_rebuilds(const struct gb_world *world);

/* A copy of cell, positions and contact histories, for a restore. */
struct gb_world_copy;
/* Reuses *copy when it is not NULL. */
bool gb_world_copy_save(const struct gb_world *world, struct gb_world_copy **copy,
                        struct gb_error *err);
bool gb_world_copy_restore(struct gb_world *world, const struct gb_world_copy *copy,
                           struct gb_error *err);
void gb_world_copy_destroy(struct gb_world_copy *copy); /* NULL is fine */

/* 64-bit hash over cell, positions and histories: equal states, equal hashes. */
uint64_t gb_world_hash(const struct gb_world *world);

/* rho = N (pi/6) <d^3> / V; 2D: (pi/4) N d^2 / A. */
double gb_world_density(const struct gb_world *world);

/* P_ij = (1/V) sum over pairs of f_i r_j, f the whole force on the first particle, r from
 * the second to it: minus the stress tensor of P1 (16).  E. */
void gb_world_pressure(const struct gb_world *world, double pressure[3][3]);

/* The same, and what fabric tensors are made of. */
void gb_world_tensors(const struct gb_world *world, double pressure[3][3],
                      struct gb_fabric_sums *fabric);

/* The normal pressures P_xx, P_yy, P_zz alone. */
void gb_world_normal_pressures(const struct gb_world *world, double pressure[3]);

#endif
