#include "pack/batch.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"

/* How these loops are written: conditions choose between values that are there already and
 * masks (1 or 0) multiply, so that no lane needs a branch; a hidden one (&&, or an expensive
 * branch of ?:) would send the whole loop back to one contact at a time.
 *
 * One source, compiled once per useful combination of terms and per vector width: every
 * `const bool` below is a constant where the function is inlined.  Nothing but the order of
 * lanes differs between the widths (contraction is off), so they give the same bits. */
#define INLINE static inline __attribute__((always_inline))

struct terms {
    bool planar, friction, bridges, viscous;
};

enum { PLANES_3D = 11, PLANES_2D = 5 };

static void name_planes(struct gb_contacts *contacts, int vector, int spring, bool viscous)
{
    double **plane = contacts->plane;
    contacts->deepest = *plane++;
    for (int k = 0; k < spring; k++) {
        contacts->shear[k] = *plane++;
        contacts->roll[k] = *plane++;
    }
    contacts->pivot = vector == 3 ? *plane++ : NULL;
    for (int k = 0; k < vector; k++) {
        contacts->arm[k] = *plane++;
    }
    if (viscous) {
        contacts->last_normal = *plane++;
        contacts->last_shear = *plane++;
        contacts->last_roll = *plane++;
        contacts->last_pivot = vector == 3 ? *plane++ : NULL;
    }
}

bool gb_contacts_init(struct gb_contacts *contacts, int dimension, bool viscous,
                      int64_t room, struct gb_error *err)
{
    const bool solid = dimension == 3;
    const int kept = solid ? PLANES_3D : PLANES_2D, last = viscous ? (solid ? 4 : 3) : 0;
    const int64_t stride = (room + 7) / 8 * 8;
    /* what is kept of a viscous scene is all: its copies go back into the middle of a motion */
    *contacts = (struct gb_contacts){.room = room,
                                     .planes = kept + last,
                                     .kept = viscous ? kept + last : kept - (solid ? 3 : 2)};
    double *slab =
        gb_alloc_array((size_t)contacts->planes * (size_t)stride, sizeof *slab, err);
    if (!slab) {
        *contacts = (struct gb_contacts){0};
        return false;
    }
    for (int p = 0; p < contacts->planes; p++) {
        contacts->plane[p] = slab + p * stride;
    }
    name_planes(contacts, solid ? 3 : 2, solid ? 3 : 1, viscous);
    return true;
}

void gb_contacts_finish(struct gb_contacts *contacts)
{
    gb_alloc_free(contacts->plane[0]);
    *contacts = (struct gb_contacts){0};
}

void gb_contacts_clear(struct gb_contacts *contacts, int64_t slot)
{
    for (int p = 0; p < contacts->planes; p++) {
        contacts->plane[p][slot] = 0.0;
    }
    contacts->deepest[slot] = -1.0;
}

/* -(h + ln(1 - h)) for 0 <= h <= 1/2 to the last digit: with s = h / (2 - h) it is
 * 2 (s^2/(1+s) + s^3/3 + s^5/5 + ...), all terms positive. */
INLINE double log_tail(double h)
{
    const double s = h / (2.0 - h), q = s * s;
    double sum = 1.0 / 33.0;
    sum = sum * q + 1.0 / 31.0;
    sum = sum * q + 1.0 / 29.0;
    sum = sum * q + 1.0 / 27.0;
    sum = sum * q + 1.0 / 25.0;
    sum = sum * q + 1.0 / 23.0;
    sum = sum * q + 1.0 / 21.0;
    sum = sum * q + 1.0 / 19.0;
    sum = sum * q + 1.0 / 17.0;
    sum = sum * q + 1.0 / 15.0;
    sum = sum * q + 1.0 / 13.0;
    sum = sum * q + 1.0 / 11.0;
    sum = sum * q + 1.0 / 9.0;
    sum = sum * q + 1.0 / 7.0;
    sum = sum * q + 1.0 / 5.0;
    sum = sum * q + 1.0 / 3.0;
    return 2.0 * q * (1.0 / (1.0 + s) + s * sum);
}

/* f_e and its slope by the rod law, P1 (1), (2); h in [0, 1/2]. */
INLINE double rod_force(const struct gb_law_rod *rod, double h)
{
    return rod->hertz * h * sqrt(h) + rod->rod * log_tail(h);
}

INLINE double rod_stiffness(const struct gb_law_rod *rod, double h)
{
    return 1.5 * rod->hertz * sqrt(h) + rod->rod * h / (1.0 - h);
}

INLINE double larger(double a, double b)
{
    return a > b ? a : b;
}

INLINE double smaller(double a, double b)
{
    return a < b ? a : b;
}

/* h_min after the move to overlap h; law_bridge.h without branches. */
INLINE double deepest_after(double length, double before, double h)
{
    const double fresh = h > length ? h : 0.0;
    const double peeled = before - h > length ? h + length : before;
    const double bridged = h >= before ? h : peeled;
    return before <= 0.0 ? fresh : bridged;
}

/* Squared overlap whose root is twice the spring radius.  printed: 1 where a_ch follows the
 * printed form at the current r, 0 where it belongs to r_min. */
INLINE double radius_square(struct terms t, double printed, double length, double deepest,
                            double h)
{
    const double ring = deepest + printed * ((h + length) - deepest);
    return (t.bridges & (deepest > 0.0)) ? ring : h;
}

/* Factor that keeps the length of a vector when its normal part is taken away. */
INLINE double keep_length(double before, double after)
{
    return sqrt((after > 0.0 ? before : 1.0) / (after > 0.0 ? after : 1.0));
}

/* Factor that cuts a spring of squared load load2 back to its cap. */
INLINE double cut_to(double cap, double load2, bool over)
{
    return (over ? cap : 1.0) / sqrt(over ? load2 : 1.0);
}

INLINE double mask(bool condition)
{
    return condition ? 1.0 : 0.0;
}

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
    const double sigma = model->slip.strength;
    const double printed = mask(model->bridge.radius_current);
#pragma omp simd
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
                const double a2 = 0.25 * radius_square(t, printed, length, now, h);
                const double a = sqrt(larger(a2, 0.0));
                const double shear = k_shear * a, shear_cap = M_PI * a2 * sigma;
                const double turn = k_pivot * a2 * a, turn_cap = 0.5 * M_PI * a2 * a * sigma;
                const double shear2 = shear * shear * (vx * vx + vy * vy + vz * vz);
                const double turn2 = turn * turn * twist * twist;
                b->fails[k] = mask((now > 0.0) & ((shear2 > shear_cap * shear_cap) |
                                                  (turn2 > turn_cap * turn_cap)));
            }
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
}

/* f_n along the normal: elastic line or rod law minus adhesion, or the pull across a gap. */
struct normal {
    double elastic, slope, total;
};

INLINE struct normal normal_force(const struct gb_model *model, double cutoff2,
                                  double deepest, double h, double r)
{
    const double live = mask(deepest >= 0.0), reached = mask(r * r < cutoff2);
    const double overlap = larger(h, 0.0);
    const double from = deepest > 0.0 ? deepest : overlap;
    const double slope = rod_stiffness(&model->rod, from);
    const double force = rod_force(&model->rod, from) - slope * (from - overlap);
    const double s = larger(r, 1.0) + model->dispersion.shift, q = s * s - 1.0;
    const double pull = model->dispersion.strength / (s * s * s * q * q);
    return (struct normal){live * force, live * slope,
                           live * (force - model->adhesion) -
                               (1.0 - live) * reached * pull};
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
    const double printed = mask(model->bridge.radius_current);
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
            const double a2 = live * 0.25 * radius_square(t, printed, length, state, h);
            const double a = sqrt(larger(a2, 0.0));
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
            const double keep = cut_to(cap, shear2, cut);
            const double stay = cut_to(turn_cap, turn2, turned);
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
                /* work over the step: the springs as they were, turned along, and as they are */
                const double ux = b->rate[0][k], uy = b->rate[1][k], uz = b->rate[2][k];
                const double up = b->rate[3][k];
                const double was = last_shear[k], turned_was = last_pivot[k];
                const double lag = damp * mask(!cut), turn_lag = damp * mask(!turned);
                const double fore = (ox - ux) * ux + (oy - uy) * uy + (oz - uz) * uz;
                const double aft = vx * ux + vy * uy + vz * uz;
                const double u2 = ux * ux + uy * uy + uz * uz;
                taken += inverse_motion *
                         (0.5 * (was * fore + ks * aft) + lag * ks * u2 +
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
                const double hold = mask(held) * cut_to(roll_cap, roll2, rolls);
                px *= hold;
                py *= hold;
                pz *= hold;
                qx[k] = px;
                qy[k] = py;
                qz[k] = pz;
                if (t.viscous) {
                    const double gx = b->rate[4][k], gy = b->rate[5][k], gz = b->rate[6][k];
                    const double lag = damp * mask(!rolls & held);
                    const double fore =
                        (qox - gx) * gx + (qoy - gy) * gy + (qoz - gz) * gz;
                    const double aft = px * gx + py * gy + pz * gz;
                    taken += inverse_motion *
                             (0.5 * (last_roll[k] * fore + kr * aft) +
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
    const double k_shear = model->slip.shear, sigma = model->slip.strength;
    const double printed = mask(model->bridge.radius_current);
#pragma omp simd
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
            const double u = m * ((rx - ax[k]) * nz - (rz - az[k]) * nx -
                                  0.5 * r * b->turn_sum[0][k]);
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
                const double a2 = 0.25 * radius_square(t, printed, length, now, h);
                const double ks = k_shear * sqrt(larger(a2, 0.0));
                const double cap = M_PI * a2 * sigma;
                b->fails[k] = mask((now > 0.0) & (ks * ks * v * v > cap * cap));
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
    const double printed = mask(model->bridge.radius_current);
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
            const double a2 = live * 0.25 * radius_square(t, printed, length, state, h);
            const double a = sqrt(larger(a2, 0.0)), ks = slip.shear * a;
            const double strength = M_PI * a2 * slip.strength;
            const double cap = held ? strength : smaller(slip.mu * f.elastic, strength);
            double v = shear[k];
            const double trial = v;
            const double shear2 = ks * ks * v * v;
            const bool cut = shear2 > cap * cap;
            v *= cut_to(cap, shear2, cut);
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
                p *= cut_to(roll_cap, roll2, rolls);
                roll[k] = p;
                if (t.viscous) {
                    const double g = b->rate[1][k], lag = damp * mask(!rolls & held);
                    taken += inverse_motion * g *
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

INLINE double lane_sum(const double lane[GB_LANES])
{
    return ((lane[0] + lane[1]) + (lane[2] + lane[3])) +
           ((lane[4] + lane[5]) + (lane[6] + lane[7]));
}

/* Adds the products of two arrays (times 1 where b is NULL) over whole groups of lanes. */
INLINE double lane_total(const double *a, const double *b, int n)
{
    double lane[GB_LANES] = {0};
    for (int k = 0; k < n; k += GB_LANES) {
        for (int l = 0; l < GB_LANES; l++) {
            lane[l] += b ? a[k + l] * b[k + l] : a[k + l];
        }
    }
    return lane_sum(lane);
}

INLINE void tally_batch(struct terms t, struct gb_batch *b, const double *deepest,
                        struct gb_tally *tally)
{
    const int axes = t.planar ? 2 : 3;
    const int whole = (b->n + GB_LANES - 1) / GB_LANES * GB_LANES;
    for (int k = b->n; k < whole; k++) { /* lanes without a pair count nothing */
        b->normal[k] = b->sliding[k] = b->absorbed[k] = 0.0;
        for (int c = 0; c < axes; c++) {
            b->force[c][k] = b->r[c][k] = 0.0;
        }
    }
    int64_t contacts = 0;
    double most = tally->deepest;
    for (int k = 0; k < b->n; k++) {
        contacts += deepest[k] >= 0.0;
        most = larger(b->overlap[k], most);
    }
    tally->contacts += contacts;
    tally->deepest = most;
    tally->normal_sum += lane_total(b->normal, NULL, whole);
    if (t.friction) {
        tally->sliding += (int64_t)lane_total(b->sliding, NULL, whole);
    }
    if (t.viscous) {
        tally->absorbed += lane_total(b->absorbed, NULL, whole);
        for (int c = 0; c < axes; c++) {
            tally->virial[t.planar ? 2 * c : c] += lane_total(b->force[c], b->r[c], whole);
        }
    }
}

/* Variants: planar or not, {normal only, friction, friction and bridges}, viscous or not. */
#define VARIANT(name, attribute, planar_, friction_, bridges_, viscous_)                  \
    attribute static void name##_stretch(const struct gb_model *model,                   \
                                         struct gb_batch *batch,                         \
                                         struct gb_contacts *contacts, int64_t slot)     \
    {                                                                                    \
        const struct terms t = {planar_, friction_, bridges_, viscous_};                 \
        if (planar_) {                                                                   \
            stretch_2d(model, t, batch, contacts, slot);                                 \
        } else {                                                                         \
            stretch_3d(model, t, batch, contacts, slot);                                 \
        }                                                                                \
    }                                                                                    \
    attribute static void name##_load(const struct gb_model *model,                      \
                                      struct gb_batch *batch,                            \
                                      struct gb_contacts *contacts, int64_t slot)        \
    {                                                                                    \
        const struct terms t = {planar_, friction_, bridges_, viscous_};                 \
        if (planar_) {                                                                   \
            load_2d(model, t, batch, contacts, slot);                                    \
        } else {                                                                         \
            load_3d(model, t, batch, contacts, slot);                                    \
        }                                                                                \
    }                                                                                    \
    attribute static void name##_tally(struct gb_batch *batch, const double *deepest,    \
                                       struct gb_tally *tally)                           \
    {                                                                                    \
        const struct terms t = {planar_, friction_, bridges_, viscous_};                 \
        tally_batch(t, batch, deepest, tally);                                           \
    }

#define VARIANTS(width, attribute)                                                        \
    VARIANT(width##_3d_normal, attribute, false, false, false, false)                    \
    VARIANT(width##_3d_friction, attribute, false, true, false, false)                   \
    VARIANT(width##_3d_bridges, attribute, false, true, true, false)                     \
    VARIANT(width##_3d_normal_viscous, attribute, false, false, false, true)             \
    VARIANT(width##_3d_friction_viscous, attribute, false, true, false, true)            \
    VARIANT(width##_3d_bridges_viscous, attribute, false, true, true, true)              \
    VARIANT(width##_2d_normal, attribute, true, false, false, false)                     \
    VARIANT(width##_2d_friction, attribute, true, true, false, false)                    \
    VARIANT(width##_2d_bridges, attribute, true, true, true, false)                      \
    VARIANT(width##_2d_normal_viscous, attribute, true, false, false, true)              \
    VARIANT(width##_2d_friction_viscous, attribute, true, true, false, true)             \
    VARIANT(width##_2d_bridges_viscous, attribute, true, true, true, true)

#define ROW(name) {name##_stretch, name##_load, name##_tally}
#define TABLE(width)                                                                      \
    {                                                                                    \
        ROW(width##_3d_normal), ROW(width##_3d_friction), ROW(width##_3d_bridges),       \
            ROW(width##_3d_normal_viscous), ROW(width##_3d_friction_viscous),            \
            ROW(width##_3d_bridges_viscous), ROW(width##_2d_normal),                     \
            ROW(width##_2d_friction), ROW(width##_2d_bridges),                           \
            ROW(width##_2d_normal_viscous), ROW(width##_2d_friction_viscous),            \
            ROW(width##_2d_bridges_viscous)                                              \
    }

VARIANTS(w128, )
static const struct gb_batch_kernel table128[] = TABLE(w128);
#if defined(__x86_64__)
#if defined(__clang__)
#define TARGET_512 "avx512f,avx512dq,avx512vl,avx512bw"
#else
#define TARGET_512 "avx512f,avx512dq,avx512vl,avx512bw,prefer-vector-width=512"
#endif
VARIANTS(w256, __attribute__((target("avx2"))))
VARIANTS(w512, __attribute__((target(TARGET_512))))
static const struct gb_batch_kernel table256[] = TABLE(w256);
static const struct gb_batch_kernel table512[] = TABLE(w512);
#endif

static const struct gb_batch_kernel *table_for(int widest)
{
#if defined(__x86_64__)
    const int most = widest > 0 ? widest : 512;
    if (most >= 512 && __builtin_cpu_supports("avx512f") &&
        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512bw")) {
        return table512;
    }
    if (most >= 256 && __builtin_cpu_supports("avx2")) {
        return table256;
    }
#else
    (void)widest;
#endif
    return table128;
}

struct gb_batch_kernel gb_batch_pick(const struct gb_model *model, int widest)
{
    const int terms = model->terms.bridges ? 2 : model->terms.friction ? 1 : 0;
    const int viscous = model->kind == GB_KIND_DYNAMIC;
    const int planar = model->dimension == 2;
    return table_for(widest)[6 * planar + 3 * viscous + terms];
}

/* First moment of the contact pressure, M(a) of (9), for the pivoting cap of contacts without a
 * bridge.  Few contacts need it in scenes with bridges. */
static void fill_moments(const struct gb_model *model, struct gb_batch *batch,
                         const double *deepest)
{
    for (int k = 0; k < batch->n; k++) {
        batch->moment[k] = deepest[k] == 0.0 && model->slip.mu_pivot > 0.0
                               ? gb_law_rod_moment(&model->rod, batch->overlap[k])
                               : 0.0;
    }
}

/* A bridge whose shear or pivoting cap is reached shrinks to the present overlap, or is gone;
 * P1 below (5) and (11). */
static void fail_bridges(const struct gb_model *model, struct gb_batch *batch,
                         double *deepest)
{
    for (int k = 0; k < batch->n; k++) {
        if (batch->fails[k] != 0.0) {
            deepest[k] = batch->overlap[k] > model->bridge.length ? batch->overlap[k] : 0.0;
        }
    }
}

void gb_batch_advance(const struct gb_batch_kernel *kernel, const struct gb_model *model,
                      struct gb_batch *batch, struct gb_contacts *contacts, int64_t slot)
{
    kernel->stretch(model, batch, contacts, slot);
    if (model->terms.bridges) {
        fail_bridges(model, batch, contacts->deepest + slot);
    }
    if (model->terms.friction && model->dimension == 3) {
        fill_moments(model, batch, contacts->deepest + slot);
    }
    kernel->load(model, batch, contacts, slot);
}
