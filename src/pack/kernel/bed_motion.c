#include "pack/kernel/bed_motion.h"

#include <math.h>

#include "pack/kernel/simd.h"

/* A row is one vector; the compiler divides it where the processor has shorter ones, with
 * the same bits.  Macros, for a function that returns such a vector has another calling
 * convention on every level. */
typedef double row __attribute__((vector_size(32), aligned(8), may_alias));
typedef int64_t bits __attribute__((vector_size(32), aligned(8), may_alias));

#define ROW(rows, i)  (*(row *)(rows)[i])
#define READ(rows, i) (*(const row *)(rows)[i])

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
        ROW(x, i) = now;
        LARGER_MAGNITUDE((now - READ(from, i)) - time * READ(steady, i), most);
    }
    *deviation2 = square((const double *)&most);
}
GB_SIMD_WIDTHS(drift,
               (gb_bed_row * x, const gb_bed_row *v, int64_t count, double step,
                const struct gb_bed_motion_course *course, double *deviation2),
               (x, v, count, step, course, deviation2))

double gb_bed_motion_drift(gb_bed_row *x, const gb_bed_row *v, int64_t count, double step,
                           const struct gb_bed_motion_course *course)
{
    double deviation2;
    drift(x, v, count, step, course, &deviation2);
    return deviation2;
}

GB_SIMD_LOOP void kick_loop(gb_bed_row *restrict v, gb_bed_row *restrict roll,
                            int64_t count, const struct gb_bed_motion_kick *by,
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
        ROW(v, i) = speed;
        ROW(roll, i) = slow * READ(roll, i) + (rolled * mass[i]) * READ(moment, i);
        LARGER_MAGNITUDE(speed, most);
    }
    *fastest2 = square((const double *)&most);
}
GB_SIMD_WIDTHS(kick,
               (gb_bed_row * v, gb_bed_row *roll, int64_t count,
                const struct gb_bed_motion_kick *by, double *fastest2),
               (v, roll, count, by, fastest2))

double gb_bed_motion_kick(gb_bed_row *v, gb_bed_row *roll, int64_t count,
                          const struct gb_bed_motion_kick *by)
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
        ROW(to, particle[e]) += READ(from, number[e]);
    }
}
GB_SIMD_WIDTHS(add_rows,
               (gb_bed_row * to, const int32_t *particle, const gb_bed_row *from,
                const int32_t *number, int64_t count),
               (to, particle, from, number, count))

void gb_bed_motion_add_rows(gb_bed_row *to, const int32_t *particle,
                            const gb_bed_row *from, const int32_t *number, int64_t count)
{
    add_rows(to, particle, from, number, count);
}
