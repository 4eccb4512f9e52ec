#ifndef GB_MEASURE_YIELD_POINT_H
#define GB_MEASURE_YIELD_POINT_H

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

#endif
