#include "pack/kernel/bed_batch.h"

#include <math.h>

#include "pack/kernel/bed_laws.h"
#include "pack/kernel/simd.h"

/* Storakers: the elastic part y of overlap h on the loading curve, so that the force is
 * Hertz' at y.  With h_x the overlap where (2) and (16) meet, F = (16) means
 * y = h_x (h/h_x)^((2+m)/3): one power of a ratio near 1 instead of two of h.  Below h_x
 * the lesser force is that of Hertz and y = h; the printed law uses (16) there too. */
INLINE void loaded_parts(const struct gb_bed_law *law, struct bed_terms t,
                         struct gb_bed_batch *restrict b,
                         const double *restrict transition)
{
    const double power = (2.0 + law->normal.exponent) / 3.0;
#pragma omp simd
    for (int k = 0; k < b->n; k++) {
        const double positive = larger(larger(b->overlap[k], 0.0), 1e-300);
        b->ratio[k] = positive / transition[k];
    }
#pragma omp simd
    for (int k = 0; k < b->n; k++) {
        b->logarithm[k] = power * log2_of(b->ratio[k]);
    }
#pragma omp simd
    for (int k = 0; k < b->n; k++) {
        const double plastic = transition[k] * exp2_of(b->logarithm[k]);
        const double h = larger(larger(b->overlap[k], 0.0), 1e-300);
        b->loaded[k] = selected(bit_mask(t.printed | (b->ratio[k] > 1.0)), plastic, h);
    }
}

/* Storakers: the plastic part of the overlap; stiffness 1 where it grows, else 0. */
INLINE void plastic_parts(const struct gb_bed_law *law, struct bed_terms t,
                          struct gb_bed_batch *restrict b,
                          struct gb_bed_contacts *restrict c, int64_t slot)
{
    double *restrict deepest = c->deepest + slot, *restrict permanent =
                                                      c->permanent + slot;
    loaded_parts(law, t, b, c->transition + slot);
#pragma omp simd
    for (int k = 0; k < b->n; k++) {
        const double h = larger(b->overlap[k], 0.0), before = deepest[k];
        const double touching = mask(b->overlap[k] > 0.0);
        const bool loads = h >= before;
        const double plastic =
            touching * selected(bit_mask(loads), h - b->loaded[k], permanent[k]);
        b->stiffness[k] = mask(loads & (plastic != 0.0));
        deepest[k] = larger(touching * before, h);
        permanent[k] = plastic;
    }
}

/* Normal forces with their dashpots. */
INLINE void normal_forces(const struct gb_bed_law *law, struct bed_terms t,
                          struct gb_bed_batch *restrict b,
                          struct gb_bed_contacts *restrict c, int64_t slot)
{
    const double *restrict hertz = c->hertz + slot, *restrict damping = c->damping + slot;
    const double *restrict inverse_mass = c->inverse_mass + slot;
    const double *restrict permanent = c->permanent + slot;
    double *restrict normal = c->normal + slot;
    const double slope = 1.0 + 0.5 * law->normal.exponent;
    const double late = b->step / GB_LAW_HERTZ_BORNE; /* gb_law_hertz_damping_borne */
    double stiffest = b->stiffest, impact = b->impact;
#pragma omp simd reduction(max : stiffest, impact)
    for (int k = 0; k < b->n; k++) {
        const double nx = b->unit[0][k], ny = b->unit[1][k], nz = b->unit[2][k];
        const double h = larger(b->overlap[k], 0.0);
        const double touching = mask(b->overlap[k] > 0.0);
        const double part = t.storakers ? larger(h - permanent[k], 0.0) : h;
        const double root = sqrt(part);
        const double elastic = hertz[k] * part * root, unloading = 1.5 * hertz[k] * root;
        const double approach =
            b->slip[0][k] * nx + b->slip[1][k] * ny + b->slip[2][k] * nz;
        double stiffness = unloading;
        if (t.storakers) {
            const double yields = b->stiffness[k];
            const double loading = slope * elastic / larger(h, 1e-300);
            stiffness = yields * loading + (1.0 - yields) * unloading;
        }
        const double square =
            (2.0 * (unloading * inverse_mass[k]) + b->held[k]) * (1.0 / 3.0);
        const double borne = unloading / larger(late * square, 1e-300);
        const double dashpot = smaller(damping[k] * sqrt(stiffness), borne) * approach;
        const double fn = larger(elastic - dashpot, 0.0);
        const double rigid = hertz[k] * inverse_mass[k];
        const double hits = -approach * (rigid * rigid);
        stiffest = square > stiffest ? square : stiffest;
        impact = hits > impact ? hits : impact;
        b->holds[k] = unloading;
        normal[k] = touching * fn - (1.0 - touching);
        b->along[k] = fn;
        if (t.friction) {
            b->stiffness[k] = stiffness;
            b->approach[k] = approach;
        }
        b->force[0][k] = fn * nx;
        b->force[1][k] = fn * ny;
        b->force[2][k] = fn * nz;
    }
    b->stiffest = stiffest;
    b->impact = impact;
}

/* Shear springs rotated into the tangent plane, but shorter by what was normal to it; the
 * shear that follows. */
INLINE void rotate_shear(const struct gb_bed_law *law, struct gb_bed_batch *restrict b,
                         struct gb_bed_contacts *restrict c, int64_t slot)
{
    double *restrict sx = c->shear[0] + slot, *restrict sy = c->shear[1] + slot;
    double *restrict sz = c->shear[2] + slot;
    const double stick = law->shear * b->step;
#pragma omp simd
    for (int k = 0; k < b->n; k++) {
        const double nx = b->unit[0][k], ny = b->unit[1][k], nz = b->unit[2][k];
        const double q = b->lever[k], approach = b->approach[k];
        const double wx = b->roll[0][k], wy = b->roll[1][k], wz = b->roll[2][k];
        const double drag = stick * b->stiffness[k];
        const struct rotated t = rotate_spring(nx, ny, nz, sx[k], sy[k], sz[k]);
        b->square[0][k] = t.before;
        b->square[1][k] = t.after;
        sx[k] = t.x;
        sy[k] = t.y;
        sz[k] = t.z;
        b->rate[0][k] =
            drag * (b->slip[0][k] - (approach * nx + q * (wy * nz - wz * ny)));
        b->rate[1][k] =
            drag * (b->slip[1][k] - (approach * ny + q * (wz * nx - wx * nz)));
        b->rate[2][k] =
            drag * (b->slip[2][k] - (approach * nz + q * (wx * ny - wy * nx)));
    }
}

/* Shear springs of their former lengths, advanced, and the share that their caps leave. */
INLINE void advance_shear(struct gb_bed_batch *restrict b,
                          struct gb_bed_contacts *restrict c, int64_t slot)
{
    double *restrict sx = c->shear[0] + slot, *restrict sy = c->shear[1] + slot;
    double *restrict sz = c->shear[2] + slot;
    const double mu = b->mu;
#pragma omp simd
    for (int k = 0; k < b->n; k++) {
        b->kept[k] = keep_length(b->square[0][k], b->square[1][k]);
    }
#pragma omp simd
    for (int k = 0; k < b->n; k++) {
        const double keep = b->kept[k];
        const double tx = keep * sx[k] - b->rate[0][k];
        const double ty = keep * sy[k] - b->rate[1][k];
        const double tz = keep * sz[k] - b->rate[2][k];
        const double cap = mu * b->along[k], load2 = tx * tx + ty * ty + tz * tz;
        const double touching = mask(b->overlap[k] > 0.0);
        b->kept[k] = touching * ((load2 > cap * cap) ? cap / sqrt(load2) : 1.0);
        sx[k] = tx;
        sy[k] = ty;
        sz[k] = tz;
    }
}

/* Shear springs cut at their caps; their forces and moments. */
INLINE void shear_forces(struct gb_bed_batch *restrict b,
                         struct gb_bed_contacts *restrict c, int64_t slot)
{
    double *restrict sx = c->shear[0] + slot, *restrict sy = c->shear[1] + slot;
    double *restrict sz = c->shear[2] + slot;
#pragma omp simd
    for (int k = 0; k < b->n; k++) {
        const double nx = b->unit[0][k], ny = b->unit[1][k], nz = b->unit[2][k];
        const double q = b->lever[k], held = b->kept[k];
        /* + 0: an open contact is as one that was never listed, which has no -0 */
        const double tx = held * sx[k] + 0.0, ty = held * sy[k] + 0.0;
        const double tz = held * sz[k] + 0.0;
        sx[k] = tx;
        sy[k] = ty;
        sz[k] = tz;
        b->force[0][k] += tx;
        b->force[1][k] += ty;
        b->force[2][k] += tz;
        b->moment[0][k] = q * (nz * ty - ny * tz);
        b->moment[1][k] = q * (nx * tz - nz * tx);
        b->moment[2][k] = q * (ny * tx - nx * ty);
    }
}

/* Short loops, as in batch_3d.h. */
INLINE void contact_forces(const struct gb_bed_law *law, struct bed_terms t,
                           struct gb_bed_batch *restrict b,
                           struct gb_bed_contacts *restrict c, int64_t slot)
{
    if (t.storakers) {
        plastic_parts(law, t, b, c, slot);
    }
    normal_forces(law, t, b, c, slot);
    if (t.friction) {
        rotate_shear(law, b, c, slot);
        advance_shear(b, c, slot);
        shear_forces(b, c, slot);
    }
}

/* One variant; the terms that it computes are the arguments behind the attribute. */
#define VARIANT(name, attribute, ...)                                                    \
    attribute static void name(const struct gb_bed_law *law, struct gb_bed_batch *batch, \
                               struct gb_bed_contacts *contacts, int64_t slot)           \
    {                                                                                    \
        const struct bed_terms t = {__VA_ARGS__};                                        \
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
#if GB_SIMD_LEVELS
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
#if GB_SIMD_LEVELS
    const int width = gb_simd_width(widest);
    return (width == 512 ? table512 : width == 256 ? table256 : table128)[row];
#else
    (void)widest;
    return table128[row];
#endif
}
