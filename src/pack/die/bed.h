#ifndef GB_PACK_DIE_BED_H
#define GB_PACK_DIE_BED_H

#include <stdbool.h>
#include <stdint.h>

#include "base/team.h"
#include "greenbody/status.h"
#include "pack/die/die.h"
#include "pack/kernel/bed_batch.h"
#include "pack/structure/hgrid.h"

/* Forces on the walls, and what limits the time step. */
struct gb_bed_tally {
    /* Bound of omega^2 of the modes without friction: the largest (2 k/m* + L)/3 of a contact,
     * where L is the stiffness of all contacts over the mass, summed over its two bodies.  It
     * is omega^2 of a lone pair, and what others add where they point in all directions; a
     * straight chain has 1.5 times it. */
    double stiffest;
    /* Largest closing speed times (H/m*)^2 of a listed contact, H its force over h^1.5: by it
     * the shortest collision that is under way or may begin (gb_die_state_leapfrog_impact).  Both bounds
     * are those of the pairs that the list has, which resumed runs make at the same steps. */
    double impact;
    double floor, punch; /* force on them, positive in compression */
    double side[2];      /* sum of f_x x, f_y y over the side's contacts */
    double drag;         /* of the side on the powder, along -z */
};

struct gb_bed_block {
    _Alignas(64) struct gb_bed_tally tally;
    double deviation2, fastest; /* of the last step, pack/die/bed_sweep.h */
    int64_t crossings;          /* listed pairs with a second particle in another block */
};

/* A pair of two blocks adds the force on its second particle to a row of its own, its
 * crossing; the block of that particle sums those rows, in the order of the pairs. */
struct gb_bed_blocks {
    int64_t count, size; /* blocks, and particles in one */
    struct gb_bed_block *block;
    int64_t *cost;     /* of all blocks before, count + 1 */
    int64_t *crossing; /* first one of each block, count + 1 */
    int64_t *entry;    /* first one that leads into each block, count + 1 */
    int64_t room;
    int32_t *target;             /* second particle of a crossing */
    int32_t *row, *row_particle; /* by entry: the crossing, and its second particle */
};

bool gb_bed_blocks_init(struct gb_bed_blocks *blocks, int64_t particles,
                        struct gb_error *err);
void gb_bed_blocks_finish(struct gb_bed_blocks *blocks);

/* Particles of block b: those from begin on, before end. */
int64_t gb_bed_blocks_begin(int64_t particles, int64_t b);
int64_t gb_bed_blocks_end(int64_t particles, int64_t b);

/* Room for the crossings that the blocks have counted; `crossing` follows.
 * Errors: GB_ERR_MEMORY. */
bool gb_bed_blocks_number(struct gb_bed_blocks *blocks, struct gb_error *err);

/* Entries of the crossings, whose targets are known. */
void gb_bed_blocks_enter(struct gb_bed_blocks *blocks);

/* Spheres of many sizes in a die.  Reduced units: length d (the reference diameter),
 * stress E, mass that of a sphere of diameter d, so that time is sqrt(m/(E d)).  The
 * fourth of a row is the radius in `position`, in `force` the sum of the normal stiffnesses of
 * the contacts (E d), in `velocity` that over the mass at the last step (1/T^2), and 0
 * elsewhere.  Rotation is that of the surface: `roll` is R w (d/T) and `moment` the torque over R
 * (E d^2), so that contacts need no radius for them.  The rows of
 * the walls follow those of the particles (enum gb_die_wall); `force` and `moment` have the walls once for each block, and then
 * the crossings (gb_bed_blocks). */

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
 * (pack/die/bed_sweep.h).  Errors: GB_ERR_MEMORY. */
bool gb_bed_evaluate(struct gb_bed *bed, double step, double deviation2,
                     struct gb_error *err);

/* The same, but the forces of pairs of two blocks on their second particles are still in the
 * rows of the crossings: gb_bed_sweep_kick adds them. */
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
