#include "pack/kernel/bed_motion.h"

#include <math.h>
#include <string.h>

#include "pack/kernel/simd.h"

/* A row is one vector; the compiler divides it where the processor has shorter ones, with
 * the same bits. */
typedef double row __attribute__((vector_size(32)));
typedef int64_t bits __attribute__((vector_size(32)));

GB_SIMD_LOOP row load(const double *from)
{
    row x;
    memcpy(&x, from, sizeof x);
    return x;
}

GB_SIMD_LOOP void store(double *to, row x)
{
    memcpy(to, &x, sizeof x);
}

/* The larger of |x| and most; most where x is not a number. */
GB_SIMD_LOOP row larger_magnitude(row x, row most)
{
    const bits sign = (bits)(row){-0.0, -0.0, -0.0, -0.0};
    const row size = (row)((bits)x & ~sign);
    const bits larger = size > most;
    return (row)(((bits)size & larger) | ((bits)most & ~larger));
}

GB_SIMD_LOOP double square(row x)
{
    return x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
}

GB_SIMD_LOOP void drift_loop(gb_bed_row *restrict x, const gb_bed_row *restrict v,
                             const gb_bed_row *restrict from, int64_t count, double step,
                             double *moved2)
{
    row most = {0.0, 0.0, 0.0, 0.0};
    for (int64_t i = 0; i < count; i++) {
        const row now = load(x[i]) + step * load(v[i]);
        store(x[i], now);
        most = larger_magnitude(now - load(from[i]), most);
    }
    *moved2 = square(most);
}
GB_SIMD_WIDTHS(drift,
               (gb_bed_row * x, const gb_bed_row *v, const gb_bed_row *from,
                int64_t count, double step, double *moved2),
               (x, v, from, count, step, moved2))

double gb_bed_motion_drift(gb_bed_row *x, const gb_bed_row *v, const gb_bed_row *from,
                           int64_t count, double step)
{
    double moved2;
    drift(x, v, from, count, step, &moved2);
    return moved2;
}

GB_SIMD_LOOP void kick_loop(gb_bed_row *restrict v, gb_bed_row *restrict w, int64_t count,
                            const struct gb_bed_motion_kick *by, double *fastest2)
{
    const double step = by->step, slow = fmax(1.0 - step * by->drag, 0.0);
    const row fall = {0.0, 0.0, -by->gravity * step, 0.0};
    const gb_bed_row *restrict force = by->force, *restrict torque = by->torque;
    const double *restrict mass = by->inverse_mass, *restrict inertia =
                                                        by->inverse_inertia;
    row most = {0.0, 0.0, 0.0, 0.0};
    for (int64_t i = 0; i < count; i++) {
        const row speed = slow * load(v[i]) + ((step * mass[i]) * load(force[i]) + fall);
        store(v[i], speed);
        store(w[i], slow * load(w[i]) + (step * inertia[i]) * load(torque[i]));
        most = larger_magnitude(speed, most);
    }
    *fastest2 = square(most);
}
GB_SIMD_WIDTHS(kick,
               (gb_bed_row * v, gb_bed_row *w, int64_t count,
                const struct gb_bed_motion_kick *by, double *fastest2),
               (v, w, count, by, fastest2))

double gb_bed_motion_kick(gb_bed_row *v, gb_bed_row *w, int64_t count,
                          const struct gb_bed_motion_kick *by)
{
    double fastest2;
    kick(v, w, count, by, &fastest2);
    return sqrt(fastest2);
}
