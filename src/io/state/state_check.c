#include "io/state/state_check.h"

#include <math.h>
#include <stddef.h>

#include "io/point_columns.h"
#include "pack/die/die.h"
#include "scene/path/path.h"

/* Beyond this a length is nonsense rather than large; d. */
static const double length_max = 1e9;

static bool positive(double x, double limit)
{
    return isfinite(x) && x > 0.0 && x <= limit;
}

/* A branch of loading and unloading, a stage, or a leg from the second on. */
static bool is_branch(int branch)
{
    return branch >= GB_BRANCH_LEAST ||
           (branch < GB_BRANCH_LEG - 1 && branch >= GB_BRANCH_LEG - GB_PATH_LEGS_MAX);
}

static const char *header_fault(const struct gb_state *state)
{
    if (state->dimension != 2 && state->dimension != 3) {
        return "dimension";
    }
    for (int k = 0; k < 3; k++) {
        if (!positive(state->cell[k], length_max)) {
            return "cell_d";
        }
    }
    if (!positive(state->metre_per_length, 1e3)) {
        return "metre_per_length";
    }
    if (!positive(state->pascal_per_stress, 1e30)) {
        return "pascal_per_stress";
    }
    if (state->point.step < 0 || !is_branch(state->point.branch)) {
        return state->point.step < 0 ? "step" : "branch";
    }
    /* NaN marks a value that does not exist; nothing of a packing is infinite */
    const struct gb_point_column *row;
    for (size_t k = 0; (row = gb_point_columns_at(k)) != NULL; k++) {
        if (row->finite && isinf(gb_point_columns_value(row, &state->point, 0))) {
            return row->state;
        }
    }
    return NULL;
}

static const char *particle_fault(const struct gb_state *state, int64_t i)
{
    for (int k = 0; k < 3; k++) {
        /* one cell beyond either side: pictures and exporters may fold, not search */
        const double x = state->position[3 * i + k] / state->cell[k];
        if (!(x >= -1.0 && x <= 2.0)) {
            return "/position";
        }
    }
    if (!positive(state->radius[i], length_max)) {
        return "/radius";
    }
    return state->contacts[i] < 0 ? "/contacts" : NULL;
}

static const char *pair_fault(const struct gb_state *state, int64_t i)
{
    const int32_t a = state->pair[2 * i];
    const int32_t b = state->pair[2 * i + 1];
    if (a < 0 || b < 0 || a >= state->count || b >= state->count || a == b) {
        return "/pair";
    }
    for (int k = 0; k < 3; k++) {
        if (!isfinite(state->pair_force[3 * i + k])) {
            return "/pair_force";
        }
    }
    if (!isfinite(state->pair_normal[i])) {
        return "/pair_normal";
    }
    return state->pair_bridged[i] > 1 ? "/pair_bridged" : NULL;
}

static const char *wall_fault(const struct gb_state *state, int64_t i)
{
    const int32_t particle = state->wall[2 * i], wall = state->wall[2 * i + 1];
    if (particle < 0 || particle >= state->count || wall < 0 || wall >= GB_DIE_WALLS) {
        return "/wall";
    }
    for (int k = 0; k < 3; k++) {
        if (!isfinite(state->wall_force[3 * i + k])) {
            return "/wall_force";
        }
    }
    return NULL;
}

const char *gb_state_check(const struct gb_state *state, int64_t *row)
{
    const char *fault = header_fault(state);
    *row = 0;
    for (int64_t i = 0; i < state->count && fault == NULL; i++) {
        fault = particle_fault(state, i);
        *row = i;
    }
    for (int64_t i = 0; i < state->pair_count && fault == NULL; i++) {
        fault = pair_fault(state, i);
        *row = i;
    }
    for (int64_t i = 0; i < state->wall_count && fault == NULL; i++) {
        fault = wall_fault(state, i);
        *row = i;
    }
    return fault;
}
