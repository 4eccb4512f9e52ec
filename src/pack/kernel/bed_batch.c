/* The contacts of a bed: storage, the laws over batches of them, and the motion of the particles
 * in rows.  The terms that a scene does not have are constants, so that a loop skips them. */
#include "pack/kernel/bed_batch.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#include "base/alloc.h"
#include "greenbody/status.h"
#include "law/law_storakers.h"
#include "law/real_f64.h"
#include "law/springs.h"
#include "law/storakers.h"
#include "pack/kernel/simd.h"

enum { PLANES = 10 };

bool gb_bed_batch_init(struct gb_bed_contacts *contacts, int64_t room,
                       struct gb_error *err)
{
    const int64_t stride = (room + 7) / 8 * 8 + 8;
    double *slab = gb_alloc_array((size_t)(PLANES * stride), sizeof *slab, err);
    *contacts = (struct gb_bed_contacts){.slab = slab, .room = room};
    if (!slab) {
        return false;
    }
    double **const plane[PLANES] = {
        &contacts->hertz,      &contacts->damping,  &contacts->inverse_mass,
        &contacts->transition, &contacts->deepest,  &contacts->permanent,
        &contacts->shear[0],   &contacts->shear[1], &contacts->shear[2],
        &contacts->normal,
    };
    for (int p = 0; p < PLANES; p++) {
        *plane[p] = slab + p * stride;
    }
    return true;
}

void gb_bed_batch_finish(struct gb_bed_contacts *contacts)
{
    gb_alloc_free(contacts->slab);
    *contacts = (struct gb_bed_contacts){0};
}

double gb_bed_batch_radius(const struct gb_bed_law *law, double star, double overlap)
{
    return law->storakers ? gb_law_storakers_contact(&law->normal, star, overlap)
                          : sqrt(star * overlap);
}

void gb_bed_batch_set(struct gb_bed_contacts *c, int64_t slot,
                      const struct gb_bed_law *law, const double radius[2],
                      const double mass[2])
{
    const double r = gb_law_hertz_radius(radius[0], radius[1]);
    const double reduced = gb_law_hertz_radius(mass[0], mass[1]); /* the same formula */
    c->hertz[slot] = 4.0 / 3.0 * law->normal.hertz.modulus * sqrt(r);
    c->damping[slot] = gb_law_hertz_damping(1.0, reduced, law->damping);
    c->inverse_mass[slot] = 1.0 / reduced;
    c->transition[slot] =
        law->storakers ? gb_law_storakers_transition(&law->normal, r) : HUGE_VAL;
    c->deepest[slot] = c->permanent[slot] = 0.0;
    c->shear[0][slot] = c->shear[1][slot] = c->shear[2][slot] = 0.0;
    c->normal[slot] = -1.0;
}

/* What a bed needs; constants where a loop is inlined, so that it computes no more. */
struct bed_terms {
    bool storakers, printed, friction;
};

/* Storakers: the elastic part of the overlap on the loading curve (law/storakers.h). */
INLINE void loaded_parts(const struct gb_bed_law *law, struct bed_terms t,
                         struct gb_bed_batch *restrict b,
                         const double *restrict transition)
{
    const double power = elastic_power(law->normal.exponent);
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
        const double on_16 = transition[k] * exp2_of(b->logarithm[k]);
        const double h = larger(larger(b->overlap[k], 0.0), 1e-300);
        b->loaded[k] = loaded_part(t.printed, b->ratio[k], on_16, h);
    }
}

/* Storakers: the permanent part h - y of the overlap; stiffness 1 where it grows, else 0. */
INLINE void permanent_parts(const struct gb_bed_law *law, struct bed_terms t,
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
        const double lasting =
            touching * selected(bit_mask(loads), h - b->loaded[k], permanent[k]);
        b->stiffness[k] = mask(loads & (lasting != 0.0));
        deepest[k] = larger(touching * before, h);
        permanent[k] = lasting;
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
    const double exponent = law->normal.exponent;
    const double late = b->step / GB_LAW_HERTZ_BORNE; /* gb_law_hertz_damping_borne */
    double stiffest = b->stiffest, impact = b->impact;
#pragma omp simd reduction(max : stiffest, impact)
    for (int k = 0; k < b->n; k++) {
        const double nx = b->unit[0][k], ny = b->unit[1][k], nz = b->unit[2][k];
        const double h = larger(b->overlap[k], 0.0);
        const double touching = mask(b->overlap[k] > 0.0);
        const double part = t.storakers ? larger(h - permanent[k], 0.0) : h;
        const double root = sqrt(part);
        const double elastic = hertz_force(hertz[k], part, root);
        const double unloading = hertz_slope(hertz[k], root);
        const double approach =
            b->slip[0][k] * nx + b->slip[1][k] * ny + b->slip[2][k] * nz;
        double stiffness = unloading;
        if (t.storakers) {
            const double yields = b->stiffness[k];
            const double loading = plastic_slope(exponent, elastic, h);
            stiffness = yields * loading + (1.0 - yields) * unloading;
        }
        /* (2 k/m* + L)/3: see gb_bed_tally.stiffest (pack/die/bed.h) */
        const double square =
            (2.0 * (unloading * inverse_mass[k]) + b->held[k]) * (1.0 / 3.0);
        const double borne = borne_damping(unloading, late, square);
        const double dashpot = smaller(damping[k] * sqrt(stiffness), borne) * approach;
        const double fn = damped_force(elastic, dashpot);
        const double rigid = hertz[k] * inverse_mass[k];
        const double hits = -approach * (rigid * rigid);
        stiffest = square > stiffest ? square : stiffest;
        impact = hits > impact ? hits : impact;
        b->holds[k] = unloading;
        normal[k] = touching * fn - (1.0 - touching); /* fn where they touch, else -1 */
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

/* Projects the shear springs on the tangent plane, which shortens them (advance_shear
 * restores the length), and computes the shear motion of this step. */
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

/* Restores the lengths, adds the motion, and finds the share of each spring that its cap
 * leaves. */
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
        /* + 0.0 turns -0 into 0, as in a contact that was never listed */
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

/* Short loops: see pack/kernel/batch/batch_3d.h. */
INLINE void contact_forces(const struct gb_bed_law *law, struct bed_terms t,
                           struct gb_bed_batch *restrict b,
                           struct gb_bed_contacts *restrict c, int64_t slot)
{
    if (t.storakers) {
        permanent_parts(law, t, b, c, slot);
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

/* The combinations of terms that beds have. */
#define TWO(X, name, attribute, ...)                                                     \
    X(name, attribute, __VA_ARGS__)                                                      \
    X(name##_friction, attribute, .friction = true, __VA_ARGS__)
#define COMBINATIONS(X, width, attribute)                                                \
    TWO(X, width##_hertz, attribute, .storakers = false)                                 \
    TWO(X, width##_storakers, attribute, .storakers = true)                              \
    TWO(X, width##_printed, attribute, .storakers = true, .printed = true)

struct variant {
    struct bed_terms terms;
    gb_bed_kernel *kernel;
};

#define ROW(name, attribute, ...) {{__VA_ARGS__}, name},

GB_SIMD_TABLES

gb_bed_kernel *gb_bed_batch_pick(const struct gb_bed_law *law,
                                 enum gb_bed_partner partner, int widest)
{
    const double mu = partner == GB_BED_PARTNER_WALL ? law->mu_wall : law->mu;
    const struct bed_terms wanted = {.storakers = law->storakers,
                                     .printed = law->storakers && law->normal.printed,
                                     .friction = mu > 0.0};
    const struct variant *table = table_for(widest);
    int row = 0;
    while (row < VARIANTS - 1 && (table[row].terms.storakers != wanted.storakers ||
                                  table[row].terms.printed != wanted.printed ||
                                  table[row].terms.friction != wanted.friction)) {
        row++;
    }
    return table[row].kernel;
}

/* Velocities and positions of the particles of a bed, in rows (bed_batch.h). */

/* A row is one vector; the compiler divides it where the processor has shorter ones, with
 * the same bits.  Macros, for a function that returns such a vector has another calling
 * convention on every level. */
typedef double row __attribute__((vector_size(32), aligned(8), may_alias));
typedef int64_t bits __attribute__((vector_size(32), aligned(8), may_alias));

#define NUMBERS(rows, i) (*(row *)(rows)[i])
#define READ(rows, i)    (*(const row *)(rows)[i])

/* most = the larger of |x| and most; most where x is not a number. */
#define LARGER_MAGNITUDE(x, most)                                                        \
    do {                                                                                 \
        const row size_ = (row)((bits)(x) & ~(bits)(row){-0.0, -0.0, -0.0, -0.0});       \
        const bits larger_ = size_ > (most);                                             \
        (most) = (row)(((bits)size_ & larger_) | ((bits)(most) & ~larger_));             \
    } while (0)

GB_SIMD_LOOP double square(const double *x)
{
    return x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
}

GB_SIMD_LOOP void drift_loop(gb_bed_row *restrict x, const gb_bed_row *restrict v,
                             int64_t count, double step,
                             const struct gb_bed_motion_course *course,
                             double *deviation2)
{
    const gb_bed_row *restrict from = course->from, *restrict steady = course->velocity;
    const row by = {step, step, step, 0.0};
    const row time = {course->time, course->time, course->time, 0.0};
    row most = {0.0, 0.0, 0.0, 0.0};
    for (int64_t i = 0; i < count; i++) {
        const row now = READ(x, i) + by * READ(v, i);
        NUMBERS(x, i) = now;
        LARGER_MAGNITUDE((now - READ(from, i)) - time * READ(steady, i), most);
    }
    *deviation2 = square((const double *)&most);
}
GB_SIMD_WIDTHS(drift,
               (gb_bed_row * x, const gb_bed_row *v, int64_t count, double step,
                const struct gb_bed_motion_course *course, double *deviation2),
               (x, v, count, step, course, deviation2))

double gb_bed_batch_drift(gb_bed_row *x, const gb_bed_row *v, int64_t count, double step,
                          const struct gb_bed_motion_course *course)
{
    double deviation2;
    drift(x, v, count, step, course, &deviation2);
    return deviation2;
}

GB_SIMD_LOOP void kick_loop(gb_bed_row *restrict v, gb_bed_row *restrict roll,
                            int64_t count, const struct gb_bed_batch_kick *by,
                            double *fastest2)
{
    const double step = by->step, slow = fmax(1.0 - step * by->drag, 0.0);
    const row fall = {0.0, 0.0, -by->gravity * step, 0.0}, kept = {slow, slow, slow, 0.0};
    const row pushed = {step, step, step, 1.0};
    const gb_bed_row *restrict force = by->force, *restrict moment = by->moment;
    const double *restrict mass = by->inverse_mass;
    const double rolled = step / by->inertia;
    row most = {0.0, 0.0, 0.0, 0.0};
    for (int64_t i = 0; i < count; i++) {
        const row speed =
            kept * READ(v, i) + ((pushed * mass[i]) * READ(force, i) + fall);
        NUMBERS(v, i) = speed;
        NUMBERS(roll, i) = slow * READ(roll, i) + (rolled * mass[i]) * READ(moment, i);
        LARGER_MAGNITUDE(speed, most);
    }
    *fastest2 = square((const double *)&most);
}
GB_SIMD_WIDTHS(kick,
               (gb_bed_row * v, gb_bed_row *roll, int64_t count,
                const struct gb_bed_batch_kick *by, double *fastest2),
               (v, roll, count, by, fastest2))

double gb_bed_batch_kick(gb_bed_row *v, gb_bed_row *roll, int64_t count,
                         const struct gb_bed_batch_kick *by)
{
    double fastest2;
    kick(v, roll, count, by, &fastest2);
    return sqrt(fastest2);
}

GB_SIMD_LOOP void add_rows_loop(gb_bed_row *restrict to, const int32_t *restrict particle,
                                const gb_bed_row *restrict from,
                                const int32_t *restrict number, int64_t count)
{
    for (int64_t e = 0; e < count; e++) {
        NUMBERS(to, particle[e]) += READ(from, number[e]);
    }
}
GB_SIMD_WIDTHS(add_rows,
               (gb_bed_row * to, const int32_t *particle, const gb_bed_row *from,
                const int32_t *number, int64_t count),
               (to, particle, from, number, count))

void gb_bed_batch_add_rows(gb_bed_row *to, const int32_t *particle,
                           const gb_bed_row *from, const int32_t *number, int64_t count)
{
    add_rows(to, particle, from, number, count);
}
