#include "pack/structure/initial_structure.h"

#include <string.h>

#include "pack/structure/chain_growth.h"
#include "pack/structure/unit_cells.h"
#include "scene/imported/imported.h"

bool gb_initial_structure_fill(const struct gb_model *model,
                               bool (*cancelled)(void *data), void *data,
                               double *position, struct gb_error *err)
{
    if (model->packing) {
        memcpy(position, model->packing->position,
               3 * (size_t)model->count * sizeof *position);
        return true;
    }
    if (model->structure != GB_STRUCTURE_GROWN) {
        gb_unit_cells_fill(model, position);
        return true;
    }
    struct gb_chain_growth growth = gb_chain_growth_from_model(model);
    growth.cancelled = cancelled;
    growth.data = data;
    return gb_chain_growth_run(&growth, position, err);
}
