#ifndef GB_PACK_BATCH_3D_H
#define GB_PACK_BATCH_3D_H

#include "pack/batch_laws.h"

/* First half, 3D: geometry, bridge state, springs stretched by the motion. */
INLINE void stretch_3d(const struct gb_model *model, struct terms t,
                       struct gb_batch *restrict b, struct gb_contacts *restrict c,
                       int64_t slot)
{
    double *restrict deepest = c->deepest + slot, *restrict pivot = c->pivot + slot;
    double *restrict ax = c->arm[0] + slot, *restrict ay = c->arm[1] + slot;
    double *restrict az = c->arm[2] + slot;
    double *restrict sx = c->shear[0] + slot, *restrict sy = c->shear[1] + slot;
    double *restrict sz = c->shear[2] + slot;
    double *restrict qx = c->roll[0] + slot, *restrict qy = c->roll[1] + slot;
    double *restrict qz = c->roll[2] + slot;
    const double m = model->slip.motion, length = model->bridge.length;
    const double k_shear = model->slip.shear, k_pivot = model->slip.pivot;
    /* the caps over the stiffnesses, both squared, without the contact's size */
    const double tear = M_PI * M_PI * model->slip.strength * model->slip.strength;
    const double wring = 0.25 * tear;
    double failed = 0.0, loose = 0.0;
#pragma omp simd reduction(+ : failed, loose)
    for (int k = 0; k < b->n; k++) {
        const double rx = b->r[0][k], ry = b->r[1][k], rz = b->r[2][k];
        const double squared = rx * rx + ry * ry + rz * rz;
        const double r = sqrt(squared), inverse = 1.0 / r;
        const double nx = rx * inverse, ny = ry * inverse, nz = rz * inverse;
        const double h = 1.0 - r, before = deepest[k];
        const bool live = squared < 1.0;
        const double lasts = mask(live & (before >= 0.0));
        const double state =
            t.bridges ? deepest_after(length, larger(before, 0.0), h) : 0.0;
        const double now = live ? state : -1.0;
        b->unit[0][k] = nx;
        b->unit[1][k] = ny;
        b->unit[2][k] = nz;
        b->distance[k] = r;
        b->overlap[k] = h;
        if (t.friction) {
            const double wx = b->turn_sum[0][k], wy = b->turn_sum[1][k];
            const double wz = b->turn_sum[2][k];
            const double dx = b->turn_difference[0][k], dy = b->turn_difference[1][k];
            const double dz = b->turn_difference[2][k];
            double ux = rx - ax[k] - 0.5 * r * (wy * nz - wz * ny);
            double uy = ry - ay[k] - 0.5 * r * (wz * nx - wx * nz);
            double uz = rz - az[k] - 0.5 * r * (wx * ny - wy * nx);
            const double un = ux * nx + uy * ny + uz * nz;
            const double dn = dx * nx + dy * ny + dz * nz;
            ux = m * (ux - un * nx);
            uy = m * (uy - un * ny);
            uz = m * (uz - un * nz);
            double vx = sx[k], vy = sy[k], vz = sz[k];
            const double v2 = vx * vx + vy * vy + vz * vz;
            const double vn = vx * nx + vy * ny + vz * nz;
            vx -= vn * nx;
            vy -= vn * ny;
            vz -= vn * nz;
            const double keep = keep_length(v2, vx * vx + vy * vy + vz * vz);
            vx = lasts * (keep * vx + ux);
            vy = lasts * (keep * vy + uy);
            vz = lasts * (keep * vz + uz);
            const double twist = lasts * (pivot[k] + m * dn);
            sx[k] = vx;
            sy[k] = vy;
            sz[k] = vz;
            pivot[k] = twist;
            if (t.viscous) {
                b->rate[0][k] = lasts * ux;
                b->rate[1][k] = lasts * uy;
                b->rate[2][k] = lasts * uz;
                b->rate[3][k] = lasts * m * dn;
            }
            if (t.bridges) {
                const double holds = lasts * mask(now > 0.0);
                double px = qx[k], py = qy[k], pz = qz[k];
                const double p2 = px * px + py * py + pz * pz;
                const double pn = px * nx + py * ny + pz * nz;
                px -= pn * nx;
                py -= pn * ny;
                pz -= pn * nz;
                const double hold = keep_length(p2, px * px + py * py + pz * pz);
                const double gx = m * (dx - dn * nx), gy = m * (dy - dn * ny);
                const double gz = m * (dz - dn * nz);
                qx[k] = holds * (hold * px + gx);
                qy[k] = holds * (hold * py + gy);
                qz[k] = holds * (hold * pz + gz);
                if (t.viscous) {
                    b->rate[4][k] = holds * gx;
                    b->rate[5][k] = holds * gy;
                    b->rate[6][k] = holds * gz;
                }
                /* (5), (11): the cap of shear or pivoting is reached */
                const double a2 = 0.25 * radius_square(t, length, now, h);
                const double v_squared = vx * vx + vy * vy + vz * vz;
                const double fails =
                    mask((now > 0.0) & ((k_shear * k_shear * v_squared > tear * a2) |
                                        (k_pivot * k_pivot * twist * twist > wring)));
                b->fails[k] = fails;
                failed += fails;
            }
        }
        if (t.friction) {
            b->moment[k] = 0.0;
            loose += mask(now == 0.0);
        }
        if (t.viscous) {
            const double arm2 = ax[k] * ax[k] + ay[k] * ay[k] + az[k] * az[k];
            b->rate[7][k] = mask(arm2 > 0.0) * (sqrt(arm2) - r);
        }
        deepest[k] = now;
        ax[k] = rx;
        ay[k] = ry;
        az[k] = rz;
    }
    b->failed = failed;
    b->loose = loose;
}

/* Second half, 3D: forces and torques from the springs, which are cut at their caps. */
INLINE void load_3d(const struct gb_model *model, struct terms t,
                    struct gb_batch *restrict b, struct gb_contacts *restrict c,
                    int64_t slot)
{
    const double *restrict deepest = c->deepest + slot;
    double *restrict pivot = c->pivot + slot;
    double *restrict sx = c->shear[0] + slot, *restrict sy = c->shear[1] + slot;
    double *restrict sz = c->shear[2] + slot;
    double *restrict qx = c->roll[0] + slot, *restrict qy = c->roll[1] + slot;
    double *restrict qz = c->roll[2] + slot;
    double *restrict last_normal = t.viscous ? c->last_normal + slot : NULL;
    double *restrict last_shear = t.viscous ? c->last_shear + slot : NULL;
    double *restrict last_roll = t.viscous ? c->last_roll + slot : NULL;
    double *restrict last_pivot = t.viscous ? c->last_pivot + slot : NULL;
    const struct gb_law_slip slip = model->slip;
    const double inverse_motion = 1.0 / slip.motion;
    const double damp = b->damp, cutoff2 = b->cutoff2;
    const double length = model->bridge.length;
#pragma omp simd
    for (int k = 0; k < b->n; k++) {
        const double nx = b->unit[0][k], ny = b->unit[1][k], nz = b->unit[2][k];
        const double r = b->distance[k], h = b->overlap[k], state = deepest[k];
        const bool held = t.bridges & (state > 0.0);
        const double live = mask(state >= 0.0);
        const struct normal f = normal_force(model, cutoff2, state, h, r);
        double fn = f.total, taken = 0.0;
        if (t.viscous) {
            const double lag = damp * f.slope * b->rate[7][k];
            taken = (0.5 * (last_normal[k] + fn) + lag) * b->rate[7][k];
            last_normal[k] = fn;
            fn += lag;
        }
        double fx = fn * nx, fy = fn * ny, fz = fn * nz;
        double tx = 0.0, ty = 0.0, tz = 0.0, jx = 0.0, jy = 0.0, jz = 0.0;
        double slides = 0.0;
        if (t.friction) {
            const double a2 = live * 0.25 * radius_square(t, length, state, h);
            const double a = radius(t, a2, live, f.root);
            const double ks = slip.shear * a, kp = slip.pivot * a2 * a;
            const double strength = M_PI * a2 * slip.strength;
            const double twisting = 0.5 * M_PI * a2 * a * slip.strength;
            const double cap = held ? strength : smaller(slip.mu * f.elastic, strength);
            const double turn_cap =
                held ? twisting : smaller(slip.mu_pivot * b->moment[k], twisting);
            double vx = sx[k], vy = sy[k], vz = sz[k], p = pivot[k];
            const double ox = vx, oy = vy, oz = vz, op = p;
            const double v2 = vx * vx + vy * vy + vz * vz;
            const double shear2 = ks * ks * v2, turn2 = kp * kp * p * p;
            const bool cut = shear2 > cap * cap, turned = turn2 > turn_cap * turn_cap;
            const double keep = cut_to(t, cap, shear2, cut);
            const double stay = cut_to(t, turn_cap, turn2, turned);
            vx *= keep;
            vy *= keep;
            vz *= keep;
            p *= stay;
            sx[k] = vx;
            sy[k] = vy;
            sz[k] = vz;
            pivot[k] = p;
            slides = mask(cut);
            if (t.viscous) {
                /* work over the step: the springs as they were, turned along, and as they
                 * are */
                const double ux = b->rate[0][k], uy = b->rate[1][k], uz = b->rate[2][k];
                const double up = b->rate[3][k];
                const double was = last_shear[k], turned_was = last_pivot[k];
                const double lag = damp * mask(!cut), turn_lag = damp * mask(!turned);
                const double fore = (ox - ux) * ux + (oy - uy) * uy + (oz - uz) * uz;
                const double aft = vx * ux + vy * uy + vz * uz;
                const double u2 = ux * ux + uy * uy + uz * uz;
                taken += inverse_motion * (0.5 * (was * fore + ks * aft) + lag * ks * u2 +
                                           0.5 * (turned_was * (op - up) + kp * p) * up +
                                           turn_lag * kp * up * up);
                last_shear[k] = ks;
                last_pivot[k] = kp;
                vx += lag * ux;
                vy += lag * uy;
                vz += lag * uz;
                p += turn_lag * up;
            }
            fx -= ks * vx;
            fy -= ks * vy;
            fz -= ks * vz;
            double mx = -kp * p * nx, my = -kp * p * ny, mz = -kp * p * nz;
            if (t.bridges) {
                const double kr = slip.roll * a2 * a;
                const double roll_cap = a * larger(f.elastic, 0.0) / 3.0;
                double px = qx[k], py = qy[k], pz = qz[k];
                const double qox = px, qoy = py, qoz = pz;
                const double p2 = px * px + py * py + pz * pz;
                const double roll2 = kr * kr * p2;
                const bool rolls = roll2 > roll_cap * roll_cap;
                const double hold = mask(held) * cut_to(t, roll_cap, roll2, rolls);
                px *= hold;
                py *= hold;
                pz *= hold;
                qx[k] = px;
                qy[k] = py;
                qz[k] = pz;
                if (t.viscous) {
                    const double gx = b->rate[4][k], gy = b->rate[5][k],
                                 gz = b->rate[6][k];
                    const double lag = damp * mask(!rolls & held);
                    const double fore =
                        (qox - gx) * gx + (qoy - gy) * gy + (qoz - gz) * gz;
                    const double aft = px * gx + py * gy + pz * gz;
                    taken += inverse_motion * (0.5 * (last_roll[k] * fore + kr * aft) +
                                               lag * kr * (gx * gx + gy * gy + gz * gz));
                    last_roll[k] = mask(held) * kr;
                    px += lag * gx;
                    py += lag * gy;
                    pz += lag * gz;
                }
                mx -= kr * px;
                my -= kr * py;
                mz -= kr * pz;
            }
            /* torque of the shear force on both: -(r/2) n x T, T = -ks v */
            const double lever = 0.5 * r * ks;
            const double cx = lever * (ny * vz - nz * vy);
            const double cy = lever * (nz * vx - nx * vz);
            const double cz = lever * (nx * vy - ny * vx);
            tx = cx + mx;
            ty = cy + my;
            tz = cz + mz;
            jx = cx - mx;
            jy = cy - my;
            jz = cz - mz;
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
            b->absorbed[k] = taken;
        }
        b->normal[k] = live * fabs(f.elastic - model->adhesion);
        b->sliding[k] = slides;
    }
}

#endif
