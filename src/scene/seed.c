#include "scene/seed.h"

#include <stddef.h>

#include "scene/imported/imported.h"
#include "scene/loading_kind.h"

bool gb_seed_matters(const struct gb_params *params)
{
    return !gb_loading_kind_of(params)->periodic_cell ||
           (!gb_imported_given(params) && params->structure == GB_STRUCTURE_GROWN);
}

bool gb_seed_check_cells(const struct gb_params *params, size_t cells,
                         struct gb_error *err)
{
    if (cells <= 1 || gb_seed_matters(params)) {
        return true;
    }
    if (gb_imported_given(params)) {
        return gb_error_set(
            err, GB_ERR_INPUT,
            "structure.from = %.200s: expected none for %zu cells: nothing "
            "in this scene depends on the seed, so they would be equal",
            params->from.path, cells);
    }
    return gb_error_set(err, GB_ERR_INPUT,
                        "structure.kind = %s: expected grown for %zu cells: nothing in "
                        "this scene depends on the seed, so they would be equal",
                        gb_params_find("structure", "kind")->choices[params->structure],
                        cells);
}
