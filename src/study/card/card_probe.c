#include "study/card/card_probe.h"

#include <math.h>
#include <stdio.h>

#include "scene/path/path.h"

struct walk {
    struct gb_card_probe *probe;
    double bulk, shear_modulus, enough;
};

/* Plastic strains since the first state. */
static void plastic(const struct gb_card_probe *probe, guint index, double bulk,
                    double shear_modulus, double *volume, double *shear)
{
    const struct gb_compact_state *first =
        &g_array_index(probe->state, struct gb_compact_state, 0);
    const struct gb_compact_state *now =
        &g_array_index(probe->state, struct gb_compact_state, index);
    *volume = now->volume - first->volume - (now->p - first->p) / bulk;
    *shear = now->shear - first->shear - (now->q - first->q) / (3.0 * shear_modulus);
}

static double plastic_size(const struct gb_card_probe *probe, guint index, double bulk,
                           double shear_modulus)
{
    double volume, shear;
    plastic(probe, index, bulk, shear_modulus, &volume, &shear);
    return fmax(fabs(volume), fabs(shear));
}

static bool take(void *data, const struct gb_point *point)
{
    const struct walk *walk = data;
    const struct gb_compact_state state = gb_compact_state_of(point);
    g_array_append_val(walk->probe->state, state);
    return plastic_size(walk->probe, walk->probe->state->len - 1, walk->bulk,
                        walk->shear_modulus) < walk->enough;
}

/* "strain z = 1, x = r, y = r to S": the axis that strains most leads. */
static void write_leg(char *text, size_t size, double axial, double lateral, double most)
{
    if (fabs(axial) >= fabs(lateral)) {
        const double ratio = lateral / axial;
        snprintf(text, size, "strain z = 1, x = %.9g, y = %.9g to %.9g %%", ratio, ratio,
                 copysign(100.0 * most, axial));
    } else {
        snprintf(text, size, "strain x = 1, y = 1, z = %.9g to %.9g %%", axial / lateral,
                 copysign(100.0 * most, lateral));
    }
}

bool gb_card_probe_run(struct gb_card_probe *probe, struct gb_compact *inside,
                       double direction, double bulk, double shear_modulus,
                       const struct gb_card_options *options,
                       const struct gb_pool_callbacks *callbacks, struct gb_error *err)
{
    char path[GB_LEG_TEXT];
    /* beyond the offset, as K and G of all probes will differ a little */
    struct walk walk = {probe, bulk, shear_modulus, 1.5 * options->offset};
    const struct gb_compact_walk steps = {take, &walk, callbacks};
    const struct gb_compact_state first = gb_compact_state_of(&inside->point);
    const double volume = cos(direction) / bulk;
    const double shear = sin(direction) / (3.0 * shear_modulus);
    struct gb_error why = {0};
    probe->direction = direction;
    probe->state = g_array_new(FALSE, FALSE, sizeof first);
    g_array_append_val(probe->state, first);
    write_leg(path, sizeof path, volume / 3.0 + shear, volume / 3.0 - 0.5 * shear,
              options->strain_most);
    if (gb_compact_follow(inside, path, options->step, &steps, NULL, &why) ==
        GB_COMPACT_FAILED) {
        return gb_error_set(err, why.code, "%s", why.text);
    }
    return true;
}

void gb_card_probe_finish(struct gb_card_probe *probe)
{
    if (probe->state != NULL) {
        g_array_free(probe->state, TRUE);
    }
    *probe = (struct gb_card_probe){.state = NULL};
}

void gb_card_probe_moduli(const struct gb_card_probe *probe, int count, double *bulk,
                          double *shear_modulus)
{
    double pv = 0.0, vv = 0.0, qw = 0.0, ww = 0.0;
    for (int i = 0; i < count; i++) {
        if (probe[i].state == NULL || probe[i].state->len < 2) {
            continue;
        }
        const struct gb_compact_state *state =
            &g_array_index(probe[i].state, struct gb_compact_state, 0);
        const double v = state[1].volume - state[0].volume;
        const double w = state[1].shear - state[0].shear;
        pv += (state[1].p - state[0].p) * v;
        qw += (state[1].q - state[0].q) * w;
        vv += v * v;
        ww += w * w;
    }
    *bulk = vv > 0.0 ? pv / vv : (double)NAN;
    *shear_modulus = ww > 0.0 ? qw / ww / 3.0 : (double)NAN;
}

/* The state, linear between two recorded ones, at which the plastic strain is `size`. */
struct crossing {
    double p, q, volume, shear; /* stress, plastic strains */
};

static bool cross(const struct gb_card_probe *probe, double bulk, double shear_modulus,
                  double size, struct crossing *at)
{
    double before = 0.0;
    for (guint i = 1; i < probe->state->len; i++) {
        const double now = plastic_size(probe, i, bulk, shear_modulus);
        if (now >= size) {
            const struct gb_compact_state *state =
                &g_array_index(probe->state, struct gb_compact_state, i - 1);
            const double share = (size - before) / (now - before);
            double volume[2], shear[2];
            plastic(probe, i - 1, bulk, shear_modulus, &volume[0], &shear[0]);
            plastic(probe, i, bulk, shear_modulus, &volume[1], &shear[1]);
            at->p = state[0].p + share * (state[1].p - state[0].p);
            at->q = state[0].q + share * (state[1].q - state[0].q);
            at->volume = volume[0] + share * (volume[1] - volume[0]);
            at->shear = shear[0] + share * (shear[1] - shear[0]);
            return true;
        }
        before = now;
    }
    return false;
}

bool gb_card_probe_point(const struct gb_card_probe *probe, double bulk,
                         double shear_modulus, double offset,
                         struct gb_yield_point *point)
{
    struct crossing half, at;
    if (!cross(probe, bulk, shear_modulus, 0.5 * offset, &half) ||
        !cross(probe, bulk, shear_modulus, offset, &at)) {
        return false;
    }
    *point = (struct gb_yield_point){.p_pa = at.p,
                                     .q_pa = at.q,
                                     .flow_volume = at.volume - half.volume,
                                     .flow_shear = at.shear - half.shear,
                                     .p_error_pa = (double)NAN,
                                     .q_error_pa = (double)NAN,
                                     .direction = probe->direction};
    return true;
}
