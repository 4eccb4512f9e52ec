#ifndef GB_MEASURE_CAP_CAP_SIDE_H
#define GB_MEASURE_CAP_CAP_SIDE_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"
#include "measure/cap/cap.h"
#include "measure/yield_point.h"

/* The points of one side of a surface, not owned; gb_alloc_free of the list. */
struct gb_cap_side {
    const struct gb_yield_point **point;
    size_t count;
    bool weighted; /* all points have errors; not where flow counts, too */
    double flow; /* an angle between flow and normal of 1 rad counts like a distance from
                    * the surface of flow times the largest pressure; 0: it does not */
};

enum { GB_CAP_SIDE_FREE = 2 }; /* R and p_a */

struct gb_cap_side_found {
    double r, p_a;
    double cov[GB_CAP_SIDE_FREE][GB_CAP_SIDE_FREE]; /* of R and p_a, the line given */
    double squares;                                 /* weighted */
};

/* R and p_a of the cap through points (2 or more), and normal to their flow, beside a given shear failure line, by
 * Levenberg and Marquardt.  line: d, beta and a.  Errors: GB_ERR_INPUT (no point at a
 * pressure above 0), GB_ERR_NOT_CONVERGED, GB_ERR_MEMORY. */
bool gb_cap_side_fit(struct gb_cap_side_found *found, const struct gb_cap_side *side,
                     const struct gb_cap *line, struct gb_error *err);

/* sqrt((p - p_a)^2 + (R q/k)^2) of a point; R D on the cap. */
double gb_cap_side_radius(const struct gb_cap *cap, const struct gb_yield_point *point);
/* Standard error of that radius, from the errors of p and q. */
double gb_cap_side_radius_error(const struct gb_cap *cap,
                                const struct gb_yield_point *point);

#endif
