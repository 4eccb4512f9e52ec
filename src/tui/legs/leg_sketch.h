#ifndef GB_TUI_LEGS_LEG_SKETCH_H
#define GB_TUI_LEGS_LEG_SKETCH_H

#include "scene/path/path.h"
#include "tui/plot/plot.h"

/* The planned path into a plot of its size: in the (p, q) plane where leg `focus` (from 1)
 * or, for 0, any leg follows from the text; else the strain of the leading component of
 * each leg; else a sentence.  The number of a leg stands at its end. */
void gb_leg_sketch_draw(const struct gb_path *path, int dimension, int focus,
                        struct gb_plot *plot);

/* '1' to '9', then 'a' to 'o': the mark of a leg (from 1), also without colours. */
int gb_leg_sketch_mark(int leg);

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

void gb_leg_sketch_plan(struct gb_leg_plan *plan, const struct gb_path *path,
                        int dimension);

#endif
