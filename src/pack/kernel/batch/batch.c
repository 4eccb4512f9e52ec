/* Batches of contacts in double precision, for all combinations of terms, and the loops of discs.
 * What is defined here makes the loops of batch_*.h those of double precision. */
#include "law/real_f64.h"

#include "pack/kernel/batch/batch.h"

#define BATCH     struct gb_batch
#define BELOW_CAP (1.0 - 0x1p-40)
#define PLANE(p)  ((real *)c->plane[p] + slot)

/* M(a) of contacts without a bridge is computed by the scalar law, contact by contact. */
#define MOMENT_FITTED false

INLINE real moment_tail(real h)
{
    (void)h;
    return 0.0;
}

#include "pack/kernel/batch/batch_3d.h"
#include "pack/kernel/batch/batch_far.h"
#include "pack/kernel/batch/batch_laws.h"
#include "pack/kernel/batch/batch_tally.h"
#include "pack/kernel/simd.h"
#include "scene/loading_kind.h"

/* In the plane a spring is one number: the shear spring along (n_z, -n_x), which rotates
 * with the contact, and the rolling spring about y; there is no pivoting.  So no root is
 * needed to cut a spring, and a failing bridge is a selection between two numbers. */

INLINE double clamp_2d(double value, double most)
{
    return smaller(larger(value, -most), most);
}

/* Radius of the springs of a contact, 0 where there is none: then root is 0. */
INLINE double radius_2d(struct terms t, double length, double deepest, double h,
                        double root)
{
    const double square = larger(radius_square(t, length, deepest, h, 1), 0.0);
    return t.printed ? 0.5 * sqrt(where(deepest >= 0.0, square)) : 0.5 * root;
}

/* All laws in one pass over a batch: geometry, state of the bridge, springs, normal
 * force, caps, viscous parts. */
INLINE void advance_2d(const struct gb_model *model, struct terms t,
                       struct gb_batch *restrict b, struct gb_contacts *restrict c,
                       int64_t slot)
{
    double *restrict deepest = PLANE(c->deepest);
    double *restrict ax = PLANE(c->branch[0]), *restrict az = PLANE(c->branch[1]);
    double *restrict shear = PLANE(c->shear[0]), *restrict roll = PLANE(c->roll[0]);
    double *restrict last_normal = t.viscous ? PLANE(c->last_normal) : NULL;
    double *restrict last_shear = t.viscous ? PLANE(c->last_shear) : NULL;
    double *restrict last_roll = t.viscous ? PLANE(c->last_roll) : NULL;
    const struct gb_law_slip slip = model->slip;
    /* without viscous forces slightly below the cap, so that no rounding error makes a
     * spring at rest slide */
    const struct plane_caps caps = plane_caps(&slip, t, t.viscous ? 1 : BELOW_CAP);
    const double m = slip.motion, inverse_motion = 1.0 / m, length = model->bridge.length;
    const struct normal_law law = normal_law(model, b->cutoff2);
    const double damp = b->damp, adhesion = model->adhesion;
    const double shear_damp = damp * model->dynamics.viscous_shear;
    const double roll_damp = damp * model->dynamics.viscous_rolling;
#pragma omp simd
    for (int k = 0; k < b->n; k++) {
        const double rx = b->r[0][k], rz = b->r[1][k], before = deepest[k];
        const double bx = ax[k], bz = az[k];
        const double squared = rx * rx + rz * rz;
        const double r = sqrt(squared), inverse = 1.0 / r;
        const double nx = rx * inverse, nz = rz * inverse, h = 1.0 - r, half = 0.5 * r;
        const bool touches = squared < 1.0;
        const bool lasts = touches & (before >= 0.0);
        const double bridge =
            t.bridges ? deepest_after(length, larger(before, 0.0), h) : 0.0;
        double state = touches ? bridge : -1.0;
        ax[k] = rx;
        az[k] = rz;
        double u = 0.0, v = 0.0;
        if (t.friction) {
            const double across = m * ((rx - bx) * rz - (rz - bz) * rx);
            const double rolled = 0.5 * m * b->rotation_sum[0][k];
            const double spring = shear[k];
            u = where(lasts, across * inverse - rolled * r);
            v = where(lasts, spring) + u;
            if (t.bridges) {
                /* a bridge at its shear cap shrinks to the present overlap, or is gone;
                 * P1 below (5).  All times r: it saves a division. */
                const double pulled = spring * r + (across - rolled * squared);
                const double tear = caps.tear * squared;
                const bool fails =
                    lasts & (state > 0.0) &
                    (pulled * pulled > tear * radius_square(t, length, state, h, 1));
                const double left = deepest_left(length, h);
                state = fails ? left : state;
            }
        }
        deepest[k] = state;
        const bool held = t.bridges & (state > 0.0);
        const struct normal f = normal_force(t, &law, equal_size(), state, h, r);
        double fn = f.total, tangent = 0.0, opposed = 0.0, slides = 0.0, twice = 0.0;
        if (t.viscous) {
            const double before2 = bx * bx + bz * bz;
            const double dh = where(before2 > 0.0, sqrt(before2) - r);
            const double lag = damp * f.slope * dh;
            const double was = last_normal[k] + fn;
            last_normal[k] = fn;
            fn += lag;
            twice = (was + (lag + lag)) * dh;
        }
        double work = 0.0; /* of shear and roll, twice, without the factor of motion */
        if (t.friction) {
            const double a = radius_2d(t, length, state, h, f.root);
            const double ks = shear_stiffness(slip.shear, a);
            const double inverse_a = 1.0 / larger(a, 1e-150);
            const double rub = held ? 1e300 : caps.rub * inverse_a * f.elastic;
            const double most = smaller(rub, caps.bond * a), cut = clamp_2d(v, most);
            const bool sticks = fabs(v) <= most;
            shear[k] = cut;
            slides = mask(!sticks);
            tangent = ks * cut;
            if (t.viscous) {
                const double lag = where(sticks, shear_damp * (ks * u));
                work = u * (last_shear[k] * (v - u) + tangent + (lag + lag));
                last_shear[k] = ks;
                tangent += lag;
            }
            if (t.bridges) {
                const bool holds = lasts & held;
                const double g = where(holds, m * b->rotation_difference[0][k]);
                const double p = where(holds, roll[k]) + g,
                             kr = roll_stiffness(slip.roll, a * a, a);
                const double limit =
                    caps.roll * inverse_a * inverse_a * larger(f.elastic, 0.0);
                const double rolled_to = clamp_2d(p, limit);
                roll[k] = rolled_to;
                opposed = kr * rolled_to;
                if (t.viscous) {
                    const double lag = where(fabs(p) <= limit, roll_damp * (kr * g));
                    work += g * (last_roll[k] * (p - g) + opposed + (lag + lag));
                    last_roll[k] = where(held, kr);
                    opposed += lag;
                }
            }
        }
        const double both = half * tangent;
        b->overlap[k] = h;
        b->force[0][k] = fn * nx - tangent * nz;
        b->force[1][k] = fn * nz + tangent * nx;
        b->torque_i[0][k] = both - opposed;
        b->torque_j[0][k] = both + opposed;
        if (t.viscous) {
            b->absorbed[k] = 0.5 * (twice + inverse_motion * work);
        }
        b->normal[k] = where(touches, fabs(f.elastic - adhesion));
        b->sliding[k] = slides;
    }
}

INLINE void advance(const struct gb_model *model, struct terms t, struct gb_batch *batch,
                    struct gb_contacts *contacts, int64_t slot)
{
    if (t.planar) {
        advance_2d(model, t, batch, contacts, slot);
    } else {
        advance_3d(model, t, batch, contacts, slot);
    }
}

/* One variant; the terms that it computes are the arguments behind the attribute. */
#define VARIANT(name, attribute, ...)                                                    \
    attribute static void name##_advance(const struct gb_model *model,                   \
                                         struct gb_batch *batch,                         \
                                         struct gb_contacts *contacts, int64_t slot)     \
    {                                                                                    \
        const struct terms t = {__VA_ARGS__};                                            \
        const struct terms printed = {.printed = true, __VA_ARGS__};                     \
        if (t.bridges && model->bridge.radius_current) {                                 \
            advance(model, printed, batch, contacts, slot);                              \
        } else {                                                                         \
            advance(model, t, batch, contacts, slot);                                    \
        }                                                                                \
    }                                                                                    \
    attribute static void name##_tally(struct gb_batch *batch,                           \
                                       const struct gb_contacts *contacts, int64_t slot, \
                                       struct gb_tally *tally)                           \
    {                                                                                    \
        const struct terms t = {__VA_ARGS__};                                            \
        const double *deepest = (const double *)contacts->plane[contacts->deepest];      \
        tally_batch(t, batch, deepest + slot, tally);                                    \
    }                                                                                    \
    attribute static void name##_attract(const struct gb_model *model,                   \
                                         struct gb_batch *batch, double *last_distance,  \
                                         double *last_pull, struct gb_tally *tally)      \
    {                                                                                    \
        const struct terms t = {__VA_ARGS__};                                            \
        attract(model, t, batch, last_distance, last_pull);                              \
        if (t.viscous) {                                                                 \
            tally_work(t, batch, tally);                                                 \
        }                                                                                \
    }

/* The combinations of terms that scenes have. */
#define THREE(X, name, attribute, ...)                                                   \
    X(name##_normal, attribute, __VA_ARGS__)                                             \
    X(name##_friction, attribute, .friction = true, __VA_ARGS__)                         \
    X(name##_bridges, attribute, .friction = true, .bridges = true, __VA_ARGS__)
#define TWO(X, name, attribute, ...)                                                     \
    X(name##_plain, attribute, .plain = true, __VA_ARGS__)                               \
    X(name##_plain_friction, attribute, .plain = true, .friction = true, __VA_ARGS__)
#define COMBINATIONS(X, width, attribute)                                                \
    THREE(X, width##_3d, attribute, .planar = false)                                     \
    THREE(X, width##_3d_viscous, attribute, .viscous = true)                             \
    TWO(X, width##_3d, attribute, .planar = false)                                       \
    THREE(X, width##_2d, attribute, .planar = true)                                      \
    THREE(X, width##_2d_viscous, attribute, .planar = true, .viscous = true)             \
    TWO(X, width##_2d, attribute, .planar = true)                                        \
    THREE(X, width##_sized, attribute, .sized = true)                                    \
    THREE(X, width##_sized_viscous, attribute, .sized = true, .viscous = true)           \
    TWO(X, width##_sized, attribute, .sized = true)

struct variant {
    struct terms terms;
    struct gb_batch_kernel kernel;
};

#define ROW(name, attribute, ...)                                                        \
    {{__VA_ARGS__}, {name##_advance, name##_tally, name##_attract}},

GB_SIMD_TABLES

/* Discs of several sizes pass through the laws of spheres; cohesionless laws have no viscous
 * partner. */
static struct terms terms_of(const struct gb_model *model)
{
    const bool plain = model->terms.plain;
    return (struct terms){
        .planar = model->dimension == 2 && !model->polydisperse,
        .friction = model->terms.friction || (model->terms.bridges && !plain),
        .bridges = model->terms.bridges && !plain,
        .viscous = gb_loading_kind_at(model->kind)->viscous_contacts && !plain,
        .plain = plain,
        .sized = model->polydisperse,
    };
}

struct gb_batch_kernel gb_batch_pick(const struct gb_model *model, int widest)
{
    const struct variant *table = table_for(widest);
    const struct terms wanted = terms_of(model);
    int row = 0;
    while (row < VARIANTS - 1 && !same_terms(table[row].terms, wanted)) {
        row++;
    }
    return table[row].kernel;
}
