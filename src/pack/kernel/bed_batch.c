#include "pack/kernel/bed_batch.h"

#include <math.h>

#include "pack/kernel/bed_laws.h"
#include "pack/kernel/simd.h"

/* Pairs: normal, overlap and, with friction, lever from the branch vector.  The contact point
 * divides it as the radii do, so that the torques conserve angular momentum up to rounding. */
INLINE void pair_geometry(struct bed_terms t, struct gb_bed_batch *restrict b)
{
#pragma omp simd
    for (int k = 0; k < b->n; k++) {
        const double x = b->branch[0][k], y = b->branch[1][k], z = b->branch[2][k];
        const double r = sqrt(x * x + y * y + z * z), inverse = 1.0 / r;
        b->unit[0][k] = x * inverse;
        b->unit[1][k] = y * inverse;
        b->unit[2][k] = z * inverse;
        b->overlap[k] = b->reach[k] - r;
        if (t.friction) {
            b->lever[k] = r / b->reach[k];
        }
    }
}

INLINE void contact_forces(const struct gb_bed_law *law, struct bed_terms t,
                           struct gb_bed_batch *restrict b,
                           struct gb_bed_contacts *restrict c, int64_t slot)
{
    const double *restrict hertz = c->hertz + slot, *restrict damping = c->damping + slot;
    const double *restrict inverse_mass = c->inverse_mass + slot, *restrict transition =
                                                                      c->transition +
                                                                      slot;
    double *restrict deepest = c->deepest + slot, *restrict permanent =
                                                      c->permanent + slot;
    double *restrict sx = c->shear[0] + slot, *restrict sy = c->shear[1] + slot;
    double *restrict sz = c->shear[2] + slot, *restrict normal = c->normal + slot;
    const double power = (2.0 + law->normal.exponent) / 3.0;
    const double slope = 1.0 + 0.5 * law->normal.exponent;
    const double stick = law->shear * b->step, mu = b->mu;
    double stiffest = b->stiffest;
#pragma omp simd reduction(max : stiffest)
    for (int k = 0; k < b->n; k++) {
        const double nx = b->unit[0][k], ny = b->unit[1][k], nz = b->unit[2][k];
        const double h = larger(b->overlap[k], 0.0);
        const double touching = mask(b->overlap[k] > 0.0);
        double ux = b->slip[0][k], uy = b->slip[1][k], uz = b->slip[2][k];
        const double normal_rate = ux * nx + uy * ny + uz * nz;
        double part = h;
        double yields = 0.0;
        if (t.storakers) {
            const double deepest_before = deepest[k], positive = larger(h, 1e-300);
            const double loaded = loaded_part(t, power, positive, transition[k]);
            const bool loads = h >= deepest_before;
            const double plastic = touching * (loads ? h - loaded : permanent[k]);
            part = larger(h - plastic, 0.0);
            yields = mask(loads & (plastic != 0.0));
            deepest[k] = larger(touching * deepest_before, h);
            permanent[k] = plastic;
        }
        const double root = sqrt(part);
        const double elastic = hertz[k] * part * root, unloading = 1.5 * hertz[k] * root;
        double stiffness = unloading;
        if (t.storakers) {
            const double loading = slope * elastic / larger(h, 1e-300);
            stiffness = yields * loading + (1.0 - yields) * unloading;
        }
        const double dashpot = damping[k] * sqrt(stiffness) * normal_rate;
        const double fn = larger(elastic - dashpot, 0.0);
        const double rate = unloading * inverse_mass[k];
        stiffest = rate > stiffest ? rate : stiffest;
        double fx = fn * nx, fy = fn * ny, fz = fn * nz;
        if (t.friction) {
            const double q = b->lever[k];
            const double wx = b->roll[0][k], wy = b->roll[1][k], wz = b->roll[2][k];
            ux -= normal_rate * nx + q * (wy * nz - wz * ny);
            uy -= normal_rate * ny + q * (wz * nx - wx * nz);
            uz -= normal_rate * nz + q * (wx * ny - wy * nx);
            double tx = sx[k], ty = sy[k], tz = sz[k];
            const double before = tx * tx + ty * ty + tz * tz;
            const double along = tx * nx + ty * ny + tz * nz;
            tx -= along * nx;
            ty -= along * ny;
            tz -= along * nz;
            const double keep = keep_length(before, tx * tx + ty * ty + tz * tz);
            const double drag = stick * stiffness;
            tx = keep * tx - drag * ux;
            ty = keep * ty - drag * uy;
            tz = keep * tz - drag * uz;
            const double cap = mu * fn, load2 = tx * tx + ty * ty + tz * tz;
            const double held =
                touching * ((load2 > cap * cap) ? cap / sqrt(load2) : 1.0);
            /* + 0: an open contact is as one that was never listed, which has no -0 */
            tx = held * tx + 0.0;
            ty = held * ty + 0.0;
            tz = held * tz + 0.0;
            sx[k] = tx;
            sy[k] = ty;
            sz[k] = tz;
            fx += tx;
            fy += ty;
            fz += tz;
            b->moment[0][k] = q * (nz * ty - ny * tz);
            b->moment[1][k] = q * (nx * tz - nz * tx);
            b->moment[2][k] = q * (ny * tx - nx * ty);
        }
        normal[k] = touching * fn - (1.0 - touching);
        b->force[0][k] = fx;
        b->force[1][k] = fy;
        b->force[2][k] = fz;
    }
    b->stiffest = stiffest;
}

/* One variant; the terms that it computes are the arguments behind the attribute. */
#define VARIANT(name, attribute, ...)                                                    \
    attribute static void name(const struct gb_bed_law *law, struct gb_bed_batch *batch, \
                               struct gb_bed_contacts *contacts, int64_t slot)           \
    {                                                                                    \
        const struct bed_terms t = {__VA_ARGS__};                                        \
        if (!t.walls) {                                                                  \
            pair_geometry(t, batch);                                                     \
        }                                                                                \
        contact_forces(law, t, batch, contacts, slot);                                   \
    }

/* Without and with friction. */
#define TWO(name, attribute, ...)                                                        \
    VARIANT(name, attribute, __VA_ARGS__)                                                \
    VARIANT(name##_friction, attribute, .friction = true, __VA_ARGS__)

#define VARIANTS(width, attribute)                                                       \
    TWO(width##_hertz, attribute, .walls = false)                                        \
    TWO(width##_storakers, attribute, .walls = false, .storakers = true)                 \
    TWO(width##_printed, attribute, .walls = false, .storakers = true, .printed = true)  \
    TWO(width##_wall_hertz, attribute, .walls = true)                                    \
    TWO(width##_wall_storakers, attribute, .walls = true, .storakers = true)             \
    TWO(width##_wall_printed, attribute, .walls = true, .storakers = true,               \
        .printed = true)

#define TABLE(width)                                                                     \
    {                                                                                    \
        width##_hertz, width##_hertz_friction, width##_storakers,                        \
            width##_storakers_friction, width##_printed, width##_printed_friction,       \
            width##_wall_hertz, width##_wall_hertz_friction, width##_wall_storakers,     \
            width##_wall_storakers_friction, width##_wall_printed,                       \
            width##_wall_printed_friction                                                \
    }

VARIANTS(w128, )
static gb_bed_kernel *const table128[] = TABLE(w128);
#if defined(__x86_64__)
VARIANTS(w256, GB_TARGET_256)
VARIANTS(w512, GB_TARGET_512)
static gb_bed_kernel *const table256[] = TABLE(w256);
static gb_bed_kernel *const table512[] = TABLE(w512);
#endif

gb_bed_kernel *gb_bed_batch_pick(const struct gb_bed_law *law,
                                 enum gb_bed_partner partner, int widest)
{
    const bool walls = partner == GB_BED_PARTNER_WALL;
    const double mu = walls ? law->mu_wall : law->mu;
    const int normal = !law->storakers ? 0 : law->normal.printed ? 2 : 1;
    const int row = 6 * walls + 2 * normal + (mu > 0.0);
#if defined(__x86_64__)
    const int width = gb_simd_width(widest);
    return (width == 512 ? table512 : width == 256 ? table256 : table128)[row];
#else
    (void)widest;
    return table128[row];
#endif
}
