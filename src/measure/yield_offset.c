#include "measure/yield_offset.h"

#include <math.h>
#include <stdbool.h>

bool gb_yield_offset_elastic(struct gb_yield_elastic *elastic, const double by_volume[2],
                             const double by_shear[2])
{
    const double determinant = by_volume[0] * by_shear[1] - by_volume[1] * by_shear[0];
    if (!(determinant > 0.0) || !(by_volume[0] > 0.0) || !isfinite(determinant)) {
        return false;
    }
    elastic->compliance[0][0] = by_shear[1] / determinant;
    elastic->compliance[0][1] = -by_shear[0] / determinant;
    elastic->compliance[1][0] = -by_volume[1] / determinant;
    elastic->compliance[1][1] = by_volume[0] / determinant;
    return true;
}

/* A state between two rows. */
struct state {
    double p, q, volume, shear; /* plastic strains */
};

static struct state state_at(const struct gb_yield_path *path,
                             const struct gb_yield_elastic *elastic, size_t row)
{
    const double p = path->p[row] - path->p[0], q = path->q[row] - path->q[0];
    const double(*compliance)[2] = elastic->compliance;
    return (struct state){
        path->p[row], path->q[row],
        path->volume[row] - path->volume[0] - compliance[0][0] * p - compliance[0][1] * q,
        path->shear[row] - path->shear[0] - compliance[1][0] * p - compliance[1][1] * q};
}

/* Compacts stiffen under pressure, so that the compliance at the beginning overestimates the
 * elastic strain of compression.  What is left is then opposite to the loading, and no flow. */
static double measure_of(const struct state *state, double direction)
{
    const double along = state->volume * cos(direction) + state->shear * sin(direction);
    return along > 0.0 ? fmax(fabs(state->volume), fabs(state->shear)) : 0.0;
}

static double between(double a, double b, double share)
{
    return a + share * (b - a);
}

/* The first state whose plastic strain reaches a level; false: none, the last one. */
static bool reach(const struct gb_yield_path *path,
                  const struct gb_yield_elastic *elastic, double level,
                  struct state *found)
{
    struct state before = state_at(path, elastic, 0);
    for (size_t i = 1; i < path->count; i++) {
        const struct state now = state_at(path, elastic, i);
        const double low = measure_of(&before, path->direction),
                     high = measure_of(&now, path->direction);
        if (high >= level) {
            const double share = high > low ? (level - low) / (high - low) : 1.0;
            found->p = between(before.p, now.p, share);
            found->q = between(before.q, now.q, share);
            found->volume = between(before.volume, now.volume, share);
            found->shear = between(before.shear, now.shear, share);
            return true;
        }
        before = now;
    }
    *found = before;
    return false;
}

bool gb_yield_offset_find(const struct gb_yield_path *path,
                          const struct gb_yield_elastic *elastic, double offset,
                          double flow_end, struct gb_yield_point *point)
{
    struct state at, first, last;
    if (!reach(path, elastic, offset, &at)) {
        return false;
    }
    reach(path, elastic, GB_YIELD_FLOW_BEGIN * offset, &first);
    reach(path, elastic, flow_end * offset, &last);
    point->p_pa = at.p;
    point->q_pa = at.q;
    point->flow_volume = last.volume - first.volume;
    point->flow_shear = last.shear - first.shear;
    point->direction = path->direction;
    return true;
}
