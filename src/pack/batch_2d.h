#ifndef GB_PACK_BATCH_2D_H
#define GB_PACK_BATCH_2D_H

#include "pack/batch_laws.h"

/* First half, 2D: the shear spring is one number along (n_z, -n_x), which turns with the
 * contact by itself; rolling is about y; there is no pivoting. */
INLINE void stretch_2d(const struct gb_model *model, struct terms t,
                       struct gb_batch *restrict b, struct gb_contacts *restrict c,
                       int64_t slot)
{
    double *restrict deepest = c->deepest + slot;
    double *restrict ax = c->arm[0] + slot, *restrict az = c->arm[1] + slot;
    double *restrict shear = c->shear[0] + slot, *restrict roll = c->roll[0] + slot;
    const double m = model->slip.motion, length = model->bridge.length;
    const double k_shear = model->slip.shear;
    /* the cap over the stiffness, squared, without the contact's size */
    const double tear = M_PI * M_PI * model->slip.strength * model->slip.strength;
    double failed = 0.0;
#pragma omp simd reduction(+ : failed)
    for (int k = 0; k < b->n; k++) {
        const double rx = b->r[0][k], rz = b->r[1][k];
        const double squared = rx * rx + rz * rz;
        const double r = sqrt(squared), inverse = 1.0 / r;
        const double nx = rx * inverse, nz = rz * inverse;
        const double h = 1.0 - r, before = deepest[k];
        const bool live = squared < 1.0;
        const double lasts = mask(live & (before >= 0.0));
        const double state =
            t.bridges ? deepest_after(length, larger(before, 0.0), h) : 0.0;
        const double now = live ? state : -1.0;
        b->unit[0][k] = nx;
        b->unit[1][k] = nz;
        b->distance[k] = r;
        b->overlap[k] = h;
        if (t.friction) {
            const double u =
                m * ((rx - ax[k]) * nz - (rz - az[k]) * nx - 0.5 * r * b->turn_sum[0][k]);
            const double v = lasts * (shear[k] + u);
            shear[k] = v;
            if (t.viscous) {
                b->rate[0][k] = lasts * u;
            }
            if (t.bridges) {
                const double holds = lasts * mask(now > 0.0);
                const double g = m * b->turn_difference[0][k];
                roll[k] = holds * (roll[k] + g);
                if (t.viscous) {
                    b->rate[1][k] = holds * g;
                }
                const double a2 = 0.25 * radius_square(t, length, now, h);
                const double fails =
                    mask((now > 0.0) & (k_shear * k_shear * v * v > tear * a2));
                b->fails[k] = fails;
                failed += fails;
            }
        }
        if (t.viscous) {
            const double arm2 = ax[k] * ax[k] + az[k] * az[k];
            b->rate[7][k] = mask(arm2 > 0.0) * (sqrt(arm2) - r);
        }
        deepest[k] = now;
        ax[k] = rx;
        az[k] = rz;
    }
    b->failed = failed;
    b->loose = 0.0;
}

/* Second half, 2D. */
INLINE void load_2d(const struct gb_model *model, struct terms t,
                    struct gb_batch *restrict b, struct gb_contacts *restrict c,
                    int64_t slot)
{
    const double *restrict deepest = c->deepest + slot;
    double *restrict shear = c->shear[0] + slot, *restrict roll = c->roll[0] + slot;
    double *restrict last_normal = t.viscous ? c->last_normal + slot : NULL;
    double *restrict last_shear = t.viscous ? c->last_shear + slot : NULL;
    double *restrict last_roll = t.viscous ? c->last_roll + slot : NULL;
    const struct gb_law_slip slip = model->slip;
    const double inverse_motion = 1.0 / slip.motion;
    const double damp = b->damp, cutoff2 = b->cutoff2;
    const double length = model->bridge.length;
#pragma omp simd
    for (int k = 0; k < b->n; k++) {
        const double nx = b->unit[0][k], nz = b->unit[1][k];
        const double r = b->distance[k], h = b->overlap[k], state = deepest[k];
        const bool held = t.bridges & (state > 0.0);
        const double live = mask(state >= 0.0);
        const struct normal f = normal_force(model, cutoff2, state, h, r);
        double fn = f.total, tangent = 0.0, both = 0.0, opposed = 0.0, slides = 0.0;
        double taken = 0.0;
        if (t.viscous) {
            const double lag = damp * f.slope * b->rate[7][k];
            taken = (0.5 * (last_normal[k] + fn) + lag) * b->rate[7][k];
            last_normal[k] = fn;
            fn += lag;
        }
        if (t.friction) {
            const double a2 = live * 0.25 * radius_square(t, length, state, h);
            const double a = radius(t, a2, live, f.root), ks = slip.shear * a;
            const double strength = M_PI * a2 * slip.strength;
            const double cap = held ? strength : smaller(slip.mu * f.elastic, strength);
            double v = shear[k];
            const double trial = v;
            const double shear2 = ks * ks * v * v;
            const bool cut = shear2 > cap * cap;
            v *= cut_to(t, cap, shear2, cut);
            shear[k] = v;
            slides = mask(cut);
            if (t.viscous) {
                const double u = b->rate[0][k], lag = damp * mask(!cut);
                taken += inverse_motion * u *
                         (0.5 * (last_shear[k] * (trial - u) + ks * v) + lag * ks * u);
                last_shear[k] = ks;
                v += lag * u;
            }
            tangent = -ks * v;
            both = 0.5 * r * ks * v;
            if (t.bridges) {
                const double kr = slip.roll * a2 * a;
                const double roll_cap = a * larger(f.elastic, 0.0) / 3.0;
                double p = mask(held) * roll[k];
                const double before = p;
                const double roll2 = kr * kr * p * p;
                const bool rolls = roll2 > roll_cap * roll_cap;
                p *= cut_to(t, roll_cap, roll2, rolls);
                roll[k] = p;
                if (t.viscous) {
                    const double g = b->rate[1][k], lag = damp * mask(!rolls & held);
                    taken +=
                        inverse_motion * g *
                        (0.5 * (last_roll[k] * (before - g) + kr * p) + lag * kr * g);
                    last_roll[k] = mask(held) * kr;
                    p += lag * g;
                }
                opposed = -kr * p;
            }
        }
        b->force[0][k] = fn * nx + tangent * nz;
        b->force[1][k] = fn * nz - tangent * nx;
        b->torque_i[0][k] = both + opposed;
        b->torque_j[0][k] = both - opposed;
        if (t.viscous) {
            b->absorbed[k] = taken;
        }
        b->normal[k] = live * fabs(f.elastic - model->adhesion);
        b->sliding[k] = slides;
    }
}

#endif
