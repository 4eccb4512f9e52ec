#ifndef GB_MEASURE_YIELD_OFFSET_H
#define GB_MEASURE_YIELD_OFFSET_H

#include <stdbool.h>
#include <stddef.h>

#include "measure/yield_point.h"

/* Stresses (any unit) and strains along a loading path from a state inside the yield
 * surface, which is row 0; symbols as in measure/yield_point.h. */
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
bool gb_yield_offset_elastic(struct gb_yield_elastic *elastic, const double by_volume[2],
                             const double by_shear[2]);

/* Where the plastic strain, total less elastic, first reaches the offset, as the larger of
 * |volume| and |shear|, by linear interpolation between rows.  Strain that opposes the
 * direction of loading does not count: it comes from an elastic response that stiffens.  Fills stresses (unit of the
 * path), flow and direction.  The flow is the increment of plastic strain while its measure
 * grows from GB_YIELD_FLOW_BEGIN to flow_end (1 or more) of the offset, or to the end of the
 * path.  False: the path ends before the offset. */
#define GB_YIELD_FLOW_BEGIN 0.5
bool gb_yield_offset_find(const struct gb_yield_path *path,
                          const struct gb_yield_elastic *elastic, double offset,
                          double flow_end, struct gb_yield_point *point);

#endif
