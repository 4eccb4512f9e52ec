#include "tui/session/overlay/previous_curve.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "scene/loading_kind.h"

void gb_previous_curve_finish(struct gb_previous_curve *previous)
{
    gb_alloc_free(previous->density);
    gb_alloc_free(previous->pressure_pa);
    gb_alloc_free(previous->elapsed);
    gb_alloc_free(previous->loading);
    memset(previous, 0, sizeof *previous);
}

double gb_previous_curve_elapsed(int kind, const struct gb_point *point)
{
    return gb_loading_kind_at(kind)->given_rate ? 1e9 * point->time_s
                                                : (double)point->step;
}

/* Copies the branches of a curve one after the other, with NaN between them. */
static void copy_branches(struct gb_previous_curve *previous,
                          const struct gb_curve *curve, size_t count)
{
    int branch = 0;
    size_t n = 0;
    for (size_t i = 0; i < count; i++) {
        const struct gb_point *point = gb_curve_at(curve, i);
        if (i > 0 && point->branch != branch && (point->branch > 0 || branch > 0)) {
            previous->density[n] = NAN;
            previous->elapsed[n] = NAN;
            previous->loading[n] = false;
            previous->pressure_pa[n++] = NAN;
        }
        branch = point->branch;
        previous->density[n] = point->density;
        previous->loading[n] = branch <= 0;
        previous->elapsed[n] = gb_previous_curve_elapsed(previous->params.kind, point);
        previous->pressure_pa[n++] = point->p_pa;
    }
    previous->count = n;
}

bool gb_previous_curve_copy(struct gb_previous_curve *previous,
                            const struct gb_params *params, const struct gb_curve *curve,
                            size_t count)
{
    memset(previous, 0, sizeof *previous);
    previous->params = *params;
    previous->density = gb_alloc_array(2 * count, sizeof(double), NULL);
    previous->pressure_pa = gb_alloc_array(2 * count, sizeof(double), NULL);
    previous->elapsed = gb_alloc_array(2 * count, sizeof(double), NULL);
    previous->loading = gb_alloc_array(2 * count, sizeof(bool), NULL);
    if (previous->density == NULL || previous->pressure_pa == NULL ||
        previous->elapsed == NULL || previous->loading == NULL) {
        gb_previous_curve_finish(previous);
        return false;
    }
    copy_branches(previous, curve, count);
    return true;
}
