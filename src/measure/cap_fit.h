#ifndef GB_MEASURE_CAP_FIT_H
#define GB_MEASURE_CAP_FIT_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"
#include "measure/cap.h"
#include "measure/fit.h"
#include "measure/yield_point.h"

/* How far the points of one side are from the surface, Pa: along q for shear failure, along
 * the radius of the ellipse for the cap. */
struct gb_cap_fit_misses {
    double distance; /* rms */
    double error;    /* rms of the standard errors of the points, seen the same way; NaN
                      * where points have none */
};

/* A cap surface fitted to yield points of one density: d and beta by least squares
 * through the points of shear failure, then R and p_a through those of the cap. */
struct gb_cap_fit {
    struct gb_cap cap;
    struct gb_fit_value d, beta, r, p_a, p_b; /* Pa, rad, 1, Pa, Pa */
    size_t shear_points, cap_points;
    struct gb_cap_fit_misses misses[2]; /* by enum gb_cap_fit_side */
    double rms;                         /* of the distances of both, weighted alike, Pa */
};

/* By plastic flow: points that lose volume lie on the cap, those that grow fail in shear.
 * Where volume grows more than GB_CAP_FIT_TENSION times the shear it is failure in tension,
 * for which the surface has no part: such a point is left out. */
#define GB_CAP_FIT_TENSION 2.0
enum gb_cap_fit_side { GB_CAP_FIT_SHEAR, GB_CAP_FIT_CAP, GB_CAP_FIT_LEFT_OUT };
enum gb_cap_fit_side gb_cap_fit_side_of(const struct gb_yield_point *point);

/* Least squares weighted by the errors of p and q; unknown errors (0 or NaN in any point)
 * weigh alike, and the residuals give the intervals.  Extension counts as compression
 * (K = 1).  The 95 % intervals hold for points that are independent; those of a set of
 * replicas are the caller's, by leaving out one at a time.
 * a     transition, 0 to 0.05
 * flow  weight of the directions of flow in the fit of R and p_a: an angle of 1 rad between
 *       flow and normal counts like a distance of flow times the largest pressure, and all
 *       points of the cap weigh alike; 0: by position alone
 * Errors: GB_ERR_INPUT (fewer than two points of either side, beta not above 0, d not
 * above 0, a cap that does not close), GB_ERR_NOT_CONVERGED, GB_ERR_MEMORY. */
bool gb_cap_fit(struct gb_cap_fit *fit, const struct gb_yield_point *points, size_t count,
                double a, double flow, struct gb_error *err);

#endif
