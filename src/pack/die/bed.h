#ifndef GB_PACK_DIE_BED_H
#define GB_PACK_DIE_BED_H

#include <stdbool.h>
#include <stdint.h>

#include "base/team/team.h"
#include "greenbody/status.h"
#include "pack/die/bed_blocks.h"
#include "pack/die/die.h"
#include "pack/kernel/bed_batch.h"
#include "pack/structure/hgrid.h"

/* Spheres of many sizes in a die.  Reduced units: length d (the reference diameter),
 * stress E, mass that of a sphere of diameter d, so that time is sqrt(m/(E d)).  The
 * fourth of a row is the radius in `position`, in `force` the sum of the normal stiffnesses of
 * the contacts (E d), in `velocity` that over the mass at the last step (1/T^2), and 0
 * elsewhere.  Rotation is that of the surface: `roll` is R w (d/T) and `moment` the torque over R
 * (E d^2), so that contacts need no radius for them.  Behind the rows of the particles are those of
 * the walls (enum gb_die_wall); `force` and `moment` have the walls once for each block, and then
 * the crossings (pack/die/bed_blocks.h). */

/* Near contacts, sorted by their first particle and then by `other`: the second particle,
 * or enum gb_die_wall. */
struct gb_bed_list {
    int64_t count;
    int64_t *start; /* particles + 1 */
    int64_t room;
    int32_t *first, *other; /* of each slot */
    int32_t *target;        /* row of `force` and `moment` for the second */
    struct gb_bed_contacts contacts;
};

struct gb_bed_welds;

struct gb_bed {
    int64_t count;
    gb_bed_row *position, *velocity, *roll, *force, *moment;
    double *mass, *inverse_mass;
    double inertia; /* moment of inertia over m R^2: 2/5, times 10 in P3 */
    struct gb_die die;
    struct gb_bed_law law;
    gb_bed_kernel *pair_kernel, *wall_kernel;
    struct gb_bed_transfer transfer; /* of pairs */
    struct gb_bed_list pairs, walls;
    struct gb_bed_tally tally; /* of the last evaluation */
    struct gb_bed_blocks blocks;
    struct gb_team *team;       /* NULL: one thread */
    int64_t force_room;         /* rows of `force` and `moment` */
    struct gb_bed_welds *welds; /* of the compact; NULL: none */
    double smallest;            /* radius */
    int32_t *counts;            /* one per particle, for measures to count in */
    int64_t evaluations, rebuilds;
    /* The candidates, pairs with a gap below the skin, and the list of walls hold while
     * nothing has moved further than half the skin since they were built.  The list of pairs
     * has those of them that steady motion brings closer than near_skin in listed_time; it
     * holds for that time, while nothing deviates from this motion by half of near_skin. */
    double skin, near_skin;
    struct gb_hgrid hgrid; /* the candidates */
    int32_t *near;         /* second particles of those that are drawn, by block */
    int64_t near_room;
    gb_bed_row *built_position, *listed_position, *listed_velocity;
    double listed_age, listed_time; /* of the list of pairs: now, and at most */
    double moved_most; /* since the candidates were built, while that list holds */
    double punch_built_position, top_built_position;
    int64_t built_evaluation, listed_evaluation; /* evaluations then */
    bool listed;
    struct gb_bed_list previous_pairs, previous_walls;
};

/* count      spheres, with these radii; at rest at the origin
 * Errors: GB_ERR_MEMORY. */
bool gb_bed_create(struct gb_bed **out, int64_t count, const double *radius,
                   const struct gb_die *die, const struct gb_bed_law *law,
                   double inertia_scale, struct gb_error *err);
void gb_bed_destroy(struct gb_bed *bed); /* NULL is fine */

/* At most this many threads; the bits do not depend on their number.  Errors: GB_ERR_MEMORY. */
bool gb_bed_use_threads(struct gb_bed *bed, int threads, struct gb_error *err);

/* work(data, b) for each block b, on the threads: always on the same shares of them, so that a
 * core finds its rows where it left them. */
void gb_bed_run_blocks(struct gb_bed *bed, gb_team_item *work, void *data);

/* First row of `force` and `moment` for the walls of block b, and for the crossings. */
int64_t gb_bed_wall_rows(const struct gb_bed *bed, int64_t b);
int64_t gb_bed_crossing_rows(const struct gb_bed *bed);

/* Masses of the present radii. */
void gb_bed_weigh(struct gb_bed *bed);

/* Replaces the law; all contacts lose their history. */
void gb_bed_set_law(struct gb_bed *bed, const struct gb_bed_law *law);

/* Forces and torques at the present positions and velocities; advances the history of
 * every contact over the step since the last evaluation.  deviation2: largest squared
 * deviation of a particle from steady motion since the pairs were listed
 * (pack/die/bed_drift.h).  Errors: GB_ERR_MEMORY. */
bool gb_bed_evaluate(struct gb_bed *bed, double step, double deviation2,
                     struct gb_error *err);

/* The same, but the forces of pairs of two blocks on their second particles are still in the
 * rows of the crossings: gb_bed_drift_kick adds them. */
bool gb_bed_evaluate_blocks(struct gb_bed *bed, double step, double deviation2,
                            struct gb_error *err);

/* Positions were replaced: the next evaluation rebuilds the lists. */
void gb_bed_invalidate_lists(struct gb_bed *bed);

/* First particle that is not a number or beyond a wall; -1: none. */
int64_t gb_bed_escaped(const struct gb_bed *bed);

/* Largest overlap of the listed pairs, in diameters of the smaller particle, and its two
 * particles; 0: none. */
double gb_bed_deepest(const struct gb_bed *bed, int64_t pair[2]);

/* Sums over a bed, right after an evaluation. */
double gb_bed_solid_volume(const struct gb_bed *bed);
struct gb_bed_kinetic_energy {
    double translational, rotational; /* of the centres, about them */
};
struct gb_bed_kinetic_energy gb_bed_kinetic_energy(const struct gb_bed *bed);
double gb_bed_top(const struct gb_bed *bed); /* of the highest particle */
/* rms resultant force (gravity g acts along -z) over the mean normal force of the
 * contacts; INFINITY without contacts. */
double gb_bed_unbalanced_force(const struct gb_bed *bed, double gravity);

#endif
