#include "measure/fit/compaction/equation_profile.h"

#include <math.h>
#include <string.h>

#include "measure/fit/compaction/equation_iterate.h"

/* A linear interval stands where the root of the rise of the sum of squares at its ends
 * is within this share of its quantile. */
static const double linear_enough = 0.05;

/* Of the quantile, at an end of a profile interval. */
static const double end_tolerance = 0.005;

enum { DOUBLINGS = 20, STEPS = 60 };

/* Positive parameters this many factors of e away are not bounded. */
static const double farthest_logarithm = 12.0;

/* Profile of one parameter. */
struct profile {
    struct gb_equation_fit *fit;
    const struct gb_equations_points *points;
    size_t k;
    double x[GB_EQUATIONS_PARAMETERS]; /* of the last value inside: the next start */
    struct gb_error *err;
    bool good; /* memory */
};

/* Root of the rise of the sum of squares in units of the variance, with parameter k held
 * at a coordinate; infinite where no other parameters give densities. */
static double rise(struct profile *profile, double coordinate)
{
    const struct gb_equation *equation = profile->fit->equation;
    double x[GB_EQUATIONS_PARAMETERS];
    struct gb_equation_iterate iterate = {.equation = equation,
                                          .points = profile->points,
                                          .fixed = (int)profile->k,
                                          .x = x};
    memcpy(x, profile->x, sizeof x);
    x[profile->k] = gb_equation_iterate_value(equation, profile->k, coordinate);
    if (!gb_equation_iterate(&iterate, profile->err)) {
        profile->good = false;
        return INFINITY;
    }
    if (!isfinite(iterate.squares)) {
        return INFINITY;
    }
    const double above =
        sqrt(fmax(iterate.squares - profile->fit->squares, 0.0) / profile->fit->variance);
    if (above < profile->fit->quantile) {
        memcpy(profile->x, x, sizeof x);
    }
    return above;
}

/* The coordinate between `inside` and `outside` where the rise is the quantile. */
static double bisect(struct profile *profile, double inside, double outside)
{
    const double wanted = profile->fit->quantile;
    double below = 0.0;
    double above = INFINITY;
    for (int i = 0; i < STEPS && profile->good; i++) {
        /* the rise is almost linear: interpolation, kept away from the ends */
        double share = isfinite(above) ? (wanted - below) / (above - below) : 0.5;
        share = fmin(fmax(share, 0.1), 0.9);
        const double middle = inside + share * (outside - inside);
        const double here = rise(profile, middle);
        if (fabs(here - wanted) < end_tolerance * wanted || middle == inside) {
            return middle;
        }
        if (here < wanted) {
            inside = middle;
            below = here;
        } else {
            outside = middle;
            above = here;
        }
    }
    return 0.5 * (inside + outside);
}

/* The end of the interval, as a coordinate, on the side of `half`. */
static double find_end(struct profile *profile, double at, double half)
{
    const bool positive =
        gb_equations_parameter(profile->fit->equation, profile->k)->positive;
    double inside = at;
    double step = half;
    memcpy(profile->x, profile->fit->x, sizeof profile->x);
    for (int i = 0; i < DOUBLINGS && profile->good; i++) {
        if (positive && fabs(step) > farthest_logarithm) {
            break;
        }
        if (rise(profile, at + step) >= profile->fit->quantile) {
            return bisect(profile, inside, at + step);
        }
        inside = at + step;
        step *= 2.0;
    }
    return half > 0.0 ? INFINITY : -INFINITY;
}

/* The rise at both ends of the linear interval. */
static bool is_linear(struct profile *profile, double at, double half)
{
    const double wanted = profile->fit->quantile;
    for (int side = -1; side <= 1; side += 2) {
        memcpy(profile->x, profile->fit->x, sizeof profile->x);
        if (!(fabs(rise(profile, at + side * half) - wanted) < linear_enough * wanted)) {
            return false;
        }
    }
    return true;
}

bool gb_equation_profile(struct gb_equation_fit *fit,
                         const struct gb_equations_points *points, struct gb_error *err)
{
    struct profile profile = {.fit = fit, .points = points, .err = err, .good = true};
    for (size_t k = 0; k < fit->size && profile.good; k++) {
        const struct gb_equation *equation = fit->equation;
        struct gb_fit_value *value = &fit->value[k];
        const double at = gb_equation_iterate_coordinate(equation, k, fit->x[k]);
        const double half = gb_equation_iterate_coordinate(equation, k, value->high) - at;
        profile.k = k;
        if (!(half > 0.0) || !isfinite(half)) {
            continue;
        }
        if (!is_linear(&profile, at, half) && profile.good) {
            value->low =
                gb_equation_iterate_value(equation, k, find_end(&profile, at, -half));
            value->high =
                gb_equation_iterate_value(equation, k, find_end(&profile, at, half));
        }
    }
    return profile.good;
}
