#ifndef GB_PACK_BATCH_LAWS_H
#define GB_PACK_BATCH_LAWS_H

#include <math.h>

#include "pack/batch.h"

/* How these loops are written: conditions choose between values that are there already
 * and masks (1 or 0) multiply, so that no lane needs a branch; a hidden one (&&, or an
 * expensive branch of ?:) would send the whole loop back to one contact at a time.
 *
 * One source, compiled once per useful combination of terms and per vector width: every
 * `const bool` below is a constant where the function is inlined.  Nothing but the order
 * of lanes differs between the widths (contraction is off), so they give the same bits.
 */
#define INLINE static inline __attribute__((always_inline))

struct terms {
    bool planar, friction, bridges, viscous;
};

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

/* Squared overlap whose root is twice the spring radius.  printed: 1 where a_ch follows
 * the printed form at the current r, 0 where it belongs to r_min. */
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

/* f_n along the normal: elastic line or rod law minus adhesion, or the pull across a gap.
 */
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

#endif
