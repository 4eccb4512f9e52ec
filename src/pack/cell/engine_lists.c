#include "pack/cell/engine_lists.h"

#include "pack/cell/engine.h"
#include "pack/list/contact_carry.h"
#include "pack/list/engine_blocks.h"
#include "pack/list/list_build.h"
#include "scene/loading_kind.h"

/* Room for the pairs of the lists as they are. */
static bool reserve(struct gb_engine *engine, struct gb_error *err)
{
    const struct gb_model *model = engine->model;
    const int64_t near = engine->list.near.capacity, far = engine->list.far.capacity;
    const enum gb_real real = engine->state.real;
    const bool viscous = gb_loading_kind_at(model->kind)->viscous_contacts;
    if (near > engine->contacts.capacity) {
        const struct gb_contacts_shape shape = {model->record_dimension, viscous, real};
        if ((real == GB_REAL_F64 &&
             !gb_pair_results_resize_near(&engine->pair, near, err)) ||
            !(engine->contacts.capacity > 0
                  ? gb_contact_carry_grow(&engine->contacts, near, err)
                  : gb_contacts_init(&engine->contacts, shape, near, err))) {
            return false;
        }
    }
    if (far > engine->pair.far_capacity &&
        !gb_pair_results_resize_far(
            &engine->pair, far, real,
            viscous ? GB_PAIR_RESULTS_FAR_WORK : GB_PAIR_RESULTS_FAR_FORCE, err)) {
        return false;
    }
    return real == GB_REAL_F64 ||
           gb_wrench_rows_update(&engine->f32.rows, &engine->list, err);
}

bool gb_engine_lists_build(struct gb_engine *engine, const struct gb_cell *cell,
                           struct gb_error *err)
{
    const struct gb_numerics *numerics = &engine->model->numerics;
    const struct gb_list_build_range range = {numerics->cutoff, numerics->skin};
    gb_engine_state_drop_lists(&engine->state);
    if (!gb_list_build(&engine->list, cell, engine->particles.position, range,
                       engine->team, err) ||
        !reserve(engine, err)) {
        gb_neighbour_list_clear(&engine->list);
        return false;
    }
    gb_engine_blocks_weigh(engine);
    gb_engine_state_build_lists(&engine->state);
    return true;
}
