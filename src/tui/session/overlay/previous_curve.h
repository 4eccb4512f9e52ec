#ifndef GB_TUI_SESSION_OVERLAY_PREVIOUS_CURVE_H
#define GB_TUI_SESSION_OVERLAY_PREVIOUS_CURVE_H

#include "greenbody/curve.h"
#include "greenbody/params.h"
#include "tui/session/params_diff.h"

/* Curve of a replaced run or quick cell, as the plot shows it. */
struct gb_previous_curve {
    struct gb_params params;
    char marker;                          /* 'a', 'b', ...: marker in the plot */
    bool quick;                           /* of a quick cell */
    char difference[GB_PARAMS_DIFF_TEXT]; /* its different values */
    size_t count;
    double *density, *pressure_pa; /* NaN between branches */
    bool *loading;                 /* no unloading branch */
    double *elapsed;               /* gb_previous_curve_elapsed of the points */
};

/* Copies the first `count` points; false: out of memory. */
bool gb_previous_curve_copy(struct gb_previous_curve *previous,
                            const struct gb_params *params, const struct gb_curve *curve,
                            size_t count);
void gb_previous_curve_finish(struct gb_previous_curve *previous);

/* Time coordinate of a point: simulated ns of a dynamic run, number of the recorded step
 * of a quasi-static one. */
double gb_previous_curve_elapsed(int kind, const struct gb_point *point);

#endif
