#include "solve/loading/loading_cell.h"

#include <inttypes.h>
#include <stdbool.h>

#include "base/alloc.h"
#include "base/vec.h"
#include "pack/cell/world_record.h"
#include "pack/structure/chain_growth.h"
#include "pack/structure/hilbert.h"
#include "scene/model.h"
#include "scene/tolerances.h"

struct gb_compressed_axes gb_loading_cell_of(const struct gb_model *model)
{
    struct gb_compressed_axes axes = {
        .axis = {model->geometry == GB_GEOMETRY_ISOTROPIC,
                 model->dimension == 3 && model->geometry != GB_GEOMETRY_UNIAXIAL, true}};
    for (int k = 0; k < 3; k++) {
        axes.count += axes.axis[k];
    }
    return axes;
}

double gb_loading_cell_mean(const struct gb_compressed_axes *axes,
                            const double pressure[3])
{
    double sum = 0.0;
    for (int k = 0; k < 3; k++) {
        sum += axes->axis[k] ? pressure[k] : 0.0;
    }
    return sum / axes->count;
}

void gb_loading_cell_scale(const struct gb_compressed_axes *axes, double along,
                           double factor[3])
{
    for (int k = 0; k < 3; k++) {
        factor[k] = axes->axis[k] ? along : 1.0;
    }
}

/* Overlap of pair k of particle i, in diameters of the smaller one. */
static double overlap_of(const struct gb_world *world, int64_t i, int64_t k)
{
    const struct gb_pair_list *near = &gb_world_pairs(world)->near;
    const double *x = gb_world_position(world), *y = x + 3 * near->other[k];
    double r[3] = {x[3 * i] - y[0], x[3 * i + 1] - y[1], x[3 * i + 2] - y[2]};
    gb_cell_nearest(gb_world_cell(world), r);
    const double a = gb_world_diameter(world, i);
    const double b = gb_world_diameter(world, near->other[k]);
    return (0.5 * (a + b) - gb_vec_length(r)) / fmin(a, b);
}

/* A packing of a file whose pairs overlap deeper than contact laws hold; err: any other
 * reason why it has no forces. */
static bool refuse_packing(const struct gb_world *world, struct gb_error *err)
{
    const struct gb_pair_list *near = &gb_world_pairs(world)->near;
    int64_t pairs = 0, first = 0, second = 0;
    double deepest = 0.0;
    for (int64_t i = 0; i < gb_world_model(world)->count; i++) {
        for (int64_t k = near->start[i]; k < near->start[i + 1]; k++) {
            const double overlap = near->other[k] == i ? 0.0 : overlap_of(world, i, k);
            pairs += overlap > GB_OVERLAP_MAX;
            if (overlap > deepest) {
                deepest = overlap;
                first = i;
                second = near->other[k];
            }
        }
    }
    return pairs > 0 ? gb_error_set(err, GB_ERR_INPUT,
                                    "structure.from: %" PRId64
                                    " pairs overlap by more than %g of their diameter, "
                                    "particles %" PRId64 " and %" PRId64
                                    " by %.3g: must be at most %g",
                                    pairs, GB_OVERLAP_MAX, first + 1, second + 1, deepest,
                                    GB_OVERLAP_MAX)
                     : false;
}

bool gb_loading_cell_grow(struct gb_loading *loading, bool (*cancelled)(void *data),
                          void *data, struct gb_error *err)
{
    const struct gb_model *model = loading->model;
    double *position = gb_alloc_array(3 * (size_t)model->count, sizeof *position, err);
    if (!position) {
        return false;
    }
    const bool done = gb_chain_growth_fill(model, cancelled, data, position, err) &&
                      (model->packing || gb_hilbert_sort(model, position, err)) &&
                      gb_world_create(&loading->world, model, position, err);
    gb_alloc_free(position);
    if (!done || gb_world_evaluate(loading->world, err)) {
        return done;
    }
    return model->packing ? refuse_packing(loading->world, err) : false;
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
