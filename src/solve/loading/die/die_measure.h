#ifndef GB_SOLVE_LOADING_DIE_DIE_MEASURE_H
#define GB_SOLVE_LOADING_DIE_DIE_MEASURE_H

#include "greenbody/stage.h"
#include "solve/loading/die/die_state.h"

/* How far a die scene has come, for displays: nothing depends on it. */

/* Stage, measure, value, goal, share, timed and poured; lengths in d, pressures in E, times
 * in T.  Right after an evaluation. */
void gb_die_measure_stage(const struct gb_die_stages *stages, const struct gb_bed *bed,
                          struct gb_stage_report *report);

/* Share of the whole run that is done, 0 to 1. */
double gb_die_measure_progress(const struct gb_die_stages *stages,
                               const struct gb_bed *bed);

#endif
