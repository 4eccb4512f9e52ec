#ifndef GB_STUDY_CHART_CHART_PLAN_H
#define GB_STUDY_CHART_CHART_PLAN_H

#include <stdbool.h>
#include <stddef.h>

#include "study/chart/chart.h"

/* The settings of a chart, in the order of their simulation. */
struct gb_chart_plan {
    struct gb_params params;          /* the scene */
    struct gb_chart_setting *setting; /* [0] is the reference, [1] the preset's own */
    size_t settings;
    double pressure_pa[GB_CHART_PRESSURES]; /* ascending */
    int pressures;
    int seeds; /* params.seed, params.seed + 1, ... */
};

/* Plans the chart of a scene.
 *
 * vary       NULL-terminated "group.key=a,b,c" (loading.step, without parts;
 * numerics.relaxer, tolerance, cutoff, time_step, step_error, particles.count): all
 * combinations, other keys as in the preset.  NULL: a plan by kind of scene: strain steps x
 * tolerances of each fast relaxer, a few cutoffs and cell sizes, P1's relaxer twice.
 * reference  NULL-terminated "group.key=value" that replace values of the reference
 * pressures  "100 MPa; 1 GPa", or NULL: those of unloading, and the final one
 * Errors: GB_ERR_INPUT. */
bool gb_chart_plan_init(struct gb_chart_plan *plan, const struct gb_params *params,
                        const char *const *vary, const char *const *reference,
                        const char *pressures, int seeds, struct gb_error *err);
void gb_chart_plan_finish(struct gb_chart_plan *plan); /* zeroed is fine */

/* Rough relative cost of a run, by which the settings are sorted. */
double gb_chart_plan_effort(const struct gb_chart_setting *setting);

#endif
