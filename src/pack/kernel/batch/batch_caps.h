#ifndef GB_PACK_KERNEL_BATCH_CAPS_H
#define GB_PACK_KERNEL_BATCH_CAPS_H

#include "pack/kernel/batch/batch_laws.h"

/* Normal force, stiffnesses and caps of a batch in 3D. */

/* Constants of shear, pivoting and rolling. */
struct slip_law {
    real shear, pivot, roll, mu, mu_pivot;
    real bond; /* pi sigma_b */
    /* the two terms of M(a) */
    real plate, rod;
};

INLINE struct slip_law slip_law(const struct gb_law_slip *slip,
                                const struct gb_law_rod *rod)
{
    return (struct slip_law){
        .shear = (real)slip->shear,
        .pivot = (real)slip->pivot,
        .roll = (real)slip->roll,
        .mu = (real)slip->mu,
        .mu_pivot = (real)slip->mu_pivot,
        .bond = (real)(M_PI * slip->strength),
        .plate = (real)(3.0 * M_PI / 32.0 * rod->hertz),
        .rod = (real)(0.5 * rod->pivot),
    };
}

/* Integral of pressure times radius over the area of contact, by the fit of its tail. */
INLINE real fitted_moment(const struct slip_law *slip, real from, real root)
{
    return from * from * (slip->plate + slip->rod * root * moment_tail(from));
}

/* Of unequal sizes: root is that of d' h. */
INLINE real fitted_unequal_moment(const struct slip_law *slip, struct pair_size size,
                                  real from, real root)
{
    const real tail = slip->rod * root * moment_tail(from * size.inverse_mean);
    return size.reduced * (from * from) * (slip->plate + tail * size.inverse_mean);
}

/* Factor of a spring at its cap, 1 below it, and whether it is below: at a cap it gives up
 * its dashpot. */
INLINE void cut_spring(struct terms t, BATCH *restrict b, int spring, int k, real cap,
                       real load2)
{
    const bool over = load2 > cap * cap;
    b->kept[spring][k] = cut_to(t, cap, load2, over);
    if (t.viscous) {
        b->below[spring][k] = mask(!over);
    }
}

/* Normal forces of a batch, and what the caps need of them. */
INLINE void normal_forces_3d(const struct gb_model *model, struct terms t,
                             BATCH *restrict b, const struct gb_contacts *restrict c,
                             int64_t slot)
{
    const real *restrict deepest = PLANE(c->deepest);
    const struct normal_law law = normal_law(model, b->cutoff2);
#pragma omp simd
    for (int k = 0; k < b->n; k++) {
        const struct normal_parts parts = normal_parts(
            t, &law, stored_size(t, b, k), deepest[k], b->overlap[k], b->distance[k]);
        b->root[k] = parts.root;
        b->tail_at[k] = parts.tail_at;
        b->rod_slope[k] = parts.rod_slope;
        b->pull[k] = parts.pull;
    }
#pragma omp simd
    for (int k = 0; k < b->n; k++) {
        const struct normal_parts parts = {b->root[k], b->tail_at[k], b->rod_slope[k],
                                           b->pull[k]};
        const struct normal f = normal_of(t, &law, parts, stored_size(t, b, k),
                                          deepest[k], b->overlap[k], b->distance[k]);
        b->along[k] = f.total;
        b->elastic[k] = f.elastic;
        b->normal[k] =
            masked(bit_mask(deepest[k] >= 0), magnitude(f.elastic - f.adhesion));
        if (!t.friction) {
            b->sliding[k] = 0;
        }
        if (t.viscous) {
            b->slope[k] = f.slope;
        }
    }
}

/* Stiffnesses and caps of the springs.  Not one loop with what follows: where a factor is
 * known to be 1 the compiler would store a spring under a mask, which costs some processors
 * (Zen) ten times a store. */
INLINE void cut_springs_3d(const struct gb_model *model, struct terms t,
                           BATCH *restrict b, const struct gb_contacts *restrict c,
                           int64_t slot)
{
    const real *restrict deepest = PLANE(c->deepest), *restrict pivot = PLANE(c->pivot);
    const real *restrict sx = PLANE(c->shear[0]), *restrict sy = PLANE(c->shear[1]);
    const real *restrict sz = PLANE(c->shear[2]);
    const real *restrict qx = PLANE(c->roll[0]), *restrict qy = PLANE(c->roll[1]);
    const real *restrict qz = PLANE(c->roll[2]);
    const struct slip_law slip = slip_law(&model->slip, &model->rod);
    const real half = 0.5, quarter = 0.25, third = (real)(1.0 / 3.0);
    const real relative = (real)model->bridge.length;
#pragma omp simd
    for (int k = 0; k < b->n; k++) {
        const real h = b->overlap[k], state = deepest[k];
        const bool held = t.bridges & (state > 0), live = state >= 0;
        const struct pair_size size = stored_size(t, b, k);
        const real length = relative * size.mean;
        const real elastic = b->elastic[k], root_of = b->root[k];
        const real a2 =
            where(live, quarter * radius_square(t, length, state, h, size.reduced));
        const real a = radius(t, a2, live, root_of), strength = a2 * slip.bond;
        const real ks = slip.shear * a;
        const real cap = held ? strength : smaller(slip.mu * elastic, strength);
        const real vx = sx[k], vy = sy[k], vz = sz[k];
        const real shear2 = ks * ks * (vx * vx + vy * vy + vz * vz);
        b->stiffness[0][k] = ks;
        b->sliding[k] = mask(shear2 > cap * cap);
        cut_spring(t, b, 0, k, cap, shear2);
        if (!t.unpivoted) {
            const real from = larger(h, 0), kp = slip.pivot * a2 * a, p = pivot[k];
            const real twisting = half * a2 * a * slip.bond;
            const real moment = !MOMENT_FITTED ? b->moment[k]
                                : t.sized
                                    ? fitted_unequal_moment(&slip, size, from, root_of)
                                    : fitted_moment(&slip, from, root_of);
            b->stiffness[1][k] = kp;
            cut_spring(t, b, 1, k,
                       held ? twisting : smaller(slip.mu_pivot * moment, twisting),
                       kp * kp * p * p);
        }
        if (t.bridges) {
            const real kr = slip.roll * a2 * a;
            const real px = qx[k], py = qy[k], pz = qz[k];
            b->stiffness[2][k] = kr;
            cut_spring(t, b, 2, k, a * larger(elastic, 0) * third,
                       kr * kr * (px * px + py * py + pz * pz));
        }
    }
}

#endif
