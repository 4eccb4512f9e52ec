#ifndef GB_MEASURE_YIELD_POINT_H
#define GB_MEASURE_YIELD_POINT_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"

/* A point of a yield surface in the plane of p = tr/3 and q = p_z - (p_x + p_y)/2, pressures
 * positive in compression.  Strains are conjugate to them: p dv + q dw is the work per
 * volume, v = e_x + e_y + e_z and w = 2/3 (e_z - (e_x + e_y)/2), logarithmic. */
struct gb_yield_point {
    double density;                 /* of the compact, before it was unloaded */
    double p_pa, q_pa;              /* q < 0: extension */
    double flow_volume, flow_shear; /* plastic strain increments, compression positive;
                                     * shear has the sign of q */
    double p_error_pa, q_error_pa;  /* standard errors; NaN for the point of one cell */
    int replica;                    /* from 1; 0: the mean of all */
    double direction;               /* of loading, rad in the (p, q) plane */
};

/* Stresses (any unit) and strains along a loading path from a state inside the yield
 * surface, which is row 0; symbols as in struct gb_yield_point. */
struct gb_yield_path {
    const double *p, *q, *volume, *shear;
    size_t count;
    double direction; /* of loading, rad */
};

/* Elastic strain (v, w) per stress (p, q). */
struct gb_yield_elastic {
    double compliance[2][2];
};

/* Compliance from the slopes of p and q by volume strain alone and by shear strain alone.
 * False: they are no stiffness. */
bool gb_yield_point_elastic(struct gb_yield_elastic *elastic, const double by_volume[2],
                            const double by_shear[2]);

/* Where the plastic strain, total less elastic, first reaches the offset, as the larger of
 * |volume| and |shear|, by linear interpolation between rows.  Strain that opposes the
 * direction of loading does not count: it comes from an elastic response that stiffens.  Fills stresses (unit of the
 * path), flow and direction.  The flow is the increment of plastic strain while its measure
 * grows from GB_YIELD_FLOW_BEGIN to flow_end (1 or more) of the offset, or to the end of the
 * path.  False: the path ends before the offset. */
#define GB_YIELD_FLOW_BEGIN 0.5
bool gb_yield_point_find(const struct gb_yield_path *path,
                         const struct gb_yield_elastic *elastic, double offset,
                         double flow_end, struct gb_yield_point *point);

/* An ellipse with axes along p and q: ((p - centre_p)/half_p)^2 +
 * ((q - centre_q)/half_q)^2 = 1; any unit of stress. */
struct gb_ellipse {
    double centre_p, centre_q, half_p, half_q;
    double
        misfit; /* rms of the relative distance of the points along rays from the centre */
};

/* Least squares in the relative distance along rays from the centre, by Levenberg and
 * Marquardt (GSL), from the box of the points on.  Errors: GB_ERR_INPUT (fewer points than
 * parameters, points on a line), GB_ERR_NOT_CONVERGED, GB_ERR_MEMORY. */
bool gb_yield_point_ellipse(struct gb_ellipse *ellipse, const double *p, const double *q,
                            size_t count, struct gb_error *err);

/* Direction of the outward normal, rad, of the ellipse of this family through a point. */
double gb_yield_point_ellipse_normal(const struct gb_ellipse *ellipse, double p,
                                     double q);

#endif
