#ifndef GB_PACK_CELL_ENGINE_H
#define GB_PACK_CELL_ENGINE_H

#include <stdbool.h>
#include <stdint.h>

#include "base/vec.h"
#include "greenbody/status.h"
#include "pack/cell/contacts.h"
#include "pack/cell/particles.h"
#include "pack/f32/f32_state.h"
#include "pack/kernel/batch/batch.h"
#include "pack/kernel/tally.h"
#include "pack/list/list_check.h"
#include "pack/list/neighbour_list.h"
#include "scene/model.h"

/* Positions exist twice: `position` (double, count x 3), which everything outside the
 * engine reads and writes, and fixed-point positions, which sweeps in single precision and
 * integrate_f32.c work on.  The state says which of them is current, whether a velocity
 * update waits for its evaluation, and whether the bounds of the particle groups hold. */
enum gb_engine_motion {
    /* `position` is current, fixed-point positions are stale, bounds unknown */
    GB_ENGINE_EDITED,
    /* evaluated; both agree; bounds unknown */
    GB_ENGINE_EVALUATED,
    /* a velocity update without its evaluation; `position` is stale; bounds known */
    GB_ENGINE_MOVED,
    /* the same, `position` synchronised */
    GB_ENGINE_MOVED_SYNCHRONISED,
    /* a velocity update with its evaluation; `position` is stale; bounds known */
    GB_ENGINE_RELAXING,
    /* the same, `position` synchronised */
    GB_ENGINE_RELAXING_SYNCHRONISED,
    GB_ENGINE_MOTIONS,
};

enum gb_engine_lists {
    GB_ENGINE_NO_LISTS, /* not built yet, or spoilt by a failure */
    GB_ENGINE_LISTS,
    GB_ENGINE_LISTS_PATCHED, /* just checked and completed: valid for the next sweep
                              * without another check */
};

/* Where forces and torques of the last evaluation are. */
enum gb_engine_forces {
    GB_ENGINE_FORCES_F64, /* in the arrays of gb_particles (and in f32, where that exists) */
    GB_ENGINE_FORCES_F32, /* in gb_f32_state only */
};

struct gb_engine_state {
    enum gb_real real; /* constant */
    enum gb_engine_motion motion;
    enum gb_engine_lists lists;
    enum gb_engine_forces forces;
    int64_t evaluation; /* number of the last one: what was computed from it tells by this
                         * whether it still holds */
};

/* `position` lags behind the fixed-point positions. */
static inline bool gb_engine_state_position_stale(const struct gb_engine_state *state)
{
    return state->motion == GB_ENGINE_MOVED || state->motion == GB_ENGINE_RELAXING;
}

/* Fixed-point positions lag behind `position`. */
static inline bool gb_engine_state_fixed_stale(const struct gb_engine_state *state)
{
    return state->motion == GB_ENGINE_EDITED;
}

/* A velocity update has set the fixed-point positions for the next evaluation. */
static inline bool gb_engine_state_moved(const struct gb_engine_state *state)
{
    return state->motion == GB_ENGINE_MOVED ||
           state->motion == GB_ENGINE_MOVED_SYNCHRONISED;
}

/* Forces belong to the present positions. */
static inline bool gb_engine_state_evaluated(const struct gb_engine_state *state)
{
    return state->motion == GB_ENGINE_EVALUATED || state->motion == GB_ENGINE_RELAXING ||
           state->motion == GB_ENGINE_RELAXING_SYNCHRONISED;
}

/* Only velocity updates have moved particles since the bounds were last computed. */
static inline bool gb_engine_state_bounds_known(const struct gb_engine_state *state)
{
    return state->motion >= GB_ENGINE_MOVED;
}

/* `position` was set from the fixed-point positions. */
void gb_engine_state_synchronise(struct gb_engine_state *state);

/* A caller receives `position` for writing; it must be synchronised.  While a velocity
 * update waits for its evaluation the caller may read only. */
void gb_engine_state_lend(struct gb_engine_state *state);

/* All positions were replaced: strain, restored copy, loaded checkpoint. */
void gb_engine_state_replace(struct gb_engine_state *state);

/* A velocity update has moved the fixed-point positions; once per evaluation. */
void gb_engine_state_move(struct gb_engine_state *state);

/* Forces were computed; `position` must be synchronised unless particles were moved. */
void gb_engine_state_evaluate(struct gb_engine_state *state);

/* Lists. */
void gb_engine_state_build_lists(struct gb_engine_state *state);

void gb_engine_state_drop_lists(struct gb_engine_state *state);

void gb_engine_state_patch_lists(struct gb_engine_state *state);

/* The sweep after a patch is done. */
void gb_engine_state_use_lists(struct gb_engine_state *state);

/* Forces. */
void gb_engine_state_convert_forces(struct gb_engine_state *state);

/* Results of the pairs in double precision, one row per slot of a list; owned by
 * engine.c.  A world in single precision keeps none. */
struct gb_pair_results {
    double *wrench; /* rows per near pair: force on i, torque on j */
    int width;      /* doubles in a row: 6; of equal discs 3 (x, z, about y) */
    double *pull;   /* three per far pair: attraction on i */
    int64_t far_capacity;
    /* Dynamic scenes, per far pair: distance and attraction at the last evaluation. */
    double *far_distance, *far_pull;
};

void gb_engine_pair_init(struct gb_pair_results *results, const struct gb_model *model);

void gb_engine_pair_finish(struct gb_pair_results *results);

/* Room for `capacity` pairs; the contents are lost. */
bool gb_engine_pair_resize_near(struct gb_pair_results *results, int64_t capacity,
                                struct gb_error *err);

/* What is stored of a far pair. */
enum gb_pair_results_far {
    GB_PAIR_RESULTS_FAR_FORCE,
    GB_PAIR_RESULTS_FAR_WORK, /* also distance and attraction, for the work absorbed until
                               * the next evaluation (dynamic scenes) */
};

bool gb_engine_pair_resize_far(struct gb_pair_results *results, int64_t capacity,
                               enum gb_real real, enum gb_pair_results_far content,
                               struct gb_error *err);

/* Rows of a scene in the x-z plane. */
static inline bool gb_engine_pair_planar(const struct gb_pair_results *results)
{
    return results->width < 6;
}

/* Force of near pair k on its first particle. */
static inline void gb_engine_pair_force(const struct gb_pair_results *results, int64_t k,
                                        double force[3])
{
    const double *row = results->wrench + (int64_t)results->width * k;
    const bool planar = gb_engine_pair_planar(results);
    force[0] = row[0];
    force[1] = planar ? 0.0 : row[1];
    force[2] = planar ? row[1] : row[2];
}

void gb_engine_pair_set_force(struct gb_pair_results *results, int64_t k,
                              const double force[3]);

/* The far pairs of a new list have no last evaluation. */
void gb_engine_pair_reset_far(struct gb_pair_results *results, int64_t pairs);

struct gb_team;

/* The data of the periodic engine: one member per owner, see docs/engine.md.  The files
 * that work on it (list check, sweeps, velocity update, contact history) see this struct
 * and the files below them, never gb_world. */
struct gb_engine {
    const struct gb_model *model;
    struct gb_team *team; /* NULL: the calling thread alone */
    struct gb_engine_state state;
    struct gb_particles particles;
    struct gb_neighbour_list list;
    struct gb_contacts contacts; /* one per slot of list.near */
    struct gb_pair_results pair; /* f64 */
    struct gb_f32_state f32;     /* f32 */
    struct gb_batch_kernel kernel;
    double damp; /* viscous time over time step */
    /* Of every block of particles (pack/list/blocks.h). */
    struct gb_list_check_block *check; /* owner: list_check.c */
    struct gb_tally_block *tally;      /* owner: world.c */
    int64_t *block_cost; /* of all blocks before one, blocks + 1; owner: blocks.c */
    struct gb_tally_block total; /* of all blocks; owner: world.c */
    double force_rms, torque_rms;
};

/* Position of particle i, even if `position` has not been synchronised with the
 * fixed-point positions. */
static inline void gb_engine_position(const struct gb_engine *engine, int64_t i,
                                      double x[3])
{
    const struct gb_particles *particles = &engine->particles;
    for (int c = 0; c < 3; c++) {
        x[c] = particles->position[3 * i + c];
        if (gb_engine_state_position_stale(&engine->state)) {
            x[c] = gb_fixed_position_follow(x[c], engine->f32.particle[i].position[c],
                                            gb_fixed_position_units(&particles->cell, c),
                                            gb_fixed_position_unit(&particles->cell, c));
        }
    }
}

/* Branch vector x_i - x_j of pair k of a list, nearest image, d; returns its square. */
static inline double gb_engine_branch_vector(const struct gb_engine *engine,
                                             const struct gb_pair_list *list, int64_t i,
                                             int64_t k, double r[3])
{
    double xi[3], xj[3];
    gb_engine_position(engine, i, xi);
    gb_engine_position(engine, list->other[k], xj);
    const double *shift = engine->list.shift[list->image[k]];
    for (int c = 0; c < 3; c++) {
        r[c] = xi[c] - xj[c] + shift[c];
    }
    return gb_vec_dot(r, r);
}

/* Reach of the attraction, d; 0 without attraction. */
static inline double gb_engine_cutoff(const struct gb_engine *engine)
{
    return engine->model->terms.attraction ? engine->model->numerics.cutoff : 0.0;
}

static inline bool gb_engine_is_f32(const struct gb_engine *engine)
{
    return engine->state.real == GB_REAL_F32;
}

#endif
