#include "pack/kernel/bed_batch.h"

#include <math.h>

#include "pack/kernel/bed_laws.h"
#include "pack/kernel/simd.h"

/* Pairs: normal, overlap and lever from the arm.  The contact point divides the arm as
 * the radii do, so that the torques conserve angular momentum to the bit of rounding. */
INLINE void shape(struct gb_bed_batch *restrict b)
{
#pragma omp simd
    for (int k = 0; k < b->n; k++) {
        const double x = b->arm[0][k], y = b->arm[1][k], z = b->arm[2][k];
        const double r = sqrt(x * x + y * y + z * z), inverse = 1.0 / r;
        b->unit[0][k] = x * inverse;
        b->unit[1][k] = y * inverse;
        b->unit[2][k] = z * inverse;
        b->overlap[k] = b->reach[k] - r;
        b->lever[k] = r / b->reach[k];
    }
}

INLINE void respond(const struct gb_bed_law *law, struct bed_terms t,
                    struct gb_bed_batch *restrict b, struct gb_bed_contacts *restrict c,
                    int64_t slot)
{
    const double *restrict hertz = c->hertz + slot, *restrict damping = c->damping + slot;
    const double *restrict inverse_mass = c->inverse_mass + slot, *restrict transition = c->transition + slot;
    double *restrict deepest = c->deepest + slot, *restrict permanent = c->permanent + slot;
    double *restrict sx = c->shear[0] + slot, *restrict sy = c->shear[1] + slot;
    double *restrict sz = c->shear[2] + slot, *restrict normal = c->normal + slot;
    const double share = (2.0 + law->normal.exponent) / 3.0;
    const double slope = 1.0 + 0.5 * law->normal.exponent;
    const double stick = law->shear * b->step, mu = b->mu;
    double stiffest = b->stiffest;
#pragma omp simd reduction(max : stiffest)
    for (int k = 0; k < b->n; k++) {
        const double nx = b->unit[0][k], ny = b->unit[1][k], nz = b->unit[2][k];
        const double h = larger(b->overlap[k], 0.0);
        const double touching = mask(b->overlap[k] > 0.0);
        double ux = b->slip[0][k], uy = b->slip[1][k], uz = b->slip[2][k];
        const double parting = ux * nx + uy * ny + uz * nz;
        double part = h;
        double yields = 0.0;
        if (t.storakers) {
            const double reached = deepest[k], live = larger(h, 1e-300);
            const double fresh = loaded_part(t, share, live, transition[k]);
            const bool loads = h >= reached;
            const double flat = touching * (loads ? h - fresh : permanent[k]);
            part = larger(h - flat, 0.0);
            yields = mask(loads & (flat != 0.0));
            deepest[k] = larger(touching * reached, h);
            permanent[k] = flat;
        }
        const double root = sqrt(part);
        const double elastic = hertz[k] * part * root, steep = 1.5 * hertz[k] * root;
        double stiffness = steep;
        if (t.storakers) {
            const double soft = slope * elastic / larger(h, 1e-300);
            stiffness = yields * soft + (1.0 - yields) * steep;
        }
        const double dashpot = damping[k] * sqrt(stiffness) * parting;
        const double fn = larger(elastic - dashpot, 0.0);
        const double rate = steep * inverse_mass[k];
        stiffest = rate > stiffest ? rate : stiffest;
        double fx = fn * nx, fy = fn * ny, fz = fn * nz;
        if (t.friction) {
            const double q = b->lever[k];
            const double wx = b->roll[0][k], wy = b->roll[1][k], wz = b->roll[2][k];
            ux -= parting * nx + q * (wy * nz - wz * ny);
            uy -= parting * ny + q * (wz * nx - wx * nz);
            uz -= parting * nz + q * (wx * ny - wy * nx);
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
            tx *= held;
            ty *= held;
            tz *= held;
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

#define VARIANT(name, attribute, storakers_, printed_, friction_, walls_)                \
    attribute static void name(const struct gb_bed_law *law, struct gb_bed_batch *batch, \
                               struct gb_bed_contacts *contacts, int64_t slot)           \
    {                                                                                    \
        const struct bed_terms t = {storakers_, printed_, friction_, walls_};            \
        if (!(walls_)) {                                                                 \
            shape(batch);                                                                \
        }                                                                                \
        respond(law, t, batch, contacts, slot);                                          \
    }

/* Walls or not, {Hertz, Storakers, as printed}, friction or not. */
#define VARIANTS(width, attribute)                                                       \
    VARIANT(width##_hertz, attribute, false, false, false, false)                        \
    VARIANT(width##_hertz_friction, attribute, false, false, true, false)                \
    VARIANT(width##_storakers, attribute, true, false, false, false)                     \
    VARIANT(width##_storakers_friction, attribute, true, false, true, false)             \
    VARIANT(width##_printed, attribute, true, true, false, false)                        \
    VARIANT(width##_printed_friction, attribute, true, true, true, false)                \
    VARIANT(width##_wall_hertz, attribute, false, false, false, true)                    \
    VARIANT(width##_wall_hertz_friction, attribute, false, false, true, true)            \
    VARIANT(width##_wall_storakers, attribute, true, false, false, true)                 \
    VARIANT(width##_wall_storakers_friction, attribute, true, false, true, true)         \
    VARIANT(width##_wall_printed, attribute, true, true, false, true)                    \
    VARIANT(width##_wall_printed_friction, attribute, true, true, true, true)

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

gb_bed_kernel *gb_bed_batch_pick(const struct gb_bed_law *law, bool walls, int widest)
{
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
