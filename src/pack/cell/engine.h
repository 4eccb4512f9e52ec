#ifndef GB_PACK_CELL_ENGINE_H
#define GB_PACK_CELL_ENGINE_H

#include "base/vec.h"
#include "pack/cell/contacts.h"
#include "pack/cell/engine_state.h"
#include "pack/cell/pair_results.h"
#include "pack/cell/particles.h"
#include "pack/f32/f32_state.h"
#include "pack/kernel/batch/batch.h"
#include "pack/kernel/tally.h"
#include "pack/list/list_check.h"
#include "pack/list/neighbour_list.h"
#include "scene/model.h"

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
    struct gb_tally_block *tally;      /* owner: sweep.c */
    int64_t *block_cost; /* of all blocks before one, blocks + 1; owner: blocks.c */
    struct gb_tally_block total; /* of all blocks; owner: sweep.c */
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
