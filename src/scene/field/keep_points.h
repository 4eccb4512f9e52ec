#ifndef GB_SCENE_KEEP_POINTS_H
#define GB_SCENE_KEEP_POINTS_H

#include "greenbody/params.h"

/* Points of a run at which a state is kept (output.snapshots_at): "100 MPa; 1 GPa;
 * density = 0.5; every 20".  The last one means every 20th recorded point. */
enum { GB_KEEP_POINTS_MAX = 16 };

struct gb_keep_point {
    bool by_density;
    double value; /* Pa, or density */
};

struct gb_keep_points {
    int count;
    struct gb_keep_point point[GB_KEEP_POINTS_MAX];
    int64_t every; /* recorded points; 0: none */
};

/* Errors: GB_ERR_INPUT naming the entry and what is expected. */
bool gb_keep_points_parse(const char *text, struct gb_keep_points *points,
                          struct gb_error *err);

/* Does a run reach the point as its largest pressure (Pa) or density on loading rises
 * from `before` to `now`?  Loading ends at such values, so a density is compared within
 * rounding, and a pressure of a run with legs within the tolerance of the leg's end. */
bool gb_keep_points_reached(const struct gb_keep_point *point,
                            const struct gb_params *params, double before, double now);

#endif
