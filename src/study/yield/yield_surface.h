#ifndef GB_STUDY_YIELD_YIELD_SURFACE_H
#define GB_STUDY_YIELD_YIELD_SURFACE_H

#include <stdbool.h>

#include "greenbody/status.h"
#include "measure/fit.h"
#include "measure/yield_point.h"
#include "scene/field/keep_points.h"

enum { GB_YIELD_DIRECTIONS_MAX = 72, GB_YIELD_REPLICAS_MAX = 1000 };

/* What a yield surface says in one number each.  Angles in degrees. */
enum gb_yield_surface_quantity {
    GB_YIELD_CENTRE_P, /* of the fitted ellipse, Pa */
    GB_YIELD_CENTRE_Q,
    GB_YIELD_HALF_P,
    GB_YIELD_HALF_Q,
    GB_YIELD_TENSION, /* where the ellipse meets the p axis, Pa: centre less half axis ... */
    GB_YIELD_PRESSURE,  /* ... and centre plus half axis */
    GB_YIELD_SHIFT,     /* centre over half axis along p; above 0: towards compression */
    GB_YIELD_MISFIT,    /* rms distance of the points from the ellipse, relative */
    GB_YIELD_ANGLE_RMS, /* between flow and normal, over all directions */
    GB_YIELD_ANGLE_NOISE, /* rms of the errors of these angles: what flow along the normal
                           * would show as rms */
    GB_YIELD_FLOW_DEVIATION, /* mean angle from the normal to the flow, positive towards
                              * +p; without the directions along the p axis.  0 for flow
                              * along the normal */
    GB_YIELD_DILATANCY_COMPRESSION, /* -dv/|dw| of plastic flow along +q at constant p */
    GB_YIELD_DILATANCY_EXTENSION,   /* the same along -q */
    GB_YIELD_QUANTITIES
};

/* A row of the table of quantities. */
struct gb_yield_surface_row {
    const char *name, *unit;
    double factor; /* to the unit */
};
extern const struct gb_yield_surface_row gb_yield_surface_rows[GB_YIELD_QUANTITIES];

/* One direction of loading, over the cells. */
struct gb_yield_surface_direction {
    struct gb_yield_point mean;    /* replica 0 */
    int cells;                     /* that reached the offset */
    struct gb_fit_value angle;     /* of the flow from the outward normal, degrees */
    struct gb_fit_value dilatancy; /* -dv/|dw| */
};

/* The yield surface of a compact at one offset.  Errors and 95 % intervals by the jackknife
 * over the cells (Student's t); NaN with fewer than two. */
struct gb_yield_surface {
    struct gb_keep_point mark;
    double offset;
    struct gb_fit_value density, top_p, top_q; /* of the compact; Pa */
    int cells, directions;
    struct gb_yield_surface_direction direction[GB_YIELD_DIRECTIONS_MAX];
    struct gb_fit_value quantity[GB_YIELD_QUANTITIES];
};

/* The points of one compact and offset: cells x directions, p_pa NaN where there is none;
 * the stresses of the compacts. */
struct gb_yield_surface_data {
    const struct gb_yield_point *point;
    const double *top_p, *top_q; /* of each cell, Pa; NaN: the cell failed */
    int cells, directions;
};

/* A direction counts where half of the cells or more reached the offset.  Errors:
 * GB_ERR_MEMORY; a surface that cannot be fitted has quantities NaN. */
bool gb_yield_surface_measure(struct gb_yield_surface *surface,
                              const struct gb_yield_surface_data *data,
                              struct gb_error *err);

#endif
