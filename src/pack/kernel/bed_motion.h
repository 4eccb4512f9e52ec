#ifndef GB_PACK_KERNEL_BED_MOTION_H
#define GB_PACK_KERNEL_BED_MOTION_H

#include <stdint.h>

#include "pack/kernel/bed_batch.h"

/* Velocities and positions of the particles of a bed, in rows (bed_batch.h). */

/* Steady motion that began at `from` a time ago. */
struct gb_bed_motion_course {
    const gb_bed_row *from, *velocity;
    double time;
};

/* Central differences of positions x: x += step v.  Returns the sum of the squares of the
 * largest components of the new distance from a course, a bound of its squares that needs no
 * square of every particle. */
double gb_bed_motion_drift(gb_bed_row *x, const gb_bed_row *v, int64_t count, double step,
                           const struct gb_bed_motion_course *course);

/* What changes velocities and rolls (pack/die/bed.h). */
struct gb_bed_motion_kick {
    const gb_bed_row *force, *moment;
    const double *inverse_mass;
    double inertia; /* over m R^2 */
    double step;
    double gravity; /* along -z */
    double drag;    /* speed lost per time */
};

/* v += step force/m and roll += step moment/(m inertia).  Returns a bound of the
 * speed of the fastest particle, from the largest components. */
double gb_bed_motion_kick(gb_bed_row *v, gb_bed_row *roll, int64_t count,
                          const struct gb_bed_motion_kick *by);

/* to[particle[e]] += from[number[e]] for e below count, in that order; no row of `from` is one
 * of `to`. */
void gb_bed_motion_add_rows(gb_bed_row *to, const int32_t *particle,
                            const gb_bed_row *from, const int32_t *number, int64_t count);

#endif
