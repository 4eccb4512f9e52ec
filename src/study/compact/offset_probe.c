#include "study/compact/offset_probe.h"

#include <math.h>
#include <stdio.h>

/* What the growing probe is compared with at each point. */
struct growing {
    struct gb_offset_probe *probe;
    double enough;
};

/* e_z = v/3 + w and e_x = e_y = v/3 - w/2. */
char *gb_offset_probe_leg(double volume, double shear, double strain_most, char *buffer,
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
static double *columns_of(const struct gb_offset_probe *probe, struct gb_yield_path *path)
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

bool gb_offset_probe_point(const struct gb_offset_probe *probe, double offset,
                           double flow_end, struct gb_yield_point *point)
{
    struct gb_yield_path path;
    double *columns = columns_of(probe, &path);
    const bool reached =
        gb_yield_offset_find(&path, &probe->elastic, offset, flow_end, point);
    g_free(columns);
    return reached;
}

static bool take(void *data, const struct gb_point *point)
{
    const struct growing *growing = data;
    struct gb_yield_point ignored;
    const struct gb_compact_state state = gb_compact_state_of(point);
    g_array_append_val(growing->probe->state, state);
    return !gb_offset_probe_point(growing->probe, growing->enough, 1.0, &ignored);
}

bool gb_offset_probe_run(struct gb_offset_probe *probe, struct gb_compact *inside,
                         double direction, const struct gb_yield_elastic *elastic,
                         const struct gb_offset_probe_steps *steps,
                         const struct gb_pool_callbacks *callbacks, struct gb_error *err)
{
    char leg[GB_LEG_TEXT];
    const double(*compliance)[2] = elastic->compliance;
    const double p = cos(direction), q = sin(direction);
    struct growing growing = {probe, steps->enough};
    const struct gb_compact_walk walk = {take, &growing, callbacks};
    const struct gb_compact_state start = gb_compact_state_of(&inside->point);
    probe->direction = direction;
    probe->elastic = *elastic;
    probe->state = g_array_new(FALSE, FALSE, sizeof(struct gb_compact_state));
    g_array_append_val(probe->state, start);
    gb_offset_probe_leg(compliance[0][0] * p + compliance[0][1] * q,
                        compliance[1][0] * p + compliance[1][1] * q, steps->strain_most,
                        leg, sizeof leg);
    probe->outcome =
        gb_compact_follow(inside, leg, steps->step, &walk, NULL, &probe->why);
    return probe->outcome != GB_COMPACT_FAILED ||
           gb_error_set(err, probe->why.code, "%s", probe->why.text);
}

void gb_offset_probe_finish(struct gb_offset_probe *probe)
{
    if (probe->state != NULL) {
        g_array_unref(probe->state);
    }
    probe->state = NULL;
}
