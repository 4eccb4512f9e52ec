#ifndef GB_SCENE_KEEP_POINTS_H
#define GB_SCENE_KEEP_POINTS_H

#include "greenbody/params.h"

/* At which points of a run a state is kept (output.snapshots_at): "100 MPa; 1 GPa;
 * density = 0.5; every 20", the last for each 20th recorded point. */
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

/* Errors: GB_ERR_INPUT, naming the entry and what is accepted. */
bool gb_keep_points_parse(const char *text, struct gb_keep_points *points,
                          struct gb_error *err);

/* Whether a run reaches the point: its pressure (Pa) or density, the largest so far on
 * loading, rises from before to now.  Ends of loading are points, so a density counts within
 * rounding, and a pressure of a run by legs within their tolerance. */
bool gb_keep_points_reached(const struct gb_keep_point *point,
                            const struct gb_params *params, double before, double now);

#endif
