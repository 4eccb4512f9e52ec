#ifndef GB_TUI_SESSION_OVERLAY_PREVIOUS_CURVE_H
#define GB_TUI_SESSION_OVERLAY_PREVIOUS_CURVE_H

#include "greenbody/curve.h"
#include "greenbody/params.h"
#include "tui/session/params_diff.h"

enum { GB_CURVE_NAME = 40, GB_CURVE_COLOURS = 5 /* besides that of the run */ };

/* How a curve is called and drawn; a run keeps it when it is shown again. */
struct gb_curve_label {
    char marker;              /* 'a', 'b', ...: marker in the plot; 0: none yet */
    int colour;               /* 1 to GB_CURVE_COLOURS; 0: dim */
    bool pinned;              /* stays among the previous curves */
    bool hidden;              /* not drawn and in no table */
    char name[GB_CURVE_NAME]; /* given by the user; "": its differences are its name */
};

/* Curve of a replaced run or quick cell, as the plot shows it. */
struct gb_previous_curve {
    struct gb_params params;
    struct gb_curve_label label;
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
