#include "solve/loading/loading_cell.h"

#include "base/alloc.h"
#include "pack/cell/world_record.h"
#include "pack/structure/hilbert.h"
#include "pack/structure/initial_structure.h"

bool gb_loading_cell_grow(struct gb_loading *loading, bool (*cancelled)(void *data),
                          void *data, struct gb_error *err)
{
    const struct gb_model *model = loading->model;
    double *position = gb_alloc_array(3 * (size_t)model->count, sizeof *position, err);
    if (!position) {
        return false;
    }
    const bool done = gb_initial_structure_fill(model, cancelled, data, position, err) &&
                      gb_hilbert_sort(model, position, err) &&
                      gb_world_create(&loading->world, model, position, err) &&
                      gb_world_evaluate(loading->world, err);
    gb_alloc_free(position);
    return done;
}

bool gb_loading_cell_load(struct gb_loading *loading, struct gb_record *record,
                          struct gb_error *err)
{
    const struct gb_model *model = loading->model;
    double *position = gb_alloc_array(3 * (size_t)model->count, sizeof *position, err);
    const bool done = position &&
                      gb_record_array(record, "world/position", GB_RECORD_DOUBLE,
                                      model->count, 3, "d", position, err) &&
                      gb_world_create(&loading->world, model, position, err) &&
                      gb_world_record(loading->world, record, err);
    gb_alloc_free(position);
    return done;
}
