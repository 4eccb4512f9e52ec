#include "study/yield/yield_probe.h"

#include <math.h>
#include <stdio.h>

/* What the growing probe is compared with at each point. */
struct growing {
    struct gb_yield_probe *probe;
    const struct gb_yield_options *options;
};

/* e_z = v/3 + w and e_x = e_y = v/3 - w/2. */
char *gb_yield_probe_leg(double volume, double shear, double strain_most, char *buffer,
                         size_t size)
{
    const double axial = volume / 3.0 + shear, lateral = volume / 3.0 - 0.5 * shear;
    if (fabs(axial) >= fabs(lateral)) {
        snprintf(buffer, size, "strain z = 1, x = %.12f, y = %.12f to %.9g %%",
                 lateral / axial, lateral / axial, 100.0 * copysign(strain_most, axial));
    } else {
        snprintf(buffer, size, "strain x = 1, y = 1, z = %.12f to %.9g %%",
                 axial / lateral, 100.0 * copysign(strain_most, lateral));
    }
    return buffer;
}

/* Columns of the states, for g_free. */
static double *columns_of(const struct gb_yield_probe *probe, struct gb_yield_path *path)
{
    const size_t count = probe->state->len;
    double *column = g_new(double, 4 * count);
    for (size_t i = 0; i < count; i++) {
        const struct gb_compact_state *state =
            &g_array_index(probe->state, struct gb_compact_state, i);
        column[i] = state->p;
        column[count + i] = state->q;
        column[2 * count + i] = state->volume;
        column[3 * count + i] = state->shear;
    }
    *path = (struct gb_yield_path){
        column, column + count,  column + 2 * count, column + 3 * count,
        count,  probe->direction};
    return column;
}

/* The largest offset, with the rest of the way over which its flow is measured. */
static double enough_of(const struct gb_yield_options *options)
{
    return (1.0 + GB_YIELD_FLOW_SHARE) * options->offset *
           gb_yield_options_offset[GB_YIELD_OFFSETS - 1];
}

static bool is_reached(const struct gb_yield_probe *probe, double offset,
                       struct gb_yield_point *point)
{
    struct gb_yield_path path;
    double *columns = columns_of(probe, &path);
    const bool reached = gb_yield_offset_find(&path, &probe->elastic, offset, point);
    g_free(columns);
    return reached;
}

static bool take(void *data, const struct gb_point *point)
{
    const struct growing *growing = data;
    struct gb_yield_point ignored;
    const struct gb_compact_state state = gb_compact_state_of(point);
    g_array_append_val(growing->probe->state, state);
    return growing->options == NULL ||
           !is_reached(growing->probe, enough_of(growing->options), &ignored);
}

/* options NULL: to the end of the leg. */
static bool follow(struct gb_yield_probe *probe, struct gb_compact *inside,
                   const char *leg, double step, const struct gb_yield_options *options,
                   const struct gb_pool_callbacks *callbacks, struct gb_error *err)
{
    struct growing growing = {probe, options};
    const struct gb_compact_walk walk = {take, &growing, callbacks};
    const struct gb_compact_state start = gb_compact_state_of(&inside->point);
    probe->state = g_array_new(FALSE, FALSE, sizeof(struct gb_compact_state));
    g_array_append_val(probe->state, start);
    probe->outcome = gb_compact_follow(inside, leg, step, &walk, NULL, &probe->why);
    return probe->outcome != GB_COMPACT_FAILED ||
           gb_error_set(err, probe->why.code, "%s", probe->why.text);
}

/* Slopes of p and q along a strain of volume, or of shear. */
static bool measure_slopes(struct gb_compact *inside, bool by_shear, double slope[2],
                           const struct gb_yield_options *options,
                           const struct gb_pool_callbacks *callbacks,
                           struct gb_error *err)
{
    char leg[GB_LEG_TEXT];
    struct gb_yield_path path;
    struct gb_yield_probe probe = {0};
    gb_yield_probe_leg(by_shear ? 0.0 : 3.0, by_shear ? 1.0 : 0.0, options->elastic, leg,
                       sizeof leg);
    const bool good = follow(&probe, inside, leg, options->elastic, NULL, callbacks, err);
    if (good) {
        double *columns = columns_of(&probe, &path);
        gb_yield_offset_slopes(&path, by_shear ? path.shear : path.volume,
                               (double)INFINITY, slope);
        g_free(columns);
    }
    gb_yield_probe_finish(&probe);
    return good;
}

bool gb_yield_probe_elastic(struct gb_yield_elastic *elastic, struct gb_compact *inside,
                            const struct gb_yield_options *options,
                            const struct gb_pool_callbacks *callbacks,
                            struct gb_error *err)
{
    double by_volume[2], by_shear[2];
    return measure_slopes(inside, false, by_volume, options, callbacks, err) &&
           measure_slopes(inside, true, by_shear, options, callbacks, err) &&
           (gb_yield_offset_elastic(elastic, by_volume, by_shear) ||
            gb_error_set(err, GB_ERR_GUARD, "the unloaded compact has no stiffness"));
}

bool gb_yield_probe_run(struct gb_yield_probe *probe, struct gb_compact *inside,
                        double direction, const struct gb_yield_elastic *elastic,
                        const struct gb_yield_options *options,
                        const struct gb_pool_callbacks *callbacks, struct gb_error *err)
{
    char leg[GB_LEG_TEXT];
    const double(*compliance)[2] = elastic->compliance;
    const double p = cos(direction), q = sin(direction);
    probe->direction = direction;
    probe->elastic = *elastic;
    gb_yield_probe_leg(compliance[0][0] * p + compliance[0][1] * q,
                       compliance[1][0] * p + compliance[1][1] * q, options->strain_most,
                       leg, sizeof leg);
    return follow(probe, inside, leg, options->step, options, callbacks, err);
}

void gb_yield_probe_finish(struct gb_yield_probe *probe)
{
    if (probe->state != NULL) {
        g_array_unref(probe->state);
    }
    probe->state = NULL;
}

bool gb_yield_probe_point(const struct gb_yield_probe *probe, double offset,
                          struct gb_yield_point *point)
{
    return is_reached(probe, offset, point);
}
