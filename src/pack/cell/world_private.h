#ifndef GB_PACK_CELL_WORLD_PRIVATE_H
#define GB_PACK_CELL_WORLD_PRIVATE_H

#include "base/vec.h"
#include "pack/cell/contact_history.h"
#include "pack/cell/f32_state.h"
#include "pack/cell/list_check.h"
#include "pack/cell/world.h"
#include "pack/kernel/sweep.h"

/* The inside of gb_world, for the files that work on it: world.c (owner), ledger.c
 * (histories across rebuilds), sweep.c (forces), world_record.c (checkpoints). */

/* Sums over one block of particles. */
struct gb_sweep_block {
    struct gb_tally tally;
    struct gb_force_sums sums;
    double travel;                        /* longest way since the list was built */
    struct gb_list_check_missing missing; /* where somebody has strayed */
    double speed2; /* of a drive: sum of squared velocities, with inertia */
};

struct gb_world {
    const struct gb_model *model;
    struct gb_cell cell;
    int64_t count;
    double *position, *turn, *force, *torque; /* count x 3 */
    double *diameter;                         /* d; NULL: all are 1 */
    struct gb_neighbour_list pairs;
    double shift[27][3]; /* of the periodic images, as of the last evaluation */
    struct gb_batch_kernel kernel;
    struct gb_contacts contacts; /* one per near pair */
    double *wrench;              /* rows per near pair: force on i, torque on j */
    double damp;                 /* viscous time over time step */
    bool in_single;              /* histories and forces of pairs are of float ... */
    struct gb_f32_state single;  /* ... and in these instead of wrench and pull, as far as
                                  * they are kept */
    int row;                     /* doubles in a row: 6, in 2D 3 (x, z, about y) */
    int64_t far_room;
    double *pull; /* three per far pair: force on the first particle */
    /* Dynamic scenes, per far pair: distance and pull at the last evaluation. */
    double *far_distance, *far_pull;
    struct gb_contact_history ledger;
    struct gb_contact_history spare; /* of checkpoints, which keep less */
    struct gb_sweep_block *block;
    int32_t *degree; /* scratch of gb_world_coordination, one a particle */
    int threads;
    struct gb_tally tally;
    double force_rms, torque_rms;
    struct gb_force_sums sums;
    /* of the evaluation under way: what its power is asked along; NULL: nothing */
    const double *velocity, *spin;
    bool listed;   /* the pair list exists */
    bool amended;  /* just now, so that it holds where the particles are */
    int64_t state; /* grows whenever a history may have changed */
    int64_t evaluations, rebuilds;
};

struct gb_world_copy {
    struct gb_cell cell;
    int64_t count;
    double *position;
    struct gb_contact_history ledger;
};

/* A copy to be filled, made when *copy is NULL. */
bool gb_world_copy_ensure(const struct gb_world *world, struct gb_world_copy **copy,
                          struct gb_error *err);

/* Room for the contacts and pulls of the lists as they are; what was there is lost when
 * it grows. */
bool gb_world_reserve(struct gb_world *world, struct gb_error *err);

/* Pairs of particle i within n that begin at slot: index behind the last one. */
static inline int gb_world_stop(const struct gb_pair_list *list, int n, int64_t slot,
                                int64_t i)
{
    const int64_t stop = list->start[i + 1] - slot;
    return stop < n ? (int)stop : n;
}

/* Where particle i is, be it that its position has not followed yet. */
static inline void gb_world_at(const struct gb_world *world, int64_t i, double x[3])
{
    for (int c = 0; c < 3; c++) {
        x[c] = world->position[3 * i + c];
        if (world->single.ahead == GB_F32_STATE_PLACES) {
            x[c] = gb_f32_state_follow(x[c], world->single.spot[i].place[c],
                                       gb_f32_state_units(&world->cell, c),
                                       gb_f32_state_d(&world->cell, c));
        }
    }
}

/* x_i - x_j of pair k of a list, nearest image; returns its square. */
static inline double gb_world_arm_of(const struct gb_world *world,
                                     const struct gb_pair_list *list, int64_t i,
                                     int64_t k, double r[3])
{
    double xi[3], xj[3];
    gb_world_at(world, i, xi);
    gb_world_at(world, list->other[k], xj);
    const double *shift = world->shift[list->image[k]];
    for (int c = 0; c < 3; c++) {
        r[c] = xi[c] - xj[c] + shift[c];
    }
    return gb_vec_dot(r, r);
}

/* Reach of the attraction, d; 0: there is none. */
static inline double gb_world_cutoff(const struct gb_world *world)
{
    return world->model->terms.attraction ? world->model->numerics.cutoff : 0.0;
}

#endif
