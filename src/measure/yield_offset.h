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

/* Slopes of p and q against a strain along a path in which that strain alone grows, by least
 * squares through row 0 over the rows up to `range`; by: the strain, volume or shear. */
void gb_yield_offset_slopes(const struct gb_yield_path *path, const double *by,
                            double range, double slope[2]);
/* Compliance from the slopes along a path of volume strain and one of shear.  False: they
 * are no stiffness. */
bool gb_yield_offset_elastic(struct gb_yield_elastic *elastic, const double by_volume[2],
                             const double by_shear[2]);

/* Where the plastic strain, total less elastic, first reaches the offset, as the larger of
 * |volume| and |shear|, by linear interpolation between rows.  Fills stresses (unit of the
 * path), flow and direction.  The flow is the increment of plastic strain while its measure
 * grows from (1 - GB_YIELD_FLOW_SHARE) to (1 + GB_YIELD_FLOW_SHARE) of the offset, or to the
 * end of the path.  False: the path ends before the offset. */
#define GB_YIELD_FLOW_SHARE 0.5
bool gb_yield_offset_find(const struct gb_yield_path *path,
                          const struct gb_yield_elastic *elastic, double offset,
                          struct gb_yield_point *point);

#endif
