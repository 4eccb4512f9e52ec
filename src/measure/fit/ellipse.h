#ifndef GB_MEASURE_FIT_ELLIPSE_H
#define GB_MEASURE_FIT_ELLIPSE_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"

/* An ellipse with axes along p and q: ((p - centre_p)/half_p)^2 +
 * ((q - centre_q)/half_q)^2 = 1; any unit of stress. */
struct gb_ellipse {
    double centre_p, centre_q, half_p, half_q;
    double
        misfit; /* rms of the relative distance of the points along rays from the centre */
};

enum { GB_ELLIPSE_PARAMETERS = 4 };

/* Least squares in the relative distance along rays from the centre, by Levenberg and
 * Marquardt (GSL), from the box of the points on.  Errors: GB_ERR_INPUT (fewer points than
 * parameters, points on a line), GB_ERR_NOT_CONVERGED, GB_ERR_MEMORY. */
bool gb_ellipse_fit(struct gb_ellipse *ellipse, const double *p, const double *q,
                    size_t count, struct gb_error *err);

/* Direction of the outward normal, rad, of the ellipse of this family through a point. */
double gb_ellipse_normal(const struct gb_ellipse *ellipse, double p, double q);

#endif
