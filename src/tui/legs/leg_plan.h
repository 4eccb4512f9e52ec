#ifndef GB_TUI_LEGS_LEG_PLAN_H
#define GB_TUI_LEGS_LEG_PLAN_H

#include "scene/path/path.h"

/* The path that follows from the text alone: what the packing decides is NaN.  A packing
 * under isotropic strain is taken for isotropic, one that was not sheared for free of shear
 * stress. */
enum { GB_LEG_PLAN_STATES = 5 * GB_PATH_LEGS_MAX + 1 };

struct gb_leg_plan_state {
    int leg;       /* from 1; 0: before the first */
    double p, q;   /* Pa */
    double strain; /* of the component that leads this leg, since the leg began */
};

struct gb_leg_plan {
    int count;
    struct gb_leg_plan_state state[GB_LEG_PLAN_STATES];
};

void gb_leg_plan_make(struct gb_leg_plan *plan, const struct gb_path *path,
                      int dimension);

#endif
