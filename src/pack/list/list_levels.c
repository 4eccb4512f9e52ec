#include "pack/list/list_levels.h"

#include <string.h>

#include "base/alloc.h"

bool gb_list_levels_create(struct gb_list_levels **out, int64_t count,
                           struct gb_error *err)
{
    struct gb_list_levels *levels = gb_alloc_array(1, sizeof *levels, err);
    if (!levels) {
        return false;
    }
    levels->sphere = gb_alloc_array((size_t)count, sizeof *levels->sphere, err);
    if (!levels->sphere || !gb_hgrid_init(&levels->hgrid, count, err)) {
        gb_alloc_free(levels->sphere);
        gb_alloc_free(levels);
        return false;
    }
    *out = levels;
    return true;
}

void gb_list_levels_destroy(struct gb_list_levels *levels)
{
    if (levels) {
        gb_hgrid_finish(&levels->hgrid);
        gb_alloc_free(levels->sphere);
        gb_alloc_free(levels);
    }
}

bool gb_list_levels_find(struct gb_list_levels *levels, struct gb_list_scan *scan,
                         int64_t count, struct gb_team *team, struct gb_error *err)
{
    struct gb_hgrid_box box = {.low = {0.0}};
    for (int k = 0; k < 3; k++) {
        box.high[k] = scan->cell->edge[k];
        box.periodic[k] = scan->cell->periodic[k];
    }
    for (int64_t i = 0; i < count; i++) {
        memcpy(levels->sphere[i], scan->position + 3 * i, 3 * sizeof(double));
        levels->sphere[i][3] = 0.5 * scan->diameter[i];
    }
    levels->hgrid.team = team;
    if (!gb_hgrid_build(&levels->hgrid, &box, count, (const double(*)[4])levels->sphere,
                        NULL, scan->bounds.gap, err)) {
        return false;
    }
    scan->candidates = &levels->hgrid;
    return true;
}
