#ifndef GB_PACK_KERNEL_BATCH_BATCH_3D_H
#define GB_PACK_KERNEL_BATCH_BATCH_3D_H

#include "pack/kernel/batch/batch_laws.h"
#include "scene/unequal_pair.h"

/* Difference of the angles of i and j from sum and difference of their arcs. */
INLINE real angle(struct terms t, struct pair_size size, real sum, real difference)
{
    return t.sized ? (real)0.5 * ((sum + difference) * size.inverse_i -
                                  (sum - difference) * size.inverse_j)
                   : difference;
}

/* The law in 3D is a sequence of short loops, with columns of the batch between them.  Each
 * step of a loop waits for roots, divisions and chains of multiplications, while a processor
 * looks ahead some hundred instructions only: short loops let it begin the next pairs
 * meanwhile (one loop for the first half took a sixth more time on Zen 3). */

/* Unit vectors, overlaps, and which contacts and bridges there are after the move. */
INLINE void contact_geometry_3d(const struct gb_model *model, struct terms t,
                                BATCH *restrict b, struct gb_contacts *restrict c,
                                int64_t slot)
{
    real *restrict deepest = PLANE(c->deepest);
    const real relative = (real)model->bridge.length;
#pragma omp simd
    for (int k = 0; k < b->n; k++) {
        const real rx = b->r[0][k], ry = b->r[1][k], rz = b->r[2][k];
        const real squared = rx * rx + ry * ry + rz * rz;
        const real r = root(squared), inverse = 1 / r;
        const struct pair_size size =
            t.sized ? unequal_size(b->diameter[0][k], b->diameter[1][k]) : equal_size();
        const real length = relative * size.mean;
        const real h = size.mean - r, before = deepest[k];
        const bool live = t.sized ? h > 0 : squared < 1;
        const real state = t.bridges ? deepest_after(length, larger(before, 0), h) : 0;
        b->unit[0][k] = rx * inverse;
        b->unit[1][k] = ry * inverse;
        b->unit[2][k] = rz * inverse;
        b->distance[k] = r;
        b->overlap[k] = h;
        if (t.sized) {
            store_size(b, k, size);
        }
        b->lasts[k] = bit_mask(live & (before >= 0));
        deepest[k] = live ? state : -1;
    }
}

/* Shear springs rotated into the tangent plane, but shorter by what was normal to it; the
 * shear that follows.  The branch vectors become those of the next move. */
INLINE void rotate_shear_3d(const struct gb_model *model, struct terms t,
                            BATCH *restrict b, struct gb_contacts *restrict c,
                            int64_t slot)
{
    real *restrict ax = PLANE(c->branch[0]), *restrict ay = PLANE(c->branch[1]);
    real *restrict az = PLANE(c->branch[2]);
    real *restrict sx = PLANE(c->shear[0]), *restrict sy = PLANE(c->shear[1]);
    real *restrict sz = PLANE(c->shear[2]);
    const real m = (real)model->slip.motion, half = 0.5;
#pragma omp simd
    for (int k = 0; k < b->n; k++) {
        const real rx = b->r[0][k], ry = b->r[1][k], rz = b->r[2][k];
        const real r = b->distance[k];
        if (t.friction) {
            const real nx = b->unit[0][k], ny = b->unit[1][k], nz = b->unit[2][k];
            const struct pair_size size = stored_size(t, b, k);
            const real_bits lasts = b->lasts[k];
            const real wx = b->rotation_sum[0][k], wy = b->rotation_sum[1][k];
            const real wz = b->rotation_sum[2][k];
            const real lever = t.sized ? half * r * size.inverse_mean : half * r;
            const real ux = rx - ax[k] - lever * (wy * nz - wz * ny);
            const real uy = ry - ay[k] - lever * (wz * nx - wx * nz);
            const real uz = rz - az[k] - lever * (wx * ny - wy * nx);
            const real un = ux * nx + uy * ny + uz * nz;
            const struct rotated v = rotate_spring(nx, ny, nz, sx[k], sy[k], sz[k]);
            b->square[0][k] = v.before;
            b->square[1][k] = v.after;
            sx[k] = masked(lasts, v.x);
            sy[k] = masked(lasts, v.y);
            sz[k] = masked(lasts, v.z);
            b->rate[0][k] = masked(lasts, m * (ux - un * nx));
            b->rate[1][k] = masked(lasts, m * (uy - un * ny));
            b->rate[2][k] = masked(lasts, m * (uz - un * nz));
        }
        if (t.viscous) {
            const real before2 = ax[k] * ax[k] + ay[k] * ay[k] + az[k] * az[k];
            b->rate[7][k] = mask(before2 > 0) * (root(before2) - r);
        }
        ax[k] = rx;
        ay[k] = ry;
        az[k] = rz;
    }
}

/* The same for rolling; springs of pivoting, advanced by the relative rotation. */
INLINE void rotate_rolling_3d(const struct gb_model *model, struct terms t,
                              BATCH *restrict b, struct gb_contacts *restrict c,
                              int64_t slot)
{
    const real *restrict deepest = PLANE(c->deepest);
    real *restrict pivot = PLANE(c->pivot);
    real *restrict qx = PLANE(c->roll[0]), *restrict qy = PLANE(c->roll[1]);
    real *restrict qz = PLANE(c->roll[2]);
    const real m = (real)model->slip.motion;
#pragma omp simd
    for (int k = 0; k < b->n; k++) {
        const real nx = b->unit[0][k], ny = b->unit[1][k], nz = b->unit[2][k];
        const struct pair_size size = stored_size(t, b, k);
        const real_bits lasts = b->lasts[k];
        const real dx =
            angle(t, size, b->rotation_sum[0][k], b->rotation_difference[0][k]);
        const real dy =
            angle(t, size, b->rotation_sum[1][k], b->rotation_difference[1][k]);
        const real dz =
            angle(t, size, b->rotation_sum[2][k], b->rotation_difference[2][k]);
        const real dn = dx * nx + dy * ny + dz * nz;
        if (!t.unpivoted) {
            pivot[k] = masked(lasts, pivot[k] + m * dn);
        }
        if (t.viscous) {
            b->rate[3][k] = masked(lasts, m * dn);
        }
        if (t.bridges) {
            const real_bits holds = lasts & bit_mask(deepest[k] > 0);
            const struct rotated q = rotate_spring(nx, ny, nz, qx[k], qy[k], qz[k]);
            b->square[2][k] = q.before;
            b->square[3][k] = q.after;
            qx[k] = masked(holds, q.x);
            qy[k] = masked(holds, q.y);
            qz[k] = masked(holds, q.z);
            b->rate[4][k] = masked(holds, m * (dx - dn * nx));
            b->rate[5][k] = masked(holds, m * (dy - dn * ny));
            b->rate[6][k] = masked(holds, m * (dz - dn * nz));
        }
    }
}

/* Factors that restore the lengths of the rotated springs. */
INLINE void restore_lengths(struct terms t, BATCH *restrict b)
{
#pragma omp simd
    for (int k = 0; k < b->n; k++) {
        b->kept[0][k] = keep_length(b->square[0][k], b->square[1][k]);
        if (t.bridges) {
            b->kept[2][k] = keep_length(b->square[2][k], b->square[3][k]);
        }
    }
}

/* Springs advanced by the relative motion; bridges that their caps break. */
INLINE void advance_springs_3d(const struct gb_model *model, struct terms t,
                               BATCH *restrict b, struct gb_contacts *restrict c,
                               int64_t slot)
{
    real *restrict deepest = PLANE(c->deepest);
    const real *restrict pivot = PLANE(c->pivot);
    real *restrict sx = PLANE(c->shear[0]), *restrict sy = PLANE(c->shear[1]);
    real *restrict sz = PLANE(c->shear[2]);
    real *restrict qx = PLANE(c->roll[0]), *restrict qy = PLANE(c->roll[1]);
    real *restrict qz = PLANE(c->roll[2]);
    const real relative = (real)model->bridge.length;
    const struct slip_law slip = slip_law(&model->slip, &model->rod);
    const real quarter = 0.25;
    real loose = 0.0;
#pragma omp simd reduction(+ : loose)
    for (int k = 0; k < b->n; k++) {
        const real keep = b->kept[0][k];
        const real vx = keep * sx[k] + b->rate[0][k];
        const real vy = keep * sy[k] + b->rate[1][k];
        const real vz = keep * sz[k] + b->rate[2][k];
        real now = deepest[k];
        sx[k] = vx;
        sy[k] = vy;
        sz[k] = vz;
        if (t.bridges) {
            const struct pair_size size = stored_size(t, b, k);
            const real length = relative * size.mean, h = b->overlap[k];
            const real twist = pivot[k], hold = b->kept[2][k];
            qx[k] = hold * qx[k] + b->rate[4][k];
            qy[k] = hold * qy[k] + b->rate[5][k];
            qz[k] = hold * qz[k] + b->rate[6][k];
            const real a2 = quarter * radius_square(t, length, now, h, size.reduced);
            const real v2 = vx * vx + vy * vy + vz * vz;
            const bool fails = (now > 0) & breaks(&slip, a2, v2, twist);
            const real left = deepest_left(length, h);
            now = fails ? left : now;
            deepest[k] = now;
        }
        if (!MOMENT_FITTED) {
            b->moment[k] = 0;
            loose += mask(now == 0);
        }
    }
    b->loose = loose;
}

/* M(a) by the fit of its tail. */
INLINE real fitted_moment(struct terms t, const struct slip_law *slip,
                          struct pair_size size, real h, real root_of)
{
    return t.sized ? unequal_contact_moment(slip, size, h, root_of,
                                            moment_tail(h * size.inverse_mean))
                   : contact_moment(slip, h, root_of, moment_tail(h));
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
    const real quarter = 0.25;
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
        const real a = radius(t, a2, live, root_of);
        const real ks = shear_stiffness(slip.shear, a);
        const real cap = shear_cap(&slip, held, a2, elastic);
        const real vx = sx[k], vy = sy[k], vz = sz[k];
        const real shear2 = ks * ks * (vx * vx + vy * vy + vz * vz);
        b->stiffness[0][k] = ks;
        b->sliding[k] = mask(shear2 > cap * cap);
        cut_spring(t, b, 0, k, cap, shear2);
        if (!t.unpivoted) {
            const real kp = pivot_stiffness(slip.pivot, a2, a), p = pivot[k];
            const real moment = MOMENT_FITTED
                                    ? fitted_moment(t, &slip, size, larger(h, 0), root_of)
                                    : b->moment[k];
            b->stiffness[1][k] = kp;
            cut_spring(t, b, 1, k, pivot_cap(&slip, held, a2, a, moment),
                       kp * kp * p * p);
        }
        if (t.bridges) {
            const real kr = roll_stiffness(slip.roll, a2, a);
            const real px = qx[k], py = qy[k], pz = qz[k];
            b->stiffness[2][k] = kr;
            cut_spring(t, b, 2, k, roll_cap(a, elastic),
                       kr * kr * (px * px + py * py + pz * pz));
        }
    }
}

/* Second half: springs cut at their caps; forces and torques. */
INLINE void spring_forces_3d(const struct gb_model *model, struct terms t,
                             BATCH *restrict b, struct gb_contacts *restrict c,
                             int64_t slot)
{
    const real *restrict deepest = PLANE(c->deepest);
    real *restrict pivot = PLANE(c->pivot);
    real *restrict sx = PLANE(c->shear[0]), *restrict sy = PLANE(c->shear[1]);
    real *restrict sz = PLANE(c->shear[2]);
    real *restrict qx = PLANE(c->roll[0]), *restrict qy = PLANE(c->roll[1]);
    real *restrict qz = PLANE(c->roll[2]);
    real *restrict last_normal = t.viscous ? PLANE(c->last_normal) : NULL;
    real *restrict last_shear = t.viscous ? PLANE(c->last_shear) : NULL;
    real *restrict last_roll = t.viscous ? PLANE(c->last_roll) : NULL;
    real *restrict last_pivot = t.viscous ? PLANE(c->last_pivot) : NULL;
    const real half = 0.5;
    const real inverse_motion = (real)(1.0 / model->slip.motion);
    const real damp = b->damp;
    const real shear_damp = damp * (real)model->dynamics.viscous_shear;
    const real roll_damp = damp * (real)model->dynamics.viscous_rolling;
    normal_forces_3d(model, t, b, c, slot);
    if (t.friction) {
        cut_springs_3d(model, t, b, c, slot);
    }
#pragma omp simd
    for (int k = 0; k < b->n; k++) {
        const real nx = b->unit[0][k], ny = b->unit[1][k], nz = b->unit[2][k];
        const real r = b->distance[k], h = b->overlap[k];
        const struct pair_size size = stored_size(t, b, k);
        real fn = b->along[k], absorbed = 0.0;
        if (t.viscous) {
            const real lag = damp * b->slope[k] * b->rate[7][k];
            absorbed = (half * (last_normal[k] + fn) + lag) * b->rate[7][k];
            last_normal[k] = fn;
            fn += lag;
        }
        real fx = fn * nx, fy = fn * ny, fz = fn * nz;
        real tx = 0.0, ty = 0.0, tz = 0.0, jx = 0.0, jy = 0.0, jz = 0.0;
        if (t.friction) {
            const real ks = b->stiffness[0][k], kp = t.unpivoted ? 0 : b->stiffness[1][k];
            const real keep = b->kept[0][k], stay = t.unpivoted ? 1 : b->kept[1][k];
            real vx = sx[k], vy = sy[k], vz = sz[k], p = t.unpivoted ? 0 : pivot[k];
            const real ox = vx, oy = vy, oz = vz, op = p;
            vx *= keep;
            vy *= keep;
            vz *= keep;
            p *= stay;
            sx[k] = vx;
            sy[k] = vy;
            sz[k] = vz;
            if (!t.unpivoted) {
                pivot[k] = p;
            }
            if (t.viscous) {
                /* work over the step: mean of the spring forces before (rotated with the
                 * contact) and after */
                const real ux = b->rate[0][k], uy = b->rate[1][k], uz = b->rate[2][k];
                const real up = b->rate[3][k];
                const real was = last_shear[k], pivot_was = last_pivot[k];
                const real lag = shear_damp * b->below[0][k];
                const real pivot_lag = roll_damp * b->below[1][k];
                const real fore = (ox - ux) * ux + (oy - uy) * uy + (oz - uz) * uz;
                const real aft = vx * ux + vy * uy + vz * uz;
                const real u2 = ux * ux + uy * uy + uz * uz;
                absorbed +=
                    inverse_motion * (half * (was * fore + ks * aft) + lag * ks * u2 +
                                      half * (pivot_was * (op - up) + kp * p) * up +
                                      pivot_lag * kp * up * up);
                last_shear[k] = ks;
                last_pivot[k] = kp;
                vx += lag * ux;
                vy += lag * uy;
                vz += lag * uz;
                p += pivot_lag * up;
            }
            fx -= ks * vx;
            fy -= ks * vy;
            fz -= ks * vz;
            real mx = -kp * p * nx, my = -kp * p * ny, mz = -kp * p * nz;
            if (t.bridges) {
                const bool held = deepest[k] > 0;
                const real kr = b->stiffness[2][k];
                const real hold = where(held, b->kept[2][k]);
                real px = qx[k], py = qy[k], pz = qz[k];
                const real qox = px, qoy = py, qoz = pz;
                px *= hold;
                py *= hold;
                pz *= hold;
                qx[k] = px;
                qy[k] = py;
                qz[k] = pz;
                if (t.viscous) {
                    const real gx = b->rate[4][k], gy = b->rate[5][k], gz = b->rate[6][k];
                    const real lag = where(held, roll_damp * b->below[2][k]);
                    const real fore = (qox - gx) * gx + (qoy - gy) * gy + (qoz - gz) * gz;
                    const real aft = px * gx + py * gy + pz * gz;
                    absorbed +=
                        inverse_motion * (half * (last_roll[k] * fore + kr * aft) +
                                          lag * kr * (gx * gx + gy * gy + gz * gz));
                    last_roll[k] = where(held, kr);
                    px += lag * gx;
                    py += lag * gy;
                    pz += lag * gz;
                }
                mx -= kr * px;
                my -= kr * py;
                mz -= kr * pz;
            }
            /* torque of the shear force on both: -(r/2) n x T, T = -ks v */
            const real lever =
                t.sized ? half * r * size.inverse_mean * ks : half * r * ks;
            const real cx = lever * (ny * vz - nz * vy);
            const real cy = lever * (nz * vx - nx * vz);
            const real cz = lever * (nx * vy - ny * vx);
            tx = cx + mx * size.inverse_i;
            ty = cy + my * size.inverse_i;
            tz = cz + mz * size.inverse_i;
            jx = cx - mx * size.inverse_j;
            jy = cy - my * size.inverse_j;
            jz = cz - mz * size.inverse_j;
        }
        b->force[0][k] = fx;
        b->force[1][k] = fy;
        b->force[2][k] = fz;
        b->torque_i[0][k] = tx;
        b->torque_i[1][k] = ty;
        b->torque_i[2][k] = tz;
        b->torque_j[0][k] = jx;
        b->torque_j[1][k] = jy;
        b->torque_j[2][k] = jz;
        if (t.viscous) {
            b->absorbed[k] = absorbed;
        }
        if (t.sized) { /* for the tally */
            b->overlap[k] = h * size.inverse_mean;
        }
    }
}

/* Force on the first particle, 3D and not viscous, from springs already cut. */
INLINE void recompute_3d(const struct gb_model *model, struct terms t, BATCH *restrict b,
                         const struct gb_contacts *restrict c, int64_t slot)
{
    const real *restrict deepest = PLANE(c->deepest);
    const real *restrict ax = PLANE(c->branch[0]), *restrict ay = PLANE(c->branch[1]);
    const real *restrict az = PLANE(c->branch[2]);
    const real *restrict sx = PLANE(c->shear[0]), *restrict sy = PLANE(c->shear[1]);
    const real *restrict sz = PLANE(c->shear[2]);
    const struct normal_law law = normal_law(model, b->cutoff2);
    const real k_shear = (real)model->slip.shear, relative = (real)model->bridge.length;
    const real quarter = 0.25;
    const real away2 = 4 * (1 + b->cutoff2); /* of free slots, whose branch vector is 0 */
#pragma omp simd
    for (int k = 0; k < b->n; k++) {
        const real rx = ax[k], ry = ay[k], rz = az[k], state = deepest[k];
        const real squared = rx * rx + ry * ry + rz * rz;
        const struct pair_size size =
            t.sized ? unequal_size(b->diameter[0][k], b->diameter[1][k]) : equal_size();
        const real length = relative * size.mean;
        const real r = root(squared > 0 ? squared : away2), h = size.mean - r;
        const bool live = state >= 0;
        const struct normal f = normal_force(t, &law, size, state, h, r);
        const real along = f.total / r;
        real ks = 0;
        if (t.friction) {
            const real a2 =
                where(live, quarter * radius_square(t, length, state, h, size.reduced));
            ks = shear_stiffness(k_shear, radius(t, a2, live, f.root));
        }
        b->r[0][k] = rx;
        b->r[1][k] = ry;
        b->r[2][k] = rz;
        b->force[0][k] = along * rx - (t.friction ? ks * sx[k] : 0);
        b->force[1][k] = along * ry - (t.friction ? ks * sy[k] : 0);
        b->force[2][k] = along * rz - (t.friction ? ks * sz[k] : 0);
    }
}

static inline double unequal_moment(const struct gb_model *model, const BATCH *b, int k)
{
    struct gb_law_unequal law;
    gb_unequal_pair_init(&law, model, b->diameter[0][k], b->diameter[1][k]);
    return gb_law_unequal_moment(&law, b->overlap[k]);
}

/* First moment of the contact pressure, M(a) of (9), for the pivoting cap of contacts
 * without a bridge.  Few contacts need it in scenes with bridges. */
INLINE void fill_moments(const struct gb_model *model, struct terms t, BATCH *batch,
                         const real *deepest)
{
    for (int k = 0; k < batch->n; k++) {
        if (deepest[k] == 0) {
            batch->moment[k] =
                t.sized ? (real)unequal_moment(model, batch, k)
                        : (real)gb_law_rod_moment(&model->rod, batch->overlap[k]);
        }
    }
}

/* Springs advanced, then cut, and their forces; between these halves the moments, which few
 * contacts need. */
INLINE void advance_3d(const struct gb_model *model, struct terms t, BATCH *b,
                       struct gb_contacts *c, int64_t slot)
{
    contact_geometry_3d(model, t, b, c, slot);
    rotate_shear_3d(model, t, b, c, slot);
    if (t.friction) {
        rotate_rolling_3d(model, t, b, c, slot);
        restore_lengths(t, b);
        advance_springs_3d(model, t, b, c, slot);
    }
    if (t.friction && !MOMENT_FITTED && b->loose > 0 && model->slip.mu_pivot > 0.0) {
        fill_moments(model, t, b, PLANE(c->deepest));
    }
    spring_forces_3d(model, t, b, c, slot);
}

#endif
